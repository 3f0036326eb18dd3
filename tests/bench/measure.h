// measure.h: measurement of one script: medians over rounds, in which its variants take turns.
#ifndef TESTS_BENCH_MEASURE_H
#define TESTS_BENCH_MEASURE_H

#include "cases.h"
#include "worker.h"

#include <stdbool.h>

typedef struct Plan {
    int rounds;
    double budget;   // minimum seconds that a variant runs in a round
    int warm_steps;  // steps before the measurement
    int starts;      // processes started per round
    double patience; // seconds after which no further rounds are started
    int threads;     // number of threads that is compared with one thread
    uint32_t max_particles;
    bool tiny;           // true: minimal run, which only tests the bench
    const char *only;    // first words of the requested rows; NULL: all rows
    const char *self;    // path of this executable
    const char *scripts; // folder of scripts
    const char *petri;   // path of the petri command
    const char *other;   // path of the bench executable of another build; NULL: none
} Plan;

// Seconds per frame unless stated otherwise; NaN: not measured.
typedef struct Figures {
    bool done;
    // On one thread.
    double evaluation, physics, frame, output;
    double fastest;     // frame of the fastest round
    int rounds, clean;  // number of rounds, and of those in which no variant shared its processor
    double steps;       // simulation steps per frame
    double allocations; // per frame
    double load;
    double peak, per_particle; // bytes
    // On plan->threads.
    double physics_threads, frame_threads;
    double evaluation_threads;
    double other_evaluation, other_physics, other_frame; // other build, on plan->threads
    double fastest_start, start_median;                  // seconds of `petri run --frames 1`
    double limit;                                        // nanoseconds, see limit.h
} Figures;

bool measure_wanted(const Plan *plan, const Case *c);
Figures measure_case(const Plan *plan, const Case *c);

// Seconds per pair of the engine's kernel and of the limit kernel, on one core, for electrostatic forces in 2
// dimensions or gravity in 3. limit: 0 without a limit kernel.
typedef struct KernelFigures {
    double ours, limit;
} KernelFigures;
KernelFigures measure_kernel(const Plan *plan, int dimensions);

// Returns the seconds that a petri command runs, without output. `words` are its path, subcommand and script, further
// arguments and NULL. Ends the bench if the command fails.
double measure_command(const Plan *plan, const char *const *words);

// These functions are also used for the comparison with LAMMPS.
// Starts a worker and runs the warm-up steps.
Worker measure_warm_worker(const Plan *plan, const Case *c, const char *executable, int threads);
// Returns the number of frames in a round of `budget` seconds.
int measure_round_frames(Worker *worker, const Case *c, double budget);
// Returns true if the worker did not share its processor in this round.
bool measure_clean(const Sample *round);
// Returns the median. Sorts the values.
double measure_median(double *values, int count);

enum { ROUNDS_MAX = 31 };

#endif
