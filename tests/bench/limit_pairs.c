// limit_pairs.c: the limit kernel for forces between all pairs (see limit.h).
#include "limit.h"

#if defined(__x86_64__)

#include "base/cpu.h"

#include <immintrin.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <time.h>

typedef struct Cloud {
    int n;               // a multiple of 8
    double *p[3], *f[3]; // positions and forces
    double *q, *r;       // charges (or masses), and radii
} Cloud;

#define WIDTH 4
#include "limit_tile.h"
#undef WIDTH
#define WIDTH 8
#include "limit_tile.h"
#undef WIDTH

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

double limit_pair(uint32_t n, int dimensions) {
    size_t stride = (n + 7) / 8 * 8;
    double *data = aligned_alloc(64, 8 * stride * sizeof *data);
    if (!data || cpu_detected.level == CPU_SCALAR) {
        free(data);
        return 0;
    }
    Cloud cloud = {.n = (int)stride, .q = data + 6 * stride, .r = data + 7 * stride};
    for (int k = 0; k < 3; k++) {
        cloud.p[k] = data + (size_t)k * stride;
        cloud.f[k] = data + (size_t)(k + 3) * stride;
    }
    for (size_t i = 0; i < 8 * stride; i++)
        data[i] = (double)((i * 7919) % 10007) * 0.37 + 1;
    typedef void Work(const Cloud *);
    static Work *const works[][2][2] = {// by level, dimensions and way
                                        {{divider_2_4, fused_2_4}, {divider_3_4, fused_3_4}},
                                        {{divider_2_8, fused_2_8}, {divider_3_8, fused_3_8}}};
    double best = INFINITY;
    for (int round = 0; round < 14; round++) {
        Work *work = works[cpu_detected.level - CPU_AVX2][dimensions - 2][round % 2 && cpu_detected.fma];
        int calls = 0;
        double start = now(), spent;
        do {
            work(&cloud);
            calls++;
        } while ((spent = now() - start) < 0.02);
        best = fmin(best, spent / calls);
    }
    free(data);
    return best / (0.5 * (double)n * (n - 1.0)) * 1e9;
}

#else

double limit_pair(uint32_t n, int dimensions) {
    (void)n;
    (void)dimensions;
    return 0;
}

#endif
