// read.c: see read.h.
#include "canvas/read.h"

#include "value/format.h"

#include <math.h>

static const struct {
    const char *name;
    PlaceKind place;
    PlaceKind children;
    const char *help;
} kinds[] = {
#define NODE(id, text, place, children, help) {text, PLACE_##place, PLACE_##children, help},
#include "canvas/canvas_list.h"
};

static const char *const names[] = {
#define NAME(id, text) text,
#include "canvas/canvas_list.h"
};

static const char *const undrawn[] = {
#define UNDRAWN(text) text,
#include "canvas/canvas_list.h"
};

static const struct {
    DrawType type;
    int value;
    Str text;
} words[] = {
#define WORD(type, text, value) {TYPE_##type, value, {text, sizeof text - 1}},
#include "canvas/word_list.h"
};

typedef struct Row {
    DrawKind kind;
    DrawName name;
    DrawType type;
    const char *fallback;
    const char *help;
} Row;

static const Row rows[] = {
#define ATTR(kind_, name_, type_, fallback_, help_) {DRAW_##kind_, NAME_##name_, TYPE_##type_, fallback_, help_},
#include "canvas/canvas_list.h"
};
enum { ROW_COUNT = sizeof rows / sizeof rows[0] };

static const char *const type_texts[DRAW_TYPE_COUNT] = {
    [TYPE_NUMBER] = "number",
    [TYPE_WIDTH] = "number, 0 or more",
    [TYPE_POINT] = "x;y",
    [TYPE_SIZE] = "one number or two, 0 or more",
    [TYPE_SCALE] = "one number or two",
    [TYPE_POINTS] = "x;y;x;y…",
    [TYPE_COLOR] = "grey, r;g;b or r;g;b;a, each from 0 to 1",
    [TYPE_FLAG] = "true or false",
    [TYPE_TEXT] = "text",
    [TYPE_ANY] = "any",
    [TYPE_WEIGHT] = "100 to 1000, or a word such as :bold",
    [TYPE_JOIN] = ":miter, :round or :bevel",
    [TYPE_CAP] = ":butt, :round or :square",
    [TYPE_FILL_TYPE] = ":winding or :even_odd",
    [TYPE_SLANT] = ":upright, :oblique or :italic",
    [TYPE_COMPOSITE] = "a word such as :over, :add, :multiply or :dst_out",
};

void canvas_schema_init(CanvasSchema *schema, SymbolTable *symbols, CanvasHost host) {
    schema->symbols = symbols;
    schema->host = host;
    for (int i = 0; i < DRAW_KIND_COUNT; i++)
        schema->kinds[i] = symbol_intern(symbols, str_from(kinds[i].name));
    for (int i = 0; i < DRAW_NAME_COUNT; i++)
        schema->names[i] = symbol_intern(symbols, str_from(names[i]));
    for (int i = 0; i < WORD_COUNT; i++)
        schema->words[i] = symbol_number(words[i].text);
    for (int i = 0, row = 0; i < DRAW_KIND_COUNT; i++) {
        schema->first_row[i] = row;
        while (row < ROW_COUNT && rows[row].kind == (DrawKind)i)
            row++;
    }
    schema->first_row[DRAW_KIND_COUNT] = ROW_COUNT;
}

DrawKind canvas_kind(const CanvasSchema *schema, const Node *node) {
    int kind = 0;
    while (kind < DRAW_KIND_COUNT && schema->kinds[kind] != node->kind)
        kind++;
    return (DrawKind)kind;
}

// What is being read.
typedef struct Reader {
    const CanvasSchema *schema;
    Arena *arena;
    const Node *node;
} Reader;

// Reports something that stands at `place` in the node that is read.
static void report(const Reader *reader, Origin place, const char *code, Str key, Str text) {
    Str kind = reader->node->kind->name;
    Str node = str_format(reader->arena, "!%.*s", (int)kind.len, kind.bytes);
    reader->schema->host.report(reader->schema->host.host, DIAG_WARNING, code, &place, node, key, text);
}

