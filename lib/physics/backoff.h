// backoff.h: whether other threads are asked for help, by what came of asking before.
//
// On a busy machine a thread that has begun a share may lose its processor for milliseconds, and the caller must wait
// for it; or nobody comes at all. When the caller has waited longer than help has spared it, nobody is asked for a
// pause, which is so much longer than the loss that this hardly counts. Only speed depends on this, never a result.
#ifndef PETRI_PHYSICS_BACKOFF_H
#define PETRI_PHYSICS_BACKOFF_H

#include <stdbool.h>
#include <stdint.h>

enum {
    PHYS_MAX_UNANSWERED = 16, // jobs in a row, before a pause
    PHYS_LOSS_DIVISOR = 20,   // of the time, this part at most is lost
    PHYS_MAX_DOUBLINGS = 4,   // of a pause, if the machine is still as busy after it
};

// All times in nanoseconds.
typedef struct PhysBackoff {
    int64_t saved;             // by help, less what was waited for it
    uint64_t pause_length;     // how long the last one was; 0: there was none
    uint64_t pause_end;        // when it has ended, or will
    int doublings;             // of it
    int unanswered;            // jobs in a row that nobody helped with
    uint64_t unanswered_since; // since when
} PhysBackoff;

typedef struct PhysJobTimes {
    uint64_t begin, end;
    uint64_t waited; // of that, the caller
    bool answered;   // somebody else has done some of it
} PhysJobTimes;

// Whether help pays at all in jobs so short that it may not: both ways are timed, now and then, and the faster is
// taken. A pair of cores that are far apart needs longer jobs than one with a common cache, and cores move.
typedef struct PhysTuner {
    uint32_t jobs;        // in this round
    bool alone_is_faster; // by the last round
    double alone, helped; // nanoseconds for a unit of work, smoothed; 0: unknown
} PhysTuner;

enum {
    PHYS_TUNER_PERIOD = 1024, // jobs, of which the first so many are done in the way that is not the faster one
    PHYS_TUNER_PROBES = 24,
    PHYS_TUNER_WARMUP = 8, // jobs that do not count, as caches are those of the other way
};

// Whether the next job is to be done with help.
bool phys_tuner_should_help(const PhysTuner *tuner);
// Counts one that is done alone because that is faster; false if it is to be timed.
bool phys_tuner_skip(PhysTuner *tuner);
// What it took, `helped` or alone.
void phys_tuner_learn(PhysTuner *tuner, bool helped, double nanoseconds);

bool phys_backoff_pauses(const PhysBackoff *backoff, uint64_t now);
void phys_backoff_learn(PhysBackoff *backoff, const PhysJobTimes *job);

#endif
