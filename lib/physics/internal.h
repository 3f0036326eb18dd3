// internal.h: what the files of lib/physics share; nobody else includes it.
//
// A system exists in two forms. The description is what the scene gave, in order of the calls: records, and for each
// particle a row of 2 n doubles (position, velocity), which is also where results are read. To simulate, it is
// arranged: particles go into columns, component k of particle i at [k * stride + i], in pre-order of their groups,
// each group's own first; forces are sorted by group and by the stage in which they act. Then
//
//   - the particles of a group are one contiguous range, and so are those of a group with all its sub-groups;
//   - what a particle sees in a pass over pairs is its own range and one range for each enclosing group;
//   - all forces that one stage applies for one group are contiguous.
//
// Columns, not rows, because kernels give each lane a particle of its own.
#ifndef PETRI_PHYSICS_INTERNAL_H
#define PETRI_PHYSICS_INTERNAL_H

#include "base/arena.h"
#include "physics/forces.h"

#include <math.h>

// An array that grows and is kept from frame to frame. Its memory is an arena of one block, because only base/ touches
// the heap.
typedef struct Buffer {
    Arena arena;
    void *bytes;
    uint64_t capacity; // in bytes
    bool shown;        // the host may look at it
} Buffer;

#define NO_GROUP UINT32_MAX
#define NO_COLUMN UINT32_MAX

enum {
    PHYS_MAX_LISTS = 8,          // passes that have neighbour lists
    PHYS_MAX_RANGES = 8,         // groups whose particles take part in such a pass
    PHYS_MIN_FOR_THREADS = 1500, // particles, where the work for each is small (threads.h)
};

typedef struct Group {
    uint32_t parent; // the top is its own parent
    uint32_t first;  // own particles are columns first … first + count - 1
    uint32_t count;
    uint32_t movers;               // that are no anchors, if the columns have `draws`
    uint32_t populated;            // this group or its nearest ancestor that has particles, or NO_GROUP
    uint32_t nearest[STAGE_COUNT]; // this group or its nearest ancestor that has forces of a stage, or NO_GROUP
} Group;

typedef struct ParticleRecord {
    double ease;
    double radius;
    double mass;
    double charge;
    uint32_t group;
    bool anchor;
    bool unused[3]; // no padding: equal records have equal bytes
} ParticleRecord;

typedef struct ForceRecord {
    PhysForce given;  // its vectors are those of the caller and must not be used
    uint64_t vector;  // where the copy begins in the vector buffer, plus 1; 0 stands for all zeros
    uint64_t vector2; // likewise
    uint32_t group;
    uint32_t arranged; // its number among the arranged forces
} ForceRecord;

// A force as the kernels see it: vectors point to the copies, `from` and `to` are columns.
typedef struct Force {
    PhysForce given;
    double strength; // at this step, eased in
    uint64_t item;   // random: items of the stream taken so far in this frame
} Force;

typedef struct Columns {
    size_t dimensions;
    uint32_t count;
    size_t stride; // >= count
    double *position;
    double *velocity;
    double *own_force; // the particle's own force; valid, as `ease` is, if there are any
    double *force;     // sum of all forces of the step
    bool forces_clear; // they are 0, for the step before left them so
    double *ease;
    double *radius;
    double *mass;
    bool uniform_mass; // the sweep may take the first of both for all
    bool no_anchors;   // likewise: none is an anchor
    double *charge;
    double *section; // radius^(n-1), valid if some force needs it
    double *volume;  // radius^n, likewise
    const uint32_t
        *random_offset; // those before it in its group that take random numbers; NULL: as counted in the columns
    double *scratch;    // 3 n doubles for the kernel that is running
    bool *anchor;
} Columns;

