// internal.h: internal declarations of lib/physics. Of other libraries, only lib/ranks includes it.
//
// A system exists in two forms. The first is the description: a record per particle and per force, in the order of the
// calls that added them. The number of a particle in this order is its handle. The description also has a row for each
// particle: its position and velocity, 2 n doubles in n dimensions. Results are read from the rows. The second form is
// arranged for simulation: particles are copied into columns, where component k of particle i is at [k * stride + i].
// The index i is called the column of the particle. Particles are sorted by group, in pre-order: the particles of a
// group itself come before those of its sub-groups. Forces are sorted by group and by the stage in which they act.
// Therefore:
//
//   - the particles of a group are one contiguous range, with or without its sub-groups;
//   - in a pass over pairs, the partners of a particle are in the range of its group and one range per enclosing group;
//   - the forces that one group declares for one stage are contiguous.
//
// Kernels use columns rather than rows, because each SIMD lane processes a different particle.
//
// A file calls only files in later lines of this list:
//
//     timestep, explain                       a frame, and the forces in its steps
//     step, energy, stability, divergence     a step, and properties of a state
//     system, force_pair                      the description; passes over pairs
//     neighbour_list                          passes of bounded range
//     far_force, grid, groups                 passes with `theta`; cells; the order of particles and forces
//     far_tree, grid_search, integrate, kernel_pair, pair_wavefront, particles, reorder
//     kernel_integrate, threads
//     backoff, barrier, buffer, fused_choice, far_moments, far_sort, far_walk, pair_rows, the other kernels
#pragma once

#include "base/arena.h"
#include "physics/forces.h"
#include "physics/fused_choice.h"

#include <math.h>

// A growing array whose memory is reused from frame to frame. The memory is an arena of one block, because libraries
// other than lib/base do not call malloc.
typedef struct Buffer {
    Arena arena;
    void *bytes;
    uint64_t capacity; // in bytes
    bool shown;        // the host may still be reading the memory, so phys_buffer_free retires it (arena_retire)
} Buffer;

typedef struct FarForest FarForest; // far_field.h

#define NO_GROUP UINT32_MAX
#define NO_COLUMN UINT32_MAX

enum {
    PHYS_MAX_LISTS = 8,          // maximum number of neighbour lists; a pass has at most one
    PHYS_MAX_RANGES = 8,         // maximum number of groups with particles in a pass that uses a neighbour list
    PHYS_MIN_FOR_THREADS = 1500, // with fewer particles, most work is done on one thread
};

typedef struct Group {
    uint32_t parent;    // number of the enclosing group; the top group, 0, is its own parent
    uint32_t first;     // first of the columns that hold the particles of the group itself
    uint32_t count;     // number of these particles
    uint32_t movers;    // number of particles that are not anchors; valid only if Columns.random_offset is set
    uint32_t populated; // this group if it has particles, else the nearest enclosing group that has; NO_GROUP: none
    uint32_t nearest[STAGE_COUNT]; // by stage: like `populated`, for groups with forces
} Group;

typedef struct ParticleRecord {
    double ease;
    double radius;
    double mass;
    double charge;
    uint32_t group;
    bool anchor;
    bool unused[3]; // explicit padding, so that equal records have equal bytes
} ParticleRecord;

typedef struct ForceRecord {
    PhysForce given;  // its vectors are the caller's pointers and must not be used
    uint64_t vector;  // index of the copy in PhysSystem.vectors, plus 1; 0: all zeros
    uint64_t vector2; // like `vector`
    uint32_t group;
    uint32_t arranged; // index of the force in PhysSystem.forces
} ForceRecord;

// A force as the kernels see it. In `given`, the vectors point to the copies, and `from` and `to` are columns instead
// of handles.
typedef struct Force {
    PhysForce given;
    double strength; // strength in this step, after easing
    uint64_t item;   // random forces only: number of items of the random stream that were used so far in this frame
    uint64_t start;  // random forces only: `item` at the start of the step
    uint32_t number; // number that phys_add_force returned
} Force;

