// measure.h: the figures of one whole script: medians over rounds in which its variants take turns.
#ifndef TESTS_BENCH_MEASURE_H
#define TESTS_BENCH_MEASURE_H

#include "cases.h"
#include "worker.h"

#include <stdbool.h>

typedef struct Plan {
    int rounds;
    double budget;   // seconds that a variant runs in one round, at least
    int warm_steps;  // before anything is measured
    int starts;      // processes started per round
    double patience; // seconds after which a row makes do with the rounds that it has
    int threads;     // of the variant that is compared with one thread
    uint32_t max_particles;
    bool tiny;           // only what shows that everything works
    const char *only;    // the first words of the wanted rows, or NULL
    const char *self;    // this executable
    const char *scripts; // folder
    const char *petri;   // the command
    const char *other;   // the bench executable of another build, or NULL
} Plan;

// Seconds per frame unless said otherwise; NaN where nothing was measured.
typedef struct Figures {
    bool done;
    // On one thread.
    double evaluation, physics, frame, output;
    double fastest;     // the frame of the fastest round
    int rounds, clean;  // how many there were, and in how many no variant had to share its processor
    double steps;       // of simulation per frame
    double allocations; // per frame
    double load;
    double peak, per_particle; // bytes
    // On plan->threads.
    double physics_threads, frame_threads;
    double evaluation_threads;
    double other_evaluation, other_physics, other_frame; // the other build, on plan->threads too
    double fastest_start, start_median;                  // of the process `petri run --frames 1`
    double limit;                                        // nanoseconds, as limit.h has them
} Figures;

bool measure_wanted(const Plan *plan, const Case *c);
Figures measure_case(const Plan *plan, const Case *c);

// Seconds per pair of the engine's own kernel and of the limit, on one core, for electrostatic forces in 2 dimensions
// or gravity in 3; the limit is 0 where there is none.
typedef struct KernelFigures {
    double ours, limit;
} KernelFigures;
KernelFigures measure_kernel(const Plan *plan, int dimensions);

// Seconds from start to end of the petri command, silent; `words` begin with its path, its subcommand and the script,
// and end in NULL. Ends the bench if the command fails.
double measure_command(const Plan *plan, const char *const *words);

// The same helpers serve the comparison with LAMMPS.
// Starts a worker and lets it run until it is warm.
Worker measure_warm_worker(const Plan *plan, const Case *c, const char *executable, int threads);
// How many frames make a round of `budget` seconds.
int measure_round_frames(Worker *worker, const Case *c, double budget);
// Whether the worker had a processor for itself in this round.
bool measure_clean(const Sample *round);
// Sorts the values.
double measure_median(double *values, int count);

enum { ROUNDS_MAX = 31 };

#endif
