// neighbour_list.h: Verlet neighbour lists for passes whose forces all have a bounded range.
//
// The list of a particle holds all particles that can interact with it before some particle has moved by half the skin.
// The skin is a margin added to the interaction range. So a list serves many steps and is retained between frames. Each
// list has the order in which the pass would visit all partners. Partners that are not listed contribute nothing, so
// the sums equal those over all pairs bit for bit.
//
// Particles are sorted by grid cell. The index of a particle in that order is its sorted index: regular particles come
// first, then the few particles that are much larger than the others, then idle particles, which have no partners.
#pragma once

#include "physics/internal.h"
#include "physics/kernels.h"

#include <string.h>

// Limits of NeighbourList.skin, in units of NeighbourList.contact_distance.
#define MIN_SKIN 0.05
#define MAX_SKIN 0.6

enum {
    PHYS_MAX_LARGE = 64, // maximum number of particles that may be much larger than the others
};

typedef struct ColumnRange {
    uint32_t first;
    uint32_t count;
} ColumnRange;

// The particles of a pass: one range for the group of the pass, one for its parent, and so on outwards.
typedef struct PassRanges {
    uint32_t count;
    ColumnRange at[PHYS_MAX_RANGES];
} PassRanges;

// States of the lists of a pass. Only neighbour_list.c changes them.
//
//           build_list: lists do not pay off
//     ┌─▶ DUE ────────────────────────────────────▶ PAUSED
//     │   │ ▲                                         │
//     │   │ └──── `cooldown` steps later ─────────────┘
//     │   │ build_list
//     │   ▼      step_with_list: also writes next_packed
//     ├── BUILT ──────────────────────────────────▶ AHEAD, SPENT
//     │   ▲                                          │ │
//     │   └── next refresh of AHEAD; of both, if ────┘ │
//     │       something else has moved particles       │
//     └── next refresh of SPENT ───────────────────────┘
//       refresh: a particle has moved by half the skin
//
//   From all states, another pass (prepare_list), reordered columns (phys_lists_invalidate, except PAUSED) or another
//   halo (phys_lists_drop) leads to DUE.
//
//   DUE     The lists must be built before use.
//   PAUSED  The pass computes all pairs; in a local system, until the halo is rebuilt. Other systems with
//           PHYS_NEIGHBOURS_ALWAYS never pause: a list that cannot be built stays DUE.
//   BUILT   The lists can be used after a refresh, unless it finds that a particle has moved by half the skin.
//   AHEAD   As BUILT. If nothing else moves particles (next_motion_version), `next_packed` replaces a refresh.
//   SPENT   As AHEAD, but a particle in `next_packed` has moved by half the skin.
typedef enum ListState { LIST_DUE, LIST_PAUSED, LIST_BUILT, LIST_AHEAD, LIST_SPENT } ListState;

// The lists of all particles of one pass.
typedef struct NeighbourList {
    // the pass that the list is for
    uint32_t group; // every pair has a particle of this group
    uint32_t level; // group that declares the forces: `group` or an enclosing one
    uint64_t frame; // frame of the last use; 0: never used
    PassRanges ranges;
    size_t dimensions;
    size_t lanes; // number of lanes of the kernels that use the list
    double bound; // largest max_distance of the forces that need no contact; 0: all forces need contact
    // contents
    ListState state;
    ListView view;
    double *next_packed;          // `view.packed` of the next step, written by the current step; NULL for PHYS_QUAD
    uint64_t next_motion_version; // AHEAD, SPENT: PhysSystem.motion_version that `next_packed` matches
    uint32_t *key;                // by sorted index: position in the order of the pass
    uint32_t *cell;               // by position in `ranges`: grid cell of the particle; after sorting, its sorted index
    const uint32_t *order;        // by column: position in the order of the pass; NULL: columns are in that order
    uint32_t total;               // number of particles; sorted indices from view.listed on are idle (PHYS_CELL_IDLE)
    double contact_distance;      // typical distance of interacting particles, the unit of MIN_SKIN and MAX_SKIN
    double skin;                  // margin added to the interaction range of each pair
    uint64_t radius_version;      // PhysSystem.radius_version for which the lists were built
    uint64_t scanned;             // number of candidates tested in the last build
    uint64_t padded;              // number of entries of all lists, including dummies
    // tuning
    uint32_t age;      // number of steps since the lists were built
    uint32_t lifetime; // number of steps that the previous lists served
    double cost;       // cost of a step with the previous lists; 0: unknown
    bool shrinking;    // true: the last adjustment reduced the skin; false: it increased the skin
    uint32_t cooldown; // PAUSED: number of further steps that compute all pairs
    uint32_t backoff;  // length of the last pause in steps; 0: none
    Buffer arrays;
    Buffer cells;
    Buffer entries;
} NeighbourList;

