// far.c: the benchmark of forces with `theta` in lib/physics, beside all pairs in the same run.
//
//   bench_far [--quick] [--peer=MILLISECONDS]
//
// --quick: only up to 10000 particles. --peer: milliseconds of a tick of d3-force-3d (peers/d3_force.mjs). Particles
// are spread uniformly in a cube. Errors are measured for 500 particles against a plain sum over all others.
#include "physics/system.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { SAMPLES = 500 };

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static double uniform(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (double)(*state >> 11) * 0x1p-53;
}

static double resident_bytes(void) {
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file) {
        if (fscanf(file, "%*d %ld", &pages) != 1)
            pages = 0;
        fclose(file);
    }
    return (double)pages * (double)sysconf(_SC_PAGESIZE);
}

static PhysSystem *make_system(uint32_t count, double theta, int threads) {
    uint64_t state = UINT64_C(88172645463325252);
    PhysSystem *system = phys_new();
    if (!system)
        exit(1);
    phys_set_options(system, &(PhysOptions){.threads = threads, .cpu = cpu_detected.level});
    phys_begin(system, 3);
    phys_expect_particles(system, count);
    for (uint32_t i = 0; i < count; i++) {
        double position[3];
        for (int k = 0; k < 3; k++)
            position[k] = uniform(&state);
        phys_add_particle(system, 0, &(PhysParticle){.position = position, .mass = 1});
    }
    PhysForce gravity = {.kind = PHYS_GRAVITY, .strength = 1e-20, .theta = theta};
    phys_add_force(system, 0, &gravity);
    return system;
}

static void take_steps(PhysSystem *system, int steps) {
    PhysTime time = {.now = steps, .resolution = 1, .lockstep = true};
    if (phys_simulate(system, &time).status != PHYS_OK)
        exit(1);
}

// Returns the shortest time of a step, in seconds. Sets *bytes to the growth of memory per particle, if not NULL.
static double time_step(uint32_t count, double theta, int threads, double *bytes) {
    double before = resident_bytes(), best = INFINITY, begin = seconds();
    PhysSystem *system = make_system(count, theta, threads);
    for (int round = 0; round < 9 && (round < 2 || seconds() - begin < 4); round++) {
        double start = seconds();
        take_steps(system, 1);
        best = fmin(best, seconds() - start);
    }
    if (bytes)
        *bytes = (resident_bytes() - before) / count;
    phys_free(system);
    return best;
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Returns the relative error that the forces on 99 % of the samples do not exceed.
static double measure_error(uint32_t count, double theta) {
    double errors[SAMPLES], *start = malloc((size_t)count * 3 * sizeof *start);
    if (!start)
        exit(1);
    PhysSystem *system = make_system(count, theta, 2);
    for (uint32_t i = 0; i < count; i++)
        memcpy(start + 3 * (size_t)i, phys_position(system, i), 3 * sizeof *start);
    take_steps(system, 1);
    for (int s = 0; s < SAMPLES; s++) {
        uint32_t i = (uint32_t)((uint64_t)count * (uint64_t)s / SAMPLES);
        double force[3] = {0, 0, 0}, difference = 0, square = 0;
        for (size_t j = 0; j < count; j++) {
            double d[3], r2 = 0;
            for (size_t k = 0; k < 3; k++) {
                d[k] = start[3 * j + k] - start[3 * (size_t)i + k];
                r2 += d[k] * d[k];
            }
            for (size_t k = 0; k < 3 && r2 > 0; k++)
                force[k] += 1e-20 * d[k] / (r2 * sqrt(r2));
        }
        for (size_t k = 0; k < 3; k++) {
            double error = phys_velocity(system, i)[k] - force[k];
            difference += error * error;
            square += force[k] * force[k];
        }
        errors[s] = sqrt(difference / square);
    }
    phys_free(system);
    free(start);
    qsort(errors, SAMPLES, sizeof *errors, by_value);
    return errors[SAMPLES * 99 / 100];
}

static void print_row(uint32_t count, double theta, bool exact) {
    double bytes, two = time_step(count, theta, 2, &bytes), one = time_step(count, theta, 1, NULL);
    printf("| %u | %g | %.1e | %.3g | %.3g | %.2f |", count, theta, measure_error(count, theta), one * 1e3, two * 1e3,
           one / two);
    if (exact) {
        double pairs = time_step(count, 0, 2, NULL);
        printf(" %.4g | %.3g | %.0f |\n", pairs * 1e3, pairs / two, bytes);
    } else {
        printf(" | | %.0f |\n", bytes);
    }
    fflush(stdout);
}

int main(int argc, char **argv) {
    bool quick = argc > 1 && strcmp(argv[1], "--quick") == 0;
    double peer = argc > 1 && strncmp(argv[1], "--peer=", 7) == 0 ? strtod(argv[1] + 7, NULL) : NAN;
    puts(
        "| particles | theta | error, 99 % | 1 thread, ms | 2 threads, ms | speedup | all pairs, 2 threads, ms | times "
        "faster | bytes each |\n|---|---|---|---|---|---|---|---|---|");
    print_row(1000, 0.5, true);
    print_row(2000, 0.5, true);
    print_row(10000, 0.5, true);
    if (!quick) {
        print_row(100000, 0.6, true);
        print_row(100000, 0.9, true);
        print_row(1000000, 0.6, false);
    }
    if (isfinite(peer)) {
        double step = time_step(100000, 0.9, 2, NULL) * 1e3;
        printf("\nd3-force-3d: %.0f ms; petri: %.3g ms; %.3g times faster\n", peer, step, peer / step);
    }
    return 0;
}
