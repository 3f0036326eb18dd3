// reports.c: reports of mistakes in nodes; see reader.h.
//
// All reports pass through report(), which names the node by its kind and its id or state, and counts them. A report
// says what is wrong; if there is a likely remedy, it follows after a semicolon.
#include "base/number.h"
#include "schema/help.h"
#include "schema/reader_internal.h"
#include "value/format.h"
#include "value/node_batch.h"

#include <inttypes.h>
#include <string.h>

// Adds " name=value" of an attribute that identifies the node: the state of a system, the id of other nodes.
static void add_identifier(Text *out, const Reader *reader, AttrRow row) {
    Value v = node_get(reader->node, reader->schema->slots[row].name);
    if (v.len == 0 || v.len > 16)
        return;
    text_add_format(out, " %s=", schema_names[schema_rows[row].name]);
    format_value(out, reader->schema->symbols, v);
}

static void report(const Reader *reader, DiagLevel level, const char *code, Origin place, Str key, Str text) {
    Schema *schema = reader->schema;
    Text out = text_new(reader->arena);
    text_add_format(&out, "!%.*s", STR_ARGS(reader->node->kind->name));
    add_identifier(&out, reader, ROW_PARTICLE_ID);
    add_identifier(&out, reader, ROW_PHYSICS_STATE);
    schema->report_count++;
    schema->sink.report(schema->sink.user_data, level, code, &place, text_str(&out), key, text);
}

void reader_report_at(const Reader *reader, const char *code, Origin place, Str key, Str text) {
    report(reader, DIAG_WARNING, code, place, key, text);
}

void reader_report_error(const Reader *reader, const char *code, Str text) {
    report(reader, reader->schema->lint ? DIAG_ERROR : DIAG_WARNING, code, node_origin(reader->node, NULL), (Str){0},
           text);
}

void reader_report(const Reader *reader, const char *code, const char *key, Str text) {
    reader_report_at(reader, code, node_origin(reader->node, NULL), str_from(key), text);
}

static void report_symbol(const Reader *reader, const char *code, const Symbol *attr, Str text) {
    reader_report_at(reader, code, node_origin(reader->node, attr), attr->name, text);
}

void reader_report_attr(const Reader *reader, const char *code, AttrName name, Str text) {
    const SchemaRow *row = schema_row(reader->kind, name);
    report_symbol(reader, code, reader->schema->slots[row - schema_rows].name, text);
}

// Adds what to write instead of an attribute that other programs have.
static void add_replacement(Text *out, const Reader *reader, Str name) {
    static const struct {
        const char *names;
        const char *attr; // suggested if the node has it
        const char *text;
    } replacements[] = {
        {"x y cx cy left top position pos center centre", "point", "point=x;y"},
        {"x y cx cy z pos", "position", "position=x;y"},
        {"vel speed", "velocity", "velocity=x;y"},
        {"gravity g", "acceleration", "acceleration=x;y"},
        {"from to start end", "points", "points=x;y;x;y"},
        {"w h width height", "size", "size=width;height"},
        {"r diameter", "radius", "radius=r"},
        {"angle rotation", "rotate", "rotate=turns"},
    };
    bool transforms = str_word_number(name, "translate scale rotate skew") >= 0;
    const Schema *schema = reader->schema;
    for (int i = schema->first_row[reader->kind]; i < schema->first_row[reader->kind + 1]; i++)
        for (size_t k = 0; k < sizeof replacements / sizeof replacements[0]; k++)
            if (str_word_number(name, replacements[k].names) >= 0 &&
                strcmp(schema_names[schema_rows[i].name], replacements[k].attr) == 0) {
                text_add_format(out, "; write %s", replacements[k].text);
                return;
            }
    if (transforms && schema_can_contain(KIND_TRANSFORM, schema_kinds[reader->kind].place))
        text_add_c(out, "; put the node in a '!transform', which has it");
}

void reader_report_unknown(const Reader *reader, const Symbol *name) {
    StrNearest nearest = str_nearest(name->name);
    for (int i = reader->schema->first_row[reader->kind]; i < reader->schema->first_row[reader->kind + 1]; i++)
        str_try_nearest(&nearest, str_from(schema_names[schema_rows[i].name]));
    Text out = text_new(reader->arena);
    text_add_format(&out, "unknown attribute '%.*s'", STR_ARGS(name->name));
    if (nearest.found.len)
        text_add_format(&out, "; did you mean '%.*s'?", STR_ARGS(nearest.found));
    else
        add_replacement(&out, reader, name->name);
    report_symbol(reader, "unknown-attribute", name, text_str(&out));
}

