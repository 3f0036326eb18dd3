// build.c: walks over a canvas's nodes once and writes down what they draw; see list.h and spec canvas.md 2.
//
// Trees may be thousands of nodes deep, and whoever draws may have a small stack: so the walk keeps its own.
#include "draw/build.h"

#include "maths/maths.h"

#include <math.h>
#include <string.h>

static const double TURN = 6.283185307179586;

// A node whose children are being read.
typedef struct Level {
    const DrawNode *node;
    uint32_t next;      // child
    uint32_t matrix_at; // of the matrix in the list; LIST_NONE: not there yet
    uint32_t paint_at;
    bool saved; // the clip, by a command
    ListMatrix matrix;
    ListPath path;
    Look look;
} Level;

typedef struct Walk {
    Build build;
    Level *levels;
    uint32_t depth;
    uint32_t capacity;
} Walk;

void *list_room(Arena *arena, void *items, uint32_t count, uint32_t *room, uint32_t more, size_t size) {
    enum { SMALLEST = 16 };
    if (more <= *room - count)
        return items;
    if (more > UINT32_MAX / 4 - count)
        arena_exhausted(arena);
    uint32_t wanted = *room ? 2 * *room : SMALLEST;
    wanted = wanted < count + more ? count + more : wanted;
    void *grown = arena_grow(arena, items, *room * size, wanted * size);
    *room = wanted;
    return grown;
}

ListMatrix list_multiply(ListMatrix m, ListMatrix a) {
    return (ListMatrix){.xx = m.xx * a.xx + m.xy * a.yx,
                        .yx = m.yx * a.xx + m.yy * a.yx,
                        .xy = m.xx * a.xy + m.xy * a.yy,
                        .yy = m.yx * a.xy + m.yy * a.yy,
                        .x0 = m.xx * a.x0 + m.xy * a.y0 + m.x0,
                        .y0 = m.yx * a.x0 + m.yy * a.y0 + m.y0};
}

bool list_invertible(const ListMatrix *m) {
    double determinant = m->xx * m->yy - m->xy * m->yx;
    return isfinite(determinant) && determinant != 0 && isfinite(m->x0) && isfinite(m->y0);
}

void build_transform(ListMatrix *matrix, const DrawNode *node, bool after) {
    for (uint32_t i = 0; i < node->attr_count; i++) {
        const double *n = node->attrs[i].as.numbers;
        ListMatrix step = {1, 0, 0, 1, 0, 0};
        if (node->attrs[i].name == ATTR_TRANSLATE) {
            step.x0 = n[0];
            step.y0 = n[1];
        } else if (node->attrs[i].name == ATTR_SCALE) {
            step.xx = n[0];
            step.yy = n[1];
        } else if (node->attrs[i].name == ATTR_ROTATE) {
            double angle = (n[0] - floor(n[0])) * TURN;
            step.xx = step.yy = maths_cos(angle);
            step.yx = maths_sin(angle);
            step.xy = -step.yx;
        } else {
            continue;
        }
        *matrix = after ? list_multiply(step, *matrix) : list_multiply(*matrix, step);
    }
}

bool build_take(Look *look, const DrawNode *node) {
    bool changed = false;
    for (uint32_t i = 0; i < node->attr_count; i++) {
        if (schema_rows[node->attrs[i].row].field == FIELD_NOWHERE)
            continue;
        changed = true;
        schema_store(&node->attrs[i], look);
        if (node->attrs[i].name == ATTR_COLOR)
            look->source = LIST_NONE;
    }
    return changed;
}

uint32_t build_paint(Build *build, const Look *look) {
    ListPaint *paint = LIST_ADD(build->arena, build->list->paints, 1);
    *paint = (ListPaint){.color = {look->color[0], look->color[1], look->color[2], look->color[3]},
                         .stroke_width = look->stroke_width,
                         .source = look->source,
                         .filter = look->filter,
                         .effect = look->effect,
                         .join = look->join,
                         .cap = look->cap,
                         .composite = look->composite,
                         .antialias = look->antialias};
    return build->list->paints.count - 1;
}

// A command in the state of a level; `own` is the look of a node that has one.
static ListCommand *add_command(Build *build, Level *level, ListCommandKind kind, const Look *own) {
    List *list = build->list;
    if (level->matrix_at == LIST_NONE) {
        *LIST_ADD(build->arena, list->matrices, 1) = level->matrix;
        level->matrix_at = list->matrices.count - 1;
    }
    if (!own && level->paint_at == LIST_NONE)
        level->paint_at = build_paint(build, &level->look);
    uint32_t paint = own ? build_paint(build, own) : level->paint_at;
    ListCommand *command = LIST_ADD(build->arena, list->commands, 1);
    *command = (ListCommand){.kind = kind, .matrix = level->matrix_at, .paint = paint, .path = level->path};
    return command;
}

