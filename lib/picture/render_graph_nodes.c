// render_graph_nodes.c: the pictures of single nodes: canvases, composites, effects and 3-D scenes; see
// render_graph_walk.h.
#include "gl/functions.h"
#include "picture/layer_composite.h"
#include "picture/render_graph_walk.h"
#include "picture/resize.h"
#include "scene3d/scene.h"

#include <stdio.h>

static Sampler sampler_of(const DrawNode *node) {
    const AttrValue *border = draw_attr(node, ATTR_BORDER), *repeat = draw_attr(node, ATTR_REPEAT);
    Sampler sampler = {.nearest = draw_flag(node, ATTR_NEAREST)};
    for (int k = 0; border && k < 4; k++)
        sampler.border[k] = (float)border->as.numbers[k];
    for (int k = 0; repeat && !border && k < 2; k++)
        sampler.repeat[k] = repeat->as.numbers[k] != 0;
    return sampler;
}

int render_graph_bits(const DrawNode *node, int bits) {
    double x = draw_number(node, ATTR_COLORBITS);
    return x == 8 || x == 16 || x == 32 ? (int)x : bits;
}

// Handles a failed allocation of pixels. If the memory limit was the cause, reports this and returns NULL. If the
// machine is out of memory, aborts the frame.
static Texture *report_no_memory(Walk *walk, const DrawNode *node, int width, int height) {
    char name[40];
    snprintf(name, sizeof name, "!%s", schema_kinds[node->kind].name);
    DiagLevel level = node->kind == KIND_CANVAS3D || node->kind == KIND_CAMERA ? DIAG_ERROR : DIAG_WARNING;
    if (!painter_report_refused(walk->painter, level, &node->origin, name, width, height, walk->diags))
        arena_exhausted(&walk->frame->arena);
    return NULL;
}

Texture *render_graph_draw_canvas(Walk *walk, const DrawNode *node, int width, int height) {
    bool linear = draw_flag(node, ATTR_LINEAR), wide = linear && render_graph_bits(node, 8) > 8;
    double detail = walk->picture->detail;
    Texture *texture = texture_new(&walk->painter->budget, render_graph_pixels(width, detail),
                                   render_graph_pixels(height, detail), wide);
    if (!texture)
        return report_no_memory(walk, node, width, height);
    const CanvasBackend *backend = walk->painter->backend;
    PetriStatus status = backend->draw_canvas ? backend->draw_canvas(walk->painter, walk->picture, node, width, height,
                                                                     texture, walk->diags)
                                              : painter_report_no_backend(walk->diags);
    if (status == PETRI_OUT_OF_MEMORY) {
        texture_free(texture);
        arena_exhausted(&walk->frame->arena);
    }
    if (!linear || wide)
        return texture;
    Texture *converted = texture_from_linear_bytes(&walk->painter->budget, texture);
    texture_free(texture);
    return converted ? converted : report_no_memory(walk, node, width, height);
}

Texture *render_graph_load_image(Walk *walk, const DrawNode *node) {
    const AttrValue *name = draw_attr(node, ATTR_FILENAME);
    PetriPainter *painter = walk->painter;
    ImagePixels image;
    if (!name || name->as.text.len == 0)
        return NULL;
    if (!painter->backend->find_image) {
        painter_report_no_backend(walk->diags);
        return NULL;
    }
    if (!painter->backend->find_image(painter, walk->picture, node, &image, walk->diags))
        return NULL;
    int width = image.width, height = image.height;
    render_graph_node_size(node, &width, &height);
    if (width < 1 || height < 1 || width > IMAGE_MAX_SIDE || height > IMAGE_MAX_SIDE ||
        (int64_t)width * height > IMAGE_MAX_PIXELS) {
        painter_report(walk->diags, &node->origin, DIAG_WARNING, "bad-size",
                       "!image: a picture can have 1 to %d pixels in width and height", IMAGE_MAX_SIDE);
        return NULL;
    }
    Texture *texture = resize_pixels(&painter->budget, image.pixels, image.width, image.height, image.stride,
                                     image.alpha, width, height, draw_word(node, ATTR_FLIP));
    return texture ? texture : report_no_memory(walk, node, width, height);
}

