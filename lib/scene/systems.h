// systems.h: internal declarations of lib/scene. Its files, from those that call to those that are called:
//
//   scene.c                               the tree of a frame
//   physics_bind.c, counter_bind.c        its systems and counters; input_bind.c: its inputs
//   physics_reuse.c, physics_read.c       particles and forces, of a tree like the last one or of any
//   physics_lint.c                        what is probably wrong in them; physics_stability.c: in their motion
//   mirror.c                              positions and velocities in the state
//   physics_slots.c                       keys and slots of particles
#pragma once

#include "base/hash_index.h"
#include "scene/input_bind.h"
#include "scene/mirror.h"
#include "scene/scene.h"
#include "value/node_batch.h"

// A random force. The key of its random stream changes from frame to frame.
typedef struct RandomForce {
    uint32_t force;   // number of the force in the engine
    uint32_t randoms; // number of random forces before it in its group and the enclosing groups
} RandomForce;

// The ends of a distance force, as particle handles.
typedef struct Link {
    uint32_t from;
    uint32_t to;
} Link;

// A system, which is retained between frames and identified by its prefix.
struct PhysicsSystem {
    PhysicsSystem *next;
    const Scene *scene;
    StateSlot start;     // slot of the prefix; its value is the time when the run started
    uint32_t occurrence; // number of earlier systems with the same prefix in a frame; usually 0
    StateSlot run;
    StateSlot iteration;
    StateSlot clock;
    StateSlot last;
    PhysSystem *engine;
    Budget *budget; // charged for this struct and mirror.ids, not for the engine
    Mirror mirror;
    uint64_t steps; // steps taken in the last update
    // True if the clock of the system was above 0 before the last update, so that the script could see the particles.
    bool had_simulated;
    uint64_t last_frame; // scene->frame_number of the last update
    const Node *node;    // node of the last update, valid until its end; NULL: the system was skipped

    // The last frame's tree, with which the next one is compared.
    uint32_t dimensions;         // number of dimensions in the last update; 0: no update yet
    uint64_t generation;         // SceneFrame.generation of the frame that stored `children` and `nodes`
    const Node *const *children; // children of the tree if they have program lifetime, else NULL
    uint32_t child_count;
    const Node **nodes; // by handle: node of the particle if it has program lifetime, else NULL
    uint32_t node_count;
    uint32_t node_capacity;
    RandomForce *randoms;
    uint32_t random_count;
    uint32_t random_capacity;
    Link *links; // ends of the distance forces, in the order of the tree
    uint32_t link_count;
    uint32_t link_capacity;
    const NodeOrigin **origins; // by number of the force; elements can be NULL
    uint32_t origin_count;
    uint32_t origin_capacity;
    bool stability_checked;        // physics_report_instability was called
    uint64_t stability_generation; // SceneFrame.generation of that call
    uint64_t origins_frame; // scene->frame_number of the last update that read or compared the nodes of `origins`
};

struct Scene {
    Schema *schema;
    SystemAttrs system_defaults;
    BodyAttrs body_defaults[2]; // defaults of particles [0] and anchors [1]
    ForceAttrs force_defaults[PHYS_FORCE_KINDS];
    bool tree_was_read;    // a tree was read from scratch in the current update
    bool exhausted;        // true if an update ran out of memory (scene_clear_exhausted)
    BudgetOutcome stopped; // why the last update was stopped; BUDGET_OK: it was not
    Budget *budget;
    Input input;
    // All systems: first those that were updated in this frame, in the order of the tree, then the others. So the order
    // of the systems of the last frame depends only on its tree.
    PhysicsSystem *systems;
    PhysicsSystem **next_place; // link after the systems that were updated in this frame
    PhysicsSystem *viewed;      // system that scene_view found last, or NULL
    size_t viewed_number;
    uint64_t frame_number;
    bool origins_valid; // false: the nodes of the last update may have been freed
    PhysOptions physics;
    SceneAddForces *add_forces; // NULL: none
    void *forces_host;          // passed to add_forces
    uint32_t *bodies;           // by slot: mark of its particle (physics_slots.c)
    uint32_t body_capacity;
    uint32_t body_base;                 // base of the marks of the tree read last (physics_slots.c)
    uint32_t body_count;                // number of particles in that tree
    const PhysicsSystem *marked_system; // system of that tree
    // Symbols of state keys
    const Symbol *key_run;
    const Symbol *key_iteration;
    const Symbol *key_clock;
    const Symbol *key_last;
    const Symbol *key_velocity;
    const Symbol *key_time;
};

// A `!physics` tree being read.
struct PhysicsTree {
    Scene *scene;
    PhysicsSystem *system;
    const SceneFrame *frame;
    const Node *root;
    uint32_t dimensions;
    Value prefix;
    PhysSystem *engine;
    uint32_t body_count; // number of particles and anchors read so far
    bool from_state;     // true if positions and velocities are read from the state where it has them
    bool keys_collide;   // true if two particles share a key, or a particle has a key that the system itself uses
    bool out_of_memory;
    bool force_not_finite; // a vector of a force or barrier is infinite or NaN, which was reported
    double run;            // attribute `run`
    double iteration;      // number of this frame in the run, from 0
    uint32_t random_count; // number of random forces before the one with key `random_key`
    uint64_t random_key;   // last key of a random force; 0: none yet
    uint32_t next_group;   // number of the next group to read
    uint32_t next_link;    // number of the next distance force to read
};