static void report_attr(const Reader *reader, const char *code, const Symbol *attr, Str text) {
    report(reader, node_place(reader->node, attr), code, attr->name, text);
}

static void add_hex(Text *out, Str text) {
    Text colour = text_new(out->arena);
    if (text_add_hex_colour(&colour, text))
        text_add_format(out, ", did you mean %.*s?", (int)colour.len, colour.bytes);
}

// "attribute should be …, not …".
static void report_shape(const Reader *reader, const Row *row, Value found) {
    Text out = text_new(reader->arena);
    text_add_format(&out, "%s should be %s, not ", names[row->name], type_texts[row->type]);
    if (found.len <= 8)
        format_value(&out, reader->schema->symbols, found);
    else
        text_add_format(&out, "%u elements", found.len);
    if (row->type == TYPE_COLOR && found.len == 1 && found.kind == VALUE_MIXED && found.as.items[0].type == ITEM_STRING)
        add_hex(&out, found.as.items[0].as.string->text);
    report_attr(reader, "bad-attribute", reader->schema->names[row->name], text_str(&out));
}

// A number that a symbol stands for is no number here; symbols are beyond all coordinates.
static bool is_measure(double x) {
    return isfinite(x) && x > -8e307;
}

static bool all_measures(const double *numbers, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (!is_measure(numbers[i]))
            return false;
    return true;
}

static bool read_numbers(Value v, DrawType type, DrawAttr *attr) {
    uint32_t most = type == TYPE_NUMBER || type == TYPE_WIDTH || type == TYPE_WEIGHT ? 1 : type == TYPE_COLOR ? 4 : 2;
    if (!value_is_numeric(v) || v.len > most || (type == TYPE_COLOR && v.len == 2))
        return false;
    const double *numbers = value_numbers(&v);
    double *out = attr->as.numbers;
    for (uint32_t i = 0; i < v.len; i++) {
        if (!is_measure(numbers[i]) || (numbers[i] < 0 && (type == TYPE_WIDTH || type == TYPE_SIZE)))
            return false;
        out[i] = numbers[i];
    }
    if (v.len == 1)
        out[1] = out[2] = out[0];
    if (v.len < 4)
        out[3] = 1;
    attr->count = v.len;
    return true;
}

static bool read_points(const Reader *reader, Value v, DrawAttr *attr) {
    if (!value_is_numeric(v) || v.len % 2 || !all_measures(value_numbers(&v), v.len))
        return false;
    attr->as.list = arena_copy(reader->arena, value_numbers(&v), v.len * sizeof(double));
    attr->count = v.len;
    return true;
}

static bool read_text(const Reader *reader, Value v, DrawAttr *attr) {
    attr->as.text = str_from(str_to_c(reader->arena, value_text(reader->arena, reader->schema->symbols, v)));
    return true;
}

// A word, as symbol or as text.
static bool read_word(const Reader *reader, Value v, DrawType type, int *word) {
    bool text = v.len == 1 && v.kind == VALUE_MIXED && v.as.items[0].type == ITEM_STRING;
    if (!text && !(v.len == 1 && v.kind == VALUE_NUMBERS))
        return false;
    for (int i = 0; i < WORD_COUNT; i++)
        if (words[i].type == type && (text ? str_equal(words[i].text, v.as.items[0].as.string->text)
                                           : reader->schema->words[i] == v.as.number)) {
            *word = words[i].value;
            return true;
        }
    return false;
}

// Colours of bytes: whole numbers, of which one is far beyond white.
static void lint_colour(const Reader *reader, const Row *row, Value v) {
    const double *numbers = value_numbers(&v);
    double most = 0;
    for (uint32_t i = 0; i < v.len && i < 3; i++) {
        if (numbers[i] != floor(numbers[i]))
            return;
        most = fmax(most, numbers[i]);
    }
    if (most < 2)
        return;
    Text out = text_new(reader->arena);
    text_add_format(&out, "%s=", names[row->name]);
    format_value(&out, reader->schema->symbols, v);
    text_add_c(&out, " is beyond white, which is 1;1;1: parts that go up to 255 are written (r;g;b)/255");
    report_attr(reader, "colour-range", reader->schema->names[row->name], text_str(&out));
}

