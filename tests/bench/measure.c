// measure.c: see measure.h.
#include "measure.h"

#include "limit.h"
#include "worker.h"
#include "workloads.h"

#include <fcntl.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { VARIANTS = 3, STARTS_MAX = 8 };

// Compares whole words: "soft discs 10000" matches "soft discs 10000 x10", but not "soft discs 1000000".
static bool begins_with_words(const char *name, const char *words) {
    size_t length = strlen(words);
    return !strncmp(name, words, length) && (name[length] == '\0' || name[length] == ' ');
}

bool measure_wanted(const Plan *plan, const Case *c) {
    if (plan->tiny)
        return c->n <= 200 || !strcmp(c->name, "script 500");
    return plan->only ? begins_with_words(c->name, plan->only) : c->n <= plan->max_particles;
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double measure_median(double *values, int count) {
    if (count == 0)
        return NAN;
    qsort(values, (size_t)count, sizeof *values, by_value);
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}

bool measure_clean(const Sample *round) {
    return round->cpu_share >= 0.97;
}

// Returns the median of one member of the `count` samples in `rounds`. `member` is the offset of this member. Disturbed
// rounds are included only if all rounds are disturbed.
static double median_of(const Sample *rounds, int count, size_t member) {
    double values[ROUNDS_MAX];
    int clean = 0, kept = 0;
    for (int i = 0; i < count; i++)
        clean += measure_clean(&rounds[i]);
    for (int i = 0; i < count; i++)
        if (clean == 0 || measure_clean(&rounds[i]))
            memcpy(&values[kept++], (const char *)&rounds[i] + member, sizeof *values);
    return measure_median(values, kept);
}

static double fastest_frame(const Sample *rounds, int count) {
    double min = INFINITY;
    for (int i = 0; i < count; i++)
        min = fmin(min, rounds[i].frame);
    return min;
}

Worker measure_warm_worker(const Plan *plan, const Case *c, const char *executable, int threads) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", plan->scripts, c->script);
    Worker worker = worker_start(executable, path, threads, c->fps);
    // The first frame takes no step. Stops the warm-up after 15 s.
    double start = clock_now();
    worker_run(&worker, 2, false);
    for (int steps = c->steps; steps < plan->warm_steps && clock_now() - start < 15; steps += 5 * c->steps)
        worker_run(&worker, 5, false);
    return worker;
}

// A round must include several rebuilds of neighbour lists, which happen every 10 to 15 steps.
int measure_round_frames(Worker *worker, const Case *c, double budget) {
    int min = c->unit == PER_STEP ? (30 + c->steps - 1) / c->steps : 3, max = 2000;
    double frame = worker_run(worker, 3, false).frame, frames = ceil(budget / frame);
    return frames < min ? min : frames > max ? max : (int)frames;
}

double measure_command(const Plan *plan, const char *const *words) {
    double begin = clock_now();
    pid_t process = fork();
    if (process == 0) {
        int nothing = open("/dev/null", O_RDWR);
        dup2(nothing, STDIN_FILENO);
        dup2(nothing, STDOUT_FILENO);
        execv(plan->petri, (char *const *)words);
        _exit(127);
    }
    int status;
    if (process < 0 || waitpid(process, &status, 0) != process || status != 0) {
        fprintf(stderr, "bench: cannot run %s %s on %s\n", words[0], words[1], words[2]);
        exit(1);
    }
    return clock_now() - begin;
}

static double time_start(const Plan *plan, const Case *c) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", plan->scripts, c->script);
    return measure_command(plan, (const char *[]){plan->petri, "run", path, "--frames=1", NULL});
}

static double limit_once(const Case *c) {
    switch (c->limit) {
    case LIMIT_PAIRS_2D:
        return limit_pair(c->n, 2);
    case LIMIT_PAIRS_3D:
        return limit_pair(c->n, 3);
    case LIMIT_DISCS:
        return limit_soft(2, c->side);
    case LIMIT_SPHERES:
        return limit_soft(3, c->side);
    case LIMIT_NONE:
        break;
    }
    return 0;
}

typedef struct Rounds {
    Worker workers[VARIANTS];
    bool present[VARIANTS]; // [0]: one thread, [1]: plan->threads threads, [2]: the other build
    Sample samples[VARIANTS][ROUNDS_MAX];
    double starts[ROUNDS_MAX * STARTS_MAX];
    int start_count;
    double limit;
    int done, clean; // number of rounds, and of rounds in which no variant was disturbed
} Rounds;

