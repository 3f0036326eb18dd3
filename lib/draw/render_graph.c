// render_graph.c: see render_graph.h.
#include "draw/render_graph.h"

#include "base/heap.h"
#include "draw/layer_composite.h"
#include "draw/painter.h"
#include "gl/functions.h"

#include <stdio.h>
#include <string.h>

enum { MAX_DEPTH = 100, DEFAULT_SIZE = 512 };

// State of a node, kept until the next frame. In that frame, a node with the same parent, kind, tags and id continues
// the state; images must also have the same file. Each state is continued at most once. If several states match a node,
// the node continues the first one that is left.
typedef struct GraphNode GraphNode;
struct GraphNode {
    uint8_t kind;
    bool matched; // true if a node of the next frame has continued this state
    Str tags;
    Str id;
    Str file;
    Texture *picture;    // the node's picture; NULL: none
    GraphNode *children; // the state of each child of the node
    uint32_t count;
};

// A picture that can be referenced by its id.
typedef struct NamedPicture {
    Str id;
    Texture *picture;
} NamedPicture;

typedef struct Frame {
    Arena arena;   // holds all other data of the frame
    GraphNode top; // the windows are its children
    NamedPicture *known;
    uint32_t known_count;
    uint32_t known_capacity;
    Recorded *records;
    uint32_t record_count;
} Frame;

struct RenderGraph {
    Frame frames[2];
    double beat; // beat of the last frame
    int now;     // index in `frames` of the current or last frame
};

typedef struct Walk {
    PetriPainter *painter;
    const CanvasPicture *picture;
    DiagSink *faults;
    Frame *frame;
    const Frame *before; // the previous frame
    int bits;            // bits per channel of the window
    int depth;           // nesting depth of the node that is being rendered
    bool gpu;            // true if the context of the GPU is current in this thread
    double beat;         // beat of the previous frame
    Texture *shown;
} Walk;

RenderGraph *render_graph_new(void) {
    RenderGraph *pictures = heap_calloc(1, sizeof *pictures);
    for (int i = 0; pictures && i < 2; i++)
        arena_init(&pictures->frames[i].arena, "pictures", SIZE_MAX);
    return pictures;
}

static void release_node(GraphNode *made) {
    texture_free(made->picture);
    for (uint32_t i = 0; i < made->count; i++)
        release_node(&made->children[i]);
}

static void clear_frame(Frame *frame) {
    release_node(&frame->top);
    Arena arena = frame->arena;
    arena_reset(&arena);
    *frame = (Frame){.arena = arena};
}

void render_graph_clear(PetriPainter *painter) {
    const char *problem;
    bool gpu = painter->gl && gl_call.enter(painter->gl, &problem);
    for (int i = 0; painter->render_graph && i < 2; i++)
        clear_frame(&painter->render_graph->frames[i]);
    if (gpu)
        gl_call.leave(painter->gl);
}

void render_graph_free(PetriPainter *painter) {
    render_graph_clear(painter);
    for (int i = 0; painter->render_graph && i < 2; i++)
        arena_free(&painter->render_graph->frames[i].arena);
    heap_free(painter->render_graph);
    painter->render_graph = NULL;
}

const Recorded *render_graph_records(const RenderGraph *pictures, uint32_t *count) {
    const Frame *frame = &pictures->frames[pictures->now];
    *count = frame->record_count;
    return frame->records;
}

static Texture *find_known(const Frame *frame, Str id) {
    for (uint32_t i = frame->known_count; i-- > 0;)
        if (str_equal(frame->known[i].id, id))
            return frame->known[i].picture;
    return NULL;
}

Texture *render_graph_find(const RenderGraph *pictures, Str id) {
    Texture *found = find_known(&pictures->frames[pictures->now], id);
    return found ? found : find_known(&pictures->frames[!pictures->now], id);
}

