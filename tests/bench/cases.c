// cases.c: see cases.h.
#include "cases.h"

#include <string.h>

#define DISH(n)                                                                                                        \
    { "dish " #n, "petri_n" #n ".fl", "dish", n, 1, 60, PER_PAIR, LIMIT_PAIRS_2D, NULL, 0, 0 }
#define BOX(n)                                                                                                         \
    { "packed box " #n, "box_n" #n ".fl", "box", n, 1, 60, PER_STEP, LIMIT_NONE, NULL, 0, 0 }
#define GRAVITY(n)                                                                                                     \
    { "gravity " #n, "gravity_n" #n ".fl", "gravity", n, 1, 60, PER_PAIR, LIMIT_PAIRS_3D, NULL, 0, 0 }
#define SCRIPT(n)                                                                                                      \
    { "script " #n, "script_n" #n ".fl", "script", n, 1, 60, PER_PARTICLE, LIMIT_NONE, NULL, 0, 0 }
// Rows "x10" run at 5 frames per second. A frame is then 0.06 s of simulated time, which is ten steps of the scripts'
// resolution, 0.006.
#define DISCS(n, side, steps)                                                                                          \
    {"soft discs " #n, "soft2d_n" #n ".fl", "discs", n, 1, 60, PER_STEP, LIMIT_DISCS, "soft2d", side, steps}, {        \
        "soft discs " #n " x10", "soft2d_n" #n ".fl", "discs", n, 10, 5, PER_STEP, LIMIT_DISCS, "soft2d", side, steps  \
    }
#define SPHERES(n, side, steps)                                                                                        \
    {"soft spheres " #n, "soft3d_n" #n ".fl", "spheres", n, 1, 60, PER_STEP, LIMIT_SPHERES, "soft3d", side, steps}, {  \
        "soft spheres " #n " x10", "soft3d_n" #n ".fl", "spheres", n, 10, 5, PER_STEP, LIMIT_SPHERES, "soft3d", side,  \
            steps                                                                                                      \
    }

// clang-format off
const Case cases[] = {
    DISH(50), DISH(200), DISH(1000), DISH(4000),
    BOX(200), BOX(1000), BOX(4000),
    GRAVITY(200), GRAVITY(1000), GRAVITY(4000),
    SCRIPT(500), SCRIPT(2000),
    DISCS(10000, 100, 1000), DISCS(99856, 316, 200), DISCS(1000000, 1000, 30),
    SPHERES(10648, 22, 500), SPHERES(97336, 46, 100), SPHERES(1000000, 100, 15),
};
// clang-format on
const size_t case_count = sizeof cases / sizeof *cases;

size_t case_find(const char *name) {
    size_t i = 0;
    while (i < case_count && strcmp(cases[i].name, name) != 0)
        i++;
    return i;
}

size_t case_before(size_t index) {
    const Case *c = &cases[index];
    for (size_t i = index; i-- > 0;)
        if (!strcmp(cases[i].family, c->family) && cases[i].steps == c->steps)
            return i;
    return case_count;
}
