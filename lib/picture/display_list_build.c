// display_list_build.c: translates the nodes of a canvas to a display list in one pass; see display_list.h and spec
// canvas.md 2.
//
// Trees can be thousands of nodes deep, and the stack of the calling thread can be small. The pass therefore uses an
// explicit stack (Level) instead of recursion.
#include "picture/display_list_build.h"

#include "picture/outline.h"

#include <math.h>

enum { MAX_EFFECT_ELEMENTS = 2000000 }; // maximum number of path elements that the effects of a host's list may create

// A node whose children are being translated.
typedef struct Level {
    const DrawNode *node;
    uint32_t next;      // index of the next child
    uint32_t matrix_at; // number of the matrix, the same for all levels that share it; DISPLAY_NONE: not used yet
    uint32_t paint_at;  // number of the paint; DISPLAY_NONE: not used yet
    bool saved;         // true if a PETRI_DRAW_SAVE was added, which leave_node must balance
    DisplayMatrix matrix;
    DisplayPath path;
    GraphicsState state;
} Level;

typedef struct Walk {
    DisplayListBuild build;
    uint32_t numbered; // matrices and paints that have a number
    uint32_t matrix;   // the matrix and the paint written last; DISPLAY_NONE: none
    uint32_t paint;
    Level *levels;
    uint32_t depth;
    uint32_t capacity;
} Walk;

// Gives the matrix and the paint of a level a number, unless they have one.
static void number_level(Walk *walk, Level *level) {
    if (level->matrix_at == DISPLAY_NONE)
        level->matrix_at = walk->numbered++;
    if (level->paint_at == DISPLAY_NONE)
        level->paint_at = walk->numbered++;
}

// Returns the node of a path effect without its outermost dashes, which backends draw themselves. NULL: no other
// effect.
static const DrawNode *effect_beside_dashes(const DrawNode *effect) {
    return !effect || effect->kind != KIND_DASH ? effect : effect->child_count > 0 ? effect->children[0] : NULL;
}

static const DrawNode *effect_of(const DisplayListBuild *build, const GraphicsState *state) {
    return state->effect == DISPLAY_NONE ? NULL : build->settings.at[state->effect].node;
}

static void write_paint(DisplayListBuild *build, const GraphicsState *state) {
    DisplayList *list = build->list;
    const DrawNode *effect = effect_of(build, state), *rest = effect_beside_dashes(effect);
    display_list_build_colour(build, state, effect && effect->kind == KIND_DASH ? effect : NULL);
    if (state->filter != DISPLAY_NONE) {
        const DisplaySetting *filter = &build->settings.at[state->filter];
        DISPLAY_WRITE(list, FILTER, );
        uint32_t start = display_list_open(list);
        build->state = &filter->state;
        display_list_build_filter(build, filter->node);
        display_list_close(list, start);
        list->numbers.at[DISPLAY_HEADER - 1] = true;
    }
    if (rest && !build->host) {
        DISPLAY_WRITE(list, EFFECT, );
        uint32_t start = display_list_open(list);
        display_list_add_note(list, effect->origin, (Str){0});
        display_list_build_effect(build, rest);
        display_list_close(list, start);
    }
}

// Writes the matrix and the paint of the next drawing if they differ from those written last. If `own` is not NULL, it
// replaces the graphics state of the level.
static void begin_drawing(Walk *walk, Level *level, const GraphicsState *own) {
    if (own && level->matrix_at == DISPLAY_NONE)
        level->matrix_at = walk->numbered++;
    else if (!own)
        number_level(walk, level);
    uint32_t paint = own ? walk->numbered++ : level->paint_at;
    if (walk->matrix != level->matrix_at)
        DISPLAY_WRITE(walk->build.list, MATRIX, .matrix = &level->matrix);
    if (walk->paint != paint)
        write_paint(&walk->build, own ? own : &level->state);
    walk->matrix = level->matrix_at;
    walk->paint = paint;
}

// Writes a command that changes the clip or the target. Backends also restore matrix and paint, so both are written
// again after it.
#define WRITE_STATE(walk, level, ...)                                                                                  \
    (number_level((walk), (level)), (walk)->matrix = (walk)->paint = DISPLAY_NONE,                                     \
     DISPLAY_WRITE((walk)->build.list, __VA_ARGS__))

static Level *push_level(Walk *walk, const DrawNode *node) {
    walk->levels =
        arena_grow_array(walk->build.arena, walk->levels, walk->depth, &walk->capacity, sizeof *walk->levels);
    Level *level = &walk->levels[walk->depth++];
    if (walk->depth > 1)
        *level = level[-1];
    level->node = node;
    level->next = 0;
    level->saved = false;
    return level;
}