static void name_picture(Walk *walk, Str id, Texture *picture) {
    Frame *frame = walk->frame;
    if (frame->known_count == frame->known_capacity) {
        uint32_t capacity = frame->known_capacity ? 2 * frame->known_capacity : 8;
        frame->known = arena_grow(&frame->arena, frame->known, frame->known_capacity * sizeof *frame->known,
                                  capacity * sizeof *frame->known);
        frame->known_capacity = capacity;
    }
    frame->known[frame->known_count++] = (NamedPicture){id, picture};
}

static Str text_of(Arena *arena, const DrawNode *node, AttrName name) {
    const AttrValue *attr = schema_row((NodeKind)node->kind, name) ? draw_attr(node, name) : NULL;
    return attr ? str_copy(arena, attr->as.text) : (Str){0};
}

// Returns the child of `past` that the state `made` continues, and marks it as matched. Returns NULL if there is none.
static const GraphNode *find_past(const GraphNode *past, const GraphNode *made) {
    for (uint32_t i = 0; past && i < past->count; i++) {
        GraphNode *other = &past->children[i];
        if (!other->matched && other->kind == made->kind && str_equal(other->tags, made->tags) &&
            str_equal(other->id, made->id) &&
            (made->kind != KIND_PICTURE_IMAGE || str_equal(other->file, made->file))) {
            other->matched = true;
            return other;
        }
    }
    return NULL;
}

static Sampler sampler_of(const DrawNode *node) {
    const AttrValue *border = draw_attr(node, ATTR_BORDER), *repeat = draw_attr(node, ATTR_REPEAT);
    Sampler sampler = {.nearest = draw_flag(node, ATTR_NEAREST)};
    for (int k = 0; border && k < 4; k++)
        sampler.border[k] = (float)border->as.numbers[k];
    for (int k = 0; repeat && !border && k < 2; k++)
        sampler.repeat[k] = repeat->as.numbers[k] != 0;
    return sampler;
}

static int bits_of(const DrawNode *node, int bits) {
    double x = draw_number(node, ATTR_COLORBITS);
    return x == 8 || x == 16 || x == 32 ? (int)x : bits;
}

// Handles a failed allocation of pixels. If the memory limit was the cause, reports this and returns NULL. If the
// machine is out of memory, aborts the frame.
static Texture *report_no_memory(Walk *walk, const DrawNode *node, int width, int height) {
    char name[40];
    snprintf(name, sizeof name, "!%s", schema_kinds[node->kind].name);
    if (!draw_report_refused(walk->painter, &node->origin, name, width, height, walk->faults))
        arena_exhausted(&walk->frame->arena);
    return NULL;
}

static Texture *make_canvas(Walk *walk, const DrawNode *node, int width, int height) {
    bool linear = draw_flag(node, ATTR_LINEAR), wide = linear && bits_of(node, 8) > 8;
    double detail = walk->picture->detail;
    Texture *texture = texture_new(&walk->painter->budget, render_graph_pixels(width, detail),
                                   render_graph_pixels(height, detail), wide);
    if (!texture)
        return report_no_memory(walk, node, width, height);
    if (draw_canvas(walk->painter, walk->picture, node, width, height, texture, walk->faults) == PETRI_OUT_OF_MEMORY) {
        texture_free(texture);
        arena_exhausted(&walk->frame->arena);
    }
    if (!linear || wide)
        return texture;
    Texture *converted = texture_from_linear_bytes(&walk->painter->budget, texture);
    texture_free(texture);
    return converted ? converted : report_no_memory(walk, node, width, height);
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
                          .bits = bits_of(node, walk->bits),
                          .srgb = node->kind == KIND_RECORD,
                          .budget = &walk->painter->budget};
    if (mix.how == MIX_UNKNOWN && count > 1)
        return NULL;
    Texture *texture = layer_composite(&mix);
    return texture ? texture : report_no_memory(walk, node, width, height);
}

