// domain.h: domain decomposition of one system over MPI ranks.
//
// Space is divided into patches. Each rank is assigned a contiguous range of patches along a Hilbert curve, and owns
// the particles in these patches. Its halo consists of the particles of other ranks that can interact with owned
// particles. Before each step the rank receives the positions of its halo. Owned and halo particles form the local
// system of the rank. A rank computes all forces on its owned particles, so no forces are sent. Forces are summed in
// the order of global columns, which are the columns of the whole system. So the sums match those of a single process
// bit for bit. The range of all pair forces must be bounded.
//
// The halo is valid until a particle has moved by half the skin (neighbour_list.h). Then particles migrate, and halos
// and lists are rebuilt on all ranks together. At the end of a frame all ranks receive all rows. The columns of the
// whole system are not updated then, because they are not used while the decomposition continues.
//
// States of a domain. Only domain.c changes them.
//
//              domain_begin                        domain_end
//     NONE ──────────────────────▶ STEPPING ──────────────────────▶ COLLECTED
//      ▲  ▲                         │    ▲                           │  │
//      │  └─────────────────────────┘    └───────────────────────────┘  │
//      │    domain_step, domain_end:       domain_begin: the same       │
//      │    out of memory or aborted       particles are divided again  │
//      └────────────────────────────────────────────────────────────────┘
//        domain_begin: the frame is not divided, or the columns were filled again
//
//   NONE       There is no valid local system. The columns of the whole system are current, unless the frame was
//              aborted: then they are filled again before the next frame.
//   STEPPING   A frame is divided. The local system has the current values of its owned particles.
//   COLLECTED  As STEPPING, and all rows are current. In the columns of the whole system, positions and velocities are
//              out of date.
#pragma once

#include "physics/grid.h"
#include "ranks/ranks.h"

typedef enum DomainState { DOMAIN_NONE, DOMAIN_STEPPING, DOMAIN_COLLECTED } DomainState;

// A particle that must be sent to another rank.
typedef struct Transfer {
    uint32_t rank;
    uint32_t column;
} Transfer;

// Global columns of particles to send to or receive from each rank: items start[r] to start[r + 1] - 1 are for rank r.
typedef struct Transfers {
    uint32_t *start;
    Buffer starts;
    Buffer items; // uint32_t
} Transfers;

typedef struct ColumnList {
    uint32_t count;
    Buffer columns; // uint32_t
} ColumnList;

// Distances at which the pair forces of a system act.
typedef struct ForceReach {
    bool contact; // some pair force needs contact
    double bound; // largest max_distance of the pair forces that need no contact; 0: no such force
} ForceReach;

typedef struct Domain {
    DomainState state;
    PetriRankStats stats;
    PhysSystem *local;
    Buffer spare; // memory for the next columns of `local`, which are copied from the current ones
    // interaction ranges
    ForceReach reach;
    double max_radius;    // largest radius of the particles that are not in `large`
    NeighbourList survey; // holds no lists; `cell` is the patch of each particle, and `skin` is the skin of all lists
    uint32_t large[PHYS_MAX_LARGE]; // columns of particles much larger than the others
    uint32_t large_count;
    // ownership
    Grid patches;
    Buffer patch_owners; // uint32_t by patch: rank that owns it
    Buffer interior;     // uint32_t by patch: 1 if no other rank can need its particles, else 0
    Buffer owners;       // uint32_t by column: rank that owns the particle
    Buffer counts;       // uint32_t by rank: number of particles that it owns
    // uint32_t: memory of the local system's `order`, of its previous `order`, and of its `column_of`. The handles of
    // the local system are global columns.
    Buffer orders, last_orders, column_of;
    Buffer remote;        // bool by local column: the particle is in the halo or has moved to another rank
    Buffer built;         // double: positions and radii of owned particles at the last rebuild, in column order
    bool built_valid;     // true if `built` was recorded
    Buffer movers;        // uint32_t by column: number of earlier particles of the same group that are not anchors
    Buffer random_offset; // uint32_t by local column: element of `movers` for the particle
    Transfers to, from;   // particles to send and to receive: those of halos or, in domain_move, migrating ones
    // Used during a rebuild. The system's columns are then up to date for all particles that are sent or received.
    ColumnList boundary; // columns of owned particles that other ranks possibly need
    ColumnList arrivals; // columns of received particles, which are now owned or in the halo
    Buffer sources; // uint32_t by local column: column to copy it from, in the last local system or in the whole system
    // communication
    Buffer transfers; // Transfer
    uint32_t transfer_count;
    Buffer transfer_counts; // double[ranks][ranks]: number of particles sent from one rank to another
    Buffer message;         // scratch memory, for example for one message
    Buffer gathered;        // double: one section per rank with its particles (domain_collect.c)
    Buffer starts;          // size_t by rank: argument of PetriRanks.allgatherv
    // rebuilding and load balancing
    uint32_t age;                // number of steps since the last rebuild
    uint64_t padded;             // upper bound of the number of list entries on all ranks, including dummies
    double seconds;              // CPU time of this rank since the last balancing
    uint64_t steps;              // number of steps since the last balancing
    uint64_t rebalance_interval; // minimum of `steps` before uneven load causes another balancing
    Buffer rank_seconds;         // double by rank: `seconds` of that rank
} Domain;

