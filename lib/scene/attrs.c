// attrs.c: see attrs.h.
#include "scene/attrs.h"

#include "value/format.h"

#include <math.h>

static const char *const kind_names[] = {
#define KIND(id, text) text,
#include "scene/schema_list.h"
};

static const struct {
    SceneKind kind;
    const char *name;
    double fallback;
} rows[] = {
#define ATTR(kind, id, text, fallback) {KIND_##kind, text, fallback},
#include "scene/schema_list.h"
};

void schema_init(Schema *schema, SymbolTable *symbols, SceneHost host) {
    schema->symbols = symbols;
    schema->host = host;
    for (int i = 0; i < KIND_COUNT_OF; i++)
        schema->kinds[i] = symbol_intern(symbols, str_from(kind_names[i]));
    for (int i = ROW_COUNT - 1; i >= 0; i--) {
        schema->attrs[i] = symbol_intern(symbols, str_from(rows[i].name));
        schema->first_row[rows[i].kind] = i;
        schema->row_count[rows[i].kind]++;
    }
}

SceneKind schema_kind(const Schema *schema, const Node *node) {
    int kind = 0;
    while (kind < KIND_COUNT_OF && schema->kinds[kind] != node->kind)
        kind++;
    return (SceneKind)kind;
}

static void report_at(const Reader *reader, const char *code, const Symbol *attr, Str key, Str text) {
    const Schema *schema = reader->schema;
    Text out = text_new(reader->arena);
    text_add_format(&out, "!%.*s", (int)reader->node->kind->name.len, reader->node->kind->name.bytes);
    // A system is known by its state, anything else by its id.
    Value id = node_get(reader->node, schema->attrs[ROW_PARTICLE_ID]);
    if (id.len > 0 && id.len <= 16) {
        text_add_c(&out, " id=");
        format_value(&out, schema->symbols, id);
    }
    Value state = node_get(reader->node, schema->attrs[ROW_PHYSICS_STATE]);
    if (state.len > 0 && state.len <= 16) {
        text_add_c(&out, " state=");
        format_value(&out, schema->symbols, state);
    }
    Origin place = node_place(reader->node, attr);
    schema->host.report(schema->host.host, DIAG_WARNING, code, &place, text_str(&out), key, text);
}

void reader_report(const Reader *reader, const char *code, const char *key, Str text) {
    report_at(reader, code, NULL, str_from(key), text);
}

void reader_report_attr(const Reader *reader, const char *code, const Symbol *attr, Str text) {
    report_at(reader, code, attr, attr->name, text);
}

static bool has_attr(const Schema *schema, SceneKind kind, const Symbol *name) {
    const Symbol *const *attrs = schema->attrs + schema->first_row[kind];
    int i = 0;
    while (i < schema->row_count[kind] && attrs[i] != name)
        i++;
    return i < schema->row_count[kind];
}

static void report_unknown(const Reader *reader, SceneKind kind, const Symbol *name) {
    const Symbol *nearest = NULL;
    int least = 4;
    for (int i = 0; i < ROW_COUNT; i++) {
        int distance = str_distance(name->name, reader->schema->attrs[i]->name);
        if (rows[i].kind == kind && distance < least) {
            least = distance;
            nearest = reader->schema->attrs[i];
        }
    }
    Text out = text_new(reader->arena);
    text_add_format(&out, "unknown attribute '%.*s'", (int)name->name.len, name->name.bytes);
    if (nearest)
        text_add_format(&out, ", did you mean '%.*s'?", (int)nearest->name.len, nearest->name.bytes);
    reader_report_attr(reader, "unknown-attribute", name, text_str(&out));
}

void reader_check_names(const Reader *reader, SceneKind kind) {
    for (uint32_t i = 0; i < reader->node->attr_count; i++)
        if (!has_attr(reader->schema, kind, reader->node->attrs[i].name))
            report_unknown(reader, kind, reader->node->attrs[i].name);
}

void reader_lint(const Reader *reader, SceneKind kind) {
    static const AttrRow from_zero[] = {ROW_PARTICLE_RADIUS, ROW_PARTICLE_MASS, ROW_ANCHOR_RADIUS, ROW_ANCHOR_MASS};
    for (size_t i = 0; reader->schema->lint && i < sizeof from_zero / sizeof from_zero[0]; i++) {
        Value v = rows[from_zero[i]].kind == kind ? attr_value(reader, from_zero[i]) : VALUE_NULL;
        if (v.kind != VALUE_NUMBERS || v.len != 1 || !(v.as.number < 0))
            continue;
        Text out = text_new(reader->arena);
        text_add_format(&out, "%s=", rows[from_zero[i]].name);
        format_value(&out, reader->schema->symbols, v);
        text_add_c(&out, " is below 0 and counts as 0");
        reader_report_attr(reader, "below-zero", reader->schema->attrs[from_zero[i]], text_str(&out));
    }
}

Value attr_value(const Reader *reader, AttrRow row) {
    return node_get(reader->node, reader->schema->attrs[row]);
}

// "attribute: wanted …, found …".
static void report_shape(const Reader *reader, AttrRow row, const char *wanted, Value found) {
    Text out = text_new(reader->arena);
    text_add_format(&out, "%s should be %s, not ", rows[row].name, wanted);
    if (found.len <= 8)
        format_value(&out, reader->schema->symbols, found);
    else
        text_add_format(&out, "%u elements", found.len);
    reader_report_attr(reader, "bad-attribute", reader->schema->attrs[row], text_str(&out));
}

static bool is_number(Value v) {
    return v.kind == VALUE_NUMBERS && v.len == 1;
}

double attr_float_or(const Reader *reader, AttrRow row, double fallback) {
    Value v = attr_value(reader, row);
    if (v.len == 0)
        return fallback;
    if (is_number(v) && !isnan(v.as.number))
        return v.as.number;
    report_shape(reader, row, "one number", v);
    return fallback;
}

double attr_float(const Reader *reader, AttrRow row) {
    return attr_float_or(reader, row, rows[row].fallback);
}

double attr_time(const Reader *reader, AttrRow row, double fallback) {
    Value v = attr_value(reader, row);
    return is_number(v) ? v.as.number : attr_float_or(reader, row, fallback);
}

const double *attr_vector(const Reader *reader, AttrRow row) {
    Value v = attr_value(reader, row);
    uint32_t n = reader->dimensions;
    if (v.len == 0)
        return NULL;
    if (v.kind == VALUE_NUMBERS && v.len == n && n > 1)
        return v.as.numbers;
    if (v.kind == VALUE_NUMBERS && v.len == 1) {
        double *repeated = arena_alloc_array(reader->arena, n, sizeof *repeated);
        for (uint32_t k = 0; k < n; k++)
            repeated[k] = v.as.number;
        return repeated;
    }
    report_shape(reader, row,
                 n == 1 ? "one number"
                        : str_to_c(reader->arena, str_format(reader->arena, "one number or a vector of %u", n)),
                 v);
    return NULL;
}

bool attr_first(const Reader *reader, const AttrRow *candidates, uint32_t count, double *x) {
    for (uint32_t i = 0; i < count; i++) {
        Value v = attr_value(reader, candidates[i]);
        if (v.len == 0)
            continue;
        *x = attr_float_or(reader, candidates[i], NAN);
        if (!isnan(*x))
            return true;
    }
    return false;
}
