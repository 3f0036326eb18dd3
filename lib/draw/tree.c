// tree.c: walks over a canvas's nodes and draws them.
//
// Trees may be thousands of nodes deep, and whoever draws may have a small stack: so the walk keeps its own.
#include "draw/draw.h"

enum { MOST_LAYERS = 64 }; // open at a time
static const double MOST_LAYER_PIXELS = 1 << 27;

// A node whose children are being drawn.
typedef struct Level {
    const DrawNode *node;
    uint32_t next; // child
    bool keeps_path;
    bool layer; // what is drawn goes to a layer
    KeptPath kept;
    double pixels; // of the layer
    int composite; // of the layer
    Look look;
} Level;

typedef struct Walk {
    Canvas *canvas;
    Level *levels;
    uint32_t depth;
    uint32_t capacity;
} Walk;

static Level *push(Walk *walk, const DrawNode *node, const Look *look) {
    Arena *arena = &walk->canvas->painter->arena;
    walk->levels = arena_room(arena, walk->levels, walk->depth, &walk->capacity, sizeof *walk->levels);
    Level *level = &walk->levels[walk->depth++];
    *level = (Level){.node = node, .look = *look};
    return level;
}

// When the level ends, the path is what it was before.
static void keep(Level *level, KeptPath kept) {
    level->kept = kept;
    level->keeps_path = true;
}

// Begins a layer; false, after a report, if there are too many. They take memory.
static bool begin_layer(Canvas *canvas, Level *level) {
    double x1, y1, x2, y2;
    cairo_save(canvas->cr);
    cairo_identity_matrix(canvas->cr);
    cairo_clip_extents(canvas->cr, &x1, &y1, &x2, &y2);
    cairo_restore(canvas->cr);
    level->pixels = (x2 - x1) * (y2 - y1);
    if (canvas->layers >= MOST_LAYERS || canvas->layer_pixels + level->pixels > MOST_LAYER_PIXELS) {
        draw_fault(canvas, DIAG_WARNING, "too-many-layers",
                   "!layer: layers are too many or too large; the innermost are drawn without");
        return false;
    }
    canvas->layers++;
    canvas->layer_pixels += level->pixels;
    cairo_push_group(canvas->cr);
    level->layer = true;
    return true;
}

static void end_layer(Canvas *canvas, const Level *level) {
    cairo_pop_group_to_source(canvas->cr);
    draw_paint(canvas, level->composite, draw_number(level->node, ATTR_ALPHA));
    canvas->layers--;
    canvas->layer_pixels -= level->pixels;
}

static void enter_layer(Walk *walk, const DrawNode *node, const Look *look, KeptPath kept) {
    Canvas *canvas = walk->canvas;
    double size[2], origin[2];
    draw_set_edges(canvas, look);
    if (draw_pair(node, ATTR_SIZE, size)) {
        draw_pair(node, ATTR_ORIGIN, origin);
        double x1 = origin[0], y1 = origin[1], x2 = x1 + size[0], y2 = y1 + size[1];
        draw_tame(canvas, &x1, &y1);
        draw_tame(canvas, &x2, &y2);
        cairo_rectangle(canvas->cr, x1, y1, x2 - x1, y2 - y1);
        cairo_clip(canvas->cr);
    }
    Level *level = push(walk, node, look);
    keep(level, kept);
    level->composite = look->composite;
    if (begin_layer(canvas, level))
        level->look.composite = COMPOSITE_OVER;
}