static void report_composite(const Reader *reader) {
    report_attr(reader, "bad-attribute", reader->schema->names[NAME_COMPOSITE],
                STR("composite=:modulate cannot be drawn here, :multiply comes near to it; ignored"));
}

// False if the value cannot be used.
static bool read_value(const Reader *reader, const Row *row, Value v, DrawAttr *attr) {
    switch (row->type) {
    case TYPE_POINTS:
        return read_points(reader, v, attr);
    case TYPE_FLAG:
        attr->as.flag = value_true(v);
        return true;
    case TYPE_TEXT:
        return read_text(reader, v, attr);
    case TYPE_WEIGHT: {
        int weight = 0;
        if (!read_word(reader, v, TYPE_WEIGHT, &weight))
            return read_numbers(v, row->type, attr) && attr->as.numbers[0] >= 1 && attr->as.numbers[0] <= 1000;
        attr->as.numbers[0] = weight;
        return true;
    }
    case TYPE_JOIN:
    case TYPE_CAP:
    case TYPE_FILL_TYPE:
    case TYPE_SLANT:
    case TYPE_COMPOSITE:
        return read_word(reader, v, row->type, &attr->as.word);
    case TYPE_ANY:
        return true;
    default:
        if (!read_numbers(v, row->type, attr))
            return false;
        if (row->type == TYPE_COLOR && reader->schema->lint)
            lint_colour(reader, row, v);
        return true;
    }
}

static const Row *find_row(const CanvasSchema *schema, DrawKind kind, const Symbol *name) {
    for (int i = schema->first_row[kind]; i < schema->first_row[kind + 1]; i++)
        if (schema->names[rows[i].name] == name)
            return &rows[i];
    return NULL;
}

// Adds the candidate that is nearest to a name, if any is near.
static void add_nearest(Text *out, Str name, const char *const *candidates, int count, const char *mark) {
    const char *nearest = NULL;
    int least = 2 + (int)(name.len < 12 ? name.len : 12) / 4; // long names may be further off
    for (int i = 0; i < count; i++) {
        int distance = str_distance(name, str_from(candidates[i]));
        if (distance < least) {
            least = distance;
            nearest = candidates[i];
        }
    }
    if (nearest)
        text_add_format(out, ", did you mean '%s%s'?", mark, nearest);
}

static void report_unknown_attribute(const Reader *reader, DrawKind kind, const Symbol *name) {
    const char *candidates[DRAW_NAME_COUNT];
    const CanvasSchema *schema = reader->schema;
    int count = 0;
    for (int i = schema->first_row[kind]; i < schema->first_row[kind + 1]; i++)
        candidates[count++] = names[rows[i].name];
    Text out = text_new(reader->arena);
    text_add_format(&out, "unknown attribute '%.*s'", (int)name->name.len, name->name.bytes);
    add_nearest(&out, name->name, candidates, count, "");
    report_attr(reader, "unknown-attribute", name, text_str(&out));
}

static bool may_stand(PlaceKind place, PlaceKind children) {
    return place == children || (place == PLACE_SOURCE && children == PLACE_DRAWING);
}

static bool is_undrawn(Str name) {
    for (size_t i = 0; i < sizeof undrawn / sizeof undrawn[0]; i++)
        if (str_equal(name, str_from(undrawn[i])))
            return true;
    return false;
}

static void report_misplaced(const Reader *reader, const Node *child, bool known) {
    Text out = text_new(reader->arena);
    Str name = child->kind->name;
    text_add_format(&out, "'!%.*s' ", (int)name.len, name.bytes);
    text_add_c(&out, known ? "has no effect here; it is left out" : "is not drawn; it is left out");
    bool exists = !known && is_undrawn(name);
    if (!known && !exists) {
        const char *candidates[DRAW_KIND_COUNT];
        for (int i = 0; i < DRAW_KIND_COUNT; i++)
            candidates[i] = kinds[i].name;
        add_nearest(&out, name, candidates, DRAW_KIND_COUNT, "!");
    }
    report(reader, node_place(child, NULL),
           known    ? "misplaced-node"
           : exists ? "undrawn-node"
                    : "unknown-node",
           name, text_str(&out));
}