// domain.c: hooks of PhysDivision (physics/division.h). domain_begin decides whether this frame uses domain
// decomposition, with the same result on all ranks. If so, domain_step updates or rebuilds the halo before each step.
void domain_begin(PhysSystem *system, const PhysTime *time);
bool domain_step(PhysSystem *system, double clock, double delta, double speed_of_light);
bool domain_end(PhysSystem *system, bool keep_last_finite);
void domain_free(PhysSystem *system);

// domain_collect.c: writes the rows of all particles on every rank, as phys_write_rows does for one process. If the
// frame was aborted, leaves the rows unchanged and returns false.
bool domain_collect(PhysSystem *system, Domain *domain, bool keep_last_finite);

// domain_balance.c: assigns patches to ranks by the measured cost of their particles. The system's columns must be up
// to date. Returns false if space cannot be divided into patches, or if out of memory.
bool domain_balance(PhysSystem *system, Domain *domain);

// Returns the index of a cell along a Hilbert curve through a cube with n = 1 to 3 axes and 2^levels cells along each.
uint64_t domain_hilbert_index(const uint32_t *cell, uint32_t n, uint32_t levels);

// domain_select.c: finds the interior patches: owned patches that no particle of another rank can reach with the
// current skin. Returns false if out of memory.
bool domain_find_interior(PhysSystem *system, Domain *domain);
// Adds a transfer of each boundary particle to each rank that needs it in its halo. The system's columns must be up to
// date for boundary particles. Returns false if out of memory.
bool domain_select(PhysSystem *system, Domain *domain);

// domain_halo.c. These functions return false if out of memory or if the frame is interrupted.
//
// Sends the owned particles that have left this rank's patches to their new owners, and receives those that have
// entered.
bool domain_move(PhysSystem *system, Domain *domain);
// Determines the new halos. Sends the positions that other ranks need, and receives those of this rank's halo into the
// system's columns.
bool domain_find_halo(PhysSystem *system, Domain *domain);
// Exchanges the positions of halo particles before a step.
bool domain_exchange(PhysSystem *system, Domain *domain);
// Append to a list of columns or to domain->transfers.
bool domain_list_column(PhysSystem *system, ColumnList *list, uint32_t column);
bool domain_add_transfer(PhysSystem *system, Domain *domain, uint32_t rank, uint32_t column);
// Sets each number to its maximum over all ranks.
void domain_reduce(const PhysSystem *system, Domain *domain, double *numbers, size_t count);

// domain_local.c: builds the local system of owned and halo particles. Particles in `arrivals` are copied from the
// system's columns. The other particles are copied from the previous local system, or from the system's columns if
// there is none (DOMAIN_NONE).
bool domain_build_local(PhysSystem *system, Domain *domain);
// Copies the system's forces to the local system.
bool domain_update_forces(PhysSystem *system, Domain *domain);
// Copies Force.item, the position in a random stream, of all single-particle forces from `local` to `system`. The
// positions are the same on all ranks.
void domain_return_items(PhysSystem *system, const PhysSystem *local);
// After attributes have changed between frames, copies attributes and rows to the local system. All rows must be up to
// date.
void domain_reload(const PhysSystem *system, Domain *domain);

// Returns the local column of the particle with the global column `column`.
static inline uint32_t domain_local_column(const Domain *domain, uint32_t column) {
    return domain->local->column_of[column];
}

static inline uint32_t domain_own_count(const PhysSystem *system, const Domain *domain) {
    return ((const uint32_t *)domain->counts.bytes)[ranks_self(system)];
}

static inline uint32_t *domain_owners(const Domain *domain) {
    return domain->owners.bytes;
}

static inline const uint32_t *domain_transfer(const Transfers *transfers, size_t rank) {
    return (const uint32_t *)transfers->items.bytes + transfers->start[rank];
}

static inline size_t domain_transfer_count(const Transfers *transfers, size_t rank) {
    return transfers->start[rank + 1] - transfers->start[rank];
}
