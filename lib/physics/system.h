// system.h: a particle system as arrays of doubles, and how it moves (spec physics.md section 4).
//
// This room knows no Flitter word: the scene translates `!physics` trees into calls of these functions and puts the
// results into the state. A system is described (phys_begin … phys_add_…) and then simulated, frame after frame; what
// changes in between is said with phys_update_particle, phys_begin_forces and phys_set_key, or by a new description.
// All arithmetic is IEEE double in the order that the specification fixes; the results do not depend on how the
// particles are stored or on how many threads share the work.
#ifndef PETRI_PHYSICS_SYSTEM_H
#define PETRI_PHYSICS_SYSTEM_H

#include "base/budget.h"
#include "base/cpu.h"
#include "physics/force_list.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct PhysSystem PhysSystem;

// A vector attribute of n (= dimensions) doubles; NULL stands for all zeros.
typedef const double *PhysVector;

typedef struct PhysParticle {
    PhysVector position;
    PhysVector velocity; // ignored for an anchor: zero
    PhysVector force;    // ignored for an anchor
    double ease;         // of `force`, in units of the simulation clock
    double radius;       // >= 0
    double mass;         // >= 0; 0 is never accelerated
    double charge;
    bool anchor;
    bool position_from_attribute; // not from the state: no frame has stored it yet (PhysTime.keep_last_finite)
    bool velocity_from_attribute;
} PhysParticle;

typedef enum PhysForceKind {
#define PHYS_KIND(KIND, ...) PHYS_##KIND,
    PHYS_FORCES(PHYS_KIND, PHYS_KIND, PHYS_KIND, PHYS_KIND)
#undef PHYS_KIND
        PHYS_FORCE_KINDS,
} PhysForceKind;

// One force applier or barrier. Fields that its kind does not name are ignored. Vectors are copied by phys_add_force.
typedef struct PhysForce {
    PhysForceKind kind;
    double strength;
    double ease;         // ramp of strength, in units of the simulation clock; <= 0: none
    double power;        // distance, collision, barrier; below 0 counts as 0
    double max_distance; // pair forces; <= 0: no limit
    double overlap;      // adhesion; clamped to 0…1 by the scene
    double density;      // buoyancy
    double restitution;  // barrier; clamped to 0…1 by the scene
    bool has_minimum;    // distance and barrier bounds
    bool has_maximum;
    double minimum;
    double maximum;
    uint32_t from; // distance: particle handles
    uint32_t to;
    uint64_t key;       // random: key of the stream for this frame
    PhysVector vector;  // constant: force; field: direction; drag: flow; buoyancy: gravity; barrier: position
    PhysVector vector2; // constant: acceleration; barrier: unit normal
} PhysForce;

// A system without particles; NULL if memory is used up. phys_free takes NULL too.
PhysSystem *phys_new(void);
void phys_free(PhysSystem *system);

typedef enum PhysNeighbours {
    PHYS_NEIGHBOURS_AUTO,   // neighbour lists where they pay
    PHYS_NEIGHBOURS_NEVER,  // all pairs always
    PHYS_NEIGHBOURS_ALWAYS, // lists wherever the forces of a pass have a bounded reach
} PhysNeighbours;

// Threads that systems can share; they start when there is work for them. NULL if memory is used up.
typedef struct PhysThreads PhysThreads;
PhysThreads *phys_threads_new(int count); // with the caller; 0: as many as processors
void phys_threads_free(PhysThreads *threads);