// Reads the attributes; false if one is malformed without which the node cannot be drawn as it is meant.
static bool read_attrs(const Reader *reader, DrawKind kind, DrawNode *out) {
    const Node *node = reader->node;
    DrawAttr *attrs = arena_alloc_array(reader->arena, node->attr_count, sizeof *attrs);
    bool good = true;
    for (uint32_t i = 0; i < node->attr_count; i++) {
        const Row *row = find_row(reader->schema, kind, node->attrs[i].name);
        if (!row) {
            report_unknown_attribute(reader, kind, node->attrs[i].name);
            continue;
        }
        DrawAttr *attr = &attrs[out->attr_count];
        *attr = (DrawAttr){.name = (uint8_t)row->name};
        if (!read_value(reader, row, node->attrs[i].value, attr)) {
            report_shape(reader, row, node->attrs[i].value);
            // Where something is counts more than how it looks.
            good &= row->type != TYPE_NUMBER && row->type != TYPE_POINT && row->type != TYPE_SIZE &&
                    row->type != TYPE_SCALE && row->type != TYPE_POINTS;
        } else if (row->type == TYPE_COMPOSITE && attr->as.word == COMPOSITE_NONE) {
            report_composite(reader);
        } else {
            out->attr_count++;
        }
    }
    out->attrs = attrs;
    return good;
}

static const DrawNode *read_node(const CanvasSchema *schema, Arena *arena, const Node *node, DrawKind kind);

static void read_children(const Reader *reader, DrawKind kind, DrawNode *out) {
    const Node *node = reader->node;
    const DrawNode **children = arena_alloc_array(reader->arena, node->child_count, sizeof *children);
    for (uint32_t i = 0; i < node->child_count; i++) {
        DrawKind child = canvas_kind(reader->schema, node->children[i]);
        if (child == DRAW_KIND_COUNT || !may_stand(kinds[child].place, kinds[kind].children)) {
            report_misplaced(reader, node->children[i], child != DRAW_KIND_COUNT);
            continue;
        }
        const DrawNode *read = read_node(reader->schema, reader->arena, node->children[i], child);
        if (read)
            children[out->child_count++] = read;
    }
    out->children = children;
}

// NULL if the node is left out. The depth is limited by NODE_MAX_HEIGHT.
static const DrawNode *read_node(const CanvasSchema *schema, Arena *arena, const Node *node, DrawKind kind) {
    Reader reader = {schema, arena, node};
    DrawNode *out = arena_alloc(arena, sizeof *out);
    *out = (DrawNode){.kind = (uint8_t)kind};
    if (!read_attrs(&reader, kind, out) && kinds[kind].place != PLACE_TOP)
        return NULL;
    read_children(&reader, kind, out);
    return out;
}

const DrawNode *canvas_read(const CanvasSchema *schema, Arena *arena, const Node *window) {
    return read_node(schema, arena, window, canvas_kind(schema, window));
}

bool canvas_help_kind(size_t kind, CanvasHelp *help) {
    if (kind >= DRAW_KIND_COUNT)
        return false;
    *help = (CanvasHelp){.name = kinds[kind].name, .type = "", .fallback = "", .help = kinds[kind].help};
    return true;
}

bool canvas_help_attribute(size_t kind, size_t attribute, CanvasHelp *help) {
    for (int i = 0; i < ROW_COUNT; i++)
        if (rows[i].kind == (DrawKind)kind && attribute-- == 0) {
            *help = (CanvasHelp){names[rows[i].name], type_texts[rows[i].type], rows[i].fallback, rows[i].help};
            return true;
        }
    return false;
}
