// scene_program.h: shader programs that a script gives a group of a scene (spec canvas3d.md 2.1).
#pragma once

#include "scene3d/gpu_cache.h"

// The view that is being rendered.
typedef struct GroupView {
    Gl *gl;
    const Scene *scene;
    const SceneCamera *camera;
    const Eye *eye;
    const Matrix *projected; // projection · view
    const ScenePictures *pictures;
    int width; // of the target, in pixels
    int height;
    int rows; // number of rows that are drawn at a time, kept from draw to draw; start with 2
} GroupView;

// Returns the program of a group, with the uniforms set that do not depend on the model. `standard` is used instead of
// a missing fragment shader. On failure, reports the problem and returns 0.
GLuint scene_group_program(const GroupView *view, const SceneGroup *group, Str standard);
// Sets the texture uniforms for a model. `bits` has one bit for each texture that is set.
void scene_group_set_textures(GLuint program, int bits);
// Draws instances of a shape with the current program, that of `node`. Draws a few rows at a time and measures the
// time. Returns false, after a report, if that exceeds the work limit.
bool scene_group_draw(GroupView *view, const DrawNode *node, const SceneShape *shape, uint32_t count);
