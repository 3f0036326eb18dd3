// far_errors.c: prints the table of errors of forces with `theta` for the physics reference, as Markdown. The errors
// are measured against all pairs.
//
// far_errors [COUNT]: uses COUNT particles (default: 10000).
#include "maths/maths.h"
#include "physics/system.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static uint64_t random_state = UINT64_C(88172645463325252);

static double uniform(void) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (double)(random_state >> 11) * 0x1p-53;
}

static void place_in_cube(double *position) {
    for (int k = 0; k < 3; k++)
        position[k] = uniform();
}

// Sets a vector of the given length in a random direction.
static void place_on_sphere(double radius, double *position) {
    double square = 2;
    while (square > 1 || square < 1e-6) {
        square = 0;
        for (int k = 0; k < 3; k++) {
            position[k] = 2 * uniform() - 1;
            square += position[k] * position[k];
        }
    }
    for (int k = 0; k < 3; k++)
        position[k] *= radius / sqrt(square);
}

// A Plummer sphere of scale radius 1, without the outermost 0.1 % of its mass.
static void place_in_plummer(double *position) {
    double mass = 1e-9 + 0.999 * uniform();
    place_on_sphere(1 / sqrt(maths_pow(mass, -2.0 / 3) - 1), position);
}

// An exponential disc with a thickness of a tenth of its scale length.
static void place_in_disc(double *position) {
    double radius = -maths_log(1 - 0.999 * uniform()), turn = 6.283185307179586 * uniform();
    position[0] = radius * maths_cos(turn);
    position[1] = radius * maths_sin(turn);
    position[2] = 0.1 * (uniform() + uniform() + uniform() - 1.5);
}

typedef struct Shape {
    const char *name;
    void (*place)(double *position);
    PhysForceKind kind;
} Shape;

// Sets forces[3 * i] to the force on each particle, for the same positions in every call.
static void compute_forces(const Shape *shape, uint32_t count, double theta, double *forces) {
    PhysSystem *system = phys_new();
    if (!system)
        exit(1);
    random_state = UINT64_C(88172645463325252);
    phys_begin(system, 3);
    for (uint32_t i = 0; i < count; i++) {
        double position[3];
        shape->place(position);
        phys_add_particle(system, 0, &(PhysParticle){.position = position, .mass = 1, .charge = i % 2 ? 1 : -1});
    }
    PhysForce force = {.kind = shape->kind, .strength = 1, .theta = theta};
    phys_add_force(system, 0, &force);
    PhysTime time = {.now = 1, .resolution = 1, .lockstep = true};
    if (phys_simulate(system, &time).status != PHYS_OK)
        exit(1);
    for (uint32_t i = 0; i < count; i++)
        for (size_t k = 0; k < 3; k++)
            forces[3 * i + k] = phys_velocity(system, i)[k];
    phys_free(system);
}

static int compare_numbers(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Sets errors[i] to the relative errors of the forces, in ascending order.
static void compute_errors(uint32_t count, const double *found, const double *exact, double *errors) {
    for (uint32_t i = 0; i < count; i++) {
        double difference = 0, square = 0;
        for (size_t k = 3 * (size_t)i; k < 3 * (size_t)i + 3; k++) {
            difference += (found[k] - exact[k]) * (found[k] - exact[k]);
            square += exact[k] * exact[k];
        }
        errors[i] = sqrt(difference / square);
    }
    qsort(errors, count, sizeof *errors, compare_numbers);
}

int main(int argc, char **argv) {
    static const Shape shapes[] = {{"uniform cube", place_in_cube, PHYS_GRAVITY},
                                   {"Plummer sphere", place_in_plummer, PHYS_GRAVITY},
                                   {"disc", place_in_disc, PHYS_GRAVITY},
                                   {"neutral mixture of charges in a cube", place_in_cube, PHYS_ELECTROSTATIC}};
    static const double thetas[] = {0.3, 0.5, 0.7, 0.9};
    uint32_t count = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 10000;
    double *exact = calloc(count, 3 * sizeof *exact), *found = calloc(count, 3 * sizeof *found),
           *errors = calloc(count, sizeof *errors);
    if (!exact || !found || !errors || count < 100)
        return 1;
    puts("| particles | `theta` | median | 99 % | worst |\n|---|---|---|---|---|");
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        compute_forces(&shapes[s], count, 0, exact);
        for (size_t t = 0; t < sizeof thetas / sizeof *thetas; t++) {
            compute_forces(&shapes[s], count, thetas[t], found);
            compute_errors(count, found, exact, errors);
            printf("| %s | %g | %.1e | %.1e | %.1e |\n", shapes[s].name, thetas[t], errors[count / 2],
                   errors[(uint64_t)count * 99 / 100], errors[count - 1]);
        }
    }
    free(exact);
    free(found);
    free(errors);
    return 0;
}
