// speed.c: benchmark of lib/maths in nanoseconds per result, compared with the C library.
//
// usage: maths_speed [NAME]. Prints the best time of many runs over 1024 arguments. Runs of both libraries alternate,
// so other load affects both alike. `plain` is the variant without fused multiply-add; `exact` is the accurate path
// alone.
#include "check.h"
#include "maths/arrays.h"
#include "maths/fast.h"
#include "maths/maths.h"

#include <stdlib.h>
#include <time.h>

enum { COUNT = 1024, ROUNDS = 1500 };

double x[COUNT], y[COUNT], out[COUNT],
    out2[COUNT]; // external linkage, so that the compiler cannot remove the computation

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

typedef struct Row {
    const char *name, *text;
    double (*one[4])(double);
    double (*two[4])(double, double);
    double low, high, y_low, y_high;
} Row;

#define ONE_ROW(name, low, high)                                                                                       \
    {                                                                                                                  \
#name, #name " of " #low " … " #high,                                                                          \
            {name, maths_##name, maths_##name##_plain, exact_##name }, {NULL }, low, high, 0, 0                        \
    }
#define TWO_ROW(name, low, high, y_low, y_high)                                                                        \
    {                                                                                                                  \
#name, #name " of " #low " … " #high ", " #y_low " … " #y_high,                                                \
            {NULL }, {name, maths_##name, maths_##name##_plain, exact_##name }, low, high, y_low, y_high               \
    }

static const Row rows[] = {
    ONE_ROW(sin, -10, 10),      ONE_ROW(sin, -1e10, 1e10), ONE_ROW(cos, -10, 10), ONE_ROW(cos, -1e200, 1e200),
    ONE_ROW(tan, -10, 10),      ONE_ROW(asin, -1, 1),      ONE_ROW(acos, -1, 1),  ONE_ROW(exp, -100, 100),
    ONE_ROW(log, 0, 10),        ONE_ROW(log2, 0, 10),      ONE_ROW(log10, 0, 10), TWO_ROW(atan2, -1, 1, -1, 1),
    TWO_ROW(pow, 0, 10, -5, 5),
};

static void fill_arguments(double *to, double low, double high, uint64_t *seed) {
    for (int i = 0; i < COUNT; i++)
        to[i] = low + (high - low) * (double)(next_bits(seed) >> 11) * 0x1p-53;
}

static void store_minimum(double *best, double start) {
    double t = (now() - start) / COUNT;
    if (t < *best)
        *best = t;
}

static void run_row(const Row *row) {
    double best[4] = {1e9, 1e9, 1e9, 1e9};
    uint64_t seed = 1;
    for (int r = 0; r < ROUNDS; r++) {
        if (r % 100 == 0) {
            fill_arguments(x, row->low, row->high, &seed);
            fill_arguments(y, row->y_low, row->y_high, &seed);
        }
        for (int k = 0; k < (r % 100 == 0 ? 4 : 3); k++) {
            double start = now();
            if (row->one[k])
                for (int i = 0; i < COUNT; i++)
                    out[i] = row->one[k](x[i]);
            else
                for (int i = 0; i < COUNT; i++)
                    out[i] = row->two[k](x[i], y[i]);
            store_minimum(&best[k], start);
        }
    }
    printf("%-34s C library %6.2f  petri %6.2f (%.2f)  plain %6.2f  exact %7.1f\n", row->text, best[0], best[1],
           best[1] / best[0], best[2], best[3]);
}

static void run_vectors(CpuLevel level) {
    double best[5] = {1e9, 1e9, 1e9, 1e9, 1e9};
    uint64_t seed = 1;
    const ArraysIsa *arrays = maths_arrays(level);
    fill_arguments(x, 0, 1, &seed);
    fill_arguments(y, -2, 2, &seed);
    for (int r = 0; r < ROUNDS; r++) {
        double start = now();
        arrays->log(x, COUNT, out);
        store_minimum(&best[0], start);
        start = now();
        arrays->exp(y, COUNT, out);
        store_minimum(&best[1], start);
        start = now();
        arrays->turns_sin(y, COUNT, out);
        store_minimum(&best[2], start);
        start = now();
        arrays->pow(x, y, 1, COUNT, out);
        store_minimum(&best[3], start);
        start = now();
        arrays->log(x, COUNT, out2);
        arrays->turns_sin(y, COUNT, out);
        store_minimum(&best[4], start);
    }
    printf("%-7s log %.2f  exp %.2f  sine of turns %.2f  pow %.2f  log + sine %.2f\n", cpu_name(level), best[0],
           best[1], best[2], best[3], best[4]);
}

int main(int count, char **words) {
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        if (count < 2 || !strcmp(words[1], rows[i].name))
            run_row(&rows[i]);
    for (int level = 0; count < 2 && level <= (int)cpu_detected.level; level++)
        run_vectors((CpuLevel)level);
    return 0;
}
