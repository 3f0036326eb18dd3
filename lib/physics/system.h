// system.h: interface of the particle engine (spec physics.md section 4).
//
// The engine works on arrays of doubles and does not know Flitter. lib/scene translates `!physics` trees into calls of
// these functions and writes the results to the state. The caller describes a system (phys_begin, phys_add_…) and then
// simulates it frame by frame. Between frames it changes particles and forces with phys_update_particle,
// phys_begin_forces and phys_set_key, or describes the system again. All arithmetic is IEEE double in the order that
// the specification fixes. Therefore results do not depend on storage order or on the number of threads.
#pragma once

#include "base/budget.h"
#include "base/cpu.h"
#include "base/private_api.h"
#include "physics/force_list.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct PhysSystem PhysSystem;

// A vector attribute of n (= dimensions) doubles; NULL: all zeros.
typedef const double *PhysVector;

typedef struct PhysParticle {
    PhysVector position;
    PhysVector velocity; // ignored for an anchor, whose velocity is zero
    PhysVector force;    // ignored for an anchor
    double ease;         // ramp time of `force`, in units of the simulation clock; <= 0: none
    double radius;       // >= 0
    double mass;         // >= 0; a particle with mass 0 is never accelerated
    double charge;
    bool anchor;
    bool position_from_attribute; // true: `position` is an attribute; false: it was kept from an earlier frame (see
                                  // PhysTime.keep_last_finite)
    bool velocity_from_attribute; // the same for `velocity`
} PhysParticle;

typedef enum PhysForceKind {
#define PHYS_KIND(KIND, ...) PHYS_##KIND,
    PHYS_FORCES(PHYS_KIND, PHYS_KIND, PHYS_KIND, PHYS_KIND)
#undef PHYS_KIND
        PHYS_FORCE_KINDS,
} PhysForceKind;

enum { PHYS_FAR_MIN_PARTICLES = 1024 }; // PhysForce.theta has no effect in groups with fewer particles
// Returns about the number of particles above which PhysForce.theta makes a step faster.
double phys_far_min_useful(double theta);

// One force applier or barrier. Some fields are used only by the kinds of forces that their comments name first.
// phys_add_force copies the vectors.
typedef struct PhysForce {
    PhysForceKind kind;
    double strength;
    double ease;         // ramp time of `strength`, in units of the simulation clock; <= 0: none
    double power;        // distance, collision, barrier: exponent of the displacement; a negative value counts as 0
    double max_distance; // pair forces: distance below which the force acts; <= 0: no limit
    double theta;        // gravity, electrostatic: opening angle of the far field; <= 0: none, all pairs are exact
    double overlap;      // adhesion: overlap of two particles at rest; lib/scene clamps it to 0…1
    double density;      // buoyancy: density of the medium
    double restitution;  // barrier: factor of the velocity in a reflection; lib/scene clamps it to 0…1
    bool has_minimum;    // distance and barrier: `minimum` is set
    bool has_maximum;    // distance and barrier: `maximum` is set
    double minimum;
    double maximum;
    uint32_t from; // distance: handles of the two particles
    uint32_t to;
    uint64_t key;       // random: key of the random stream for this frame
    PhysVector vector;  // constant: force; field: direction; drag: flow; buoyancy: gravity; barrier: position
    PhysVector vector2; // constant: acceleration; barrier: unit normal
} PhysForce;

// Returns a system without particles, or NULL if out of memory. The caller frees it with phys_free, which ignores NULL.
PhysSystem *phys_new(void);
void phys_free(PhysSystem *system);

typedef enum PhysNeighbours {
    PHYS_NEIGHBOURS_AUTO,   // neighbour lists where they are faster
    PHYS_NEIGHBOURS_NEVER,  // always all pairs
    PHYS_NEIGHBOURS_ALWAYS, // lists wherever all forces of a pass have a bounded range
} PhysNeighbours;

// A thread pool that systems can share. Its threads start with the first job.
typedef struct PhysThreads PhysThreads;
// Returns a pool of `count` threads including the caller (0: one per processor), or NULL if out of memory.
PhysThreads *phys_threads_new(int count);
void phys_threads_free(PhysThreads *threads);

// Divides the work of systems among processes (division.h).
typedef struct PhysDivision PhysDivision;