typedef struct Columns {
    size_t dimensions;
    uint32_t count;
    size_t stride; // distance between two components of a particle; at least `count`
    double *position;
    double *velocity;
    double *own_force; // PhysParticle.force; `own_force` and `ease` are invalid if OWN_FORCES_NONE
    double *force;     // sum of all forces of the step
    bool forces_clear; // the previous step has set all elements of `force` to 0
    double *ease;      // ramp time of own_force
    double *radius;
    double *mass;
    bool uniform_mass; // all particles have the radius and mass of column 0
    bool no_anchors;   // no particle is an anchor
    double *charge;
    double *section; // radius^(n-1); valid only if a force needs it
    double *volume;  // radius^n; valid only if a force needs it
    // By column: number of earlier particles of the same group that use random numbers, which all particles except
    // anchors do. NULL: integrate.c counts them.
    const uint32_t *random_offset;
    double *scratch; // 3 n doubles of working memory for the running kernel
    bool *anchor;
} Columns;

// States of a system. Only system.c changes them.
//
//               phys_prepare: sorts and      phys_prepare:         phys_prepare: computes
//               copies particles             sorts forces          powers of radii
//     DESCRIBED ─────────────────────▶ FILLED ─────────────▶ SORTED ──────────────────────▶ READY
//      ▲                                  ▲                   ▲                              │ │ │
//      │                                  │                   └── a radius changes ──────────┘ │ │
//      │                                  └── phys_begin_forces ──────────────────────────────┘ │
//      └── phys_begin; own_forces increases; a frame was aborted (phys_discard_columns) ─────────┘
//
//   An event that leads to a state has no effect in earlier states. Only in READY can the system take a step.
//
//   DESCRIBED  Only the description is valid.
//   FILLED     The particles are sorted and copied to the columns.
//   SORTED     Also the forces are sorted.
//   READY      Also Columns.section and Columns.volume are up to date.
typedef enum SystemState { SYSTEM_DESCRIBED, SYSTEM_FILLED, SYSTEM_SORTED, SYSTEM_READY } SystemState;

// The order of the columns. Only reorder.c changes it.
//
//             phys_allow_reorder                 phys_reorder: a list was rebuilt
//     FIXED ◀────────────────────▶ BY_HANDLE ─────────────────────────────────────▶ BY_CELL
//        ▲                             ▲                                             │  │
//        │                             └─────────────────────────────────────────────┘  │
//        │                               phys_restore_order: a pass needs the order     │
//        │                               of handles; phys_forget_order: the columns     │
//        │                               are about to be filled from scratch            │
//        └──────────────────────────────────────────────────────────────────────────────┘
//          phys_allow_reorder: not allowed any more
//
//   FIXED      By group, then by handle. Some force depends on this order.
//   BY_HANDLE  As FIXED. But all particles are in one group, and only the single pass of this group depends on their
//              order. A pass over all pairs needs this order, because it sums in the order of columns.
//   BY_CELL    In the sorted order (neighbour_list.h) of the list of this pass.
typedef enum ColumnOrder { ORDER_FIXED, ORDER_BY_HANDLE, ORDER_BY_CELL } ColumnOrder;

// Which particles have a `force` attribute (PhysParticle.force).
typedef enum OwnForces {
    OWN_FORCES_NONE,
    OWN_FORCES_CONSTANT, // some have one, which is not eased in
    OWN_FORCES_EASED,    // some have one that is eased in
} OwnForces;

// How attributes in the columns have changed. Later values include earlier ones.
typedef enum ColumnsChange {
    COLUMNS_SAME,
    COLUMNS_EDITED, // attributes of some particles
    COLUMNS_FILLED, // all columns were filled again
} ColumnsChange;

// What the last check of divergence.h has found.
typedef struct Watch {
    uint64_t steps;   // PhysSystem.steps at the check
    double energy;    // kinetic energy
    uint32_t growths; // number of successive checks in which the energy had grown fast
    bool huge;        // the run started with vectors above PHYS_DIVERGENT
    bool found;       // a divergence was found in this run
} Watch;

