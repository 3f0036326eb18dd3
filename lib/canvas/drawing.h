// drawing.h: a window's tree of nodes, prepared for drawing: kinds and attribute names are enum constants, and values
// are typed.
//
// The tree is translated and checked in the session's thread. The code that draws, perhaps in another thread, never
// sees symbols or values of the language.
#pragma once

#include "schema/reader.h"

typedef struct DrawNode DrawNode;
struct DrawNode {
    uint8_t kind; // NodeKind
    uint32_t attr_count;
    uint32_t child_count;
    const AttrValue *attrs; // in the order in which they are written; transforms are applied in this order
    const DrawNode *const *children;
    Str tags; // tags of a picture node, each followed by a space, which identify the node from frame to frame
    // Position of the shader program if there is one, else of the node. The script can be unloaded before a problem
    // with the node is reported.
    Origin origin;
};

// Returns the first syntax of templates (Mako) other than ${HEADER} in the source of a shader, which petri does not
// expand: ${name}, <%tag>, or a line that starts with % or ##. Returns an empty string if there is none. The text is
// printable ASCII and ends with the line, the bracket or after 40 characters.
static inline Str draw_find_template(Str source) {
    enum { MAX_SHOWN = 40 };
    bool line_start = true; // true if only white space comes before in this line
    for (size_t i = 0; i < source.len; i++) {
        Str rest = {source.bytes + i, source.len - i};
        char c = source.bytes[i];
        bool value = str_starts_with(rest, STR("${")), tag = str_starts_with(rest, STR("<%"));
        if ((value && !str_starts_with(rest, STR("${HEADER}"))) || tag ||
            (line_start && (c == '%' || str_starts_with(rest, STR("##"))))) {
            size_t len = 0;
            while (len < rest.len && len < MAX_SHOWN && rest.bytes[len] >= ' ' && rest.bytes[len] <= '~' &&
                   !(len > 0 && (value || tag) && rest.bytes[len - 1] == (value ? '}' : '>')))
                len++;
            return (Str){rest.bytes, len};
        }
        line_start = c == '\n' || (line_start && (c == ' ' || c == '\t' || c == '\r'));
    }
    return (Str){0};
}

// Returns the attribute; NULL if it is not set.
static inline const AttrValue *draw_attr(const DrawNode *node, AttrName name) {
    for (uint32_t i = 0; i < node->attr_count; i++)
        if (node->attrs[i].name == name)
            return &node->attrs[i];
    return NULL;
}

// Returns the value of a number attribute, or the default if the attribute is not set.
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

// Reads the two numbers of an attribute into `pair`. If the attribute is not set, sets both to 0 and returns false.
static inline bool draw_pair(const DrawNode *node, AttrName name, double pair[2]) {
    const AttrValue *attr = draw_attr(node, name);
    pair[0] = attr ? attr->as.numbers[0] : 0;
    pair[1] = attr ? attr->as.numbers[1] : 0;
    return attr;
}
