// measure.h: measurement of one script. The figures are medians over rounds, in which the variants take turns.
#pragma once

#include "cases.h"
#include "worker.h"

#include <stdbool.h>

typedef struct Plan {
    int rounds;
    double budget;   // minimum seconds for which a variant runs in each round
    int warm_steps;  // number of steps before the measurement
    int starts;      // number of times per round that the start of the command is timed
    double patience; // seconds after which no further round of a script is started
    int threads;     // number of threads of the second variant; the first has one thread
    uint32_t max_particles;
    bool tiny;           // true: minimal run that only tests the benchmark itself
    const char *only;    // first words of the names of the requested rows; NULL: all rows
    const char *self;    // path of this executable
    const char *scripts; // folder of scripts
    const char *petri;   // path of the petri executable
    const char *other;   // path of another build's bench executable; NULL: none
} Plan;

// Seconds per frame unless stated otherwise; NaN: not measured.
typedef struct Figures {
    bool done;
    // with one thread
    double evaluation, physics, frame, output;
    double fastest;     // frame time in the fastest round
    int rounds, clean;  // number of rounds, and of those in which no variant shared its processor
    double steps;       // simulation steps per frame
    double allocations; // number of allocations per frame
    double load;
    double peak, per_particle; // bytes
    // with plan->threads threads
    double physics_threads, frame_threads;
    double evaluation_threads;
    double other_evaluation, other_physics, other_frame; // the other build, with plan->threads threads
    double fastest_start, start_median;                  // seconds of `petri run --frames 1`
    double limit;                                        // nanoseconds, see limit.h
} Figures;

bool measure_wanted(const Plan *plan, const Case *c);
Figures measure_case(const Plan *plan, const Case *c);

// Seconds per pair for petri's kernel and the limit kernel, on one core: electrostatic forces in 2 dimensions, or
// gravity in 3. `limit` is 0 if there is no limit kernel.
typedef struct KernelFigures {
    double ours, limit;
} KernelFigures;
KernelFigures measure_kernel(const Plan *plan, int dimensions);

// Returns the run time of a petri command in seconds, with its output discarded. `words` are its path, subcommand,
// script and further arguments, followed by NULL. Exits the benchmark if the command fails.
double measure_command(const Plan *plan, const char *const *words);

// These functions are also used for the comparison with LAMMPS.
// Starts a worker and runs the warm-up steps.
Worker measure_warm_worker(const Plan *plan, const Case *c, const char *executable, int threads);
// Returns the number of frames in a round of `budget` seconds.
int measure_round_frames(Worker *worker, const Case *c, double budget);
// Returns true if the worker had its processor for itself in this round.
bool measure_clean(const Sample *round);
// Returns the median of `values`, which it sorts.
double measure_median(double *values, int count);

enum { ROUNDS_MAX = 31 };
