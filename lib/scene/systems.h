// systems.h: what the scene's files share.
#ifndef PETRI_SCENE_SYSTEMS_H
#define PETRI_SCENE_SYSTEMS_H

#include "physics/system.h"
#include "scene/input_bind.h"
#include "scene/scene.h"

// What a system keeps from frame to frame. It is the same system as long as its prefix is the same.
typedef struct PhysicsSystem PhysicsSystem;
struct PhysicsSystem {
    PhysicsSystem *next;
    StateSlot start;     // slot of the prefix itself: what identifies the system
    uint32_t occurrence; // 0, or 1, 2 … for further systems of the same prefix in one frame
    StateSlot run;
    StateSlot iteration;
    StateSlot clock;
    StateSlot last;
    PhysSystem *engine;
    StateSlot *slots; // positions and velocities, in pairs, of the particles in the last frame's tree
    uint32_t slot_count;
    uint32_t slot_capacity;
    uint32_t dimensions; // in the last update
    uint64_t steps;      // likewise
    uint64_t seen;       // number of the scene's frame in which it was updated last
};

struct Scene {
    Schema schema;
    Input input;
    PhysicsSystem *systems;
    uint64_t frame_number;
    PhysOptions physics;
    // Symbols of state keys
    const Symbol *key_run;
    const Symbol *key_iteration;
    const Symbol *key_clock;
    const Symbol *key_last;
    const Symbol *key_velocity;
    const Symbol *key_time;
};

// A particle or anchor of the tree.
typedef struct Body {
    const Node *node;
    StateSlot position;
    StateSlot velocity;
    uint32_t handle;
    bool anchor;
} Body;

// A `!physics` tree being read.
typedef struct PhysicsTree {
    Scene *scene;
    const SceneFrame *frame;
    const Node *root;
    uint32_t dimensions;
    Value prefix;
    Body *bodies;
    uint32_t body_count;
    uint32_t body_capacity;
    uint32_t particle_count; // bodies that are not anchors
    Index by_slot;           // bodies by the slot of their position; heap, freed by physics_tree_free
    PhysSystem *engine;
    bool from_state; // positions and velocities come from the state where it has them
    double run;
    double iteration;
    uint32_t next_group;
} PhysicsTree;

// prefix;id or prefix;id;symbol as a key.
Value scene_key(Arena *arena, Value prefix, Value id, const Symbol *last);
double scene_number(const State *state, StateSlot slot, double fallback);

// Fills the engine from the tree: groups and particles, then forces.
void physics_read_bodies(PhysicsTree *tree);
void physics_read_forces(PhysicsTree *tree);
// The body with this position slot, or with this id; NULL if there is none.
const Body *physics_find_slot(const PhysicsTree *tree, StateSlot slot);
const Body *physics_find_body(const PhysicsTree *tree, Value id);

uint64_t physics_update(Scene *scene, const Node *node, const SceneFrame *frame);
void counter_update(Scene *scene, const Node *node, const SceneFrame *frame);

#endif