static Level *push(Walk *walk, const DrawNode *node) {
    walk->levels = arena_room(walk->build.arena, walk->levels, walk->depth, &walk->capacity, sizeof *walk->levels);
    Level *level = &walk->levels[walk->depth++];
    if (walk->depth > 1)
        *level = level[-1];
    level->node = node;
    level->next = 0;
    level->saved = false;
    return level;
}

static bool keeps_clip(NodeKind kind) {
    return kind == KIND_CANVAS || kind == KIND_CANVAS_GROUP || kind == KIND_LAYER || kind == KIND_TRANSFORM;
}

// Before the clip changes: it is saved by the node with which it ends.
static void save_clip(Walk *walk) {
    uint32_t at = walk->depth - 1;
    while (at > 0 && !keeps_clip((NodeKind)walk->levels[at].node->kind))
        at--;
    if (walk->levels[at].saved)
        return;
    // Nothing has been clipped at this level yet, so that saving now is as good as at its beginning.
    walk->levels[at].saved = true;
    add_command(&walk->build, &walk->levels[walk->depth - 1], LIST_SAVE, NULL);
}

// A node whose children are drawn in a state of their own.
static void enter(Walk *walk, const DrawNode *node) {
    NodeKind kind = (NodeKind)node->kind;
    double size[2], origin[2];
    if (kind == KIND_LAYER) {
        if (!draw_pair(node, ATTR_SIZE, size))
            return;
        draw_pair(node, ATTR_ORIGIN, origin);
        save_clip(walk);
        ListPath box = build_no_path;
        build_rectangle(&walk->build, &box, origin, size);
        add_command(&walk->build, &walk->levels[walk->depth - 1], LIST_CLIP, NULL)->path = box;
        add_command(&walk->build, &walk->levels[walk->depth - 1], LIST_LAYER, NULL)->item =
            walk->build.list->places.count;
        *LIST_ADD(walk->build.arena, walk->build.list->places, 1) = node->place;
    }
    Level *level = push(walk, node);
    build_transform(&level->matrix, node, false);
    if (keeps_clip(kind))
        level->matrix_at = LIST_NONE;
    if (build_take(&level->look, node))
        level->paint_at = LIST_NONE;
    if (kind == KIND_PATH || kind == KIND_CANVAS_GROUP || kind == KIND_LAYER) {
        level->path = build_no_path;
        if (kind != KIND_LAYER)
            level->path.fill_type = (uint8_t)draw_word(node, ATTR_FILL_TYPE);
    }
    if (!list_invertible(&level->matrix))
        level->next = node->child_count; // all is squeezed to nothing, or beyond all numbers
}

// How siblings after it are painted: what nodes inside of it have changed, perhaps.
static void keep_paint(Level *outside, const Look *inside) {
    outside->look.source = inside->source;
    outside->look.filter = inside->filter;
    outside->look.effect = inside->effect;
    outside->paint_at = LIST_NONE;
}

static void leave(Walk *walk) {
    Level *level = &walk->levels[--walk->depth], *outside = level - 1;
    NodeKind kind = (NodeKind)level->node->kind;
    if (level->saved)
        add_command(&walk->build, level, LIST_RESTORE, NULL);
    if (kind == KIND_LAYER)
        add_command(&walk->build, level, LIST_LAYER_END, NULL)->alpha =
            floor(255 * fmin(fmax(draw_number(level->node, ATTR_ALPHA), 0), 1)) / 255;
    if (kind == KIND_TRANSFORM || kind == KIND_FONT || kind == KIND_PATH)
        keep_paint(outside, &level->look);
    if (kind == KIND_TRANSFORM || kind == KIND_FONT || kind == KIND_PAINT)
        outside->path = level->path;
}

static void add_figure(Build *build, Level *level, const DrawNode *node, ListPath path, bool fill, bool stroke) {
    if (path.first == LIST_NONE && path.fill_type <= FILL_EVEN_ODD)
        return;
    Look look = level->look;
    ListCommand *command = add_command(build, level, LIST_DRAW, build_take(&look, node) ? &look : NULL);
    command->path = path;
    command->fill = fill;
    command->stroke = stroke;
}

// A shape that is drawn at once leaves the current path alone.
static void add_shape(Build *build, Level *level, const DrawNode *node) {
    bool fill = draw_flag(node, ATTR_FILL), stroke = draw_flag(node, ATTR_STROKE);
    if (!fill && !stroke) {
        build_piece(build, &level->path, node);
        return;
    }
    ListPath path = build_no_path;
    build_piece(build, &path, node);
    add_figure(build, level, node, path, fill, stroke);
}

