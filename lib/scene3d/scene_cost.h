// scene_cost.h: estimates how long a view of a scene takes to draw, so that it can be charged before it is drawn.
#pragma once

#include "scene3d/draw_order.h"

// The view whose cost is estimated.
typedef struct SceneView {
    const Scene *scene;
    const DrawOrder *order;
    const SceneBox *boxes; // of the scene's models
    Matrix clip;           // projection · view
    int width;             // in pixels
    int height;
    int samples; // per pixel; 0: no multisampling
} SceneView;

// Returns the time in nanoseconds. If a rough upper bound is at most `enough`, returns this bound; it is quick to
// compute.
double scene_cost(const SceneView *view, double enough);
