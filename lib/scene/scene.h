// scene.h: top-level nodes and the systems that they drive.
//
// After each evaluation the frame's top-level nodes are handed to the scene, which updates its systems: kinds in the
// order in which they first appear, and nodes of a kind in order. Systems read and write the state dictionary.
#ifndef PETRI_SCENE_SCENE_H
#define PETRI_SCENE_SCENE_H

#include "scene/attrs.h"
#include "state/state.h"

typedef struct Scene Scene;

typedef struct SceneFrame {
    State *state;
    Arena *arena; // the frame's: temporaries
    double time;
    double fps;
    double performance;
    bool lockstep;
} SceneFrame;

// NULL if memory is used up. The symbol table must outlive the scene.
Scene *scene_new(SymbolTable *symbols, SceneHost host);
void scene_free(Scene *scene);
// Forgets what was in the last frame's tree (for when the state dictionary has been replaced).
void scene_reset(Scene *scene);
// Updates all systems from the node elements of `tree`; returns the simulation steps made.
uint64_t scene_update(Scene *scene, Value tree, const SceneFrame *frame);

#endif
