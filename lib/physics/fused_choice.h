// fused_choice.h: measures whether square roots by fused multiply-add (fused_roots.h) or by the divider are faster.
//
// That depends on the processor. The first steps of a system are computed in both ways, in turn, and timed; then the
// faster way is used. Some steps are measured again later, because other load may have disturbed the first. Results are
// bit-identical in both ways.
#pragma once

#include "base/cpu.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    FUSED_MIN_PAIRS = 500,   // pairs in the smallest step that is measured
    FUSED_MAX_PROBES = 8,    // measured steps of each way in a period
    FUSED_MIN_PROBES = 2,    // the same if they take longer than FUSED_MAX_TIME together
    FUSED_MAX_TIME = 500000, // ns
    FUSED_PERIOD = 1 << 14,  // steps
};

// All zero, except `use`, before the first step.
typedef struct FusedChoice {
    CpuFma use;
    bool fused;                     // the present step uses fused multiply-add
    bool measures;                  // the present step is measured
    uint32_t steps;                 // number of steps in the present period
    uint32_t probes;                // number of measured steps of the present way
    uint64_t time;                  // ns: their total time
    uint64_t step_pairs, step_time; // pairs of the present step; time for them in ns
    double best[2];                 // shortest time of a pair in ns, by `fused`; 0: unknown
} FusedChoice;

// Call this before each step.
void phys_fused_next_step(FusedChoice *choice);
// Records that a part of the present step, with this number of pairs, took `nanoseconds`.
void phys_fused_learn(FusedChoice *choice, uint64_t pairs, uint64_t nanoseconds);

// Returns true if the present step must be timed.
static inline bool phys_fused_measures(const FusedChoice *choice) {
    return choice->measures;
}

// Returns true if the present step should use fused multiply-add.
static inline bool phys_fused_chosen(const FusedChoice *choice) {
    return choice->use == CPU_FMA_ALWAYS || (choice->use == CPU_FMA_FASTER && choice->fused);
}
