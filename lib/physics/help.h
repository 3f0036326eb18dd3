// help.h: whether other threads are asked for help, by what came of asking before.
//
// On a busy machine a thread that has begun a share may lose its processor for milliseconds, and the caller must wait
// for it; or nobody comes at all. When the caller has waited longer than help has spared it, nobody is asked for a
// pause, which is so much longer than the loss that this hardly counts. Only speed depends on this, never a result.
#ifndef PETRI_PHYSICS_HELP_H
#define PETRI_PHYSICS_HELP_H

#include <stdbool.h>
#include <stdint.h>

enum {
    PHYS_MOST_UNANSWERED = 16, // jobs in a row, before a pause
    PHYS_LOSS_PART = 20,       // of the time, this part at most is lost
    PHYS_MOST_DOUBLINGS = 4,   // of a pause, if the machine is still as busy after it
};

// All times in nanoseconds.
typedef struct PhysHelp {
    int64_t spared;  // by help, less what was waited for it
    uint64_t pause;  // how long the last one was; 0: there was none
    uint64_t ended;  // when it has ended, or will
    int doublings;   // of it
    int unanswered;  // jobs in a row that nobody helped with
    uint64_t silent; // since when
} PhysHelp;

typedef struct PhysJobTimes {
    uint64_t begin, end;
    uint64_t waited; // of that, the caller
    bool answered;   // somebody else has done some of it
} PhysJobTimes;

bool phys_help_pauses(const PhysHelp *help, uint64_t now);
void phys_help_learn(PhysHelp *help, const PhysJobTimes *job);

#endif