// Charges the work of drawing a node. If that would exceed the limit, reports it and returns false.
static bool charge_node(Walk *walk, const DrawNode *node, double cost, const char *what) {
    if (budget_charge_time(&walk->painter->budget, cost))
        return true;
    painter_report(walk->diags, &node->origin, DIAG_WARNING, "drawing-limit",
                   "!%s: drawing exceeded the work limit (--work): the %s is left out", schema_kinds[node->kind].name,
                   what);
    return false;
}

static Texture *composite_on_cpu(Walk *walk, const DrawNode *node, Texture *const *inputs, uint32_t count, int width,
                                 int height) {
    LayerComposite mix = {.inputs = inputs,
                          .count = count,
                          .width = render_graph_pixels(width, walk->picture->detail),
                          .height = render_graph_pixels(height, walk->picture->detail),
                          .how = draw_word(node, ATTR_COMPOSITE),
                          .alpha = (float)draw_number(node, ATTR_ALPHA),
                          .sampler = sampler_of(node),
                          .bits = render_graph_bits(node, walk->bits),
                          .srgb = node->kind == KIND_RECORD,
                          .budget = &walk->painter->budget};
    if (mix.how == MIX_UNKNOWN && count > 1)
        return NULL;
    if (!charge_node(walk, node, layer_composite_cost(&mix), "picture"))
        return NULL;
    Texture *texture = layer_composite(&mix);
    return texture ? texture : report_no_memory(walk, node, width, height);
}

// Makes the context of the GPU current and returns it. If there is no GPU, reports this and returns NULL.
static Gl *open_gpu(Walk *walk) {
    const char *problem;
    Gl *gl = painter_gl(walk->painter, &problem);
    if (!gl && !problem)
        arena_exhausted(&walk->frame->arena);
    if (gl && (walk->gpu || gl_call.enter(gl, &problem))) {
        walk->gpu = true;
        return gl;
    }
    walk->painter->gl_problem = problem;
    painter_report(walk->diags, NULL, DIAG_WARNING, "needs-gpu", "effects and 3-D scenes are left out: %s", problem);
    return NULL;
}

static bool needs_gpu(const DrawNode *node, Texture *const *inputs, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (!inputs[i]->bytes && !inputs[i]->linear)
            return true;
    return !render_graph_is_plain(node);
}

// Runs an effect on the GPU. Without a GPU, the children are composited without the effect.
static Texture *run_effect(Walk *walk, const DrawNode *node, const GraphNode *past, Texture *const *inputs,
                           uint32_t count, int width, int height) {
    Gl *gl = open_gpu(walk);
    if (!gl)
        return composite_on_cpu(walk, node, inputs, count, width, height);
    GlImage *images = arena_alloc_array(&walk->frame->arena, count, sizeof *images);
    for (uint32_t i = 0; i < count; i++) {
        if (!texture_upload(gl, inputs[i]))
            return report_no_memory(walk, node, inputs[i]->width, inputs[i]->height);
        images[i] = inputs[i]->image;
    }
    bool again = past && past->picture && past->picture->gl == gl;
    const CanvasPicture *picture = walk->picture;
    GlFrame frame = {.beats = past ? picture->beat - walk->beat : 0,
                     .names = picture->names,
                     .numbers = picture->numbers,
                     .name_count = picture->name_count};
    GlEffect effect = {.node = node,
                       .inputs = images,
                       .count = count,
                       .last = again ? past->picture->image : (GlImage){0},
                       .width = render_graph_pixels(width, picture->detail),
                       .height = render_graph_pixels(height, picture->detail),
                       .detail = picture->detail,
                       .format = node->kind == KIND_RECORD ? GL_FORMAT_SRGB8
                                                           : gl_call.format(gl, render_graph_bits(node, walk->bits)),
                       .frame = &frame};
    if (!charge_node(walk, node, gl_call.effect_cost(&effect), "effect"))
        return NULL;
    GlImage image = gl_call.effect(gl, &walk->frame->arena, &effect, walk->diags);
    if (!image.texture && walk->painter->budget.memory_refused)
        return report_no_memory(walk, node, width, height);
    Texture *texture = image.texture ? texture_from_image(&walk->painter->budget, gl, image) : NULL;
    if (image.texture && !texture)
        arena_exhausted(&walk->frame->arena);
    return texture;
}