// Processes that simulate the same systems together. All of them do the same; of large passes over pairs each computes
// a part, and numbers go between them: `runs` runs of `length` doubles, `stride` doubles from one to the next.
typedef struct PhysRanks {
    int rank; // of this process, from 0
    int rank_count;
    uint64_t min_pairs; // pairs of a pass that are worth it; 0: as many as are found to be
    void *user_data;
    void (*send)(void *host, int to, const double *numbers, size_t count, size_t block_length,
                 size_t stride); // never waits
    void (*receive)(void *host, int from, double *numbers, size_t count, size_t block_length, size_t stride);
    // Those of one rank become those of all.
    void (*broadcast)(void *host, int from, double *numbers, size_t count, size_t block_length, size_t stride);
    // Those of each rank r, at starts[r] up to starts[r + 1], become those of all.
    void (*allgatherv)(void *host, double *numbers, const size_t *starts);
    // Each becomes the largest that a rank has; there is no NaN among them.
    void (*allreduce_max)(void *host, double *numbers, size_t count);
    // Memory for so many doubles that all ranks have in common, until the next call; NULL if they have none, on all of
    // them. The function may be NULL, too.
    double *(*alloc_shared)(void *host, size_t count);
    // A wish for an end, which the meter has, too, lets all these return without the others: what comes is zeros then.
} PhysRanks;

// How the ranks have shared a system, and what this one has sent for it.
typedef enum PhysDecomposition {
    PHYS_REPLICATED,        // each does all of it
    PHYS_FORCE_DECOMPOSED,  // blocks of pairs are dealt out
    PHYS_DOMAIN_DECOMPOSED, // each has the particles of a region
} PhysDecomposition;
typedef struct PhysRankStats {
    PhysDecomposition decomposition; // in the last frame
    uint64_t frames;
    uint64_t steps;
    uint64_t step_bytes; // halos, particles that move to another rank, sums of pairs
    uint64_t step_messages;
    uint64_t reductions;  // that all ranks take part in
    uint64_t frame_bytes; // to make everything whole at the end of frames
    uint64_t own;         // particles of its region, summed over steps
    uint64_t halo;        // those of other regions that it was told of, likewise
} PhysRankStats;

// How a system is computed. Nothing of it changes a bit of the results.
typedef struct PhysOptions {
    int threads;  // at most so many; 0: as many as processors
    CpuLevel cpu; // at most cpu_detected.level
    PhysNeighbours neighbours;
    PhysThreads *pool; // threads to work with, which outlive the system; NULL: it has its own
    Budget *meter;     // that work and memory are charged to, which outlives the system; NULL: none
    bool keep_forces;  // for PhysColumns.force; costs one store per particle and step
    PhysRanks ranks;   // none if its count is 0
} PhysOptions;

// A new system has one thread, the detected level and lists where they pay.
void phys_set_options(PhysSystem *system, const PhysOptions *options);

// The most bytes that the arrays of one system may take.
#define PHYS_MAX_BYTES (SIZE_MAX > UINT32_MAX ? UINT64_C(8) << 30 : UINT64_C(2) << 30)

// Starts a new description: drops groups, particles and forces (memory is kept). Group 0, the top, exists then.
void phys_begin(PhysSystem *system, uint32_t dimensions);
// Adds a sub-group and returns its number. Groups must be added in pre-order (a group before its sub-groups, in order
// of declaration), so numbers ascend in pre-order. Particles and forces may come in any order of groups; within a group
// the order of the calls is the order of declaration.
uint32_t phys_add_group(PhysSystem *system, uint32_t parent);
// Adds a particle to a group and returns its handle: 0, 1, 2, … in the order of the calls. Vectors are copied.
uint32_t phys_add_particle(PhysSystem *system, uint32_t group, const PhysParticle *particle);
// Makes room for so many particles, which may come next.
void phys_expect_particles(PhysSystem *system, uint64_t more);
// Adds a force applier or barrier to a group and returns its number: 0, 1, 2, … in the order of the calls.
uint32_t phys_add_force(PhysSystem *system, uint32_t group, const PhysForce *force);

