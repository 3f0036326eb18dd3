// read.c: see read.h.
#include "canvas/read.h"

#include "base/source.h"
#include "value/node_batch.h"

#include <errno.h>

// Reports a node whose file the script is not allowed to access. Returns false if the file would be read; the node must
// then be left out. If the file would be written, returns true, because the write fails later. This problem is already
// reported here, where the position in the script is known.
static bool can_use_file(const Reader *reader, const DrawNode *node) {
    const FileAccess *reach = reader->schema->file_access;
    const AttrValue *name = reach && schema_row(reader->kind, ATTR_FILENAME) ? draw_attr(node, ATTR_FILENAME) : NULL;
    bool writes = reader->kind == KIND_RECORD;
    FileAccessKind kind = writes ? FILE_ACCESS_WRITE : FILE_ACCESS_READ;
    char resolved[PATH_MAX];
    if (!name || name->as.text.len == 0)
        return true;
    const char *path = str_to_c(reader->arena, path_join(reader->arena, reach->directory, name->as.text));
    if (file_access_resolve(reach, kind, path, resolved) || errno != EXDEV)
        return true;
    const SchemaSink *host = &reader->schema->sink;
    Origin place = node_origin(reader->node, reader->schema->slots[name->row].name);
    host->report(host->user_data, writes ? DIAG_ERROR : DIAG_WARNING, writes ? "cannot-write" : "cannot-read", &place,
                 str_format(reader->arena, "!%s", schema_kinds[reader->kind].name), STR("filename"),
                 str_format(reader->arena, "cannot %s '%s': %s", writes ? "write" : "read", name->as.text.bytes,
                            file_access_reason(reader->arena, reach, kind, path)));
    return writes;
}

static void check_programs(const Reader *reader, const DrawNode *node) {
    static const AttrName names[] = {ATTR_VERTEX, ATTR_FRAGMENT};
    for (int i = 0; i < 2; i++) {
        const AttrValue *source = schema_row(reader->kind, names[i]) ? draw_attr(node, names[i]) : NULL;
        Str template = source ? draw_find_template(source->as.text) : (Str){0};
        if (template.len > 0)
            reader_report_attr(
                reader, "bad-shader", names[i],
                str_format(reader->arena,
                           "template '%.*s' is not supported, only '${HEADER}'; the default shader is used",
                           STR_ARGS(template)));
    }
}

static const DrawNode *read_node(Schema *schema, Arena *arena, const Node *node, NodeKind kind);

// Returns true if the node contains filters. `!blend` is a filter if it contains filters, else a paint source.
static bool holds_filters(const Reader *reader, const Node *node, int depth) {
    enum { MAX_DEPTH = 100 };
    const Schema *schema = reader->schema;
    arena_charge(reader->arena, 1 + node->child_count);
    for (uint32_t i = 0; i < node->child_count && depth < MAX_DEPTH; i++) {
        const Node *child = node->children[i];
        NodeKind kind = schema_kind_in(schema, child, PLACE_SOURCE);
        if (kind == KIND_COUNT ? schema_kind_in(schema, child, PLACE_FILTER) != KIND_COUNT
                               : kind == KIND_BLEND && holds_filters(reader, child, depth + 1))
            return true;
    }
    return false;
}

static NodeKind child_kind(const Reader *reader, const Node *node) {
    NodeKind kind = schema_kind_in(reader->schema, node, schema_kinds[reader->kind].children);
    bool open = schema_kinds[reader->kind].children == PLACE_DRAWING;
    return kind == KIND_BLEND && open && holds_filters(reader, node, 0) ? KIND_FILTER_BLEND : kind;
}

static void read_children(const Reader *reader, DrawNode *out) {
    uint32_t count;
    const Node *const *nodes = node_children(reader->arena, reader->node, &count);
    if (count == 0)
        return;
    const DrawNode **children = arena_alloc_array(reader->arena, count, sizeof *children);
    for (uint32_t i = 0; i < count; i++) {
        NodeKind child = child_kind(reader, nodes[i]);
        if (child == KIND_COUNT) {
            reader_report_child(reader, nodes[i]);
            continue;
        }
        const DrawNode *read = read_node(reader->schema, reader->arena, nodes[i], child);
        if (read)
            children[out->child_count++] = read;
    }
    out->children = children;
}

static Str join_tags(Arena *arena, const Node *node) {
    Text out = text_new(arena);
    for (uint32_t i = 0; i < node->tag_count; i++)
        text_add_format(&out, "%.*s ", STR_ARGS(node->tags[i]->name));
    return text_str(&out);
}

enum { CANVAS_NODE_WORK = 8, STOPS_A_UNIT = 16 };

// Translates a node and its children. Returns NULL if the node is left out. The recursion is limited by
// NODE_MAX_HEIGHT.
static const DrawNode *read_node(Schema *schema, Arena *arena, const Node *node, NodeKind kind) {
    Reader reader = {schema, arena, node, kind, 1};
    schema->current_node = node;
    uint64_t count = node_child_count(node);
    arena_charge(arena, CANVAS_NODE_WORK + node->attr_count + count / 4);
    if (kind == KIND_GRADIENT) // drawing libraries insert each stop into a sorted list, which takes quadratic time
        arena_charge(arena, count * count / STOPS_A_UNIT);
    DrawNode *out = arena_alloc(arena, sizeof *out);
    AttrValue *attrs = arena_alloc_array(arena, node->attr_count, sizeof *attrs);
    const Symbol *program = schema->slots[ROW_SHADER_FRAGMENT].name;
    *out = (DrawNode){.kind = (uint8_t)kind, .attrs = attrs, .origin = node_origin(node, program)};
    if (node->tag_count > 0 && schema_kinds[kind].place <= PLACE_PICTURE)
        out->tags = join_tags(arena, node);
    if (!reader_list(&reader, attrs, &out->attr_count) && schema_kinds[kind].place != PLACE_TOP)
        return NULL;
    check_programs(&reader, out);
    if (!can_use_file(&reader, out))
        return NULL;
    read_children(&reader, out);
    return out;
}

const DrawNode *canvas_read(Schema *schema, Arena *arena, const Node *window) {
    return read_node(schema, arena, window, schema_window_kind(schema, window));
}