// Makes the context of the GPU current and returns it. If there is no GPU, reports this and returns NULL.
static Gl *open_gpu(Walk *walk) {
    PetriPainter *painter = walk->painter;
    const char *problem = painter->gl_problem;
    if (!painter->gl && !problem) {
        painter->gl = gl_open(&problem);
        if (painter->gl)
            draw_test_shaders(painter);
    }
    if (painter->gl)
        gl_call.charge(painter->gl, &painter->budget);
    if (!painter->gl && !problem)
        arena_exhausted(&walk->frame->arena);
    if (painter->gl && (walk->gpu || gl_call.enter(painter->gl, &problem))) {
        walk->gpu = true;
        return painter->gl;
    }
    painter->gl_problem = problem;
    draw_report(walk->faults, NULL, DIAG_WARNING, "needs-gpu", "effects and 3-D scenes are left out: %s", problem);
    return NULL;
}

static bool needs_gpu(const DrawNode *node, Texture *const *inputs, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (!inputs[i]->bytes && !inputs[i]->linear)
            return true;
    return !render_graph_is_plain(node);
}

// Charges the work of an effect. If that would exceed the limit, reports it and returns false.
static bool charge_effect(Walk *walk, const GlEffect *effect) {
    Budget *budget = &walk->painter->budget;
    double cost = gl_call.effect_cost(effect);
    if (budget_charge_time(budget, cost))
        return true;
    draw_report(walk->faults, &effect->node->origin, DIAG_WARNING, "drawing-limit",
                "!%s: drawing exceeded the work limit (--work): the effect is left out",
                schema_kinds[effect->node->kind].name);
    return false;
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
                       .format =
                           node->kind == KIND_RECORD ? GL_FORMAT_SRGB8 : gl_call.format(gl, bits_of(node, walk->bits)),
                       .frame = &frame};
    if (!charge_effect(walk, &effect))
        return NULL;
    GlImage image = gl_call.effect(gl, &walk->frame->arena, &effect, walk->faults);
    if (!image.texture && walk->painter->budget.memory_refused)
        return report_no_memory(walk, node, width, height);
    Texture *texture = image.texture ? texture_from_image(&walk->painter->budget, gl, image) : NULL;
    if (image.texture && !texture)
        arena_exhausted(&walk->frame->arena);
    return texture;
}

static bool is_good_size(Walk *walk, NodeKind kind, Origin place, int width, int height) {
    if (width >= 1 && height >= 1 && width <= PETRI_MAX_PICTURE_SIDE && height <= PETRI_MAX_PICTURE_SIDE)
        return true;
    Str text = str_format(walk->faults->arena, "!%s: a picture can have 1 to %d pixels in width and height",
                          schema_kinds[kind].name, PETRI_MAX_PICTURE_SIDE);
    diag_report(walk->faults, &(Diag){DIAG_WARNING, place, text, .code = "bad-size"});
    return false;
}

static GlImage find_texture(void *user_data, Str id) {
    Walk *walk = user_data;
    Texture *found = find_known(walk->frame, id);
    found = found ? found : find_known(walk->before, id);
    if (found && !texture_upload(walk->painter->gl, found)) {
        if (!walk->painter->budget.memory_refused)
            arena_exhausted(&walk->frame->arena);
        found = NULL; // make_view then reports the limit and leaves out the scene
    }
    return found ? found->image : (GlImage){0};
}

// Allocates the state of a node's children.
static void alloc_children(Walk *walk, GraphNode *made, uint32_t count) {
    made->children = arena_alloc_array(&walk->frame->arena, count, sizeof *made->children);
    memset(made->children, 0, count * sizeof *made->children);
    made->count = count;
}

