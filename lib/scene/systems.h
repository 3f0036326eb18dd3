// systems.h: what the scene's files share.
#ifndef PETRI_SCENE_SYSTEMS_H
#define PETRI_SCENE_SYSTEMS_H

#include "base/hash_index.h"
#include "scene/input_bind.h"
#include "scene/mirror.h"
#include "scene/scene.h"
#include "value/node_batch.h"

// A force whose key changes from frame to frame.
typedef struct RandomForce {
    uint32_t force;   // its number in the engine
    uint32_t randoms; // random forces before it
} RandomForce;

// The ends of a distance force, as particle handles.
typedef struct Link {
    uint32_t from;
    uint32_t to;
} Link;

// What a system keeps from frame to frame. It is the same system as long as its prefix is the same.
struct PhysicsSystem {
    PhysicsSystem *next;
    StateSlot start;     // slot of the prefix itself: what identifies the system
    uint32_t occurrence; // 0, or 1, 2 … for further systems of the same prefix in one frame
    StateSlot run;
    StateSlot iteration;
    StateSlot clock;
    StateSlot last;
    PhysSystem *engine;
    Budget *meter; // that its own memory is charged to, as long as it has an engine
    Mirror mirror;
    uint64_t steps;      // of the last update
    bool had_simulated;  // it had simulated before the last update, so the script could see its particles
    uint64_t last_frame; // number of the scene's frame in which it was updated last

    // The last frame's tree: what the next one is compared with.
    uint32_t dimensions;         // in the last update
    uint64_t generation;         // of the nodes below
    const Node *const *children; // of the tree, if they have program lifetime, else NULL
    uint32_t child_count;
    const Node **nodes; // by handle: the particle's node, likewise; unused with `children`
    uint32_t node_count;
    uint32_t node_capacity;
    RandomForce *randoms;
    uint32_t random_count;
    uint32_t random_capacity;
    Link *links; // in the order of the tree
    uint32_t link_count;
    uint32_t link_capacity;
};

struct Scene {
    Schema *schema;
    BodyAttrs body_defaults[2]; // the defaults of a particle and of an anchor
    ForceAttrs force_defaults[PHYS_FORCE_KINDS];
    bool exhausted; // see scene_clear_exhausted
    BudgetOutcome stopped;
    Budget *meter;
    Input input;
    PhysicsSystem *systems;
    PhysicsSystem **systems_end;  // where the next one goes
    PhysicsSystem *next_expected; // the one after that of the last node; or NULL
    PhysicsSystem *viewed;        // the last one that was asked for; or NULL
    size_t viewed_number;
    uint64_t frame_number;
    PhysOptions physics;
    uint32_t *bodies; // by slot: 2 * (base + handle) of the particle whose position it is, + 1 if it is its velocity
    uint32_t body_capacity;
    uint32_t body_base;                 // of the tree that was read last; what is below is of others
    uint32_t body_count;                // of that tree
    const PhysicsSystem *marked_system; // whose tree that was
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
    uint32_t body_count; // particles and anchors
    bool from_state;     // positions and velocities come from the state where it has them
    bool keys_collide;   // two of its keys are one, or one of the system's own
    bool out_of_memory;  // memory was used up
    double run;
    double iteration;
    uint32_t random_count; // the latest key of a random force: how many were before it
    uint64_t random_key;   // 0: none yet
    uint32_t next_group;
    uint32_t next_link;
};

// prefix;id or prefix;id;symbol as a key.
Value scene_key(Arena *arena, Value prefix, Value id, const Symbol *last);

// physics_read.c
void physics_read_defaults(Scene *scene);
// The attributes of a !particle or !anchor; what is wrong is reported. Vectors are borrowed.
void physics_read_particle(const PhysicsTree *tree, const Node *node, bool anchor, BodyAttrs *body);
// Fills the engine from the tree: groups and particles, then forces.
void physics_read_bodies(PhysicsTree *tree);
void physics_read_forces(PhysicsTree *tree);
// The key of the stream of a random force in this frame.
uint64_t physics_random_key(PhysicsTree *tree, uint32_t randoms_before);
// Remembers the node of a particle, if that can help in the next frame: if it `lasts` as long as the program.
void physics_cache_node(const PhysicsTree *tree, uint32_t body, const Node *node, bool has_program_lifetime);

// physics_slots.c
enum { PHYSICS_NO_BODY = -1, PHYSICS_KEY_NUMBERS = 24 };
// The key prefix;id, or prefix;id;:velocity; usual ones are made in `numbers`.
Value physics_key(const PhysicsTree *tree, Value id, bool velocity, double numbers[PHYSICS_KEY_NUMBERS]);
// Is this the id of particle number `body`?
bool physics_has_id(const PhysicsTree *tree, uint32_t body, Value id);
// The particle of the tree with this id, or with this position slot, or PHYSICS_NO_BODY.
int64_t physics_find_body(PhysicsTree *tree, Value id);
int64_t physics_find_slot(const PhysicsTree *tree, StateSlot slot);
// The mark of a slot in the tree that is being read, or 0; sets one (false if memory is used up); begins a tree.
uint32_t physics_mark(const PhysicsTree *tree, StateSlot slot);
bool physics_set_mark(const PhysicsTree *tree, StateSlot slot, uint32_t mark);
void physics_clear_marks(const PhysicsTree *tree);
// Frees the marks, if they are many and will hardly be needed again.
void physics_free_marks(const PhysicsTree *tree);

// physics_reuse.c: brings the engine's description up to date with the tree. False if that is not possible: then it
// must be read from scratch.
bool physics_reuse(PhysicsTree *tree);
// After a frame: what the next one's tree is compared with.
void physics_cache_tree(const PhysicsTree *tree);

// What a system takes before it has any particles, about.
enum { PHYSICS_SYSTEM_BYTES = 24 << 10 };
uint64_t physics_update(Scene *scene, const Node *node, const SceneFrame *frame);
void counter_update(Scene *scene, const Node *node, const SceneFrame *frame);

#endif