static const struct {
    const char *names;
    const char *kind;
} SYNONYMS[] = {
#define SYNONYM(names, kind) {names, kind},
#include "schema/synonym_list.h"
};
enum { SYNONYM_COUNT = sizeof SYNONYMS / sizeof SYNONYMS[0] };

const char *schema_synonyms(NodeKind kind) {
    for (size_t i = 0; i < SYNONYM_COUNT; i++)
        if (strcmp(SYNONYMS[i].kind, schema_kinds[kind].name) == 0)
            return SYNONYMS[i].names;
    return "";
}

// Returns the kind of node for which other programs have another name, or an empty string.
static Str find_synonym(Str kind) {
    for (size_t i = 0; i < SYNONYM_COUNT; i++)
        if (str_word_number(kind, SYNONYMS[i].names) >= 0)
            return str_from(SYNONYMS[i].kind);
    return (Str){0};
}

void schema_add_nearest_kind(Text *out, Str kind, PlaceKind place, const char *before, const char *after) {
    Str synonym = find_synonym(kind);
    StrNearest nearest = str_nearest(synonym.len ? synonym : kind);
    for (int i = 0; i < KIND_COUNT; i++)
        if (schema_can_contain((NodeKind)i, place) || (place == PLACE_TOP && is_in_window(schema_kinds[i].place)))
            str_try_nearest(&nearest, str_from(schema_kinds[i].name));
    if (nearest.found.len)
        text_add_format(out, "; did you mean %s%.*s%s?", before, STR_ARGS(nearest.found), after);
}

void schema_add_home(Text *out, Str kind) {
    static const char *const homes[] = {
        [PLACE_SCENE] = "at the top level", [PLACE_PHYSICS] = "in '!physics'", [PLACE_TOP] = "at the top level",
        [PLACE_PICTURE] = "in '!window'",   [PLACE_INPUT] = "in '!window'",    [PLACE_DRAWING] = "in '!canvas'",
        [PLACE_SOURCE] = "in '!canvas'",    [PLACE_FILTER] = "in '!canvas'",   [PLACE_EFFECT] = "in '!canvas'",
        [PLACE_STOP] = "in '!gradient'",    [PLACE_SCENE3D] = "in '!canvas3d'"};
    const char *found[KIND_COUNT];
    int count = 0;
    for (int i = 0; i < KIND_COUNT; i++) {
        const char *home = homes[schema_kinds[i].place];
        if (str_equal(kind, str_from(schema_kinds[i].name)) && (count == 0 || strcmp(home, found[count - 1]) != 0))
            found[count++] = home;
    }
    for (int i = 0; i < count; i++)
        text_add_format(out, "%s%s", i == 0 ? "; it belongs " : i + 1 == count ? " or " : ", ", found[i]);
}

// Returns the first character of the line of a node, or a NUL byte if the location is unknown.
static char first_in_line(const Node *node) {
    Origin origin = node_origin(node, NULL);
    return origin.source ? *source_locate(origin.source, origin.span.start).text.bytes : '\0';
}

// Adds that a tab may be the reason why a node is inside another one.
static void add_tab(Text *out, const Node *parent, const Node *child) {
    char outer = first_in_line(parent), inner = first_in_line(child);
    if ((inner == '\t' && outer == ' ') || (inner == ' ' && outer == '\t'))
        text_add_c(out, "; a tab counts as eight spaces of indentation");
}

void reader_report_child(const Reader *reader, const Node *child) {
    Text out = text_new(reader->arena);
    Str name = child->kind->name;
    NodeRejection why = schema_rejection(name);
    text_add_format(&out, "'!%.*s' %s; ignored", STR_ARGS(name),
                    why == NODE_MISPLACED ? "has no effect here" : "is not supported");
    if (why == NODE_MISPLACED)
        schema_add_home(&out, name);
    if (why == NODE_MISPLACED)
        add_tab(&out, reader->node, child);
    else if (why == NODE_UNKNOWN)
        schema_add_nearest_kind(
            &out, name, schema_kinds[reader->kind].children == PLACE_PHYSICS ? PLACE_PHYSICS : PLACE_TOP, "'!", "'");
    reader_report_at(reader, schema_rejection_codes[why], node_origin(child, NULL), name, text_str(&out));
}

// Adds the numbers that a colour represented by a string such as '#ff8800' or 'red'.
static void add_colour(Text *out, Value found) {
    if (found.len != 1 || found.kind != VALUE_MIXED || found.as.items[0].type != ITEM_STRING)
        return;
    Str written = found.as.items[0].as.string->text;
    Text colour = text_new(out->arena);
    if (!text_add_hex_colour(&colour, written))
        text_add(&colour, str_named_colour(written));
    if (colour.len)
        text_add_format(out, "; did you mean %.*s?", STR_ARGS(colour));
}