Texture *render_graph_run_effect(Walk *walk, const DrawNode *node, const GraphNode *past, Texture *const *inputs,
                                 uint32_t count, int width, int height) {
    return needs_gpu(node, inputs, count) ? run_effect(walk, node, past, inputs, count, width, height)
                                          : composite_on_cpu(walk, node, inputs, count, width, height);
}

bool render_graph_check_size(Walk *walk, const DrawNode *node, int width, int height) {
    if (width >= 1 && height >= 1 && width <= PETRI_MAX_PICTURE_SIDE && height <= PETRI_MAX_PICTURE_SIDE)
        return true;
    painter_report(walk->diags, &node->origin, DIAG_WARNING, "bad-size",
                   "!%s: a picture can have 1 to %d pixels in width and height", schema_kinds[node->kind].name,
                   PETRI_MAX_PICTURE_SIDE);
    return false;
}

static GlImage find_texture(void *user_data, Str id) {
    Walk *walk = user_data;
    Texture *found = render_graph_find(walk->painter->render_graph, id);
    if (found && !texture_upload(walk->painter->gl, found)) {
        if (!walk->painter->budget.memory_refused)
            arena_exhausted(&walk->frame->arena);
        found = NULL; // make_view then reports the limit and leaves out the scene
    }
    return found ? found->image : (GlImage){0};
}

// Renders the view of a camera. If that is not possible, reports this and returns NULL.
static Texture *make_view(Walk *walk, const Scene *scene, const SceneCamera *camera) {
    Gl *gl = walk->painter->gl;
    if (!render_graph_check_size(walk, camera->node, camera->width, camera->height))
        return NULL;
    GlImage image = scene_draw(gl, scene, camera, &(ScenePictures){walk, find_texture});
    if (walk->painter->budget.memory_refused) {
        gl_call.image_free(gl, image);
        return report_no_memory(walk, camera->node, camera->width, camera->height);
    }
    Texture *texture = image.texture ? texture_from_image(&walk->painter->budget, gl, image) : NULL;
    if (image.texture && !texture)
        arena_exhausted(&walk->frame->arena);
    return texture;
}

Texture *render_graph_draw_scene(Walk *walk, const DrawNode *node, GraphNode *state, int width, int height) {
    if (!open_gpu(walk))
        return NULL;
    Scene *scene = scene_read(&walk->frame->arena, node, width, height, walk->bits, &walk->picture->reach, walk->diags);
    scene->detail = walk->picture->detail;
    Texture *texture = make_view(walk, scene, &scene->cameras[scene->shown]);
    if (state->id.len > 0 && texture)
        render_graph_name(walk, state->id, texture);
    if (scene->cameras[scene->shown].id.len > 0 && texture)
        render_graph_name(walk, str_copy(&walk->frame->arena, scene->cameras[scene->shown].id), texture);
    render_graph_alloc_children(walk, state, scene->camera_count);
    for (uint32_t i = 1; i < scene->camera_count; i++) {
        const SceneCamera *camera = &scene->cameras[i];
        if (!camera->secondary || i == scene->shown)
            continue;
        state->children[i].picture = make_view(walk, scene, camera);
        if (state->children[i].picture)
            render_graph_name(walk, str_copy(&walk->frame->arena, camera->id), state->children[i].picture);
    }
    return texture;
}

void render_graph_add_record(Walk *walk, const DrawNode *node, Texture *texture) {
    Frame *frame = walk->frame;
    if (!texture_download(walk->painter->gl, texture)) {
        report_no_memory(walk, node, texture->width, texture->height);
        return;
    }
    frame->records = arena_grow(&frame->arena, frame->records, frame->record_count * sizeof *frame->records,
                                (frame->record_count + 1) * sizeof *frame->records);
    frame->records[frame->record_count++] =
        (Recorded){node, render_graph_direct_canvas(node, texture->width, texture->height), texture};
}
