// scene.c: functions for reading and for drawing scenes; see scene.h.
#include "scene3d/scene.h"

#include "base/file.h"

#include <math.h>
#include <string.h>

const char *scene_path(const Scene *scene, Str name) {
    return str_to_c(scene->arena, path_join(scene->arena, scene->reach->directory, name));
}

void scene_report(const Scene *scene, const char *code, const DrawNode *node, const char *problem) {
    if (!scene->diags)
        return;
    Str text = str_format(scene->diags->arena, "!%s: %s", schema_kinds[node->kind].name, problem);
    diag_report(scene->diags, &(Diag){DIAG_WARNING, node->origin, text, .code = code});
}

void scene_report_missing(const Scene *scene, const DrawNode *node) {
    Str text = str_format(scene->diags->arena, "!%s: drawing exceeded the work limit (--work): the scene is left out",
                          schema_kinds[node->kind].name);
    diag_report(scene->diags, &(Diag){DIAG_ERROR, node->origin, text, .code = "drawing-limit"});
}

Eye scene_eye(const Scene *scene, const SceneCamera *camera) {
    const GraphicsState3D *state = &camera->state;
    Eye eye = {.state = state, .aspect = (double)camera->width / camera->height};
    memcpy(eye.position, camera->position, sizeof eye.position);
    memcpy(eye.focus, camera->focus, sizeof eye.focus);
    memcpy(eye.up, camera->up, sizeof eye.up);
    eye.near = fmax(state->near, 1e-9);
    eye.far = fmax(isnan(state->far) ? scene->width : state->far, eye.near + 1e-9);
    eye.width = isnan(state->width) ? scene->width : state->width;
    return eye;
}

uint32_t scene_lights(const SceneGroup *group, SceneLight *lights, uint32_t max) {
    uint32_t count = 0, wanted = (uint32_t)scene_clamp(group->state.max_lights, 1, max);
    for (; group; group = group->parent)
        for (uint32_t i = 0; i < group->light_count && count < wanted; i++)
            lights[count++] = group->lights[i];
    return count;
}