// Renders the view of a camera. If that is not possible, reports this and returns NULL.
static Texture *make_view(Walk *walk, const Scene *scene, const SceneCamera *camera) {
    Gl *gl = walk->painter->gl;
    if (!is_good_size(walk, (NodeKind)camera->node->kind, camera->node->origin, camera->width, camera->height))
        return NULL;
    GlImage image = gl_call.scene(gl, scene, camera, &(ScenePictures){walk, find_texture});
    if (walk->painter->budget.memory_refused) {
        gl_call.image_free(gl, image);
        return report_no_memory(walk, camera->node, camera->width, camera->height);
    }
    Texture *texture = image.texture ? texture_from_image(&walk->painter->budget, gl, image) : NULL;
    if (image.texture && !texture)
        arena_exhausted(&walk->frame->arena);
    return texture;
}

// Renders a scene, and the views of its secondary cameras, which are stored like children of the node.
static Texture *make_scene(Walk *walk, const DrawNode *node, GraphNode *made, int width, int height) {
    if (!open_gpu(walk))
        return NULL;
    Scene *scene =
        scene_read(&walk->frame->arena, node, width, height, walk->bits, &walk->picture->reach, walk->faults);
    scene->detail = walk->picture->detail;
    Texture *texture = make_view(walk, scene, &scene->cameras[scene->shown]);
    if (made->id.len > 0 && texture)
        name_picture(walk, made->id, texture);
    if (scene->cameras[scene->shown].id.len > 0 && texture)
        name_picture(walk, str_copy(&walk->frame->arena, scene->cameras[scene->shown].id), texture);
    alloc_children(walk, made, scene->camera_count);
    for (uint32_t i = 1; i < scene->camera_count; i++) {
        const SceneCamera *camera = &scene->cameras[i];
        if (!camera->secondary || i == scene->shown)
            continue;
        made->children[i].picture = make_view(walk, scene, camera);
        if (made->children[i].picture)
            name_picture(walk, str_copy(&walk->frame->arena, camera->id), made->children[i].picture);
    }
    return texture;
}

