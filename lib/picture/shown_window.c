// shown_window.c: the windows of a frame, and the choice of the one that a picture shows.
#include "picture/picture.h"
#include "picture/render_graph.h"
#include "session/draw_access.h"
#include "value/format.h"

#include <limits.h>
#include <math.h>

enum { DEFAULT_SIZE = 512, AUTO_SIDE = 1080 };

const Node *picture_find_window(const DrawAccess *access, int number) {
    const Node *first = NULL, *offscreen = NULL, *window;
    for (uint32_t at = 0; (window = canvas_next_window(access->schema, access->tree, &at));) {
        bool on_screen = schema_window_kind(access->schema, window) == KIND_WINDOW;
        if (number >= 0 ? number-- == 0 : on_screen && canvas_window_has_picture(access->schema, window))
            return window;
        if (number < 0 && !offscreen && !on_screen && canvas_window_has_picture(access->schema, window))
            offscreen = window;
        first = first || number >= 0 ? first : window;
    }
    return offscreen ? offscreen : first;
}

// The search of petri_find_window.
typedef struct WindowSearch {
    const char *id;
    int found; // -1: none
    Arena arena;
} WindowSearch;

static PetriStatus find_protected(PetriSession *session, void *context) {
    WindowSearch *search = context;
    DrawAccess access = session_draw_access(session);
    const Node *window;
    int number = 0;
    for (uint32_t at = 0; (window = canvas_next_window(access.schema, access.tree, &at)); number++) {
        Str id = value_text(&search->arena, access.schema->symbols,
                            node_get(window, access.schema->slots[ROW_WINDOW_ID].name));
        if (search->found < 0 && str_equal(id, str_from(search->id)))
            search->found = number;
    }
    return PETRI_OK;
}

int petri_find_window(PetriSession *session, const char *id) {
    if (!session || !id || !id[0])
        return -1;
    DrawAccess access = session_draw_access(session);
    WindowSearch search = {.id = id, .found = -1};
    arena_init(&search.arena, "picture", access.memory_limit);
    search.arena.budget = access.budget;
    session_protect(session, &search.arena, find_protected, &search);
    arena_free(&search.arena);
    return search.found;
}

void picture_report_other_windows(PetriPicture *picture, const DrawAccess *access) {
    const CanvasPicture *canvases = &picture->picture;
    const SchemaSink *sink = &access->schema->sink;
    for (uint32_t i = 0; i < canvases->top_count; i++) {
        const DrawNode *window = canvases->tops[i];
        if (window == canvases->window || window->kind != KIND_WINDOW)
            continue;
        Str text = str_format(&picture->arena, "only one window is drawn; to draw this one, use --window %u", i);
        sink->report(sink->user_data, DIAG_WARNING, "other-window", &window->origin, STR("!window"), STR(""), text);
        return;
    }
}

// Returns a text that the caller must not free.
static const char *size_problem(PetriPicture *picture, double width, double height) {
    return str_format(&picture->arena, "a picture can have 1 to %d pixels in width and height, not %.10g x %.10g",
                      PETRI_MAX_PICTURE_SIDE, width, height)
        .bytes;
}

const char *picture_show_window(PetriPicture *picture, int number) {
    CanvasPicture *canvases = &picture->picture;
    const PetriPictureOptions *options = &picture->options;
    const DrawNode *window = number >= 0 ? canvases->tops[number] : NULL;
    double units_wide = window ? DEFAULT_SIZE : AUTO_SIDE, units_high = units_wide, size[2];
    if (window && draw_pair(window, ATTR_SIZE, size)) {
        units_wide = floor(size[0]);
        units_high = floor(size[1]);
    } else if (window && picture->windows[number].has_size) {
        return "the attribute 'size' of the !window must be two numbers: width;height";
    }
    double width = options->width, height = options->height;
    if (!picture_is_good_size(units_wide, units_high))
        return size_problem(picture, units_wide, units_high);
    if (width == 0 && height == 0) {
        width = floor(units_wide * options->scale + 0.5);
        height = floor(units_high * options->scale + 0.5);
    }
    if (!picture_is_good_size(width, height))
        return size_problem(picture, width, height);
    bool on_screen = window && window->kind == KIND_WINDOW;
    const AttrValue *title = on_screen ? draw_attr(window, ATTR_TITLE) : NULL;
    picture->title = title ? title->as.text.bytes : "";
    picture->width = (int)width;
    picture->height = (int)height;
    picture->shown = number;
    canvases->width = units_wide;
    canvases->height = units_high;
    canvases->window = canvases->automatic ? NULL : window;
    canvases->opaque = canvases->automatic || on_screen;
    canvases->direct =
        canvases->window ? render_graph_direct_canvas(canvases->window, (int)units_wide, (int)units_high) : NULL;
    return NULL;
}

// Returns the window with this number, or NULL.
static const DrawNode *window_at(const PetriPicture *picture, int number) {
    return number >= 0 && (uint32_t)number < picture->picture.top_count ? picture->picture.tops[number] : NULL;
}

int petri_picture_next_window(const PetriPicture *picture, int after) {
    if (!picture || picture->picture.automatic || after == INT_MAX)
        return -1;
    for (int i = after < 0 ? 0 : after + 1; window_at(picture, i); i++)
        if (window_at(picture, i)->kind == KIND_WINDOW && picture->windows[i].has_picture)
            return i;
    return -1;
}

int petri_picture_window(const PetriPicture *picture) {
    return picture ? picture->shown : -1;
}

const char *petri_picture_window_id(const PetriPicture *picture, int window) {
    const DrawNode *node = picture ? window_at(picture, window) : NULL;
    const AttrValue *id = node ? draw_attr(node, ATTR_ID) : NULL;
    return id && id->as.text.len > 0 ? id->as.text.bytes : "";
}

// The arguments of select_window, which is called through arena_protect.
typedef struct Selection {
    PetriPicture *picture;
    int window;
    bool done;
} Selection;

static void select_window(void *context) {
    Selection *selection = context;
    PetriPicture *picture = selection->picture;
    const DrawNode *window = window_at(picture, selection->window);
    const char *problem = picture->picture.automatic || !window || window->kind != KIND_WINDOW
                              ? "nothing to draw: the frame has no !window with this number"
                              : picture_show_window(picture, selection->window);
    selection->done = !problem;
    if (problem)
        diag_report(&picture->diags, &(Diag){.level = DIAG_ERROR,
                                             .text = str_from(problem),
                                             .code = "cannot-draw",
                                             .at = window ? window->origin : (Origin){0}});
}

PetriStatus petri_picture_select(PetriPicture *picture, int window) {
    if (!picture)
        return PETRI_INVALID;
    Selection selection = {.picture = picture, .window = window};
    Arena *arenas[] = {&picture->arena};
    if (arena_protect(arenas, 1, select_window, &selection) != ARENA_OK)
        return PETRI_OUT_OF_MEMORY;
    return selection.done ? PETRI_OK : PETRI_INVALID;
}
