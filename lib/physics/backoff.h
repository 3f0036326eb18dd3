// backoff.h: decides from earlier jobs whether to use helper threads.
//
// A helper is a thread of the pool other than the caller. On a busy machine a helper that has begun a chunk can lose
// its processor for milliseconds, while the caller waits. Sometimes no helper arrives at all. When this has cost more
// time than helpers have saved, the caller works alone for a pause. The pause is much longer than the lost time, so the
// loss hardly matters. This affects only speed, never results.
#pragma once

#include <stdbool.h>
#include <stdint.h>

enum {
    PHYS_MAX_UNANSWERED = 16, // number of consecutive jobs without a helper that cause a pause
    // The first pause lasts this many times the time that was lost. If time is lost again soon after a pause, the next
    // pause is doubled.
    PHYS_LOSS_DIVISOR = 20,
    PHYS_MAX_DOUBLINGS = 4, // maximum number of times that a pause is doubled if the machine stays busy
};

// All times in nanoseconds.
typedef struct PhysBackoff {
    int64_t saved;             // time saved by helpers, minus the time spent waiting for them
    uint64_t pause_length;     // length of the last pause; 0: none so far
    uint64_t pause_end;        // end of the last pause, or of the present one
    int doublings;             // number of times that the last pause was doubled
    int unanswered;            // consecutive jobs without a helper
    uint64_t unanswered_since; // time at which the first of these jobs began
} PhysBackoff;

typedef struct PhysJobTimes {
    uint64_t begin, end;
    uint64_t waited; // length of the time that the caller waited
    bool answered;   // a helper has done part of the job
} PhysJobTimes;

// Measures whether helpers speed up short jobs. Jobs with and without helpers are timed periodically, and the faster
// way is used. The result can change, because threads move between cores, and helpers on cores without a common cache
// pay off only for longer jobs.
typedef struct PhysTuner {
    uint32_t jobs;        // number of jobs so far in the current period
    bool alone_is_faster; // result of the last period
    double alone, helped; // smoothed time per unit of work without and with helpers, in nanoseconds; 0: unknown
} PhysTuner;

enum {
    PHYS_TUNER_PERIOD = 1024, // number of jobs in a period
    // At the start of a period, this many jobs are timed the slower way, and then as many the faster way.
    PHYS_TUNER_PROBES = 24,
    // The times of the first jobs of each way are ignored, because caches are cold. This is the number of these jobs.
    PHYS_TUNER_WARMUP = 8,
};

// Returns true if the next job should use helpers.
bool phys_tuner_should_help(const PhysTuner *tuner);
// Call this for a job that is done alone because that is faster. If the job need not be timed, counts it and returns
// true. Otherwise returns false, and the job's time must be passed to phys_tuner_learn.
bool phys_tuner_skip(PhysTuner *tuner);
// Records the time of a job, in nanoseconds per unit of work. `helped`: the job used helpers.
void phys_tuner_learn(PhysTuner *tuner, bool helped, double nanoseconds);

// Returns true during a pause.
bool phys_backoff_pauses(const PhysBackoff *backoff, uint64_t now);
// Records a job that was offered to helpers.
void phys_backoff_learn(PhysBackoff *backoff, const PhysJobTimes *job);