// A step that is about to begin. Vectors have n (= dimensions) doubles for each particle, by handle.
typedef struct PhysStepStart {
    uint32_t dimensions;
    uint32_t particle_count;
    double clock;
    double delta;
    const double *position;
    const double *velocity;
    double *force; // zeros, to which the host adds; forces on anchors are ignored
} PhysStepStart;
// Adds forces of the host at the start of a step. Returns false if out of memory.
typedef bool PhysAddForces(void *add_context, const PhysSystem *system, const PhysStepStart *step);

// How a system is computed. Results are bit-identical with all options but `old_rules` and `add_forces`.
typedef struct PhysOptions {
    int threads;    // maximum number of threads, including the caller; <= 0: one per processor
    CpuLevel cpu;   // instruction set; limited to cpu_detected.level
    CpuFma use_fma; // for square roots of pairs; CPU_FMA_FASTER: cpu_detected.use_fma
    PhysNeighbours neighbours;
    PhysThreads *pool; // shared pool, which must outlive the system; NULL: the system creates its own
    Budget *budget;    // charged for work and memory; must outlive the system; NULL: none
    bool keep_forces;  // fill PhysColumns.force, which costs one store per particle and step, and allow phys_explain
                       // (explain.h), which costs one copy of all rows per frame
    const PhysDivision *division; // other processes, which must outlive the system; NULL: none
    unsigned old_rules;           // rules of an earlier specification (base/spec.h)
    PhysAddForces *add_forces;    // called in each step and by phys_explain; ignored with `division`; NULL: none
    void *add_context;            // passed to add_forces
} PhysOptions;

// Replaces the options. A new system has one thread, the detected instruction set and automatic neighbour lists.
void phys_set_options(PhysSystem *system, const PhysOptions *options);

// Maximum size of the arrays of one system, in bytes.
#define PHYS_MAX_BYTES (SIZE_MAX > UINT32_MAX ? UINT64_C(8) << 30 : UINT64_C(2) << 30)

// Starts a new description: removes all groups, particles and forces, but keeps their memory. Afterwards only group
// 0, the top, exists.
void phys_begin(PhysSystem *system, uint32_t dimensions);
// Adds a sub-group and returns its number. Groups must be added in pre-order (a group before its sub-groups, in order
// of declaration), so numbers ascend in pre-order. Particles and forces may come in any order of groups; within a group
// the order of the calls is the order of declaration. If memory runs out, this and the phys_add_… functions below
// return 0, and phys_simulate returns PHYS_NO_MEMORY.
uint32_t phys_add_group(PhysSystem *system, uint32_t parent);
// Adds a particle to a group and returns its handle: 0, 1, 2, … in the order of the calls. Vectors are copied.
uint32_t phys_add_particle(PhysSystem *system, uint32_t group, const PhysParticle *particle);
// Reserves memory for `more` particles, which the caller expects to add next. A failure has no effect.
void phys_expect_particles(PhysSystem *system, uint64_t more);
// Adds a force applier or barrier to a group and returns its number: 0, 1, 2, … in the order of the calls.
uint32_t phys_add_force(PhysSystem *system, uint32_t group, const PhysForce *force);

// The functions below change a description between frames. Values that they do not set stay as in the last frame.
//
// Parts of a particle that phys_update_particle does not change.
typedef struct PhysPreserve {
    bool position;
    bool velocity;
} PhysPreserve;
// Replaces the attributes of a particle by `numbers`. Its group, its `anchor` flag and the parts set in `preserve` stay
// as they are.
void phys_update_particle(PhysSystem *system, uint32_t particle, const PhysParticle *numbers, PhysPreserve preserve);
uint32_t phys_particle_group(const PhysSystem *system, uint32_t particle);
bool phys_is_anchor(const PhysSystem *system, uint32_t particle);
uint32_t phys_group_count(const PhysSystem *system);
uint32_t phys_group_parent(const PhysSystem *system, uint32_t group);
// Removes all forces. New forces are added with phys_add_force.
void phys_begin_forces(PhysSystem *system);
// Sets the key of a random force for the next frame.
void phys_set_key(PhysSystem *system, uint32_t force, uint64_t key);

