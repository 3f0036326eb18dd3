// renderer.c: the functions of a painter that do not depend on Cairo; see painter.h.
#include "base/heap.h"
#include "draw/painter.h"
#include "draw/resize.h"
#include "gl/functions.h"

#include <math.h>
#include <string.h>

PetriPainter *petri_painter_open(void) {
    PetriPainter *painter = heap_calloc(1, sizeof *painter);
    if (!painter)
        return NULL;
    arena_init(&painter->arena, "painter", SIZE_MAX);
    painter->budget.memory_limit = SIZE_MAX;
    budget_begin(&painter->budget, UINT64_MAX, NULL);
    painter->arena.budget = &painter->budget;
    painter->render_graph = render_graph_new();
    if (painter->render_graph)
        return painter;
    petri_painter_close(&painter);
    return NULL;
}

void petri_painter_close(PetriPainter **handle) {
    if (!handle)
        return;
    PetriPainter *painter = *handle;
    *handle = NULL;
    if (!painter)
        return;
    draw_tools_close(painter);
    render_graph_free(painter);
    if (painter->gl)
        gl_call.close(painter->gl);
    heap_free(painter->window);
    arena_free(&painter->arena);
    heap_free(painter);
}

// A GlShaderTest. `user_data` is the painter.
static bool test_shader(void *user_data, const char *vertex, const char *fragment, GlShaderProblem *problem) {
    const PetriPainter *painter = user_data;
    PetriShaderProblem found = {.size = sizeof found};
    if (painter->shader_test(painter->shader_test_data, vertex, fragment, &found))
        return true;
    found.text[sizeof found.text - 1] = '\0';
    *problem = (GlShaderProblem){.failed = found.failed, .in_vertex = found.in_vertex};
    memcpy(problem->text, found.text, sizeof problem->text);
    return false;
}

void petri_painter_test_shaders(PetriPainter *painter, PetriShaderTest *test, void *user_data) {
    if (!painter)
        return;
    painter->shader_test = test;
    painter->shader_test_data = user_data;
    if (painter->gl)
        draw_test_shaders(painter);
}

void draw_test_shaders(PetriPainter *painter) {
    gl_call.test_shaders(painter->gl, painter->shader_test ? test_shader : NULL, painter);
}

bool petri_shader_try(const char *vertex, const char *fragment, PetriShaderProblem *problem, size_t size) {
    GlShaderProblem found = {0};
    if (!vertex || !fragment || !problem)
        return false;
    if (gl_try_program(vertex, fragment, &found))
        return true;
    PetriShaderProblem reported = {size < sizeof reported ? size : sizeof reported, found.failed, found.in_vertex, ""};
    memcpy(reported.text, found.text, sizeof reported.text);
    host_struct_write(problem, size, &reported, sizeof reported);
    return false;
}

void draw_report_args(DiagSink *faults, const Origin *place, DiagLevel level, const char *code, const char *format,
                      va_list args) {
    Text text = text_new(faults->arena);
    text_add_va(&text, format, args);
    Diag diag = {.level = level, .text = text_str(&text), .code = code};
    if (place)
        diag.at = *place;
    diag_report(faults, &diag);
}

void draw_report(DiagSink *faults, const Origin *place, DiagLevel level, const char *code, const char *format, ...) {
    va_list args;
    va_start(args, format);
    draw_report_args(faults, place, level, code, format, args);
    va_end(args);
}

bool draw_report_refused(PetriPainter *painter, DiagLevel level, const Origin *place, const char *node, int width,
                         int height, DiagSink *faults) {
    if (!painter->budget.memory_refused)
        return false;
    painter->budget.memory_refused = false;
    painter->lacks_memory = true;
    draw_report(faults, place, level, "memory-limit",
                "%s: a picture of %d x %d pixels exceeds the memory limit (--memory); it is left out", node, width,
                height);
    return true;
}

double draw_fit(double width, double height, double box_width, double box_height, double *left, double *top) {
    double scale = fmin(box_width / width, box_height / height);
    *left = (box_width - width * scale) / 2;
    *top = (box_height - height * scale) / 2;
    return scale;
}

void draw_limit(PetriPainter *painter, const CanvasPicture *picture) {
    painter->budget.memory_limit = picture->memory;
    painter->lacks_memory = false;
    // Drawing has a separate work limit. Its work is not charged to the frame.
    budget_begin(&painter->budget, budget_drawing_limit(picture->work), NULL);
}

// The context of report_needed, which is called through arena_protect.
typedef struct Needed {
    PetriPainter *painter;
    const CanvasPicture *picture;
    DiagSink *faults;
} Needed;

static void report_needed(void *context) {
    const Needed *needed = context;
    PetriPainter *painter = needed->painter;
    if (painter->budget.refused_time > 0)
        draw_report(needed->faults, NULL, DIAG_NOTE, "drawing-limit", "--work %.0fM suffices to draw everything",
                    budget_suggest_work(&painter->budget));
    if (painter->lacks_memory)
        draw_report(needed->faults, NULL, DIAG_NOTE, "memory-limit", "--memory %.0fM suffices to draw everything",
                    budget_suggest_memory(&painter->budget, needed->picture->session_memory));
}

