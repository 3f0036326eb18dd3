// domain.h: one system on several processes, each of which simulates the particles of a region of its own.
//
// It is for systems whose pair forces all have a bounded reach. Space is cut into plots; runs of them along a curve
// that fills space are dealt out to the ranks. A rank owns the particles that are in its plots, and computes all that
// acts on them; what it needs for that of the others, the halo, is sent to it before each step: their positions. Its
// particles and its halo, in the order of the whole system's columns, are a system of their own, so that each particle
// meets its partners in the order that it has on one process, and no force is ever sent.
//
// A halo holds until something has moved by half of a margin, the skin, as neighbour lists do. Then, on all ranks
// together, particles move to the owners of the plots where they are, and halos and lists are made anew. At the end of
// a frame the rows of all particles are made whole on every rank; the system's columns are not, for nobody needs them
// as long as the ranks go on like that.
#ifndef PETRI_PHYSICS_DOMAIN_H
#define PETRI_PHYSICS_DOMAIN_H

#include "physics/grid.h"

// A particle that another rank is to get.
typedef struct Transfer {
    uint32_t rank;
    uint32_t column;
} Transfer;

// Particles by rank: those that go to rank r, or come from it, are numbers start[r] up to start[r + 1].
typedef struct Transfers {
    uint32_t *start;
    Buffer starts;
    Buffer items; // uint32_t
} Transfers;

typedef struct ColumnList {
    uint32_t count;
    Buffer columns; // uint32_t
} ColumnList;

typedef struct Domain {
    bool is_valid; // all that follows is there
    PhysSystem *local;
    Buffer spare;             // memory for its columns: they are made anew from those before
    uint64_t columns_version; // of the system's columns that it is for
    // how far particles see
    bool contact;      // some force acts on contact
    double bound;      // largest max_distance of the others, else 0
    double max_radius; // radius of the largest particle but for the `large` ones
    NeighbourList survey;
    uint32_t large[PHYS_MAX_LARGE]; // columns
    uint32_t large_count;
    // who owns what
    Grid patches;
    Buffer patch_owners;                   // uint32_t
    Buffer interior;                       // uint32_t by plot: what is there, nobody else needs; 0 if somebody may
    Buffer owners;                         // uint32_t by column
    Buffer counts;                         // uint32_t by rank: particles that it owns
    Buffer orders, last_orders, column_of; // the local system's `order`, that before, its `place`: handles are columns
    bool can_reorder;                      // the same on all ranks
    Buffer remote;                         // bool by the local system's column: of the halo, or of another rank by now
    Buffer built;                          // own particles when the halo was made, by column: position and radius
    bool built_valid;                      // … if that was wanted
    Buffer movers;        // uint32_t by column: particles of its group before it that move; if a force is random
    Buffer random_offset; // the same by the local system's column
    Transfers to, from;   // the halo
    // while a halo is made: what others get is in the system's columns meanwhile, and what comes from others
    ColumnList boundary; // own particles that others may need
    ColumnList arrivals; // those that have come, to be owned or of the halo
    Buffer sources;      // uint32_t by the local system's column: the one where its numbers were before
    // on the way
    Buffer transfers; // Parcel
    uint32_t transfer_count;
    Buffer transfer_counts; // R x R doubles: how many particles go from one rank to another
    Buffer message;         // of messages
    Buffer gathered;        // all particles, by rank
    Buffer starts;          // size_t
    // when
    uint32_t age; // steps that the halo has served
    uint64_t padded;
    double seconds;              // that this rank has worked since plots were dealt out
    uint64_t steps;              // since then
    uint64_t rebalance_interval; // steps after which they may be dealt out again
    Buffer rank_seconds;         // double by rank: the seconds of all
} Domain;

// domain.c: whether the ranks share this frame of the system that way; if so, all is prepared. All ranks come to the
// same. False with system->failed if memory is used up.
bool phys_domain_begin(PhysSystem *system, const PhysTime *time);
bool phys_domain_step(PhysSystem *system, double clock, double delta, double speed_of_light);
void phys_domain_free(PhysSystem *system);

// domain_collect.c: makes the rows of all particles whole, as phys_write_rows does, but not the columns:
// system->behind. False if it was given up; rows are as they were then.
bool phys_domain_collect(PhysSystem *system, bool keep_last_finite);

// domain_balance.c: deals the plots out to the ranks, by what their particles cost. The columns must be whole. False if
// plots cannot be made, or memory is used up.
bool phys_domain_balance(PhysSystem *system, Domain *domain);

// How far along a Hilbert curve a cell is, in a cube of 2^levels cells along each of n axes (1 to 3).
uint64_t phys_hilbert_index(const uint32_t *cell, uint32_t n, uint32_t levels);

// domain_select.c: finds out which plots are inland: no other rank can see into them, as far as skins reach now.
bool phys_domain_find_interior(PhysSystem *system, Domain *domain);
// Adds a parcel for each rank that needs one of the particles on the shore; their columns must be up to date.
bool phys_domain_select(PhysSystem *system, Domain *domain);

// domain_halo.c: lets particles move to the owners of their plots.
bool phys_domain_move(PhysSystem *system, Domain *domain);
// Finds out who needs what, and gets the positions of the halo into the system's columns.
bool phys_domain_find_halo(PhysSystem *system, Domain *domain);
// Gets the positions of the halo for a step.
bool phys_domain_exchange(PhysSystem *system, Domain *domain);
bool phys_list_column(PhysSystem *system, ColumnList *list, uint32_t column);
bool phys_add_transfer(PhysSystem *system, Domain *domain, uint32_t rank, uint32_t column);
// Each number becomes the largest that a rank has.
void phys_domain_reduce(PhysSystem *system, double *numbers, size_t count);

// domain_local.c: makes the system of own particles and of the halo: from the one before and what is fresh, or, if
// there is none (!domain->made), from the system's columns.
bool phys_domain_build_local(PhysSystem *system, Domain *domain);
// Brings its forces up to date.
bool phys_domain_update_forces(PhysSystem *system, Domain *domain);
// How far the streams of random numbers are: the same on all ranks.
void phys_domain_return_items(PhysSystem *system, const PhysSystem *local);
// Brings its particles up to date that were given new numbers. Rows must be whole.
void phys_domain_reload(const PhysSystem *system, Domain *domain);

// Where the local system has the particle of a column.
static inline uint32_t phys_local_column(const Domain *domain, uint32_t column) {
    return domain->local->column_of[column];
}

static inline uint32_t phys_own_count(const PhysSystem *system, const Domain *domain) {
    return ((const uint32_t *)domain->counts.bytes)[system->options.ranks.rank];
}

static inline uint32_t *phys_owners(const Domain *domain) {
    return domain->owners.bytes;
}

static inline const uint32_t *phys_transfer(const Transfers *transfers, size_t rank) {
    return (const uint32_t *)transfers->items.bytes + transfers->start[rank];
}

static inline size_t phys_transfer_count(const Transfers *transfers, size_t rank) {
    return transfers->start[rank + 1] - transfers->start[rank];
}

#endif