static void add_expected(Text *out, const Reader *reader, const TypeRow *type) {
    bool vector = type->shape == SHAPE_VECTOR || type->shape == SHAPE_NORMAL;
    if (vector && reader->dimensions > 1)
        text_add_format(out, "one number or a vector of %u", reader->dimensions);
    else
        text_add_c(out,
                   vector || (type->shape <= SHAPE_TIME && type->shape != SHAPE_NUMBERS) ? "one number" : type->text);
}

// Adds how to read the state if a value looks like one of its keys.
static void add_lookup(Text *out, const Reader *reader, Value found) {
    if (found.len < 2 || found.len > 8 || value_at(&found, 0).type != ITEM_NUMBER ||
        !symbol_of_number(reader->schema->symbols, value_at(&found, 0).as.number))
        return;
    text_add_c(out, "; to read the state, write $(");
    format_value(out, reader->schema->symbols, found);
    text_add_c(out, ")");
}

void reader_report_shape(const Reader *reader, const SchemaRow *row, Value found) {
    const TypeRow *type = &schema_types[row->type];
    Text out = text_new(reader->arena);
    text_add_format(&out, "%s should be ", schema_names[row->name]);
    add_expected(&out, reader, type);
    text_add_c(&out, ", not ");
    if (found.len <= 8)
        format_value(&out, reader->schema->symbols, found);
    else
        text_add_format(&out, "%u elements", found.len);
    if (type->shape == SHAPE_COLOR)
        add_colour(&out, found);
    add_lookup(&out, reader, found);
    report_symbol(reader, "bad-attribute", reader->schema->slots[row - schema_rows].name, text_str(&out));
}

void reader_report_ignored(const Reader *reader, const SchemaRow *row) {
    const char *help = schema_help[row - schema_rows].help;
    if (!str_starts_with(str_from(help), STR("ignored")))
        return;
    const Symbol *attr = reader->schema->slots[row - schema_rows].name;
    Str text = str_format(reader->arena, "attribute '%s' is %s", schema_names[row->name], help);
    report_symbol(reader, "ignored-attribute", attr, text);
}

void reader_report_lint(const Reader *reader, const char *code, const SchemaRow *row, Value v, const char *text) {
    Text out = text_new(reader->arena);
    text_add_format(&out, "%s=", schema_names[row->name]);
    format_value(&out, reader->schema->symbols, v);
    text_add_c(&out, text);
    report_symbol(reader, code, reader->schema->slots[row - schema_rows].name, text_str(&out));
}

bool reader_report_not_finite(const Reader *reader, AttrName name, PhysVector vector, int64_t frame,
                              const char *effect) {
    enum { MAX_SHOWN = 8 };
    uint32_t n = reader->dimensions;
    if (!vector || numbers_finite(vector, n, 1))
        return false;
    Text out = text_new(reader->arena);
    text_add_format(&out, "%s", schema_names[name]);
    if (n <= MAX_SHOWN) {
        text_add_c(&out, "=");
        format_value(&out, reader->schema->symbols, value_numbers_view(vector, n));
    }
    text_add_format(&out, " is not finite in frame %" PRId64 "; %s", frame, effect);
    reader_report_attr(reader, "not-finite", name, text_str(&out));
    return true;
}

static bool has_attr(const Schema *schema, NodeKind kind, const Symbol *name) {
    const SchemaSlot *first = schema->slots + schema->first_row[kind],
                     *end = schema->slots + schema->first_row[kind + 1];
    return reader_find_slot(first, end, first, name) < end;
}

bool reader_knows_attrs(const Reader *reader) {
    const Node *node = reader->node;
    for (uint32_t i = 0; i < node->attr_count; i++)
        if (!has_attr(reader->schema, reader->kind, node->attrs[i].name))
            return false;
    return true;
}

void reader_report_inside(const Reader *reader) {
    uint32_t count;
    const Node *const *children = node_children(reader->arena, reader->node, &count);
    arena_charge(reader->arena, 1 + count);
    for (uint32_t i = 0; i < count; i++) {
        NodeKind kind = schema_kind(reader->schema, children[i]);
        if (kind == KIND_COUNT || !schema_can_contain(kind, schema_kinds[reader->kind].children)) {
            reader_report_child(reader, children[i]);
            continue;
        }
        const Reader inner = {reader->schema, reader->arena, children[i], kind, reader->dimensions};
        for (uint32_t k = 0; k < children[i]->attr_count; k++)
            if (!has_attr(reader->schema, kind, children[i]->attrs[k].name))
                reader_report_unknown(&inner, children[i]->attrs[k].name);
        reader_report_inside(&inner);
    }
}