struct PhysSystem {
    Arena home;     // holds this struct
    uint64_t bytes; // capacity of all buffers together
    bool failed;    // memory was used up since phys_begin
    bool arranged;  // particles and forces are arranged as described
    bool forces_arranged;
    bool radius_powers_valid; // radius powers are those of the columns' radii and of the forces
    bool any_not_finite;      // `not_finite` has a mark
    bool any_from_attribute;  // some particle's position or velocity is
    PhysOptions options;
    PhysThreads *threads; // those of the options, or its own; NULL: none
    bool owns_threads;
    // description
    uint32_t dimensions;
    uint32_t group_count;
    uint32_t particle_count;
    uint32_t force_count;
    bool has_forces;       // simulated since phys_begin or phys_skip_frame: the force columns hold the last step's sums
    bool has_own_forces;   // some particle has a force of its own
    bool has_eased_forces; // … or one that is eased in; then `has_own_forces` is set too
    uint64_t vector_doubles; // doubles in use in `vectors`
    Buffer groups;           // Group
    uint32_t record_stride;  // 0: all particles have the first record; else 1
    Buffer particles;        // ParticleRecord by handle times record_stride
    Buffer rows;             // 2 n doubles by handle
    Buffer own_forces;       // n doubles by handle, the particles' own forces, if they have any
    Buffer last_rows;        // those of the description before
    Buffer force_rows;       // n doubles by handle, with PhysOptions.keep_forces: the forces of the last step
    Buffer from_attribute;   // uint8_t by handle, valid if `any_from_attribute`: what is (PhysParticle)
    Buffer not_finite;    // uint8_t by handle: results of the last frame that were not, see PhysTime.keep_last_finite
    Buffer force_records; // ForceRecord in order of the calls
    Buffer vectors;       // double
    // arranged for simulation
    Buffer indices;        // uint32_t: `order`, `place`, `starts`
    Buffer forces;         // Force, by group, then stage, then declaration
    Buffer terms;          // PairTerm: those of the pass that is running
    Buffer chain;          // Force *: those that act on the group whose turn it is
    Buffer column_data;    // what `columns` points to
    uint32_t *order;       // column -> handle
    uint32_t *column_of;   // handle -> column
    uint32_t handle_count; // how many; that of a handle which the system lacks is NO_COLUMN
    uint32_t *starts;      // forces of group g at stage s: starts[g * STAGE_COUNT + s] up to the next element
    Columns columns;
    // kept from step to step and from frame to frame
    uint64_t frame; // number of this frame
    struct Neighbours *lists;
    // in the order of a list (reorder.c)
    bool can_reorder;   // one group has all particles, and nothing but its one pass over pairs asks for their order
    bool in_cell_order; // columns are in the order of the places of the list of that pass
    // on several processes (domain.h)
    uint64_t columns_version; // counts how often the columns have been filled
    uint64_t radius_version;  // another number whenever a radius has changed
    uint64_t motion_version;  // another number whenever a position may have changed
    bool edited;              // particles were given new numbers since the last frame
    bool columns_stale;       // positions and velocities are in the rows only, not in the columns
    Buffer domain;            // Domain
    PhysRankStats rank_stats;
    bool *remote;  // of the part of a system that is one process's: by column, of the halo; else NULL
    double skin;   // likewise, that of all lists
    bool unlisted; // likewise: a pass went without a list
};

// A run of forces.
typedef struct ForceRange {
    Force *begin;
    Force *end;
} ForceRange;

// system.c: the kernels of the chosen level.
const struct Kernels *phys_kernels(const PhysSystem *system);

// The doubles of a row.
static inline double *phys_row(const PhysSystem *system, uint32_t particle) {
    return (double *)system->rows.bytes + (size_t)2 * system->dimensions * particle;
}

// Charges work to the system's meter; false if the step is to be given up, by the main thread only.
static inline bool phys_charge(const PhysSystem *system, uint64_t units) {
    return budget_charge(system->options.meter, units) == BUDGET_OK;
}

// Whether all that was charged so far could be, and nobody wants an end.
static inline bool phys_may_continue(const PhysSystem *system) {
    return !system->options.meter || budget_check(system->options.meter) == BUDGET_OK;
}

// What the threads look at meanwhile: the wish for an end.
static inline const atomic_bool *phys_stop(const PhysSystem *system) {
    return system->options.meter ? system->options.meter->interrupt : NULL;
}

// buffer.c: makes room for `count` elements of `size` bytes and keeps the first `kept` bytes. False, with
// `system->failed` set, if memory is used up.
bool phys_buffer_reserve(PhysSystem *system, Buffer *buffer, uint64_t retained, uint64_t count, uint64_t size);
void phys_buffer_free(Buffer *buffer);