// Changes of a description. What a call leaves out stays as it is after the last frame.
// Gives a particle new numbers. Its group stays, and so does whether it is an anchor; so do those of
// its position and velocity that are preserved.
typedef struct PhysPreserve {
    bool position;
    bool velocity;
} PhysPreserve;
void phys_update_particle(PhysSystem *system, uint32_t particle, const PhysParticle *numbers, PhysPreserve preserve);
uint32_t phys_particle_group(const PhysSystem *system, uint32_t particle);
bool phys_is_anchor(const PhysSystem *system, uint32_t particle);
uint32_t phys_group_count(const PhysSystem *system);
uint32_t phys_group_parent(const PhysSystem *system, uint32_t group);
// Drops all forces; phys_add_force gives new ones.
void phys_begin_forces(PhysSystem *system);
// The key of a random force for the next frame.
void phys_set_key(PhysSystem *system, uint32_t force, uint64_t key);

typedef struct PhysTime {
    double last;           // time up to which the state has been simulated
    double now;            // time of this frame; > last
    double clock;          // simulation clock at `last`
    double resolution;     // longest step; > 0 and finite
    bool lockstep;         // always catch up
    double performance;    // engine performance, decides about the one extra step in real time
    double speed_of_light; // <= 0: no limit
    bool keep_last_finite; // a position or velocity that is not finite afterwards is put back to what it was before
                           // the frame, and so is one that equals it (0 does not become -0), unless that came from an
                           // attribute: then any finite result counts
} PhysTime;

typedef enum PhysStatus {
    PHYS_OK,
    PHYS_DROPPED_TIME, // the step limit or the precision of the clock was reached; the rest of the frame was dropped
    PHYS_STOPPED,      // the meter did not let it go on: nothing was simulated
    PHYS_NO_MEMORY,    // an allocation failed or PHYS_MAX_BYTES would be exceeded; nothing was simulated
} PhysStatus;

enum { PHYS_MAX_STEPS = 1000000 }; // in one frame

typedef struct PhysResult {
    PhysStatus status;
    double clock;   // simulation clock afterwards
    uint64_t steps; // steps made
} PhysResult;

// Simulates one frame (spec section 4). Deterministic to the last bit.
PhysResult phys_simulate(PhysSystem *system, const PhysTime *time);

// A frame in which nothing is simulated. False if memory was used up since phys_begin.
bool phys_skip_frame(PhysSystem *system);

uint32_t phys_particle_count(const PhysSystem *system);
// The n doubles of a particle, by handle; the velocity follows the position. They stay where they are until phys_begin,
// and stay readable until the phys_begin after that. They may be non-finite. Before phys_simulate they are what was
// given.
const double *phys_position(const PhysSystem *system, uint32_t particle);
const double *phys_velocity(const PhysSystem *system, uint32_t particle);
// Was the result of the last phys_simulate finite? (Always true without keep_last_finite.)
bool phys_position_finite(const PhysSystem *system, uint32_t particle);
bool phys_velocity_finite(const PhysSystem *system, uint32_t particle);

// For showing a system as it stands after phys_simulate. All vectors are valid until the next phys_begin.
// Where the numbers of all particles lie, by handle: those of the next one are `stride` doubles on.
typedef struct PhysColumn {
    const double *numbers; // NULL without particles
    size_t stride;         // 0: it is the same for all
} PhysColumn;
typedef struct PhysColumns {
    PhysColumn position; // as simulated, n doubles
    PhysColumn velocity;
    PhysColumn force; // n doubles: the sum of the forces on it in the last step, zeros for an anchor. `numbers` is NULL
                      // if nothing was simulated since phys_begin or phys_skip_frame, or the forces were not kept
    PhysColumn radius;
    PhysColumn mass;
    PhysColumn charge;
    const bool *anchor; // the next one is `anchor_stride` bytes on
    size_t anchor_stride;
} PhysColumns;
PhysColumns phys_columns(const PhysSystem *system);
static inline const double *phys_at_particle(PhysColumn column, uint32_t particle) {
    return column.numbers + particle * column.stride;
}
PhysRankStats phys_rank_stats(const PhysSystem *system);
uint32_t phys_force_count(const PhysSystem *system);
// Force appliers and barriers, by number from 0 in the order of the calls; false beyond the last.
bool phys_get_force(const PhysSystem *system, uint32_t number, PhysForce *force);

#endif
