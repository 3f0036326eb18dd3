// display_list.c: arrays and matrices of display lists; see display_list.h.
#include "maths/maths.h"
#include "picture/display_list_build.h"

#include <math.h>

static const double TURN = 6.283185307179586;

void *display_list_grow(Arena *arena, void *items, uint32_t count, uint32_t *capacity, uint32_t more, size_t size) {
    enum { MIN_SIZE = 16 };
    if (more <= *capacity - count)
        return items;
    if (more > UINT32_MAX / 4 - count)
        arena_exhausted(arena);
    uint32_t wanted = *capacity ? 2 * *capacity : MIN_SIZE;
    wanted = wanted < count + more ? count + more : wanted;
    void *grown = arena_grow(arena, items, *capacity * size, wanted * size);
    *capacity = wanted;
    return grown;
}

DisplayMatrix display_matrix_multiply(DisplayMatrix m, DisplayMatrix a) {
    return (DisplayMatrix){.xx = m.xx * a.xx + m.xy * a.yx,
                           .yx = m.yx * a.xx + m.yy * a.yx,
                           .xy = m.xx * a.xy + m.xy * a.yy,
                           .yy = m.yx * a.xy + m.yy * a.yy,
                           .x0 = m.xx * a.x0 + m.xy * a.y0 + m.x0,
                           .y0 = m.yx * a.x0 + m.yy * a.y0 + m.y0};
}

bool display_matrix_is_invertible(const DisplayMatrix *m) {
    double determinant = m->xx * m->yy - m->xy * m->yx;
    return isfinite(determinant) && determinant != 0 && isfinite(m->x0) && isfinite(m->y0);
}

void display_list_build_transform(DisplayMatrix *matrix, const DrawNode *node, bool after) {
    for (uint32_t i = 0; i < node->attr_count; i++) {
        const double *n = node->attrs[i].as.numbers;
        DisplayMatrix step = {1, 0, 0, 1, 0, 0};
        if (node->attrs[i].name == ATTR_TRANSLATE) {
            step.x0 = n[0];
            step.y0 = n[1];
        } else if (node->attrs[i].name == ATTR_SCALE) {
            step.xx = n[0];
            step.yy = n[1];
        } else if (node->attrs[i].name == ATTR_ROTATE) {
            double angle = (n[0] - floor(n[0])) * TURN;
            step.xx = step.yy = maths_cos(angle);
            step.yx = maths_sin(angle);
            step.xy = -step.yx;
        } else {
            continue;
        }
        *matrix = after ? display_matrix_multiply(step, *matrix) : display_matrix_multiply(*matrix, step);
    }
}