// groups.c: sorts particles, or forces, by group. False if memory is used up. Particles come first.
bool phys_arrange(PhysSystem *system);
bool phys_arrange_forces(PhysSystem *system);

static inline const ParticleRecord *phys_record(const PhysSystem *system, uint32_t particle) {
    return (const ParticleRecord *)system->particles.bytes + (size_t)particle * system->record_stride;
}

// particles.c: rows into columns and back. phys_fill_columns and phys_clear_not_finite are false if memory is used up.
enum { PHYS_POSITION = 1, PHYS_VELOCITY = 2 }; // marks of `not_finite` and `from_attribute`
bool phys_clear_not_finite(PhysSystem *system);
bool phys_fill_columns(PhysSystem *system);
// Positions and velocities alone.
void phys_fill_motion(PhysSystem *system);
void phys_update_radius_powers(PhysSystem *system);
void phys_write_rows(PhysSystem *system, bool keep_last_finite);
// Those of some particles from other columns, without anchors perhaps. What PhysTime.keep_last_finite puts back goes to
// `home`, a system whose handles are the columns of this one, unless it is this one itself or NULL.
void phys_write_column_rows(PhysSystem *system, const Columns *columns, const uint32_t *order, bool keep_last_finite,
                            const PhysSystem *home);

// particles.c: points the columns into their memory, which has room for `spare` more.
bool phys_reserve_columns(PhysSystem *system, uint64_t spare);
// groups.c: short cuts past enclosing groups that have nothing to say, which make deep nesting cheap.
void phys_link_groups(PhysSystem *system);

// step.c: one step of `delta` at `clock`; false if it was given up half-way.
bool phys_step(PhysSystem *system, double clock, double delta, double speed_of_light);

// reorder.c: columns in the order of a list, which spares its kernels to look for each particle. `may_settle` says
// whether the system is one that can; phys_restore_order puts the columns back into the order of the description, and
// drops the list; phys_forget_order does so for columns that are made anew.
bool phys_can_reorder(const PhysSystem *system);
void phys_reorder(PhysSystem *system, struct Neighbours *list);
void phys_restore_order(PhysSystem *system);
void phys_forget_order(PhysSystem *system);

// Kernels. They apply forces to the particles of one group (for links: to any two).
void phys_apply_links(const Columns *columns, ForceRange forces);
// `move`, unless NULL: this is the last that happens before the particles of the group move, and on several threads
// they may be moved at once. Then it is marked as done.
typedef struct Move {
    double delta;
    double speed_of_light;
    bool done;
} Move;
void phys_apply_pairs(PhysSystem *system, const Group *group, Move *move);
// barrier.c: after a move of `delta`, lets particle i bounce off one barrier (4.4).
void phys_reflect(const Columns *columns, size_t i, const Force *barrier, double delta, double speed_of_light);

static inline double *phys_acceleration(const Columns *columns) {
    return columns->scratch;
}

// Where radius and mass of particle i are found.
static inline size_t phys_numbers_at(const Columns *columns, size_t i) {
    return columns->uniform_mass ? 0 : i;
}

static inline double phys_at(PhysVector vector, size_t k) {
    return vector ? vector[k] : 0.0;
}

// `factor` of a strength (or of a particle's own force) while it is eased in.
static inline double phys_ramp(double ease, double clock) {
    return ease > 0 && clock < ease ? clock / ease : 1.0;
}

// Forces that `group` declares for a stage.
static inline ForceRange phys_forces(const PhysSystem *system, uint32_t group, Stage stage) {
    const uint32_t *start = system->starts + (size_t)group * STAGE_COUNT + stage;
    Force *forces = system->forces.bytes;
    return start[0] == start[1] ? (ForceRange){0} : (ForceRange){forces + start[0], forces + start[1]};
}

// The next group above `group` that has forces of a stage, or NO_GROUP.
static inline uint32_t phys_next_above(const Group *groups, uint32_t group, Stage stage) {
    return group ? groups[groups[group].parent].nearest[stage] : NO_GROUP;
}

#endif