static void add_record(Walk *walk, const DrawNode *node, Texture *texture) {
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

static Texture *make_node(Walk *walk, const DrawNode *node, GraphNode *made, const GraphNode *past, int width,
                          int height);

// Renders the children. Stores the pictures that are not hidden in `inputs`, which has space for all children, and
// returns their number.
static uint32_t make_inputs(Walk *walk, const DrawNode *node, GraphNode *made, const GraphNode *past, int width,
                            int height, Texture **inputs) {
    uint32_t count = 0;
    alloc_children(walk, made, node->child_count);
    for (uint32_t i = 0; i < node->child_count; i++) {
        const DrawNode *child = node->children[i];
        Texture *texture = make_node(walk, child, &made->children[i], past, width, height);
        bool hidden = schema_row((NodeKind)child->kind, ATTR_HIDDEN) && draw_flag(child, ATTR_HIDDEN);
        if (texture && !hidden)
            inputs[count++] = texture;
    }
    return count;
}

static Texture *make_effect_node(Walk *walk, const DrawNode *node, GraphNode *made, const GraphNode *past, int width,
                                 int height) {
    Texture **inputs = arena_alloc_array(&walk->frame->arena, node->child_count, sizeof *inputs);
    uint32_t count = make_inputs(walk, node, made, past, width, height, inputs);
    if (node->kind == KIND_OFFSCREEN && node != walk->picture->window && made->id.len == 0)
        return NULL; // no node can refer to this picture
    Texture *texture = needs_gpu(node, inputs, count) ? run_effect(walk, node, past, inputs, count, width, height)
                                                      : composite_on_cpu(walk, node, inputs, count, width, height);
    const AttrValue *file = node->kind == KIND_RECORD ? draw_attr(node, ATTR_FILENAME) : NULL;
    if (texture && file && file->as.text.len > 0)
        add_record(walk, node, texture);
    return texture;
}

static Texture *find_reference(Walk *walk, Str id) {
    Texture *found = find_known(walk->frame, id);
    found = found ? found : find_known(walk->before, id);
    return found ? texture_retain(found) : NULL;
}

// Renders the picture of a node and fills `made`, the state of the node, which owns the picture. `parent` is the state
// of the node's parent in the previous frame; width x height is the size of the parent's picture. Returns NULL if the
// node has no picture.
static Texture *make_node(Walk *walk, const DrawNode *node, GraphNode *made, const GraphNode *parent, int width,
                          int height) {
    Arena *arena = &walk->frame->arena;
    *made = (GraphNode){.kind = node->kind,
                        .tags = str_copy(arena, node->tags),
                        .id = text_of(arena, node, ATTR_ID),
                        .file = text_of(arena, node, ATTR_FILENAME)};
    const GraphNode *past = find_past(parent, made);
    if (walk->depth >= MAX_DEPTH) {
        draw_report(walk->faults, NULL, DIAG_WARNING, "too-deep",
                    "pictures are nested more than %d deep; the innermost are "
                    "left out",
                    MAX_DEPTH);
        return NULL;
    }
    walk->depth++;
    switch ((NodeKind)node->kind) {
    case KIND_POINTER:
    case KIND_KEY:
        break;
    case KIND_REFERENCE:
        made->picture = find_reference(walk, made->id);
        made->id = (Str){0};
        break;
    case KIND_PICTURE_IMAGE:
        made->picture = draw_picture_image(walk->painter, walk->picture, node, walk->faults);
        break;
    default:
        render_graph_node_size(node, &width, &height);
        if (!is_good_size(walk, (NodeKind)node->kind, node->origin, width, height))
            break;
        made->picture = node->kind == KIND_CANVAS     ? make_canvas(walk, node, width, height)
                        : node->kind == KIND_CANVAS3D ? make_scene(walk, node, made, width, height)
                                                      : make_effect_node(walk, node, made, past, width, height);
    }
    walk->depth--;
    if (made->id.len > 0 && made->picture)
        name_picture(walk, made->id, made->picture);
    return made->picture;
}

static void make_windows(void *context) {
    Walk *walk = context;
    const CanvasPicture *picture = walk->picture;
    GraphNode *top = &walk->frame->top;
    alloc_children(walk, top, picture->top_count);
    for (uint32_t i = 0; i < picture->top_count; i++) {
        enum { DEFAULT_BITS = 16 };
        walk->bits = bits_of(picture->tops[i], DEFAULT_BITS);
        Texture *texture =
            make_node(walk, picture->tops[i], &top->children[i], &walk->before->top, DEFAULT_SIZE, DEFAULT_SIZE);
        if (picture->tops[i] == picture->window)
            walk->shown = texture;
    }
}

// Frees the older of the two stored frames. Makes the GPU context current first, because images can only be freed in
// the current context.
static void clear_old_frame(Walk *walk) {
    const char *problem;
    if (walk->painter->gl)
        walk->gpu = gl_call.enter(walk->painter->gl, &problem);
    clear_frame(walk->frame);
}

PetriStatus render_graph_run(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults, Texture **shown) {
    RenderGraph *pictures = painter->render_graph;
    Frame *before = &pictures->frames[pictures->now];
    pictures->now = !pictures->now;
    Walk walk = {.painter = painter,
                 .picture = picture,
                 .faults = faults,
                 .frame = &pictures->frames[pictures->now],
                 .before = before,
                 .beat = pictures->beat};
    pictures->beat = picture->beat;
    draw_limit(painter, picture);
    clear_old_frame(&walk);
    Arena *arenas[] = {&walk.frame->arena, &painter->arena, faults->arena};
    ArenaOutcome end = arena_protect(arenas, 3, make_windows, &walk);
    if (walk.gpu)
        gl_call.leave(painter->gl);
    *shown = end == ARENA_OK ? walk.shown : NULL;
    draw_report_needed(painter, picture, faults);
    return end == ARENA_OK ? PETRI_OK : end == ARENA_MEMORY_LIMIT ? draw_report_limit(faults) : PETRI_OUT_OF_MEMORY;
}