// neighbour_list.c: computes a pass with neighbour lists. If lists cannot be used, or if computing all pairs is faster,
// adds no forces and returns false. `move` is as in phys_apply_pairs.
bool phys_neighbour_list_pass(PhysSystem *system, const PairPass *pass, uint32_t group, uint32_t level, Move *move);
void phys_neighbour_list_free(NeighbourList *list);
// Adapts list->skin after a halo has served `lifetime` steps.
void phys_adapt_skin(NeighbourList *list, uint32_t lifetime);

// The two functions below are for local systems (ranks/domain.h), whose lists are rebuilt when the halo is.
//
// Refreshes all lists. Returns false if a list must be rebuilt, or if it has not served exactly `age` steps.
bool phys_lists_valid(PhysSystem *system, uint32_t age);
// Makes all lists DUE. Lists that are built later use this skin.
void phys_lists_drop(PhysSystem *system, double skin);

// grid.c: builds the lists of a pass for the current positions and list->skin. Returns false if out of memory, if
// contact_distance is too small or too large, or if lists would have more than `max_entries` entries.
bool phys_grid_build(PhysSystem *system, const PairPass *pass, NeighbourList *list, uint64_t max_entries);

// Returns true if a particle has no partners: its position is not finite, or all forces need contact and its radius is
// 0.
static inline bool phys_is_idle(const PairPass *pass, const NeighbourList *list, size_t column) {
    bool idle = list->bound == 0 && pass->radius[column] == 0;
    for (size_t k = 0; k < pass->dimensions; k++)
        idle |= !isfinite(pass->position[k * pass->stride + column]);
    return idle;
}

// Returns the first remote column at or after `from`. If there is none, returns the number of columns.
static inline uint32_t phys_next_remote(const PhysSystem *local, uint32_t from) {
    const bool *mark =
        from < local->particle_count ? memchr(local->remote + from, true, local->particle_count - from) : NULL;
    return mark ? (uint32_t)(mark - local->remote) : local->particle_count;
}

static inline bool phys_list_is_built(const NeighbourList *list) {
    return list->state >= LIST_BUILT;
}

// Makes all built lists DUE except `kept`, which may be NULL.
static inline void phys_lists_invalidate(PhysSystem *system, const NeighbourList *kept) {
    for (NeighbourList *list = system->lists; list < system->lists + PHYS_MAX_LISTS; list++)
        if (list != kept && phys_list_is_built(list))
            list->state = LIST_DUE;
}

// Returns the square of the distance that a particle may move before lists with this skin are invalid. The distance is
// slightly less than half the skin, so that rounding cannot miss a pair.
static inline double phys_skin_square(double skin) {
    return 0.25 * skin * skin * (1 - 1e-6);
}

// Returns the limit below which keys belong to the pass's own group. Without enclosing groups there is no limit: all
// keys belong to it, and they can be handles with gaps.
static inline uint32_t phys_own_keys(const NeighbourList *list) {
    return list->ranges.count > 1 ? list->ranges.at[0].count : UINT32_MAX;
}

static inline uint64_t phys_ranges_total(const PassRanges *ranges) {
    uint64_t total = 0;
    for (uint32_t r = 0; r < ranges->count; r++)
        total += ranges->at[r].count;
    return total;
}