static bool saves_clip(NodeKind kind) {
    return kind == KIND_CANVAS || kind == KIND_CANVAS_GROUP || kind == KIND_LAYER || kind == KIND_TRANSFORM;
}

// Saves the clip before it changes, unless this was already done. A clip ends with the nearest enclosing canvas, group,
// layer or transform. The level of that node therefore records that the clip must be restored.
static void save_clip(Walk *walk) {
    uint32_t at = walk->depth - 1;
    while (at > 0 && !saves_clip((NodeKind)walk->levels[at].node->kind))
        at--;
    if (walk->levels[at].saved)
        return;
    // No clip has been set inside this node yet, so saving the clip now is equivalent to saving it at the node's start.
    walk->levels[at].saved = true;
    number_level(walk, &walk->levels[walk->depth - 1]);
    DISPLAY_WRITE(walk->build.list, SAVE, );
}

static void write_clip(Walk *walk, Level *level, const DisplayPath *path, bool outside) {
    begin_drawing(walk, level, NULL);
    DISPLAY_WRITE(walk->build.list, CLIP, .outside = outside != (path->fill_type > FILL_EVEN_ODD),
                  .even_odd = path->fill_type & 1, .path = display_list_build_elements(&walk->build, path));
}

// Begins a node with children: pushes a level with a copy of the graphics state, which the node and its children
// change.
static void enter_node(Walk *walk, const DrawNode *node) {
    NodeKind kind = (NodeKind)node->kind;
    double size[2], origin[2];
    if (kind == KIND_LAYER) {
        if (!draw_pair(node, ATTR_SIZE, size))
            return;
        draw_pair(node, ATTR_ORIGIN, origin);
        save_clip(walk);
        DisplayPath box = display_list_build_no_path;
        display_list_build_rectangle(&walk->build, &box, origin, size);
        write_clip(walk, &walk->levels[walk->depth - 1], &box, false);
        display_list_add_note(walk->build.list, node->origin, (Str){0});
        WRITE_STATE(walk, &walk->levels[walk->depth - 1], LAYER, );
    }
    Level *level = push_level(walk, node);
    display_list_build_transform(&level->matrix, node, false);
    if (saves_clip(kind))
        level->matrix_at = DISPLAY_NONE;
    if (display_list_build_read_state(&level->state, node))
        level->paint_at = DISPLAY_NONE;
    if (kind == KIND_PATH || kind == KIND_CANVAS_GROUP || kind == KIND_LAYER) {
        level->path = display_list_build_no_path;
        if (kind != KIND_LAYER)
            level->path.fill_type = (uint8_t)draw_word(node, ATTR_FILL_TYPE);
    }
    if (!display_matrix_is_invertible(&level->matrix))
        level->next = node->child_count; // the content has no area or is out of range: skip it
}

// Sources, filters and effects that were set inside a node also apply to the siblings after the node: copies them to
// the enclosing level.
static void propagate_paint(Level *outside, const GraphicsState *inside) {
    outside->state.source = inside->source;
    outside->state.filter = inside->filter;
    outside->state.effect = inside->effect;
    outside->paint_at = DISPLAY_NONE;
}

static void leave_node(Walk *walk) {
    Level *level = &walk->levels[--walk->depth], *outside = level - 1;
    NodeKind kind = (NodeKind)level->node->kind;
    if (level->saved)
        WRITE_STATE(walk, level, RESTORE, );
    if (kind == KIND_LAYER)
        WRITE_STATE(walk, level, LAYER_END,
                    .opacity = floor(255 * fmin(fmax(draw_number(level->node, ATTR_ALPHA), 0), 1)) / 255);
    if (kind == KIND_TRANSFORM || kind == KIND_FONT || kind == KIND_PATH)
        propagate_paint(outside, &level->state);
    if (kind == KIND_TRANSFORM || kind == KIND_FONT || kind == KIND_PAINT)
        outside->path = level->path;
}

static DisplayNumbers elements_of(DisplayListBuild *build, const Outline *outline) {
    build->joined.count = 0;
    for (uint32_t i = 0; i < outline->elements.count; i++) {
        const OutlineElement *element = &outline->elements.at[i];
        double *to = DISPLAY_ADD(build->arena, build->joined, 1u + display_path_sizes[element->kind]);
        *to++ = element->kind;
        for (uint32_t k = 0; k < display_path_sizes[element->kind]; k++)
            to[k] = (&element->points[0].x)[k];
    }
    return (DisplayNumbers){build->joined.at, build->joined.count};
}

