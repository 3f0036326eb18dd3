// forces.h: the rows of force_list.h as structs. If the kind is a compile-time constant, so are all fields of its row.
#pragma once

#include "physics/system.h"

// The stages of a step in which forces act.
typedef enum Stage { STAGE_LINK, STAGE_PAIR, STAGE_SINGLE, STAGE_BARRIER, STAGE_COUNT } Stage;

// What a force needs from its particles or from the step.
typedef enum ForceNeed {
    NEED_NOTHING,
    NEED_RADIUS,
    NEED_MASS,
    NEED_CHARGE,
    NEED_SECTION,
    NEED_VOLUME,
    NEED_STREAM,
} ForceNeed;

// The distances at which a pair force acts (force_list.h).
typedef enum PairReach { REACH_CONTACT, REACH_FAR, REACH_INVERSE_SQUARE } PairReach;

typedef struct ForceRow {
    Stage stage;
    ForceNeed need;  // a pair force needs it from both particles
    PairReach reach; // pair forces only
    int sign;        // pair forces only: PairTerm.strength is sign · strength
} ForceRow;

static inline ForceRow phys_force_row(PhysForceKind kind) {
    static const ForceRow rows[PHYS_FORCE_KINDS] = {
#define PAIR(KIND, name, SIGN, SOURCE, REACH) {STAGE_PAIR, NEED_##SOURCE, REACH_##REACH, SIGN},
#define LINK(KIND, name) {STAGE_LINK, NEED_NOTHING, REACH_FAR, 0},
#define SINGLE(KIND, name, NEED) {STAGE_SINGLE, NEED_##NEED, REACH_FAR, 0},
#define BARRIER(KIND, name, NEED) {STAGE_BARRIER, NEED_##NEED, REACH_FAR, 0},
        PHYS_FORCES(PAIR, LINK, SINGLE, BARRIER)
#undef PAIR
#undef LINK
#undef SINGLE
#undef BARRIER
    };
    return rows[kind];
}

// For a force that has a formula but no potential energy: `stage` is Pair, Link or Single.
#define NO_POTENTIAL(stage, name) static stage##Potential *const potential_##name __attribute__((unused)) = NULL;