struct PhysSystem {
    Arena home;     // holds this struct
    uint64_t bytes; // total capacity of all buffers
    bool failed;    // memory has run out since phys_begin
    SystemState state;
    bool any_not_finite;     // some element of `not_finite` is set
    bool any_from_attribute; // some element of `from_attribute` is set
    PhysOptions options;
    const struct Kernels *kernels; // for options.cpu
    FusedChoice fused;             // whether pairs use fused multiply-add
    PhysThreads *threads;          // options.pool or the system's own pool; NULL: none
    // description
    uint32_t dimensions;
    uint32_t group_count;
    uint32_t particle_count;
    uint32_t force_count;
    bool has_forces; // a step was taken since the last phys_begin or phys_skip_frame
    OwnForces own_forces;
    uint64_t vector_doubles; // doubles in use in `vectors`
    Buffer groups;           // Group
    uint32_t record_stride;  // 1: every particle has a record; 0: all particles share the first one
    Buffer particles;        // ParticleRecord; index: handle * record_stride
    Buffer rows;             // 2 n doubles by handle
    Buffer own_force_rows;   // n doubles by handle: the `force` attributes; valid unless OWN_FORCES_NONE
    Buffer last_rows;        // rows of the previous description, which the host can still read
    Buffer force_rows;       // n doubles by handle: the forces of the last step; used if PhysOptions.keep_forces
    Buffer host_vectors;     // arguments of PhysOptions.add_forces
    Buffer start_rows;       // `rows` as they were before the last frame (explain.h); used if PhysOptions.keep_forces
    PhysTime last_time;      // argument of the last phys_simulate
    uint64_t last_steps;     // number of steps that it took; 0 if it failed
    // uint8_t by handle: PHYS_POSITION is set if the position came from an attribute (PhysTime.keep_last_finite), and
    // PHYS_VELOCITY if the velocity did. Valid only if any_from_attribute.
    Buffer from_attribute;
    Buffer not_finite;    // uint8_t by handle: the same bits, set for vectors that were not finite in the last frame
    Buffer force_records; // ForceRecord in the order of the calls
    Buffer vectors;       // double: copies of the forces' vectors
    // arranged for simulation
    Buffer indices;        // uint32_t: memory of `order`, `column_of` and `starts`
    Buffer forces;         // Force, by group, then stage, then declaration
    Buffer terms;          // PairTerm: forces of the running pass
    Buffer chain;          // Force *: single-particle forces and barriers that act on the current group
    Buffer column_data;    // memory of `columns`
    uint32_t *order;       // column -> handle
    uint32_t *column_of;   // handle -> column
    uint32_t handle_count; // length of `column_of`, which is NO_COLUMN for handles without a particle
    // Element g * STAGE_COUNT + s: index of the first force of group g in stage s. These forces end before the index in
    // the next element.
    uint32_t *starts;
    Columns columns;
    // retained between steps and frames
    uint64_t frame;              // number of the current frame
    struct NeighbourList *lists; // PHYS_MAX_LISTS elements
    FarForest *forests;          // PHYS_FORESTS elements
    ColumnOrder column_order;
    // versions
    uint64_t radius_version;      // increases when a radius may have changed
    uint64_t motion_version;      // increases when a position may have changed
    ColumnsChange columns_change; // what has changed since a hook last read this field
    Watch watch;
    // division among processes (division.h)
    uint64_t steps;  // number of steps since phys_new
    Buffer division; // data of PhysOptions.division
    bool *remote;    // in a local system: by column, true for particles of other processes; in other systems NULL
    double skin;     // in a local system: skin of all lists
    bool unlisted;   // in a local system: a pass has run without a list since lib/ranks cleared this field
};

// A range of forces.
typedef struct ForceRange {
    Force *begin;
    Force *end;
} ForceRange;

static inline void phys_note_change(PhysSystem *system, ColumnsChange change) {
    if (change > system->columns_change)
        system->columns_change = change;
}

// Returns the row of a particle.
static inline double *phys_row(const PhysSystem *system, uint32_t particle) {
    return (double *)system->rows.bytes + (size_t)2 * system->dimensions * particle;
}

static inline ForceRecord *phys_force_record(const PhysSystem *system, uint32_t number) {
    return (ForceRecord *)system->force_records.bytes + number;
}

// Charges work to the system's budget. Returns false if the step must be aborted. Only the main thread may call this.
static inline bool phys_charge(const PhysSystem *system, uint64_t units) {
    return budget_charge(system->options.budget, units) == BUDGET_OK;
}

// Returns true if the budget is not exceeded and the frame is not interrupted.
static inline bool phys_may_continue(const PhysSystem *system) {
    return !system->options.budget || budget_check(system->options.budget) == BUDGET_OK;
}

