// drawing.h: a window's tree in the form in which it is drawn: kinds and attributes are numbers, values have their
// types.
//
// Reading turns nodes into this form and finds all faults that can be seen in the tree, in the thread that has the
// session. What draws, perhaps in another thread, meets neither symbols nor values of the language.
#ifndef PETRI_CANVAS_DRAWING_H
#define PETRI_CANVAS_DRAWING_H

#include "schema/reader.h"

typedef struct DrawNode DrawNode;
struct DrawNode {
    uint8_t kind; // NodeKind
    uint32_t attr_count;
    uint32_t child_count;
    const AttrValue *attrs; // as they were written: transforms are applied in this order
    const DrawNode *const *children;
    Str tags;      // of nodes among pictures, which tell them apart: names with a space behind each, in order
    Origin origin; // its program's text, or the node; who tells of it sees to it that the source is still there
};

// The attribute, or NULL.
static inline const AttrValue *draw_attr(const DrawNode *node, AttrName name) {
    for (uint32_t i = 0; i < node->attr_count; i++)
        if (node->attrs[i].name == name)
            return &node->attrs[i];
    return NULL;
}

// A number, or its default.
static inline double draw_number(const DrawNode *node, AttrName name) {
    const AttrValue *attr = draw_attr(node, name);
    return attr ? attr->as.numbers[0] : schema_row((NodeKind)node->kind, name)->default_value.value;
}

static inline bool draw_flag(const DrawNode *node, AttrName name) {
    const AttrValue *attr = draw_attr(node, name);
    return attr ? attr->as.flag : schema_row((NodeKind)node->kind, name)->default_value.value != 0;
}

static inline int draw_word(const DrawNode *node, AttrName name) {
    const AttrValue *attr = draw_attr(node, name);
    return attr ? attr->as.word : (int)schema_row((NodeKind)node->kind, name)->default_value.value;
}

// Two numbers; false, and 0;0, without the attribute.
static inline bool draw_pair(const DrawNode *node, AttrName name, double pair[2]) {
    const AttrValue *attr = draw_attr(node, name);
    pair[0] = attr ? attr->as.numbers[0] : 0;
    pair[1] = attr ? attr->as.numbers[1] : 0;
    return attr;
}

#endif