// Writes the path that results from a path effect, for a host. If the paths for filling and stroking differ, writes two
// commands.
static void write_path_with_effect(DisplayListBuild *build, const DrawNode *effect, const DisplayMatrix *m,
                                   const DisplayPath *path, bool fill, bool stroke) {
    DisplayList *list = build->list;
    Outline from = {.arena = build->arena, .fine = 2 / fmax(sqrt(fabs(m->xx * m->yy - m->xy * m->yx)), 1e-6)};
    outline_add_path(&from, display_list_build_elements(build, path));
    bool separate = false;
    for (int part = 0; part < 1 + separate; part++) {
        uint32_t start = list->numbers.count;
        display_list_build_effect(build, effect); // only to apply it
        list->numbers.count = start;
        separate = fill && stroke && outline_has_dashes(list->numbers.at + start);
        bool fills = fill && part == 0, strokes = stroke && part == separate;
        Outline outline = outline_apply(list->numbers.at + start, from, !fills);
        DISPLAY_WRITE(list, PATH, .fill = fills, .stroke = strokes, .rule = path->fill_type,
                      .path = elements_of(build, &outline));
        build->effect_elements += outline.elements.count;
    }
    if (build->effect_elements > MAX_EFFECT_ELEMENTS)
        DISPLAY_WRITE(list, UNSUPPORTED,
                      .name = {.text = STR("path effects with more than two million path elements")});
}

static void write_path(Walk *walk, Level *level, const DrawNode *node, const DisplayPath *path, bool fill,
                       bool stroke) {
    DisplayListBuild *build = &walk->build;
    if (path->first == DISPLAY_NONE && path->fill_type <= FILL_EVEN_ODD)
        return;
    GraphicsState state = level->state;
    begin_drawing(walk, level, display_list_build_read_state(&state, node) ? &state : NULL);
    const DrawNode *effect = effect_beside_dashes(effect_of(build, &state));
    if (effect && build->host && build->effect_elements <= MAX_EFFECT_ELEMENTS)
        write_path_with_effect(build, effect, &level->matrix, path, fill, stroke);
    else
        DISPLAY_WRITE(build->list, PATH, .fill = fill, .stroke = stroke, .rule = path->fill_type,
                      .path = display_list_build_elements(build, path));
}

// If the node sets fill or stroke, draws the shape and leaves the current path unchanged. Otherwise, adds the shape to
// the current path.
static void add_shape(Walk *walk, Level *level, const DrawNode *node) {
    bool alone = schema_row((NodeKind)node->kind, ATTR_FILL); // false: the shape has neither attribute
    bool fill = alone && draw_flag(node, ATTR_FILL), stroke = alone && draw_flag(node, ATTR_STROKE);
    if (!fill && !stroke) {
        display_list_build_shape(&walk->build, &level->path, node);
        return;
    }
    DisplayPath path = display_list_build_no_path;
    display_list_build_shape(&walk->build, &path, node);
    write_path(walk, level, node, &path, fill, stroke);
}

static void add_fill(Walk *walk, Level *level, const DrawNode *node) {
    write_path(walk, level, node, &level->path, true, false);
}

static void add_stroke(Walk *walk, Level *level, const DrawNode *node) {
    write_path(walk, level, node, &level->path, false, true);
}

static void add_clip(Walk *walk, Level *level, const DrawNode *node) {
    save_clip(walk);
    write_clip(walk, level, &level->path, node->kind == KIND_MASK);
}

static void add_mask(Walk *walk, Level *level, const DrawNode *node) {
    add_clip(walk, level, node);
}

static void add_text(Walk *walk, Level *level, const DrawNode *node) {
    DisplayListBuild *build = &walk->build;
    const AttrValue *text = draw_attr(node, ATTR_TEXT);
    if (!text || text->as.text.len == 0)
        return;
    GraphicsState state = level->state;
    display_list_build_read_state(&state, node);
    bool stroke = draw_flag(node, ATTR_STROKE),
         fill = draw_attr(node, ATTR_FILL) ? draw_flag(node, ATTR_FILL) : !stroke;
    double point[2];
    draw_pair(node, ATTR_POINT, point);
    begin_drawing(walk, level, &state);
    if (build->host && effect_beside_dashes(effect_of(build, &state)))
        DISPLAY_WRITE(build->list, UNSUPPORTED, .name = {.text = STR("a path effect on text")});
    DISPLAY_WRITE(build->list, TEXT, .fill = fill, .stroke = stroke || !fill, .point = point, .size = state.font_size,
                  .weight = state.weight, .width = state.width, .slant = state.slant,
                  .centred = draw_flag(node, ATTR_CENTER),
                  .family = {.text = str_from(state.family ? state.family : "")}, .text = {.text = text->as.text});
}

static void add_image(Walk *walk, Level *level, const DrawNode *node) {
    if (!display_list_build_has_image(node))
        return;
    begin_drawing(walk, level, NULL);
    display_list_build_image(&walk->build, node);
}

