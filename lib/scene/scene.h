// scene.h: top-level nodes and the systems that they drive.
//
// After each evaluation the frame's top-level nodes are handed to the scene, which updates its systems: kinds in the
// order in which they first appear, and nodes of a kind in order. Systems read and write the state dictionary.
// Windows only tell where the user's input goes.
#ifndef PETRI_SCENE_SCENE_H
#define PETRI_SCENE_SCENE_H

#include "physics/system.h"
#include "scene/input_bind.h"

typedef struct Scene Scene;

typedef struct SceneFrame {
    State *state;
    Arena *arena; // the frame's: temporaries
    double time;
    double fps;
    double performance;
    bool lockstep;
    uint64_t generation; // another one: programs have been dropped, and nodes of their lifetime with them
    double resolution;   // of all systems, whatever they say themselves; 0: as they say
} SceneFrame;

// The arena and the schema must outlive the scene. Systems are charged to the arena's meter, too.
Scene *scene_new(Arena *arena, Schema *schema);
void scene_free(Scene *scene);
// How the physics of new systems is computed (not what: results do not depend on it).
void scene_set_physics(Scene *scene, const PhysOptions *options);
// Forgets what was in the last frame's tree (for when the state dictionary is cleared).
void scene_reset(Scene *scene);
// Sets the systems aside while others are restored, with another dictionary; they are brought back, in place of those,
// if that has failed, and freed, after their dictionary, if it has not.
typedef struct PhysicsSystem PhysicsSystem;
PhysicsSystem *scene_detach_systems(Scene *scene);
void scene_attach_systems(Scene *scene, PhysicsSystem *systems);
void scene_free_systems(PhysicsSystem *systems);
// For saving: the systems and the state keys of the particles in their last frame's trees, which decide what a later
// frame removes. `*cursor` starts at NULL; false at the end. Slots come in pairs: position, velocity.
typedef struct SceneSystem {
    StateSlot prefix;
    uint32_t occurrence; // of several systems with one prefix
    const StateSlot *slots;
    uint32_t slot_count;
} SceneSystem;
bool scene_next_system(const Scene *scene, const void **cursor, SceneSystem *system);
// Takes a system back, as scene_next_system gave it; false if memory is used up.
bool scene_restore_system(Scene *scene, const SceneSystem *system, const SceneFrame *frame);
// For showing: the systems of the last update, by number from 0; false beyond the last. `slots` has a pair for each
// particle by its number in the engine, position and velocity. Valid until the next update.
typedef struct SceneView {
    const PhysSystem *engine;
    Value prefix;
    uint32_t dimensions;
    uint32_t particle_count;
    uint64_t steps;     // made in the last update
    bool had_simulated; // it had simulated before that
    const StateSlot *slots;
    PhysicsSystem *system;
} SceneView;
bool scene_view(Scene *scene, const State *state, size_t number, SceneView *view);
// The id of a particle of a view: what its key has beyond the prefix.
Value scene_view_id(Arena *arena, const State *state, const SceneView *view, uint32_t particle);
// All ids, if each is one number, else NULL; false if memory is used up. They stay until the system gets others.
bool scene_view_ids(const State *state, const SceneView *view, const double **ids);
// The particle with this id; false if there is none.
bool scene_view_find(Scene *scene, State *state, Arena *arena, const SceneView *view, Value id, uint32_t *particle);
// What the host reports of the user's hands, for `!pointer` and `!key` (input_bind.h).
Input *scene_input(Scene *scene);
// Updates all systems from the node elements of `tree`; returns the simulation steps made.
uint64_t scene_update(Scene *scene, Value tree, const SceneFrame *frame);
// Whether a system could not be updated since this was asked last because memory was used up.
bool scene_clear_exhausted(Scene *scene);
// Whether the arena's meter has ended the last update, half-way, and how.
bool scene_clear_stopped(Scene *scene, ArenaOutcome *end);

#endif
