// physics.c: the benchmark of lib/physics alone, compared with the limit kernels.
//
//   bench_physics [--csv] [--quick] [--cpu=scalar|avx2|avx512] [--neighbours=auto|never|always] [--threads=N]
//                 [--only=NAME]
//
// Both sides of a ratio are measured in the same run. The hash at the end of a row covers the bits of all positions. It
// must depend only on the workload.
#include "base/cpu.h"
#include "base/os.h"
#include "limit.h"
#include "workloads.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct Case {
    WorkloadKind kind;
    uint32_t n;
    int side; // particles along an edge for limit_soft; 0: compare with limit_pairs or nothing
} Case;

static const Case cases[] = {
    {DISH, 200, 0},      {DISH, 1000, 0},        {DISH, 4000, 0},      {BOX, 1000, 0},
    {BOX, 4000, 0},      {GRAVITY, 1000, 0},     {GRAVITY, 4000, 0},   {DISCS, 10000, 100},
    {DISCS, 99856, 316}, {DISCS, 1000000, 1000}, {SPHERES, 10648, 22},
};

typedef struct Settings {
    bool csv, quick;
    int threads; // 0: measures with 1 and with 2 threads
    const char *only;
    PhysOptions options;
} Settings;

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Returns the median seconds of a frame of `steps` steps.
static double measure_steps(Workload *w, int steps, double budget) {
    enum { MAX_SAMPLES = 101 };
    double times[MAX_SAMPLES], start = seconds();
    int count = 0;
    do {
        double begin = seconds();
        workload_frame(w, steps);
        times[count++] = seconds() - begin;
    } while (count < MAX_SAMPLES && (count < 5 || seconds() - start < budget));
    qsort(times, (size_t)count, sizeof *times, by_value);
    return times[count / 2];
}

static uint64_t hash_of(const Workload *w) {
    uint64_t hash = 14695981039346656037u;
    for (uint32_t i = 0; i < w->n; i++) {
        unsigned char bytes[sizeof w->bodies[i].position];
        memcpy(bytes, w->bodies[i].position, sizeof bytes);
        for (size_t k = 0; k < sizeof bytes; k++)
            hash = (hash ^ bytes[k]) * 1099511628211u;
    }
    return hash;
}

static double limit_of(const Case *c) {
    if (c->side)
        return limit_soft(c->kind == DISCS ? 2 : 3, c->side);
    return c->kind == DISH ? limit_pair(c->n, 2) : c->kind == GRAVITY ? limit_pair(c->n, 3) : 0;
}

static void run_case(const Case *c, const Settings *settings, int threads, double limit) {
    PhysOptions options = settings->options;
    options.threads = threads;
    Workload w = workload_open(c->kind, c->n, &options);
    double budget = settings->quick ? 0.1 : 0.5;
    // The hash is computed after a fixed number of steps. These steps also warm up the caches and neighbour lists.
    int warm = c->n > 100000 ? 3 : 20;
    for (int i = 0; i < warm; i++)
        workload_frame(&w, 1);
    uint64_t hash = hash_of(&w);
    double one = measure_steps(&w, 1, budget), ten = measure_steps(&w, 10, budget) / 10;
    workload_close(&w);
    double pairs = 0.5 * c->n * (c->n - 1.0), pair = ten / pairs * 1e9, step = ten / c->n * 1e9;
    double ratio = limit > 0 ? (c->side ? limit / step : limit / pair) : 0;
    const char *format = settings->csv ? "%s,%u,%d,%.2f,%.2f,%.4f,%.2f,%.3f,%.3f,%016llx\n"
                                       : "| %s | %u | %d | %.1f | %.1f | %.3f | %.1f | %.2f | %.2f | %016llx |\n";
    printf(format, workload_name(c->kind), c->n, threads, one * 1e6, ten * 1e6, pair, step, limit, ratio,
           (unsigned long long)hash);
    fflush(stdout);
}

static bool read_option(const char *text, Settings *settings) {
    static const char *const neighbours[] = {"auto", "never", "always"};
    if (!strcmp(text, "--csv"))
        return settings->csv = true;
    if (!strcmp(text, "--quick"))
        return settings->quick = true;
    if (!strncmp(text, "--only=", 7)) {
        settings->only = text + 7;
        return true;
    }
    if (!strncmp(text, "--cpu=", 6))
        return cpu_choose(text + 6, &settings->options.cpu);
    if (!strncmp(text, "--threads=", 10))
        return (settings->threads = atoi(text + 10)) > 0;
    for (int i = 0; i < 3; i++)
        if (!strncmp(text, "--neighbours=", 13) && !strcmp(text + 13, neighbours[i])) {
            settings->options.neighbours = (PhysNeighbours)i;
            return true;
        }
    return false;
}

int main(int argc, char **argv) {
    Settings settings = {.options.cpu = cpu_detected.level};
    for (int i = 1; i < argc; i++)
        if (!read_option(argv[i], &settings)) {
            fprintf(stderr, "bench: unknown option %s\n", argv[i]);
            return 2;
        }
    if (settings.csv)
        puts("workload,n,threads,us_frame,us_step_of_10,ns_pair,ns_particle_step,limit_ns,ratio,hash");
    else
        printf(
            "%s, 1 and 2 threads of %d processors; medians; the limit is for one core\n\n"
            "| workload | n | threads | us per frame of 1 step | us per step, frames of 10 | ns per pair "
            "| ns per particle-step | limit, ns | limit / ours | bits |\n|---|---|---|---|---|---|---|---|---|---|\n",
            cpu_name(settings.options.cpu), os_processor_count());
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const Case *c = &cases[i];
        if (settings.only ? strcmp(settings.only, workload_name(c->kind)) != 0 : settings.quick && c->n > 20000)
            continue;
        double limit = limit_of(c);
        int first = settings.threads ? settings.threads : 1, last = settings.threads ? settings.threads : 2;
        for (int threads = first; threads <= last; threads++)
            run_case(c, &settings, threads, limit);
    }
    return 0;
}