typedef struct PhysTime {
    double last;           // time up to which the state has been simulated
    double now;            // time of this frame; if now <= last, no step is taken
    double clock;          // simulation clock at `last`
    double resolution;     // maximum step; > 0 and finite
    bool lockstep;         // take all steps that are due; false: only one, or two with high `performance`
    double performance;    // speed of the host; without lockstep, a value above 1.5 allows a second step per frame
    double speed_of_light; // <= 0: no limit
    uint32_t parts;        // equal parts into which each step is divided; 0: 1. Random forces are constant in a step
    double shift;          // distance by which particles are moved when the clock is 0, in sizes of the system
    uint64_t shift_key;    // random stream that gives the directions
    bool keep_last_finite; // a position or velocity that is not finite after the frame is reset to its value before the
                           // frame. A result equal to that value replaces it only if the value came from an
                           // attribute. So 0 does not become -0 from frame to frame
} PhysTime;

typedef enum PhysStatus {
    PHYS_OK,
    PHYS_DROPPED_TIME, // the step limit or the clock's precision was reached; the remaining time was dropped
    PHYS_STOPPED,      // interrupted or over the work limit; nothing was simulated
    PHYS_NO_MEMORY,    // an allocation failed or PHYS_MAX_BYTES would be exceeded; nothing was simulated
} PhysStatus;

enum { PHYS_MAX_STEPS = 1000000 }; // in one frame

typedef struct PhysResult {
    PhysStatus status;
    double clock;   // simulation clock after the frame
    uint64_t steps; // number of steps taken
} PhysResult;

// Simulates one frame (spec section 4). The result is deterministic to the last bit.
PhysResult phys_simulate(PhysSystem *system, const PhysTime *time);

// Call this instead of phys_simulate in a frame in which nothing is simulated. Returns false if memory has run out
// since phys_begin.
bool phys_skip_frame(PhysSystem *system);

uint32_t phys_particle_count(const PhysSystem *system);
// Return the position or velocity of the particle with this handle: n doubles. The velocity of a particle follows its
// position in memory. The pointer does not change until the next phys_begin, and its memory stays readable until the
// phys_begin after that. Values can be non-finite. Before phys_simulate they are the values passed to
// phys_add_particle.
const double *phys_position(const PhysSystem *system, uint32_t particle);
const double *phys_velocity(const PhysSystem *system, uint32_t particle);
// Replaces the position or the velocity of a particle in what phys_position and phys_columns return. The next frame
// must begin with phys_begin.
void phys_show_vector(PhysSystem *system, uint32_t particle, bool velocity, const double *vector);
// Return true if the vector that the last phys_simulate computed was finite. Always true without keep_last_finite.
bool phys_position_finite(const PhysSystem *system, uint32_t particle);
bool phys_velocity_finite(const PhysSystem *system, uint32_t particle);

// Access to a system after phys_simulate, for display. All pointers are valid until the next phys_begin.
//
// One attribute of all particles, indexed by handle.
typedef struct PhysColumn {
    const double *numbers; // value of the particle with handle 0; NULL: no particles
    size_t stride;         // distance in doubles between the values of two particles; 0: all share one value
} PhysColumn;
typedef struct PhysColumns {
    PhysColumn position; // as simulated, n doubles
    PhysColumn velocity;
    PhysColumn force; // n doubles: sum of the forces in the last step; zeros for an anchor. `numbers` is NULL without
                      // PhysOptions.keep_forces or if nothing was simulated since phys_begin or phys_skip_frame
    PhysColumn radius;
    PhysColumn mass;
    PhysColumn charge;
    const bool *anchor; // true for anchors; the values of two handles are `anchor_stride` bytes apart
    size_t anchor_stride;
} PhysColumns;
PhysColumns phys_columns(const PhysSystem *system) PRIVATE_API(phys_columns);
static inline const double *phys_at_particle(PhysColumn column, uint32_t particle) {
    return column.numbers + particle * column.stride;
}
uint32_t phys_force_count(const PhysSystem *system) PRIVATE_API(phys_force_count);
// Copies force applier or barrier `number`, counted from 0 in the order of the calls. Returns false if there is no such
// force.
bool phys_get_force(const PhysSystem *system, uint32_t number, PhysForce *force) PRIVATE_API(phys_get_force);