static void add_text(Build *build, Level *level, const DrawNode *node) {
    const AttrValue *text = draw_attr(node, ATTR_TEXT);
    if (!text || text->as.text.len == 0)
        return;
    Look look = level->look;
    build_take(&look, node);
    bool stroke = draw_flag(node, ATTR_STROKE),
         fill = draw_attr(node, ATTR_FILL) ? draw_flag(node, ATTR_FILL) : !stroke;
    ListText *item = LIST_ADD(build->arena, build->list->texts, 1);
    *item = (ListText){.text = text->as.text,
                       .family = look.family,
                       .size = look.font_size,
                       .weight = look.weight,
                       .width = look.width,
                       .slant = look.slant,
                       .center = draw_flag(node, ATTR_CENTER)};
    draw_pair(node, ATTR_POINT, item->point);
    ListCommand *command = add_command(build, level, LIST_TEXT, &look);
    command->item = build->list->texts.count - 1;
    command->fill = fill;
    command->stroke = stroke || !fill;
}

static void add_leaf(Walk *walk, Level *level, const DrawNode *node) {
    Build *build = &walk->build;
    switch ((NodeKind)node->kind) {
    case KIND_FILL:
    case KIND_STROKE:
        add_figure(build, level, node, level->path, node->kind == KIND_FILL, node->kind == KIND_STROKE);
        break;
    case KIND_CLIP:
    case KIND_MASK:
        save_clip(walk);
        add_command(build, level, node->kind == KIND_CLIP ? LIST_CLIP : LIST_MASK, NULL);
        break;
    case KIND_TEXT:
        add_text(build, level, node);
        break;
    case KIND_IMAGE: {
        uint32_t image = build_image(build, node);
        if (image != LIST_NONE)
            add_command(build, level, LIST_IMAGE, NULL)->item = image;
        break;
    }
    default:
        build_paint_node(build, &level->look, node);
        level->paint_at = LIST_NONE;
    }
}

static void add_node(Walk *walk, const DrawNode *node) {
    Level *level = &walk->levels[walk->depth - 1];
    switch ((NodeKind)node->kind) {
    case KIND_CANVAS_GROUP:
    case KIND_TRANSFORM:
    case KIND_PAINT:
    case KIND_FONT:
    case KIND_LAYER:
    case KIND_PATH:
        enter(walk, node);
        break;
    case KIND_RECT:
    case KIND_ELLIPSE:
    case KIND_LINE:
        add_shape(&walk->build, level, node);
        break;
    default:
        if (!build_piece(&walk->build, &level->path, node))
            add_leaf(walk, level, node);
    }
}

static void make_room(Arena *arena, List *list, const ListSizes *sizes) {
    enum { MOST = 1 << 16 }; // others may be short
    if (sizes->commands == 0 || sizes->commands > MOST || sizes->numbers > 16 * MOST)
        return;
#define ROOM(array) list->array.at = list_room(arena, NULL, 0, &list->array.room, sizes->array, sizeof *list->array.at)
    ROOM(commands);
    ROOM(matrices);
    ROOM(paints);
    ROOM(numbers);
    ROOM(runs);
#undef ROOM
}

const List *list_build(Arena *arena, const DrawNode *canvas, ListSizes *sizes) {
    List *list = arena_alloc(arena, sizeof *list);
    *list = (List){.linear = draw_flag(canvas, ATTR_LINEAR)};
    make_room(arena, list, sizes);
    Walk walk = {.build = {.arena = arena, .list = list}};
    Level *top = push(&walk, canvas);
    *top = (Level){.node = canvas,
                   .matrix_at = LIST_NONE,
                   .paint_at = LIST_NONE,
                   .matrix = {1, 0, 0, 1, 0, 0},
                   .path = build_no_path,
                   .look = {.source = LIST_NONE, .filter = LIST_NONE, .effect = LIST_NONE}};
    schema_defaults(KIND_CANVAS, &top->look);
    build_take(&top->look, canvas);
    build_transform(&top->matrix, canvas, false);
    if (!list_invertible(&top->matrix))
        return list;
    while (walk.depth > 0) {
        Level *level = &walk.levels[walk.depth - 1];
        if (level->next < level->node->child_count)
            add_node(&walk, level->node->children[level->next++]);
        else if (walk.depth == 1)
            break;
        else
            leave(&walk);
    }
    if (walk.levels[0].saved)
        add_command(&walk.build, &walk.levels[0], LIST_RESTORE, NULL);
    *sizes = (ListSizes){list->commands.count, list->matrices.count, list->paints.count, list->numbers.count,
                         list->runs.count};
    return list;
}