void draw_report_needed(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults) {
    Needed needed = {painter, picture, faults};
    (void)arena_protect(&faults->arena, 1, report_needed, &needed); // without memory, the note is left out
}

static void report_limit(void *faults) {
    draw_report(faults, NULL, DIAG_ERROR, "memory-limit",
                "drawing exceeded the memory limit (--memory): the picture is not drawn");
}

PetriStatus draw_report_limit(DiagSink *faults) {
    return arena_protect(&faults->arena, 1, report_limit, faults) == ARENA_OK ? PETRI_INVALID : PETRI_OUT_OF_MEMORY;
}

void draw_clear(uint32_t *pixels, int width, int height, size_t stride) {
    for (int y = 0; y < height; y++)
        memset((unsigned char *)pixels + (size_t)y * stride, 0, (size_t)width * sizeof *pixels);
}

// Renders the render graph unless it was already rendered for this picture.
static PetriStatus make_pictures(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults) {
    if (painter->made == picture->serial) {
        painter->shown =
            render_graph_window(painter->render_graph, picture); // petri_picture_select may have changed it
        return PETRI_OK;
    }
    painter->shown = NULL;
    PetriStatus result = render_graph_run(painter, picture, faults, &painter->shown);
    painter->made = result == PETRI_OK ? picture->serial : 0;
    painter->made_frame = picture->frame;
    painter->total_work += painter->budget.work + (painter->gl ? gl_call.shader_work(painter->gl) : 0);
    return result;
}

PetriStatus draw_render(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults) {
    if (picture->window && (picture->needs_history || !picture->direct))
        return make_pictures(painter, picture, faults);
    if (painter->made > 0 &&
        painter->made !=
            picture->serial) { // this frame does not use the render graph, so the next frame has nothing to continue
        render_graph_clear(painter);
        painter->made = 0;
        painter->shown = NULL;
    }
    return PETRI_OK;
}

const Texture *draw_rendered(const PetriPainter *painter, const CanvasPicture *picture) {
    return picture->window && painter->made == picture->serial ? painter->shown : NULL;
}

typedef struct Fetching {
    PetriPainter *painter;
    const CanvasPicture *picture;
    DiagSink *faults;
} Fetching;

// Downloads the window's picture from the GPU. If the memory limit does not allow this, reports it and removes the
// picture.
static void download_shown(void *context) {
    Fetching *fetching = context;
    PetriPainter *painter = fetching->painter;
    Texture *shown = painter->shown;
    const char *problem;
    bool good = gl_call.enter(painter->gl, &problem);
    if (good) {
        good = texture_download(painter->gl, shown);
        gl_call.leave(painter->gl);
    }
    if (good)
        return;
    painter->shown = NULL;
    if (!draw_report_refused(painter, DIAG_ERROR, &fetching->picture->window->origin, "!window", shown->width,
                             shown->height, fetching->faults))
        arena_exhausted(fetching->faults->arena);
}

PetriStatus draw_render_pixels(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults) {
    PetriStatus result = draw_render(painter, picture, faults);
    const Texture *made = result == PETRI_OK ? draw_rendered(painter, picture) : NULL;
    Fetching fetching = {painter, picture, faults};
    if (made && !made->bytes && !made->linear &&
        arena_protect(&faults->arena, 1, download_shown, &fetching) != ARENA_OK)
        result = PETRI_OUT_OF_MEMORY;
    return result;
}

void draw_texture(const Texture *texture, bool opaque, uint32_t *pixels, size_t stride) {
    for (int y = 0; y < texture->height; y++) {
        uint32_t *row = (uint32_t *)(void *)((unsigned char *)pixels + (size_t)y * stride);
        texture_row(texture, y, opaque, row);
    }
}

const Recorded *draw_records(const PetriPainter *painter, const CanvasPicture *picture, uint32_t *count) {
    *count = 0;
    return painter->made == picture->serial ? render_graph_records(painter->render_graph, count) : NULL;
}

Texture *draw_sized_image(PetriPainter *painter, const DrawNode *node, const uint32_t *pixels, int width, int height,
                          size_t stride, bool alpha, DiagSink *faults) {
    int wide = width, high = height;
    render_graph_node_size(node, &wide, &high);
    if (wide < 1 || high < 1 || wide > DRAW_MAX_SIDE || high > DRAW_MAX_SIDE ||
        (int64_t)wide * high > DRAW_MAX_PIXELS) {
        draw_report(faults, &node->origin, DIAG_WARNING, "bad-size",
                    "!image: a picture can have 1 to %d pixels in width and height", DRAW_MAX_SIDE);
        return NULL;
    }
    Texture *texture =
        resize_pixels(&painter->budget, pixels, width, height, stride, alpha, wide, high, draw_word(node, ATTR_FLIP));
    if (!texture && !draw_report_refused(painter, DIAG_WARNING, &node->origin, "!image", wide, high, faults))
        arena_exhausted(&painter->arena);
    return texture;
}