// scene.c: sets the options of a system's engine to those of the scene.
void scene_set_engine(PhysicsSystem *system);

// Returns the key prefix;id or, unless `last` is NULL, prefix;id;last.
Value scene_key(Arena *arena, Value prefix, Value id, const Symbol *last);

// physics_read.c
void physics_read_defaults(Scene *scene);
// Reads the attributes of a !particle or !anchor, and reports errors. Vectors point into the node.
void physics_read_particle(const PhysicsTree *tree, const Node *node, bool anchor, BodyAttrs *body);
// Reports positions, velocities and forces of a particle or anchor that are not finite, except those that are
// preserved.
void physics_check_body(const PhysicsTree *tree, const Node *node, bool anchor, const BodyAttrs *body,
                        PhysPreserve preserve);
// Read the tree into the engine: first groups and particles, then forces.
void physics_read_bodies(PhysicsTree *tree);
void physics_read_forces(PhysicsTree *tree);
// Returns the key of a random force's stream in this frame. `randoms_before` is RandomForce.randoms.
uint64_t physics_random_key(PhysicsTree *tree, uint32_t randoms_before);
// Stores the node of a particle if it has program lifetime, so that the next frame can recognise it.
void physics_cache_node(const PhysicsTree *tree, uint32_t body, const Node *node, bool has_program_lifetime);

// physics_lint.c
// Reports a force that does nothing. `parent` is the node of the group in which it acts. Called after all particles
// have been read.
void physics_lint_force(PhysicsTree *tree, const Reader *reader, const Node *parent, uint32_t group,
                        const PhysForce *force);
// Reports settings that are probably not intended.
void physics_lint_settings(const Reader *reader, const SystemAttrs *settings, const SceneFrame *frame);

// physics_slots.c
enum { PHYSICS_NO_BODY = -1, PHYSICS_KEY_NUMBERS = 24 };
// Returns the key prefix;id or prefix;id;:velocity. A short numeric key is stored in `numbers`, any other key in the
// frame's arena.
Value physics_key(const PhysicsTree *tree, Value id, bool velocity, double numbers[PHYSICS_KEY_NUMBERS]);
// Returns true if this is the id of particle `body`.
bool physics_has_id(const PhysicsTree *tree, uint32_t body, Value id);
// Return the particle of the tree with this id or this position slot, or PHYSICS_NO_BODY.
int64_t physics_find_body(PhysicsTree *tree, Value id);
int64_t physics_find_slot(const PhysicsTree *tree, StateSlot slot);
// Marks of the slots of the current tree (physics_slots.c). physics_mark returns 0 for a slot without mark.
// physics_set_mark returns false if out of memory. physics_clear_marks begins a new tree.
uint32_t physics_mark(const PhysicsTree *tree, StateSlot slot);
bool physics_set_mark(const PhysicsTree *tree, StateSlot slot, uint32_t mark);
void physics_clear_marks(const PhysicsTree *tree);
// Sets `slots` to the addresses of the slots that a system has besides those of its particles: start, run,
// iteration, clock and last.
enum { PHYSICS_OWN_SLOTS = 5 };
void physics_own_slots(PhysicsSystem *system, StateSlot *slots[PHYSICS_OWN_SLOTS]);
// After the update of all systems: reports keys that two systems share, if a tree was read in this frame.
void physics_report_shared_keys(Scene *scene, const SceneFrame *frame);
// Frees the marks if they are many and unlikely to be needed again.
void physics_free_marks(const PhysicsTree *tree);

// physics_reuse.c: updates the engine's description (mirror.h) so that it matches the tree. Returns false if the tree
// must be read from scratch.
bool physics_reuse(PhysicsTree *tree);
// Stores the tree after a frame, for comparison with the next one.
void physics_cache_tree(const PhysicsTree *tree);

// physics_stability.c: reports a force that is certainly unstable with steps of `delta`. Checks each program once.
void physics_report_instability(PhysicsTree *tree, const Reader *reader, double delta);
// Reports once if the motion of a system has become meaningless in a frame that ended at `clock`.
// `delta` is the length of the frame's steps.
void physics_report_divergence(PhysicsTree *tree, const Reader *reader, double clock, double delta);

// Approximate memory of a system without particles, in bytes.
enum { PHYSICS_SYSTEM_BYTES = 24 << 10 };
// Update one `!physics` or `!counter`. physics_update returns the number of steps taken.
uint64_t physics_update(Scene *scene, const Node *node, const SceneFrame *frame);
void counter_update(Scene *scene, const Node *node, const SceneFrame *frame);
