// display_list_build.c: translates the nodes of a canvas to a display list in one pass; see display_list.h and spec
// canvas.md 2.
//
// Trees can be thousands of nodes deep, and the stack of the calling thread can be small. The pass therefore uses an
// explicit stack (Level) instead of recursion.
#include "picture/display_list_build.h"

#include "maths/maths.h"

#include <math.h>
#include <string.h>

// A node whose children are being translated.
typedef struct Level {
    const DrawNode *node;
    uint32_t next;      // index of the next child
    uint32_t matrix_at; // index of the matrix in the list; DISPLAY_NONE: not added yet
    uint32_t paint_at;  // index of the paint in the list; DISPLAY_NONE: not added yet
    bool saved;         // true if a DISPLAY_SAVE was added, which leave_node must balance
    DisplayMatrix matrix;
    DisplayPath path;
    GraphicsState state;
} Level;

typedef struct Walk {
    DisplayListBuild build;
    Level *levels;
    uint32_t depth;
    uint32_t capacity;
} Walk;

// Adds a command with the matrix, path and graphics state of a level. If `own` is not NULL, it replaces the graphics
// state of the level.
static DisplayCommand *add_command(DisplayListBuild *build, Level *level, DisplayCommandKind kind,
                                   const GraphicsState *own) {
    DisplayList *list = build->list;
    if (level->matrix_at == DISPLAY_NONE) {
        *DISPLAY_ADD(build->arena, list->matrices, 1) = level->matrix;
        level->matrix_at = list->matrices.count - 1;
    }
    if (!own && level->paint_at == DISPLAY_NONE)
        level->paint_at = display_list_build_paint(build, &level->state);
    uint32_t paint = own ? display_list_build_paint(build, own) : level->paint_at;
    DisplayCommand *command = DISPLAY_ADD(build->arena, list->commands, 1);
    *command = (DisplayCommand){.kind = kind, .matrix = level->matrix_at, .paint = paint, .path = level->path};
    return command;
}

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
    add_command(&walk->build, &walk->levels[walk->depth - 1], DISPLAY_SAVE, NULL);
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
        add_command(&walk->build, &walk->levels[walk->depth - 1], DISPLAY_CLIP, NULL)->path = box;
        add_command(&walk->build, &walk->levels[walk->depth - 1], DISPLAY_LAYER, NULL)->item =
            walk->build.list->places.count;
        *DISPLAY_ADD(walk->build.arena, walk->build.list->places, 1) = node->origin;
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
        add_command(&walk->build, level, DISPLAY_RESTORE, NULL);
    if (kind == KIND_LAYER)
        add_command(&walk->build, level, DISPLAY_LAYER_END, NULL)->alpha =
            floor(255 * fmin(fmax(draw_number(level->node, ATTR_ALPHA), 0), 1)) / 255;
    if (kind == KIND_TRANSFORM || kind == KIND_FONT || kind == KIND_PATH)
        propagate_paint(outside, &level->state);
    if (kind == KIND_TRANSFORM || kind == KIND_FONT || kind == KIND_PAINT)
        outside->path = level->path;
}

static void add_path_command(DisplayListBuild *build, Level *level, const DrawNode *node, DisplayPath path, bool fill,
                             bool stroke) {
    if (path.first == DISPLAY_NONE && path.fill_type <= FILL_EVEN_ODD)
        return;
    GraphicsState state = level->state;
    DisplayCommand *command =
        add_command(build, level, DISPLAY_DRAW, display_list_build_read_state(&state, node) ? &state : NULL);
    command->path = path;
    command->fill = fill;
    command->stroke = stroke;
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
    add_path_command(&walk->build, level, node, path, fill, stroke);
}

static void add_fill(Walk *walk, Level *level, const DrawNode *node) {
    add_path_command(&walk->build, level, node, level->path, true, false);
}

static void add_stroke(Walk *walk, Level *level, const DrawNode *node) {
    add_path_command(&walk->build, level, node, level->path, false, true);
}

static void add_clip(Walk *walk, Level *level, const DrawNode *node) {
    save_clip(walk);
    add_command(&walk->build, level, node->kind == KIND_CLIP ? DISPLAY_CLIP : DISPLAY_MASK, NULL);
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
    DisplayText *item = DISPLAY_ADD(build->arena, build->list->texts, 1);
    *item = (DisplayText){.text = text->as.text,
                          .family = state.family,
                          .size = state.font_size,
                          .weight = state.weight,
                          .width = state.width,
                          .slant = state.slant,
                          .center = draw_flag(node, ATTR_CENTER)};
    draw_pair(node, ATTR_POINT, item->point);
    DisplayCommand *command = add_command(build, level, DISPLAY_TEXT, &state);
    command->item = build->list->texts.count - 1;
    command->fill = fill;
    command->stroke = stroke || !fill;
}

static void add_image(Walk *walk, Level *level, const DrawNode *node) {
    uint32_t image = display_list_build_image(&walk->build, node);
    if (image != DISPLAY_NONE)
        add_command(&walk->build, level, DISPLAY_IMAGE, NULL)->item = image;
}

static void set_source(Walk *walk, Level *level, const DrawNode *node) {
    walk->build.state = &level->state;
    level->state.source = display_list_build_source(&walk->build, node);
    level->paint_at = DISPLAY_NONE;
}

static void set_filter(Walk *walk, Level *level, const DrawNode *node) {
    walk->build.state = &level->state;
    level->state.filter = display_list_build_filter(&walk->build, node);
    level->paint_at = DISPLAY_NONE;
}

static void set_effect(Walk *walk, Level *level, const DrawNode *node) {
    level->state.effect = display_list_build_effect(&walk->build, node);
    level->paint_at = DISPLAY_NONE;
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

static void reserve_arrays(Arena *arena, DisplayList *list, const DisplayListSizes *sizes) {
    enum { MAX_COMMANDS = 1 << 16 }; // if the previous list was longer, the arrays start small again
    if (sizes->commands == 0 || sizes->commands > MAX_COMMANDS || sizes->numbers > 16 * MAX_COMMANDS)
        return;
#define ROOM(array)                                                                                                    \
    list->array.at = display_list_grow(arena, NULL, 0, &list->array.room, sizes->array, sizeof *list->array.at)
    ROOM(commands);
    ROOM(matrices);
    ROOM(paints);
    ROOM(numbers);
    ROOM(runs);
#undef ROOM
}

const DisplayList *display_list_build(Arena *arena, const DrawNode *canvas, DisplayListSizes *sizes) {
    DisplayList *list = arena_alloc(arena, sizeof *list);
    *list = (DisplayList){.linear = draw_flag(canvas, ATTR_LINEAR)};
    reserve_arrays(arena, list, sizes);
    Walk walk = {.build = {.arena = arena, .list = list}};
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
        return list;
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
        add_command(&walk.build, &walk.levels[0], DISPLAY_RESTORE, NULL);
    *sizes = (DisplayListSizes){list->commands.count, list->matrices.count, list->paints.count, list->numbers.count,
                                list->runs.count};
    return list;
}