static bool write_source(DisplayListBuild *build, const DrawNode *node) {
    return display_list_build_source(build, node, 1);
}

// Returns the index of a new setting; DISPLAY_NONE if the node is not complete. It is written whenever a paint with
// this setting is. To learn whether it is complete, this function writes it and takes the numbers back.
static uint32_t add_setting(DisplayListBuild *build, Level *level, const DrawNode *node,
                            bool (*write)(DisplayListBuild *build, const DrawNode *node)) {
    DisplayList *list = build->list;
    uint32_t numbers = list->numbers.count, notes = list->notes.count;
    double pixels = list->numbers.at[DISPLAY_HEADER - 1];
    build->state = &level->state;
    level->paint_at = DISPLAY_NONE;
    bool good = write(build, node);
    list->numbers.count = numbers;
    list->notes.count = notes;
    list->numbers.at[DISPLAY_HEADER - 1] = pixels;
    if (!good)
        return DISPLAY_NONE;
    *DISPLAY_ADD(build->arena, build->settings, 1) = (DisplaySetting){node, level->state};
    return build->settings.count - 1;
}

static void set_source(Walk *walk, Level *level, const DrawNode *node) {
    level->state.source = add_setting(&walk->build, level, node, write_source);
}

static void set_filter(Walk *walk, Level *level, const DrawNode *node) {
    level->state.filter = add_setting(&walk->build, level, node, display_list_build_filter);
}

static void set_effect(Walk *walk, Level *level, const DrawNode *node) {
    level->state.effect = add_setting(&walk->build, level, node, display_list_build_effect);
}

// The functions that add nodes without drawing nodes as children. NULL: enter_node handles the node.
static void (*const leaves[KIND_COUNT])(Walk *walk, Level *level, const DrawNode *node) = {
#define SHAPE(id, name, help) [KIND_##id] = add_shape,
#define COMMAND(id, name, help) [KIND_##id] = add_##name,
#define SOURCE(id, name, children, help) [KIND_##id] = set_source,
#define FILTER(id, name, reader, children, inputs, help) [KIND_FILTER_##id] = set_filter,
#define EFFECT(id, name, help) [KIND_##id] = set_effect,
#include "schema/schema_list.h"
};

static void add_node(Walk *walk, const DrawNode *node) {
    if (leaves[node->kind])
        leaves[node->kind](walk, &walk->levels[walk->depth - 1], node);
    else
        enter_node(walk, node);
}

// Gives arrays the capacities of the previous list.
static void reserve_arrays(DisplayListBuild *build, const DisplayListSizes *sizes) {
    enum { MAX_NUMBERS = 1 << 20 }; // if the previous list was longer, the arrays start small again
    if (sizes->numbers == 0 || sizes->numbers > MAX_NUMBERS || sizes->paths > MAX_NUMBERS)
        return;
    DisplayList *list = build->list;
    list->numbers.at = display_list_grow(build->arena, list->numbers.at, list->numbers.count, &list->numbers.room,
                                         sizes->numbers, sizeof(double));
    build->paths.at = display_list_grow(build->arena, NULL, 0, &build->paths.room, sizes->paths, sizeof(double));
}

void display_list_build(DisplayList *list, const DrawNode *canvas, const DisplayHost *host, DisplayListSizes *sizes) {
    Walk walk = {
        .build = {.list = list, .arena = list->arena, .host = host}, .matrix = DISPLAY_NONE, .paint = DISPLAY_NONE};
    list->linear = draw_flag(canvas, ATTR_LINEAR);
    reserve_arrays(&walk.build, sizes);
    Level *top = push_level(&walk, canvas);
    *top = (Level){.node = canvas,
                   .matrix_at = DISPLAY_NONE,
                   .paint_at = DISPLAY_NONE,
                   .matrix = {1, 0, 0, 1, 0, 0},
                   .path = display_list_build_no_path,
                   .state = {.source = DISPLAY_NONE, .filter = DISPLAY_NONE, .effect = DISPLAY_NONE}};
    schema_defaults(KIND_CANVAS, &top->state);
    display_list_build_read_state(&top->state, canvas);
    display_list_build_transform(&top->matrix, canvas, false);
    if (!display_matrix_is_invertible(&top->matrix))
        return;
    while (walk.depth > 0) {
        Level *level = &walk.levels[walk.depth - 1];
        if (level->next < level->node->child_count)
            add_node(&walk, level->node->children[level->next++]);
        else if (walk.depth == 1)
            break;
        else
            leave_node(&walk);
    }
    if (walk.levels[0].saved)
        WRITE_STATE(&walk, &walk.levels[0], RESTORE, );
    *sizes = (DisplayListSizes){list->numbers.count, walk.build.paths.count};
}
