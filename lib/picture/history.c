// history.c: see history.h.
#include "picture/history.h"

// Pictures of the frame with an id, in the order in which a painter renders them. If there are more, references to
// those that are not stored count as references to earlier frames.
enum { MAX_KNOWN = 64 };

typedef struct Search {
    const Schema *schema;
    bool whole_frame; // true if references to known pictures do not count
    Value known[MAX_KNOWN];
    uint32_t known_count;
    uint32_t left; // number of nodes that may still be searched
} Search;

static Value attr_value(const Search *search, const Node *node, AttrRow row) {
    return node_get(node, search->schema->slots[row].name);
}

static bool has_word(Str text, Str word) {
    for (size_t i = 0; i + word.len <= text.len; i++)
        if (str_equal((Str){text.bytes + i, word.len}, word))
            return true;
    return false;
}

static bool names_word(Value program, Str word) {
    for (uint32_t i = 0; program.kind == VALUE_MIXED && i < program.len; i++)
        if (program.as.items[i].type == ITEM_STRING && has_word(program.as.items[i].as.string->text, word))
            return true;
    return false;
}

// Returns true if the node has a shader program that mentions `last`, the node's picture in the previous frame. In a
// search of the whole frame, also returns true for `beats`.
static bool names_last(const Search *search, const Node *node) {
    Value program = attr_value(search, node, ROW_SHADER_FRAGMENT);
    return names_word(program, STR("last")) || (search->whole_frame && names_word(program, STR("beats")));
}

// Returns true if both values are the same number, symbol or string. Other ids are not compared.
static bool same_id(Value a, Value b) {
    if (a.len != 1 || b.len != 1 || a.kind != b.kind)
        return false;
    if (a.kind == VALUE_NUMBERS)
        return a.as.number == b.as.number;
    return a.kind == VALUE_MIXED && a.as.items[0].type == ITEM_STRING && b.as.items[0].type == ITEM_STRING &&
           str_equal(a.as.items[0].as.string->text, b.as.items[0].as.string->text);
}

static bool refers_to_past(const Search *search, Value id) {
    bool known = false;
    for (uint32_t i = 0; search->whole_frame && i < search->known_count && !known; i++)
        known = same_id(search->known[i], id);
    return !known;
}

// Adds the id of a node that certainly has a picture, after its children were searched. A scene or an image may be
// missing in single frames, and an earlier picture is then shown.
static void add_known(Search *search, const Node *node, NodeKind kind) {
    bool certain =
        kind != KIND_CANVAS3D && kind != KIND_PICTURE_IMAGE && kind != KIND_REFERENCE && schema_row(kind, ATTR_ID);
    Value id = certain ? attr_value(search, node, ROW_REFERENCE_ID) : (Value){0};
    if (id.len > 0 && search->known_count < MAX_KNOWN)
        search->known[search->known_count++] = id;
}

// Returns true if a node in a canvas shows the picture of another node, or if too many nodes were searched.
static bool canvas_shows_others(Search *search, const Node *node, int depth) {
    enum { MAX_DEPTH = 1000 };
    if (search->left == 0)
        return true;
    --search->left;
    if (node->kind == search->schema->kinds[KIND_IMAGE] || node->kind == search->schema->kinds[KIND_PATTERN]) {
        const AttrRow rows[] = {ROW_IMAGE_IMAGE_ID, ROW_IMAGE_TEXTURE_ID};
        for (int i = 0; i < 2; i++) {
            Value id = attr_value(search, node, rows[i]);
            if (id.len > 0 && refers_to_past(search, id))
                return true;
        }
    }
    for (uint32_t i = 0; i < node->child_count && depth < MAX_DEPTH; i++)
        if (canvas_shows_others(search, node->children[i], depth + 1))
            return true;
    return false;
}

static bool shows_history(Search *search, const Node *node, NodeKind kind, int depth) {
    enum { MAX_DEPTH = 100 };
    if (search->left == 0 || kind == KIND_FEEDBACK || names_last(search, node) ||
        (kind == KIND_REFERENCE && refers_to_past(search, attr_value(search, node, ROW_REFERENCE_ID))) ||
        (kind == KIND_RECORD && attr_value(search, node, ROW_RECORD_FILENAME).len > 0))
        return true;
    --search->left;
    for (uint32_t i = 0; i < node->child_count && depth < MAX_DEPTH; i++) {
        const Node *child = node->children[i];
        NodeKind inside = schema_kind_in(search->schema, child, PLACE_PICTURES);
        if (inside == KIND_CANVAS ? canvas_shows_others(search, child, 0)
                                  : inside < KIND_COUNT && shows_history(search, child, inside, depth + 1))
            return true;
        if (inside == KIND_CANVAS)
            add_known(search, child, inside);
    }
    add_known(search, node, kind);
    return false;
}

static bool any_window(const DrawAccess *access, bool whole_frame) {
    Search search = {.schema = access->schema, .whole_frame = whole_frame, .left = CANVAS_MAX_CHECKED};
    const Node *window;
    for (uint32_t at = 0; (window = canvas_next_window(access->schema, access->tree, &at));)
        if (shows_history(&search, window, KIND_WINDOW, 0))
            return true;
    return false;
}

bool picture_needs_history(const DrawAccess *access) {
    return access->samples || any_window(access, false);
}

bool picture_shows_history(const DrawAccess *access) {
    return access->samples || any_window(access, true);
}