// A node whose children are drawn in a state of their own.
static void enter(Walk *walk, const DrawNode *node, const Look *inherited) {
    cairo_t *cr = walk->canvas->cr;
    Look look = *inherited;
    draw_take_look(&look, node);
    if (node->kind == KIND_PATH) {
        look.fill_type = draw_word(node, ATTR_FILL_TYPE);
        KeptPath kept = draw_keep_path(walk->canvas);
        keep(push(walk, node, &look), kept);
        return;
    }
    bool layer = node->kind == KIND_LAYER;
    KeptPath kept = layer ? draw_keep_path(walk->canvas) : (KeptPath){NULL, 0}; // in the transform that it returns to
    cairo_save(cr);
    if (!draw_transform(cr, node)) {
        cairo_restore(cr);
        if (layer)
            draw_put_back_path(walk->canvas, kept);
        return;
    }
    if (layer)
        enter_layer(walk, node, &look, kept);
    else
        push(walk, node, &look);
}

static void leave(Walk *walk) {
    Level *level = &walk->levels[--walk->depth];
    cairo_t *cr = walk->canvas->cr;
    if (level->layer)
        end_layer(walk->canvas, level);
    if (level->node->kind != KIND_PATH)
        cairo_restore(cr);
    if (level->keeps_path)
        draw_put_back_path(walk->canvas, level->kept);
}

// A shape that is drawn at once leaves the current path alone.
static void draw_shape(Canvas *canvas, const DrawNode *node, const Look *inherited) {
    bool fill = draw_flag(node, ATTR_FILL), stroke = draw_flag(node, ATTR_STROKE);
    if (!fill && !stroke) {
        draw_add_path(canvas, node);
        return;
    }
    Look look = *inherited;
    draw_take_look(&look, node);
    KeptPath kept = draw_keep_path(canvas);
    draw_add_path(canvas, node);
    if (fill)
        draw_fill(canvas, &look);
    if (stroke)
        draw_stroke(canvas, &look);
    draw_put_back_path(canvas, kept);
}

static void draw_leaf(Canvas *canvas, const DrawNode *node, const Look *inherited) {
    Look look = *inherited;
    draw_take_look(&look, node);
    switch ((NodeKind)node->kind) {
    case KIND_FILL:
        draw_fill(canvas, &look);
        break;
    case KIND_STROKE:
        draw_stroke(canvas, &look);
        break;
    case KIND_CLIP:
        draw_clip(canvas, &look);
        break;
    case KIND_TEXT:
        draw_text(canvas, node, &look);
        break;
    case KIND_IMAGE:
        draw_image(canvas, node, &look);
        break;
    default: // a gradient or colour: its parent has taken it
        break;
    }
}

static void draw_node(Walk *walk, const DrawNode *node, const Look *look) {
    switch ((NodeKind)node->kind) {
    case KIND_CANVAS_GROUP:
    case KIND_TRANSFORM:
    case KIND_PAINT:
    case KIND_FONT:
    case KIND_LAYER:
    case KIND_PATH:
        enter(walk, node, look);
        break;
    case KIND_RECT:
    case KIND_ELLIPSE:
    case KIND_LINE:
        draw_shape(walk->canvas, node, look);
        break;
    default:
        if (!draw_add_path(walk->canvas, node))
            draw_leaf(walk->canvas, node, look);
    }
}

void draw_tree(Canvas *canvas, const DrawNode *canvas_node) {
    Walk walk = {.canvas = canvas};
    Look look = {.source = NULL};
    schema_defaults(KIND_PAINT, &look);
    schema_defaults(KIND_FONT, &look);
    schema_defaults(KIND_PATH, &look);
    draw_take_look(&look, canvas_node);
    cairo_save(canvas->cr);
    cairo_new_path(canvas->cr);
    if (draw_transform(canvas->cr, canvas_node)) {
        push(&walk, canvas_node, &look);
        while (walk.depth > 0) {
            Level *level = &walk.levels[walk.depth - 1];
            if (level->next < level->node->child_count) {
                Look now = level->look; // the levels may move
                draw_node(&walk, level->node->children[level->next++], &now);
            } else if (walk.depth == 1) {
                break;
            } else {
                leave(&walk);
            }
        }
    }
    cairo_restore(canvas->cr);
    cairo_new_path(canvas->cr);
}
