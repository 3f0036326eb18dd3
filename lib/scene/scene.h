// scene.h: top-level nodes and the systems that they drive.
//
// After each evaluation, scene_update processes the frame's top-level nodes in document order. Systems read and write
// the state dictionary. In `!window` nodes, only the bindings of user input are read.
#pragma once

#include "base/private_api.h"
#include "physics/system.h"
#include "scene/input_bind.h"

typedef struct Scene Scene;

typedef struct SceneFrame {
    State *state;
    Arena *arena;   // for temporary data of the frame
    int64_t number; // number of the frame, for reports
    double time;    // default of the attribute `time`
    double fps;
    double performance;  // PhysTime.performance
    bool lockstep;       // PhysTime.lockstep
    uint64_t generation; // changes after nodes with program lifetime have been freed
    double resolution;   // overrides the attribute `resolution` of all systems; 0: no override
    uint32_t parts;      // PhysTime.parts, shift and shift_key of all systems
    double shift;
    uint64_t shift_key;
} SceneFrame;

// Returns a new scene. The arena and the schema must outlive it. Systems are also charged to the arena's budget.
Scene *scene_new(Arena *arena, Schema *schema);
void scene_free(Scene *scene);
// Sets how the physics of new systems is computed. Results do not depend on the options.
void scene_set_physics(Scene *scene, const PhysOptions *options);
// Sets the rules by which the physics of all systems is computed (base/spec.h).
void scene_set_rules(Scene *scene, unsigned old_rules);
// Adds forces of the host at the start of a step of the system with the prefix in this slot. `engine` is the system or,
// for explanations, a copy. Returns false if out of memory.
typedef bool SceneAddForces(void *host, StateSlot prefix, const PhysSystem *engine, const PhysStepStart *step);
// Sets the function that adds forces in each step of all systems; NULL: none.
void scene_set_forces(Scene *scene, SceneAddForces *add, void *host);
// Returns the thread pool that all systems share, or NULL if there is only one thread.
PhysThreads *scene_threads(const Scene *scene);
// Removes all systems, with what they store of the last frame's tree. Call it when the state dictionary is cleared.
void scene_reset(Scene *scene);
// Detach the systems while others are restored with another state dictionary. If restoring fails, call
// scene_attach_systems, which frees the restored systems and brings back the detached ones. If restoring succeeds, free
// the old dictionary, then the detached systems with scene_free_systems.
typedef struct PhysicsSystem PhysicsSystem;
PhysicsSystem *scene_detach_systems(Scene *scene);
void scene_attach_systems(Scene *scene, PhysicsSystem *systems);
void scene_free_systems(PhysicsSystem *systems);
// A system to save. `slots` are the state slots of the particles in its last tree, in pairs: position, velocity. After
// the system is restored, the next frame uses them to find the entries of particles that are no longer in the tree.
typedef struct SceneSystem {
    StateSlot prefix;
    uint32_t occurrence; // index among the systems with the same prefix
    const StateSlot *slots;
    uint32_t slot_count;
} SceneSystem;
// Iterates over the systems of the last update, in the order of its tree. *cursor starts as NULL. Returns false at the
// end. Absent systems have nothing to save: if they reappear, they start with the values in the state.
bool scene_next_system(const Scene *scene, const void **cursor, SceneSystem *system);
// Restores a system from scene_next_system. Returns false if out of memory.
bool scene_restore_system(Scene *scene, const SceneSystem *system, const SceneFrame *frame);
// A system of the last update, for display. Valid until the next update.
typedef struct SceneView {
    const PhysSystem *engine;
    Value prefix;
    uint32_t dimensions;
    uint32_t particle_count;
    uint64_t steps;         // steps taken in the last update
    double clock;           // simulation clock after the last update
    bool had_simulated;     // true if the clock of the system was above 0 before the last update
    const StateSlot *slots; // by handle: a pair of position and velocity
    PhysicsSystem *system;
} SceneView;
// Fills the view of a system. `number` counts from 0. Returns false if there is no such system.
bool scene_view(Scene *scene, const State *state, size_t number, SceneView *view) PRIVATE_API(scene_view);
// Returns the id of a particle: its state key without the prefix.
Value scene_view_id(Arena *arena, const State *state, const SceneView *view, uint32_t particle);
// Sets *ids to all ids if each is a single number, else to NULL. Returns false if out of memory. *ids is valid until
// the particles change.
bool scene_view_ids(const State *state, const SceneView *view, const double **ids);
// Finds the particle with this id. Returns false if there is none.
bool scene_view_find(Scene *scene, State *state, Arena *arena, const SceneView *view, Value id, uint32_t *particle);
// Lets views show the value of a position or velocity that was stored in the state since the last update.
void scene_show_entry(Scene *scene, const State *state, StateSlot slot);
// Returns the location of the node of a force. Its source is NULL if it is unknown.
Origin scene_force_origin(const Scene *scene, const SceneView *view, uint32_t force);
// Forgets all locations of nodes until the next update. Call it before programs are freed.
void scene_forget_origins(Scene *scene);
// Returns the input that the host reports for `!pointer` and `!key` (input_bind.h).
Input *scene_input(Scene *scene);
// Updates all systems from the nodes in `tree`. Returns the number of simulation steps taken.
uint64_t scene_update(Scene *scene, Value tree, const SceneFrame *frame);
// Returns true if the update of a system ran out of memory since the last call of this function.
bool scene_clear_exhausted(Scene *scene);
// If the budget stopped the last update half-way, returns true once and sets *end to the reason.
bool scene_clear_stopped(Scene *scene, ArenaOutcome *end);
