// drawing.h: a window's tree in the form in which it is drawn: kinds and attributes are numbers, values have their
// types.
//
// Reading turns nodes into this form and finds all faults that can be seen in the tree, in the thread that has the
// session. What draws, perhaps in another thread, meets neither symbols nor values of the language.
#ifndef PETRI_CANVAS_DRAWING_H
#define PETRI_CANVAS_DRAWING_H

#include <stdbool.h>
#include <stdint.h>

#include "base/str.h"

typedef enum DrawKind {
#define NODE(id, text, place, children, help) DRAW_##id,
#include "canvas/canvas_list.h"
    DRAW_KIND_COUNT
} DrawKind;

typedef enum DrawName {
#define NAME(id, text) NAME_##id,
#include "canvas/canvas_list.h"
    DRAW_NAME_COUNT
} DrawName;

// Where a node may stand.
typedef enum PlaceKind {
    PLACE_NOTHING,
    PLACE_TOP,
    PLACE_WINDOW,
    PLACE_DRAWING, // sources, too, may stand where one draws
    PLACE_SOURCE,
    PLACE_STOP,
} PlaceKind;

typedef enum DrawType {
    TYPE_NUMBER,
    TYPE_WIDTH,  // 0 or more
    TYPE_POINT,  // two numbers; one stands for both
    TYPE_SIZE,   // the same, 0 or more
    TYPE_SCALE,  // the same, any
    TYPE_POINTS, // x;y;x;y…
    TYPE_COLOR,
    TYPE_FLAG,
    TYPE_TEXT,
    TYPE_ANY, // not for drawing
    TYPE_WEIGHT,
    TYPE_JOIN,
    TYPE_CAP,
    TYPE_FILL_TYPE,
    TYPE_SLANT,
    TYPE_COMPOSITE,
    DRAW_TYPE_COUNT
} DrawType;

// The meanings of words.
enum { JOIN_MITER, JOIN_ROUND, JOIN_BEVEL };
enum { CAP_BUTT, CAP_ROUND, CAP_SQUARE };
enum { FILL_WINDING, FILL_EVEN_ODD };
enum { SLANT_UPRIGHT, SLANT_OBLIQUE, SLANT_ITALIC };
typedef enum CompositeMode {
#define COMPOSITE(id, operator) COMPOSITE_##id,
#include "canvas/composite_list.h"
    COMPOSITE_COUNT
} CompositeMode;

typedef struct DrawAttr {
    uint8_t name;   // DrawName
    uint32_t count; // of numbers
    union {
        double numbers[4]; // of points, sizes, colours (always four), a weight
        const double *list;
        Str text; // NUL-terminated
        int word;
        bool flag;
    } as;
} DrawAttr;

typedef struct DrawNode DrawNode;
struct DrawNode {
    uint8_t kind; // DrawKind
    uint32_t attr_count;
    uint32_t child_count;
    const DrawAttr *attrs; // as they were written: transforms are applied in this order
    const DrawNode *const *children;
};

// The attribute, or NULL.
static inline const DrawAttr *draw_attr(const DrawNode *node, DrawName name) {
    for (uint32_t i = 0; i < node->attr_count; i++)
        if (node->attrs[i].name == name)
            return &node->attrs[i];
    return NULL;
}

static inline double draw_number(const DrawNode *node, DrawName name, double fallback) {
    const DrawAttr *attr = draw_attr(node, name);
    return attr ? attr->as.numbers[0] : fallback;
}

static inline bool draw_flag(const DrawNode *node, DrawName name, bool fallback) {
    const DrawAttr *attr = draw_attr(node, name);
    return attr ? attr->as.flag : fallback;
}

// Two numbers; false, and 0;0, without the attribute.
static inline bool draw_pair(const DrawNode *node, DrawName name, double pair[2]) {
    const DrawAttr *attr = draw_attr(node, name);
    pair[0] = attr ? attr->as.numbers[0] : 0;
    pair[1] = attr ? attr->as.numbers[1] : 0;
    return attr != NULL;
}

#endif
