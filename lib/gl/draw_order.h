// draw_order.h: what a camera sees of a scene, and in which order it is drawn (spec canvas3d.md 2.6).
#ifndef PETRI_GL_DRAW_ORDER_H
#define PETRI_GL_DRAW_ORDER_H

#include "gl/scene.h"

enum { SCENE_MAX_TRIANGLES = 50000000 };

// Of a model, in its own coordinates.
typedef struct SceneBox {
    float low[3];
    float high[3];
    uint32_t triangles; // 0: there is no model
} SceneBox;

// Instances that are drawn at once.
typedef struct SceneDraw {
    uint32_t group;
    uint32_t model;
    uint32_t textures;
    bool transparent; // drawn last, from back to front
    bool translucent; // likewise; leaves its depth
    bool disc;        // spheres as sphere_impostor.h has them
    bool deep;        // discs: something is there that has a depth
    uint32_t first;
    uint32_t count;
    uint32_t segments; // of the model: fewer than it has where that looks the same
} SceneDraw;

typedef struct DrawOrder {
    const SceneInstance **instances;
    uint32_t count;
    SceneDraw *draws;
    uint32_t draw_count;
    uint32_t draw_capacity;
    uint64_t triangles;
    bool cut; // some are left out, since there are too many triangles
} DrawOrder;

// Of all groups in a picture of a width; `boxes` has one for each model.
DrawOrder draw_order(const Scene *scene, const Eye *eye, const Matrix *view, const Matrix *projection, int width,
                     const SceneBox *boxes);

#endif