// Returns the flag that threads poll to stop early, or NULL.
static inline const atomic_bool *phys_stop(const PhysSystem *system) {
    return system->options.budget ? system->options.budget->interrupt : NULL;
}

// buffer.c: reserves memory for `count` elements of `size` bytes and preserves the first `retained` bytes of the
// contents. Returns false and sets system->failed if out of memory.
bool phys_buffer_reserve(PhysSystem *system, Buffer *buffer, uint64_t retained, uint64_t count, uint64_t size);
// Like phys_buffer_reserve, for one more element than `count`, all of which are preserved.
bool phys_buffer_grow(PhysSystem *system, Buffer *buffer, uint64_t count, uint64_t size);
void phys_buffer_free(Buffer *buffer);

// system.c: makes the system READY. Returns false if out of memory.
bool phys_prepare(PhysSystem *system);
// Makes the system DESCRIBED, so that the columns are filled again from the rows.
void phys_discard_columns(PhysSystem *system);

// groups.c: phys_arrange sorts the particles by group. Then phys_arrange_forces must be called, which sorts the forces.
// Both return false if out of memory.
bool phys_arrange(PhysSystem *system);
bool phys_arrange_forces(PhysSystem *system);

static inline const ParticleRecord *phys_record(const PhysSystem *system, uint32_t particle) {
    return (const ParticleRecord *)system->particles.bytes + (size_t)particle * system->record_stride;
}

// particles.c: copies rows to columns and back.
enum { PHYS_POSITION = 1, PHYS_VELOCITY = 2 }; // bits of `not_finite` and `from_attribute`
// Allocates `not_finite` and clears it. Returns false if out of memory.
bool phys_clear_not_finite(PhysSystem *system);
// Allocates and fills all columns except powers of radii. Returns false if out of memory.
bool phys_fill_columns(PhysSystem *system);
// Copies the rows to `start_rows`. Returns false if out of memory.
bool phys_keep_start(PhysSystem *system);
// Fills only the positions and velocities of the columns.
void phys_fill_motion(PhysSystem *system);
void phys_update_radius_powers(PhysSystem *system);
// Writes all rows from this system's columns.
void phys_write_rows(PhysSystem *system, bool keep_last_finite);
// Copies the particles from `columns` to the rows of `system`. order[i] is the handle of the particle in column i.
// `columns->anchor` may be NULL if the forces of anchors are 0. If a row keeps its old value because of
// PhysTime.keep_last_finite, that value is also copied to the columns of `home`, unless `home` is NULL. `home` is
// `system` itself or its local system (ranks/domain.h), whose handles are columns of `system`.
void phys_write_column_rows(PhysSystem *system, const Columns *columns, const uint32_t *order, bool keep_last_finite,
                            const PhysSystem *home);

// particles.c: allocates `column_data` with space for `spare` more particles and sets the pointers of the columns.
// Returns false if out of memory.
bool phys_reserve_columns(PhysSystem *system, uint64_t spare);
// groups.c: sets Group.populated and Group.nearest, which skip empty enclosing groups, so that deep nesting is cheap.
void phys_link_groups(PhysSystem *system);
// Sets only Group.populated, from `parent` and `count`.
void phys_link_populated(Group *groups, uint32_t group_count);

// step.c: starts a step of `delta` at `clock`: sets the strengths of all forces and the initial forces on all
// particles.
void phys_start_step(PhysSystem *system, double clock, double delta);
// Takes one step of `delta` at `clock`. Returns false if the step was aborted half-way.
bool phys_step(PhysSystem *system, double clock, double delta, double speed_of_light);

// reorder.c. Returns true if all particles are in one group, and if only the single pass of this group depends on their
// order.
bool phys_can_reorder(const PhysSystem *system);
// Sets whether the columns may be in the order of cells. If they are and must not be, restores their order.
void phys_allow_reorder(PhysSystem *system, bool allowed);
// Puts the columns into the sorted order of a list, so that kernels need not look up columns.
void phys_reorder(PhysSystem *system, struct NeighbourList *list);
// Restores the ascending order of handles and drops all lists.
void phys_restore_order(PhysSystem *system);
// Only drops the lists, for columns that are about to be filled from scratch.
void phys_forget_order(PhysSystem *system);

