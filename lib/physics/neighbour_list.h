// neighbour_list.h: kept neighbour lists for passes whose forces all have a bounded reach.
//
// A list holds, for every particle of a pass, all others that could come into reach before something has moved by half
// of a margin, the skin; so it serves many steps and outlives the frame. Each list is in the order of the pass. What
// is not listed contributes nothing, so the sums are those of all pairs, bit for bit.
#ifndef PETRI_PHYSICS_NEIGHBOUR_LIST_H
#define PETRI_PHYSICS_NEIGHBOUR_LIST_H

#include "physics/internal.h"
#include "physics/kernels.h"

#include <string.h>

// In units of Neighbours.base.
#define MIN_SKIN 0.05
#define MAX_SKIN 0.6

enum {
    PHYS_MAX_LARGE = 64, // particles much larger than the others that a list takes
};

typedef struct ColumnRange {
    uint32_t first;
    uint32_t count;
} ColumnRange;

// The particles of a pass: those of the group, then those of its parent, …
typedef struct PassRanges {
    uint32_t count;
    ColumnRange at[PHYS_MAX_RANGES];
} PassRanges;

typedef struct Neighbours {
    // what it was made for
    uint32_t group;
    uint32_t level;
    uint64_t frame; // in which it was last used
    PassRanges ranges;
    size_t dimensions;
    size_t lanes;
    double bound;      // largest max_distance of forces that need no contact, else 0
    bool contact_only; // all forces need contact
    // what it is
    bool built;
    ListView view;
    double *next_packed;          // quads that the next step begins with, made by this one; NULL: no room
    uint64_t next_motion_version; // PhysSystem.motion for which they hold, else 0
    bool next_valid;              // and nothing has left its skin then
    uint32_t *key;                // by place: position in the order of the pass
    uint32_t *cell;               // by column of the ranges, counted through
    const uint32_t *order;        // by column: position in the order of the pass; NULL: columns are in that order
    uint32_t total;          // places; those after view.listed are idle: not finite, or without the size for a contact
    double contact_distance; // length that the skin is measured by: the usual distance of contact
    double skin;
    uint64_t radius_version; // PhysSystem.radii for which it was made
    bool skin_is_fixed;      // by the domain that the particles are of
    uint64_t scanned;        // candidates that the last construction looked at
    uint64_t padded;         // entries of all lists, dummies included
    // when to use it
    uint32_t age;      // steps since it was built
    uint32_t lifetime; // steps that the one before served
    double cost;       // of one of these steps; 0: unknown
    bool shrinking;    // the skin is being made shorter, else longer
    uint32_t cooldown; // steps left in which all pairs are computed instead
    uint32_t backoff;
    Buffer arrays;
    Buffer cells;
    Buffer entries;
} NeighbourList;

// force_pair.c: a pass over the columns, without forces.
PairPass phys_columns_pass(const Columns *columns);

// neighbour_list.c: computes a pass with neighbour lists, or returns false if all pairs are the better way. `move` as
// in phys_apply_pairs.
bool phys_neighbour_list_pass(PhysSystem *system, const Kernels *kernels, const PairPass *pass, uint32_t group,
                              uint32_t level, Move *move);
void phys_neighbour_list_free(NeighbourList *list);
// domain.c: another skin for what has served `life` steps.
void phys_adapt_skin(NeighbourList *list, uint32_t lifetime);

// Those of a system that is part of a larger one (domain.h), which says when lists are made.
// Brings lists up to date that have served `age` steps; false if new ones are needed.
bool phys_lists_valid(PhysSystem *system, uint32_t age);
// Drops all lists; new ones get this skin.
void phys_lists_drop(PhysSystem *system, double skin);

// grid.c: makes a list for the positions of now; list->skin is what is wanted. False if there is no memory for it or
// the particles do not lie in a way that a grid can sort.
bool phys_grid_build(PhysSystem *system, const Kernels *kernels, const PairPass *pass, NeighbourList *list);

// neighbour_list.c: with more entries than this a list costs more than all pairs.
uint64_t phys_max_useful_entries(const NeighbourList *list);

// The first column from one on that is foreign, or their number.
static inline uint32_t phys_next_remote(const PhysSystem *local, uint32_t from) {
    const bool *mark =
        from < local->particle_count ? memchr(local->remote + from, true, local->particle_count - from) : NULL;
    return mark ? (uint32_t)(mark - local->remote) : local->particle_count;
}

// The square of how far a particle may move until lists with the skin no longer hold: a little less than half of it, so
// that rounding cannot let a pair slip through.
static inline double phys_skin_square(double skin) {
    return 0.25 * skin * skin * (1 - 1e-6);
}

// Keys below this are of the pass's own group. (Keys of a group alone are handles, which may have gaps.)
static inline uint32_t phys_own_keys(const NeighbourList *list) {
    return list->ranges.count > 1 ? list->ranges.at[0].count : UINT32_MAX;
}

static inline uint64_t phys_ranges_total(const PassRanges *ranges) {
    uint64_t total = 0;
    for (uint32_t r = 0; r < ranges->count; r++)
        total += ranges->at[r].count;
    return total;
}

#endif
