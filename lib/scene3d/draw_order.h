// draw_order.h: the visible instances of a scene, and the order in which they are drawn (spec canvas3d.md 2.6).
#pragma once

#include "scene3d/scene.h"

enum { SCENE_MAX_TRIANGLES = 50000000 };

// The bounding box of a model, in model coordinates.
typedef struct SceneBox {
    float low[3];
    float high[3];
    uint32_t triangles; // number of triangles; 0: nothing to draw
    float layers[3];    // how many triangles a line along each axis through the box meets from one side, on average
    float lengths[3];   // sum of the lengths of all triangles along each axis, in lengths of the box
} SceneBox;

// Instances that are drawn with one call.
typedef struct SceneDraw {
    uint32_t group;
    uint32_t model;
    uint32_t textures;
    bool transparent; // drawn after opaque instances, from back to front
    bool translucent; // implies `transparent`; unlike other transparent instances, these write depth
    bool disc;        // true if the instances are spheres that are drawn as discs (sphere_impostor.h)
    bool deep;        // for discs: true if this group or an earlier one writes depth
    uint32_t first;   // index of the first instance in DrawOrder.instances
    uint32_t count;
    uint32_t segments; // number of segments to draw; fewer than the model has if the difference is not visible
} SceneDraw;

typedef struct DrawOrder {
    const SceneInstance **instances; // in drawing order
    uint32_t count;
    SceneDraw *draws;
    uint32_t draw_count;
    uint32_t draw_capacity;
    uint64_t triangles;
    bool cut; // true if instances were left out because there are too many triangles
} DrawOrder;

// Determines the draws of all groups for a picture that is `width` pixels wide. boxes[i] is the bounding box of model
// i.
DrawOrder draw_order(const Scene *scene, const Eye *eye, const Matrix *view, const Matrix *projection, int width,
                     const SceneBox *boxes);
