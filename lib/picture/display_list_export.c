// display_list_export.c: exports a picture as a display list for hosts with their own renderer; see petri-draw.h.
#include "picture/display_list_write.h"
#include "picture/painter.h"
#include "picture/picture.h"

#include <math.h>
#include <string.h>

typedef struct DisplayListExport {
    const CanvasPicture *picture;
    DisplayList list;
    double scale;    // of the automatic picture: pixels per unit
    double color[4]; // of the automatic picture: the current colour; NaN: none
    double line;     // of the automatic picture: the current line width; 0: none
} DisplayListExport;

static void add_unsupported(DisplayListExport *export, const char *what) {
    DISPLAY_WRITE(&export->list, UNSUPPORTED, .name = {.text = str_from(what)});
}

static void clip_shapes(void *context, const double *box) {
    static const DisplayMatrix identity = {1, 0, 0, 1, 0, 0};
    DisplayListExport *export = context;
    if (!box) {
        DISPLAY_WRITE(&export->list, RESTORE, );
        return;
    }
    double right = box[0] + box[2], bottom = box[1] + box[3];
    const double path[] = {PATH_MOVE, box[0], box[1],    PATH_LINE, right,  box[1],    PATH_LINE,
                           right,     bottom, PATH_LINE, box[0],    bottom, PATH_CLOSE};
    DISPLAY_WRITE(&export->list, SAVE, );
    DISPLAY_WRITE(&export->list, MATRIX, .matrix = &identity);
    DISPLAY_WRITE(&export->list, CLIP, .path = {path, sizeof path / sizeof *path});
    export->color[0] = NAN;
    export->line = 0;
}

// Adds a shape of the automatic picture, and the attributes in which it differs from the previous one.
static void add_shape(void *context, const AutoShape *shape) {
    DisplayListExport *export = context;
    const AutoGradient *gradient = shape->gradient;
    if (gradient) {
        const double *from = gradient->inner, *to = gradient->outer;
        const double start[] = {(from[0] - to[0]) / to[2], (from[1] - to[1]) / to[2], from[2] / to[2]};
        DISPLAY_WRITE(&export->list, RADIAL, .matrix = &(DisplayMatrix){to[2], 0, 0, to[2], to[0], to[1]},
                      .inner = start, .alpha = 1, .stops = {gradient->stops, 3});
        export->color[0] = NAN;
    } else if (memcmp(shape->color, export->color, sizeof export->color) != 0) {
        DISPLAY_WRITE(&export->list, COLOR, .colour = shape->color);
        memcpy(export->color, shape->color, sizeof export->color);
    }
    if (shape->line > 0 && shape->line != export->line) {
        DISPLAY_WRITE(&export->list, STROKE_STYLE, .width = shape->line, .mode = COMPOSITE_OVER, .antialias = true);
        export->line = shape->line;
    }
    DISPLAY_WRITE(&export->list, PATH, .fill = shape->line == 0, .stroke = shape->line > 0,
                  .path = {shape->path, shape->length});
}

static void add_automatic(DisplayListExport *export, const CanvasPicture *picture) {
    DISPLAY_WRITE(&export->list, BACKGROUND, .colour = (const double[]){AUTO_GROUND, 1});
    auto_draw(&(AutoTarget){.arena = export->list.arena,
                            .width = picture->width,
                            .height = picture->height,
                            .scale = export->scale,
                            .clip = clip_shapes,
                            .draw = add_shape,
                            .context = export},
              picture->automatic);
}

// Returns the first canvas in the tree of a node. Other nodes that produce a picture, such as effects or a second
// canvas, are reported as unsupported.
static const DrawNode *find_canvas(DisplayListExport *export, const DrawNode *node, int depth) {
    enum { MAX_DEPTH = 100 };
    if (node->kind == KIND_CANVAS || depth > MAX_DEPTH)
        return node->kind == KIND_CANVAS ? node : NULL;
    if (!(node->kind == KIND_WINDOW || node->kind == KIND_OFFSCREEN || node->kind == KIND_RECORD))
        add_unsupported(export, schema_kinds[node->kind].name);
    const DrawNode *found = NULL;
    for (uint32_t i = 0; i < node->child_count; i++) {
        const DrawNode *child = node->children[i];
        if (child->kind == KIND_POINTER || child->kind == KIND_KEY || child->kind == KIND_REFERENCE)
            continue;
        if (found)
            add_unsupported(export, schema_kinds[child->kind].name);
        else
            found = find_canvas(export, child, depth + 1);
    }
    return found;
}

static void add_canvas(DisplayListExport *export, const DrawNode *canvas, const DisplayHost *host) {
    DisplayListSizes sizes = {0};
    if (draw_flag(canvas, ATTR_LINEAR) && draw_number(canvas, ATTR_COLORBITS) > 8)
        add_unsupported(export, "HDR canvas (colorbits)");
    display_list_build(&export->list, canvas, host, &sizes);
}

static void export_picture(void *context) {
    static const DisplayHost host = {.find_pixels = NULL};
    DisplayListExport *export = context;
    const CanvasPicture *picture = export->picture;
    display_list_begin(&export->list, picture->width, picture->height);
    const DrawNode *canvas = picture->automatic ? NULL : find_canvas(export, picture->window, 0);
    if (picture->automatic)
        add_automatic(export, picture);
    else if (canvas)
        add_canvas(export, canvas, &host);
}

static Texture *find_pixels(void *context, Str id) {
    PetriPainter *painter = context;
    Texture *texture = render_graph_find(painter->render_graph, id);
    return texture && texture_download(painter->gl, texture) ? texture : NULL;
}

DisplayNumbers display_list_of_canvas(PetriPainter *painter, const DrawNode *canvas, double width, double height) {
    DisplayListExport export = {.list.arena = &painter->arena};
    display_list_begin(&export.list, width, height);
    add_canvas(&export, canvas, &(DisplayHost){find_pixels, painter});
    return (DisplayNumbers){export.list.numbers.at, export.list.numbers.count};
}

DisplayNumbers display_list_of_picture(Arena *arena, const CanvasPicture *picture, double scale) {
    DisplayListExport export = {.picture = picture, .list.arena = arena, .scale = scale};
    export_picture(&export);
    return (DisplayNumbers){export.list.numbers.at, export.list.numbers.count};
}

bool petri_picture_is_display_list(const PetriPicture *picture) {
    return picture && (!picture->picture.window || (picture->picture.direct && !picture->picture.needs_history));
}

PetriStatus petri_picture_display_list(PetriPicture *picture, const double **numbers, size_t *count) {
    if (!picture || !numbers || !count)
        return PETRI_INVALID;
    Arena *arenas[] = {&picture->arena};
    DisplayListExport export = {
        .picture = &picture->picture, .list.arena = arenas[0], .scale = picture->width / picture->picture.width};
    bool done = arena_protect(arenas, 1, export_picture, &export) == ARENA_OK;
    *numbers = done ? export.list.numbers.at : NULL;
    *count = done ? export.list.numbers.count : 0;
    return done ? PETRI_OK : PETRI_OUT_OF_MEMORY;
}