static void run_round(const Plan *plan, const Case *c, Rounds *r, int frames) {
    int round = r->done++;
    bool clean = true;
    for (int turn = 0; turn < VARIANTS; turn++) {
        int k = (turn + round) % VARIANTS;
        if (r->present[k]) {
            r->samples[k][round] = worker_run(&r->workers[k], frames, k == 0);
            clean = clean && measure_clean(&r->samples[k][round]);
        }
    }
    r->clean += clean;
    for (int i = 0; i < plan->starts && (i == 0 || c->n < 100000); i++)
        r->starts[r->start_count++] = time_start(plan, c);
    if (round < 2) {
        double limit = limit_once(c);
        r->limit = round == 0 ? limit : fmin(r->limit, limit);
    }
}

static Figures figures_of(const Case *c, Rounds *r) {
    int rounds = r->done;
    const Sample *one = r->samples[0];
    Figures f = {.done = true,
                 .rounds = rounds,
                 .clean = r->clean,
                 .physics_threads = NAN,
                 .frame_threads = NAN,
                 .evaluation_threads = NAN,
                 .other_evaluation = NAN,
                 .other_physics = NAN,
                 .other_frame = NAN};
    f.evaluation = median_of(one, rounds, offsetof(Sample, evaluation));
    f.physics = median_of(one, rounds, offsetof(Sample, physics));
    f.frame = median_of(one, rounds, offsetof(Sample, frame));
    f.output = median_of(one, rounds, offsetof(Sample, output));
    f.allocations = median_of(one, rounds, offsetof(Sample, allocations));
    f.steps = median_of(one, rounds, offsetof(Sample, steps));
    f.fastest = fastest_frame(one, rounds);
    f.load = one[0].load;
    // measured in the first round only, because writing text increases the peak memory of later rounds
    f.peak = one[0].peak;
    f.per_particle = (one[0].peak - one[0].base) / c->n;
    if (r->present[1]) {
        f.physics_threads = median_of(r->samples[1], rounds, offsetof(Sample, physics));
        f.frame_threads = median_of(r->samples[1], rounds, offsetof(Sample, frame));
        f.evaluation_threads = median_of(r->samples[1], rounds, offsetof(Sample, evaluation));
    }
    if (r->present[2]) {
        f.other_physics = median_of(r->samples[2], rounds, offsetof(Sample, physics));
        f.other_frame = median_of(r->samples[2], rounds, offsetof(Sample, frame));
        f.other_evaluation = median_of(r->samples[2], rounds, offsetof(Sample, evaluation));
    }
    f.start_median = measure_median(r->starts, r->start_count);
    f.fastest_start = r->starts[0];
    f.limit = r->limit > 0 ? r->limit : NAN;
    return f;
}

Figures measure_case(const Plan *plan, const Case *c) {
    Rounds r = {.present = {true, plan->threads > 1, plan->other != NULL}};
    const char *executables[VARIANTS] = {plan->self, plan->self, plan->other};
    int rounds = c->n > 200000 && plan->rounds > 3 ? 3 : plan->rounds;
    double start = clock_now();
    for (int k = 0; k < VARIANTS; k++)
        if (r.present[k])
            r.workers[k] = measure_warm_worker(plan, c, executables[k], k == 0 ? 1 : plan->threads);
    int frames = measure_round_frames(&r.workers[0], c, plan->budget);
    // Allows more rounds if some were disturbed.
    int max = 3 * rounds < ROUNDS_MAX ? 3 * rounds : ROUNDS_MAX;
    do
        run_round(plan, c, &r, frames);
    while (r.clean < rounds && r.done < max && clock_now() - start < plan->patience);
    for (int k = 0; k < VARIANTS; k++)
        if (r.present[k])
            worker_stop(&r.workers[k]);
    return figures_of(c, &r);
}

// Both kernels run on this thread only, so its processor time is the measure that is least affected by other load.
KernelFigures measure_kernel(const Plan *plan, int dimensions) {
    enum { N = 4000, STEPS = 5 };
    PhysOptions options = {.threads = 1};
    cpu_choose(getenv("PETRI_CPU"), &options.cpu);
    Workload w = workload_open(dimensions == 2 ? CHARGES : GRAVITY, N, &options);
    double best = INFINITY, limit = INFINITY;
    workload_frame(&w, STEPS);
    for (int round = 0; round < plan->rounds; round++) {
        double begin = clock_thread();
        workload_frame(&w, STEPS);
        best = fmin(best, clock_thread() - begin);
        limit = fmin(limit, limit_pair(N, dimensions));
    }
    workload_close(&w);
    return (KernelFigures){.ours = best / STEPS / (0.5 * N * (N - 1.0)), .limit = limit * 1e-9};
}