// Applies links. The two particles of a link can be in any groups.
void phys_apply_links(const Columns *columns, ForceRange forces);
// The motion that follows the pair forces. A pass that receives a Move may move the particles itself, as soon as their
// pair forces are complete. In that case the pass sets `done`.
typedef struct Move {
    double delta;
    double speed_of_light;
    bool done;
} Move;
// Applies all pair forces for which one particle is in `group` and the other is in `group` or an enclosing group. Each
// of these groups that declares pair forces has a pass for its forces. `move` is the motion that a pass may carry out;
// NULL: passes must not move particles.
void phys_apply_pairs(PhysSystem *system, uint32_t group, Move *move);

static inline double *phys_acceleration(const Columns *columns) {
    return columns->scratch;
}

// Returns the index of particle i in the columns `radius` and `mass`.
static inline size_t phys_numbers_at(const Columns *columns, size_t i) {
    return columns->uniform_mass ? 0 : i;
}

static inline double phys_at(PhysVector vector, size_t k) {
    return vector ? vector[k] : 0.0;
}

// Returns the distance between two points with n components, which are `stride` doubles apart.
static inline double phys_distance(const double *a, const double *b, size_t n, size_t stride) {
    double square = 0;
    for (size_t k = 0; k < n; k++) {
        double d = b[k * stride] - a[k * stride];
        square += d * d;
    }
    return sqrt(square);
}

// Returns the factor at time `clock` for a strength or a particle's `force` attribute whose ramp time is `ease`.
static inline double phys_ramp(double ease, double clock) {
    return ease > 0 && clock < ease ? clock / ease : 1.0;
}

// Returns the number of parts into which each step is divided.
static inline uint64_t phys_parts(const PhysTime *time) {
    return time->parts > 1 ? time->parts : 1;
}

// Returns the length of the step at `last` of a frame, or of each of its parts.
static inline double phys_step_length(const PhysTime *time, double last) {
    double remaining = time->now - last;
    return (time->resolution < remaining ? time->resolution : remaining) / (double)phys_parts(time);
}

// Begins a part of a step: random forces have the same values in all of them (step.c).
void phys_begin_part(PhysSystem *system, uint64_t part);

// Returns the forces that `group` declares for a stage.
static inline ForceRange phys_forces(const PhysSystem *system, uint32_t group, Stage stage) {
    const uint32_t *start = system->starts + (size_t)group * STAGE_COUNT + stage;
    Force *forces = system->forces.bytes;
    return start[0] == start[1] ? (ForceRange){0} : (ForceRange){forces + start[0], forces + start[1]};
}

// Returns the number after the last group inside `group`. Groups are numbered in pre-order.
static inline uint32_t phys_group_end(const PhysSystem *system, uint32_t group) {
    const Group *groups = system->groups.bytes;
    uint32_t end = group + 1;
    while (end < system->group_count && groups[end].parent >= group)
        end++;
    return end;
}

// Returns the nearest group that encloses `group` and has forces of a stage, or NO_GROUP.
static inline uint32_t phys_next_above(const Group *groups, uint32_t group, Stage stage) {
    return group ? groups[groups[group].parent].nearest[stage] : NO_GROUP;
}

// Returns the nearest group that encloses `group`, has particles and is `level` or inside it, or NO_GROUP. Group
// numbers ascend from parent to child, so an enclosing group with a smaller number than `level` is outside of it.
//
// A pass computes the pair forces that one group, its level, declares, for all pairs with a particle of one group. The
// level is this group or encloses it. The partners are the later particles of the same group, then the particles of the
// enclosing groups up to the level (spec 4.1). Everything that walks over pairs visits them in this order:
//
//     for (level = groups[group].nearest[STAGE_PAIR]; level != NO_GROUP;
//          level = phys_next_above(groups, level, STAGE_PAIR))
//         for (other = group; other != NO_GROUP; other = phys_next_enclosing(groups, other, level))
static inline uint32_t phys_next_enclosing(const Group *groups, uint32_t group, uint32_t level) {
    uint32_t next = group ? groups[groups[group].parent].populated : NO_GROUP;
    return next != NO_GROUP && next >= level ? next : NO_GROUP;
}
