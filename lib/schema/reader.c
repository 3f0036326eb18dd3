// reader.c: implementation of reader.h.
//
// A system can have millions of particles, so the common case has a fast path: attributes in the order of the table
// with values of the expected form are stored directly. Other attributes are read again by fill_checked, which reports
// mistakes.
#include "schema/reader.h"

#include "value/format.h"
#include "value/value_hash.h"

#include <math.h>
#include <string.h>

static bool is_in_window(PlaceKind place) {
    return place >= PLACE_TOP;
}

// Returns the slot of by_name that contains the kinds with this name, or an empty slot in which the name can be stored.
static size_t find_name(const Schema *schema, const Symbol *name) {
    enum { SLOTS = sizeof schema->by_name };
    _Static_assert(KIND_COUNT < 255 && 2 * KIND_COUNT < SLOTS, "kinds are few");
    size_t at = ((uintptr_t)name >> 4) * 0x9e3779b1u >> 7 & (SLOTS - 1);
    while (schema->by_name[at] > 0 && schema->kinds[schema->by_name[at] - 1] != name)
        at = (at + 1) & (SLOTS - 1);
    return at;
}

void schema_init(Schema *schema, SymbolTable *symbols, SchemaSink sink) {
    *schema = (Schema){.symbols = symbols, .sink = sink};
    for (int i = 0; i < KIND_COUNT; i++)
        schema->kinds[i] =
            (i == KIND_PARTICLE ? symbol_intern_batched : symbol_intern)(symbols, str_from(schema_kinds[i].name));
    for (int i = 0; i < WORD_COUNT; i++)
        schema->words[i] = symbol_number(schema_words[i].text);
    for (int i = 0, row = 0; i < KIND_COUNT; i++) {
        schema->first_row[i] = (uint16_t)row;
        for (; row < ROW_COUNT && schema_rows[row].kind == i; row++) {
            const SchemaRow *attr = &schema_rows[row];
            const TypeRow *type = &schema_types[attr->type];
            bool plain = attr->field != FIELD_NOWHERE && !attr->alias;
            schema->slots[row] = (SchemaSlot){
                .name = symbol_intern(symbols, str_from(schema_names[attr->name])),
                .low = type->low,
                .high = type->high,
                .field = attr->field,
                .plain = (uint8_t)(plain ? type->shape : SHAPE_OTHER),
            };
            schema->has_vector_default[i] |= type->shape == SHAPE_VECTOR && attr->default_value.value != 0;
        }
    }
    schema->first_row[KIND_COUNT] = ROW_COUNT;
    while (!is_in_window(schema_kinds[schema->first_in_window].place))
        schema->first_in_window++;
    for (int kind = KIND_COUNT; kind-- > schema->first_in_window;) {
        uint8_t *slot = &schema->by_name[find_name(schema, schema->kinds[kind])];
        schema->next_of_name[kind] = *slot;
        *slot = (uint8_t)(kind + 1);
    }
}

NodeKind schema_window_kind(const Schema *schema, const Node *node) {
    int kind = schema->by_name[find_name(schema, node->kind)];
    return kind > 0 ? (NodeKind)(kind - 1) : KIND_COUNT;
}

NodeKind schema_kind_in(const Schema *schema, const Node *node, PlaceKind children) {
    for (int kind = schema->by_name[find_name(schema, node->kind)]; kind > 0; kind = schema->next_of_name[kind - 1])
        if (schema_can_contain((NodeKind)(kind - 1), children))
            return (NodeKind)(kind - 1);
    return KIND_COUNT;
}

// Adds " name=value" of an attribute that identifies the node: the state of a system, the id of other nodes.
static void add_identifier(Text *out, const Reader *reader, AttrRow row) {
    Value v = node_get(reader->node, reader->schema->slots[row].name);
    if (v.len == 0 || v.len > 16)
        return;
    text_add_format(out, " %s=", schema_names[schema_rows[row].name]);
    format_value(out, reader->schema->symbols, v);
}

void reader_report_at(const Reader *reader, const char *code, Origin place, Str key, Str text) {
    Schema *schema = reader->schema;
    Text out = text_new(reader->arena);
    text_add_format(&out, "!%.*s", STR_ARGS(reader->node->kind->name));
    add_identifier(&out, reader, ROW_PARTICLE_ID);
    add_identifier(&out, reader, ROW_PHYSICS_STATE);
    schema->report_count++;
    schema->sink.report(schema->sink.user_data, DIAG_WARNING, code, &place, text_str(&out), key, text);
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

static StrNearest nearest_to(Str name) {
    return (StrNearest){name, 2 + (int)(name.len < 12 ? name.len : 12) / 4, {0}}; // long names can differ more
}

static void report_unknown(const Reader *reader, const Symbol *name) {
    StrNearest nearest = nearest_to(name->name);
    for (int i = reader->schema->first_row[reader->kind]; i < reader->schema->first_row[reader->kind + 1]; i++)
        str_try_nearest(&nearest, str_from(schema_names[schema_rows[i].name]));
    Text out = text_new(reader->arena);
    text_add_format(&out, "unknown attribute '%.*s'", STR_ARGS(name->name));
    if (nearest.found.len)
        text_add_format(&out, "; did you mean '%.*s'?", STR_ARGS(nearest.found));
    report_symbol(reader, "unknown-attribute", name, text_str(&out));
}

void schema_add_nearest_kind(Text *out, Str kind, PlaceKind place, const char *before, const char *after) {
    StrNearest nearest = nearest_to(kind);
    for (int i = 0; i < KIND_COUNT; i++)
        if (schema_can_contain((NodeKind)i, place) || (place == PLACE_TOP && is_in_window(schema_kinds[i].place)))
            str_try_nearest(&nearest, str_from(schema_kinds[i].name));
    if (nearest.found.len)
        text_add_format(out, "; did you mean %s%.*s%s?", before, STR_ARGS(nearest.found), after);
}

static void add_hex(Text *out, Value found) {
    Text colour = text_new(out->arena);
    if (found.len == 1 && found.kind == VALUE_MIXED && found.as.items[0].type == ITEM_STRING &&
        text_add_hex_colour(&colour, found.as.items[0].as.string->text))
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

// Reports "attribute should be …, not …".
static void report_shape(const Reader *reader, const SchemaRow *row, Value found) {
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
        add_hex(&out, found);
    report_symbol(reader, "bad-attribute", reader->schema->slots[row - schema_rows].name, text_str(&out));
}

// Reports "attribute=value …" for a value that is valid but unlikely to be intended.
static void report_lint(const Reader *reader, const char *code, const SchemaRow *row, Value v, const char *text) {
    Text out = text_new(reader->arena);
    text_add_format(&out, "%s=", schema_names[row->name]);
    format_value(&out, reader->schema->symbols, v);
    text_add_c(&out, text);
    report_symbol(reader, code, reader->schema->slots[row - schema_rows].name, text_str(&out));
}

static bool is_number(Value v) {
    return v.kind == VALUE_NUMBERS && v.len == 1;
}

static double clamp_to_limits(const Reader *reader, const SchemaRow *row, Value v) {
    const TypeRow *type = &schema_types[row->type];
    double x = v.as.number;
    if (x < type->low && type->low == 0 && reader->schema->lint)
        report_lint(reader, "negative-value", row, v, " is below 0 and counts as 0");
    return x < type->low ? type->low : x > type->high ? type->high : x;
}

// Returns the vector v divided by its Euclidean length. Returns NULL if the length is 0 or not finite.
static PhysVector unit_vector(const Reader *reader, PhysVector v) {
    double sum = 0;
    for (uint32_t k = 0; k < reader->dimensions; k++)
        sum += v[k] * v[k];
    double length = sqrt(sum);
    if (!(length > 0) || !isfinite(length))
        return NULL;
    double *unit = arena_alloc_array(reader->arena, reader->dimensions, sizeof *unit);
    for (uint32_t k = 0; k < reader->dimensions; k++)
        unit[k] = v[k] / length;
    return unit;
}

// Returns the elements of a vector attribute, or NULL if its value is malformed.
static PhysVector read_vector(const Reader *reader, const Value *v) {
    uint32_t n = reader->dimensions;
    if (v->kind != VALUE_NUMBERS || (v->len != n && v->len != 1))
        return NULL;
    if (v->len == n)
        return value_numbers(v);
    double *repeated = arena_alloc_array(reader->arena, n, sizeof *repeated);
    for (uint32_t k = 0; k < n; k++)
        repeated[k] = v->as.number;
    return repeated;
}

// Stores a value of the expected form. Returns false if the value needs a closer check.
static inline bool store_fast(const SchemaSlot *slot, uint32_t n, const Value *v, char *record) {
    void *field = record + slot->field;
    switch (slot->plain) {
    case SHAPE_NUMBER:
        if (v->kind != VALUE_NUMBERS || v->len != 1 || !(v->as.number >= slot->low) || !(v->as.number <= slot->high))
            return false;
        *(double *)field = v->as.number;
        return true;
    case SHAPE_VECTOR:
        if (v->kind != VALUE_NUMBERS || v->len != n)
            return false;
        *(PhysVector *)field = value_numbers(v);
        return true;
    case SHAPE_VALUE:
        *(Value *)field = *v;
        return true;
    default:
        return false;
    }
}

// Like store_fast, but for any value. Returns false if the value is malformed.
static bool store_checked(const Reader *reader, const SchemaRow *row, const Value *v, char *record) {
    void *field = record + row->field;
    AttrShape shape = schema_types[row->type].shape;
    if (shape == SHAPE_VALUE || shape == SHAPE_NUMBERS) {
        if (shape == SHAPE_NUMBERS && !value_is_numeric(*v))
            return false;
        *(Value *)field = *v;
    } else if (shape == SHAPE_VECTOR || shape == SHAPE_NORMAL) {
        PhysVector vector = read_vector(reader, v);
        if (!vector)
            return false;
        *(PhysVector *)field = shape == SHAPE_NORMAL ? unit_vector(reader, vector) : vector;
    } else {
        if (!is_number(*v) || (isnan(v->as.number) && shape != SHAPE_TIME))
            return false;
        *(double *)field = shape == SHAPE_INTEGER ? floor(v->as.number) : clamp_to_limits(reader, row, *v);
    }
    return true;
}

// Stores one attribute that the fast path did not accept. If the attribute is unknown, `row` is the end of the kind's
// rows.
static __attribute__((noinline)) void fill_checked(const Reader *reader, const Attr *attr, int row, char *record) {
    const SchemaRow *found = &schema_rows[row];
    if (row == reader->schema->first_row[reader->kind + 1]) {
        report_unknown(reader, attr->name);
        return;
    }
    if (found->field == FIELD_NOWHERE || attr->value.len == 0)
        return;
    if (found->alias) {
        const SchemaRow *winner = schema_row(reader->kind, found->alias);
        Value v = node_get(reader->node, reader->schema->slots[winner - schema_rows].name);
        if (v.len > 0 && store_checked(reader, winner, &v, record))
            return;
    }
    if (!store_checked(reader, found, &attr->value, record))
        report_shape(reader, found, attr->value);
}

// Sets vector attributes that are missing in the node to their defaults: 0;…;0;x.
static void fill_vector_defaults(const Reader *reader, char *record) {
    int first = reader->schema->first_row[reader->kind], end = reader->schema->first_row[reader->kind + 1];
    for (int i = first; i < end; i++) {
        const SchemaRow *row = &schema_rows[i];
        PhysVector *field = (PhysVector *)(void *)(record + row->field);
        if (schema_types[row->type].shape != SHAPE_VECTOR || row->default_value.value == 0 || *field)
            continue;
        double *vector = arena_alloc_array(reader->arena, reader->dimensions, sizeof *vector);
        for (uint32_t k = 0; k < reader->dimensions; k++)
            vector[k] = k + 1 == reader->dimensions ? row->default_value.value : 0;
        *field = vector;
    }
}

// Returns the slot of an attribute, or `end` if there is none. Searches from `guess`, the slot after that of the
// previous attribute, and then from `first`.
static inline const SchemaSlot *find_slot(const SchemaSlot *first, const SchemaSlot *end, const SchemaSlot *guess,
                                          const Symbol *name) {
    for (const SchemaSlot *slot = guess; slot < end; slot++)
        if (slot->name == name)
            return slot;
    for (const SchemaSlot *slot = first; slot < guess; slot++)
        if (slot->name == name)
            return slot;
    return end;
}

void reader_fill(const Reader *reader, void *record) {
    const Schema *schema = reader->schema;
    const SchemaSlot *first = schema->slots + schema->first_row[reader->kind], *guess = first;
    const SchemaSlot *end = schema->slots + schema->first_row[reader->kind + 1];
    const Attr *attr = reader->node->attrs, *last = attr ? attr + reader->node->attr_count : attr;
    for (; attr < last; attr++) {
        const SchemaSlot *slot = find_slot(first, end, guess, attr->name);
        if (slot == end || !store_fast(slot, reader->dimensions, &attr->value, record))
            fill_checked(reader, attr, (int)(slot - schema->slots), record);
        guess = slot < end ? slot + 1 : first;
    }
    if (schema->has_vector_default[reader->kind])
        fill_vector_defaults(reader, record);
}

// Returns true for a finite number that does not represent a symbol. All symbols are numbers below -8e307.
static bool is_finite_number(double x) {
    return isfinite(x) && x > -8e307;
}

static bool read_finite_numbers(Value v, const TypeRow *type, uint32_t max, AttrValue *attr) {
    bool all = type->shape == SHAPE_TRIPLE || type->shape == SHAPE_QUAD;
    if (!value_is_numeric(v) || v.len > max || (type->shape == SHAPE_COLOR && v.len == 2) ||
        (all && v.len > 1 && v.len < max))
        return false;
    const double *numbers = value_numbers(&v);
    double *out = attr->as.numbers;
    for (uint32_t i = 0; i < v.len; i++) {
        if (!is_finite_number(numbers[i]) || numbers[i] < type->low || numbers[i] > type->high)
            return false;
        out[i] = numbers[i];
    }
    if (v.len == 1)
        out[1] = out[2] = out[0];
    if (v.len < 4)
        out[3] = all ? out[0] : 1;
    attr->count = v.len;
    return true;
}

static bool read_numbers(const Reader *reader, Value v, bool even, AttrValue *attr) {
    const double *numbers = value_numbers(&v);
    if (even && v.len % 2) // the last number is an x without a y
        v.len--;
    if (!value_is_numeric(v))
        return false;
    for (uint32_t i = 0; i < v.len; i++)
        if (!is_finite_number(numbers[i]))
            return false;
    attr->as.list = arena_copy(reader->arena, numbers, v.len * sizeof(double));
    attr->count = v.len;
    return true;
}

// Reads a word, which the script gives as a symbol or as a string.
static bool read_word(const Reader *reader, Value v, AttrType type, int *word) {
    bool text = v.len == 1 && v.kind == VALUE_MIXED && v.as.items[0].type == ITEM_STRING;
    if (!text && !is_number(v))
        return false;
    for (int i = 0; i < WORD_COUNT; i++)
        if (schema_words[i].type == type && (text ? str_equal(schema_words[i].text, v.as.items[0].as.string->text)
                                                  : reader->schema->words[i] == v.as.number)) {
            *word = schema_words[i].value;
            return true;
        }
    return false;
}

static bool read_weight(const Reader *reader, Value v, const SchemaRow *row, AttrValue *attr) {
    int weight = 0;
    if (!read_word(reader, v, row->type, &weight))
        return read_finite_numbers(v, &schema_types[row->type], 1, attr);
    attr->as.numbers[0] = weight;
    return true;
}

// Reports colours whose components seem to range up to 255: integers, one of which is 2 or more.
static void lint_colour(const Reader *reader, const SchemaRow *row, Value v) {
    const double *numbers = value_numbers(&v);
    double max = 0;
    for (uint32_t i = 0; i < v.len && i < 3; i++) {
        if (numbers[i] != floor(numbers[i]))
            return;
        max = fmax(max, numbers[i]);
    }
    if (max >= 2)
        report_lint(reader, "colour-range", row, v,
                    " is brighter than white (1;1;1); if components go up to 255, divide them: (r;g;b)/255");
}

// Reads the value v of an attribute of a drawing node into `attr`. Returns false if the value is malformed.
static bool read_drawing_attr(const Reader *reader, const SchemaRow *row, Value v, AttrValue *attr) {
    const TypeRow *type = &schema_types[row->type];
    switch (type->shape) {
    case SHAPE_FINITE:
        return read_finite_numbers(v, type, 1, attr);
    case SHAPE_PAIR:
        return read_finite_numbers(v, type, 2, attr);
    case SHAPE_TRIPLE:
        return read_finite_numbers(v, type, 3, attr);
    case SHAPE_QUAD:
        return read_finite_numbers(v, type, 4, attr);
    case SHAPE_COLOR:
        if (!read_finite_numbers(v, type, 4, attr))
            return false;
        if (reader->schema->lint)
            lint_colour(reader, row, v);
        return true;
    case SHAPE_POINTS:
        return read_numbers(reader, v, true, attr);
    case SHAPE_LIST:
        return !(v.len < type->low || v.len > type->high) && read_numbers(reader, v, false, attr);
    case SHAPE_SEED:
        attr->as.numbers[0] = (double)(int64_t)value_exact_hash(reader->arena, v) / 281474976710656.0;
        return true;
    case SHAPE_FLAG:
        attr->as.flag = value_true(v);
        return true;
    case SHAPE_TEXT:
        attr->as.text = str_from(str_to_c(reader->arena, value_text(reader->arena, reader->schema->symbols, v)));
        return true;
    case SHAPE_WEIGHT:
        return read_weight(reader, v, row, attr);
    case SHAPE_WORD:
        return read_word(reader, v, row->type, &attr->as.word);
    default:
        return true; // not used in drawings
    }
}

// Returns true if the value has a valid count of numbers, even if these are out of range. If false, reader_list treats
// the attribute as missing.
static bool has_shape(const SchemaRow *row, Value v) {
    AttrShape shape = schema_types[row->type].shape;
    return value_is_numeric(v) && v.len > 0 && (shape == SHAPE_POINTS || v.len <= (shape == SHAPE_PAIR ? 2u : 1u));
}

bool reader_list(const Reader *reader, AttrValue *attrs, uint32_t *count) {
    const Node *node = reader->node;
    const SchemaSlot *slots = reader->schema->slots;
    const SchemaSlot *first = slots + reader->schema->first_row[reader->kind], *guess = first;
    const SchemaSlot *end = slots + reader->schema->first_row[reader->kind + 1];
    bool good = true;
    for (uint32_t i = 0; i < node->attr_count; i++) {
        const Value v = node->attrs[i].value;
        const SchemaSlot *slot = find_slot(first, end, guess, node->attrs[i].name);
        guess = slot < end ? slot + 1 : first;
        AttrValue *attr = &attrs[*count];
        if (slot == end) {
            *attr = (AttrValue){.name = ATTR_NONE};
            if (reader->kind != KIND_SHADER)
                report_unknown(reader, node->attrs[i].name);
            else if (read_numbers(reader, v, false, attr)) { // shaders can have uniforms of any name
                attr->custom_name = str_to_c(reader->arena, node->attrs[i].name->name);
                ++*count;
            }
            continue;
        }
        const SchemaRow *found = &schema_rows[slot - slots];
        *attr = (AttrValue){.name = found->alias ? found->alias : found->name, .row = (uint16_t)(slot - slots)};
        if (!read_drawing_attr(reader, found, v, attr)) {
            report_shape(reader, found, v);
            good &= !schema_types[found->type].required || !has_shape(found, v);
            if (found->type == TYPE_MIX) { // a node with an unknown mode is not drawn
                attr->as.word = MIX_UNKNOWN;
                ++*count;
            }
        } else {
            ++*count;
        }
    }
    return good;
}

void schema_store(const AttrValue *attr, void *record) {
    const SchemaRow *row = &schema_rows[attr->row];
    if (row->field == FIELD_NOWHERE)
        return;
    void *field = (char *)record + row->field;
    switch (schema_types[row->type].shape) {
    case SHAPE_FINITE:
    case SHAPE_WEIGHT:
        *(double *)field = attr->as.numbers[0];
        break;
    case SHAPE_COLOR:
        memcpy(field, attr->as.numbers, sizeof attr->as.numbers);
        break;
    case SHAPE_TRIPLE:
        memcpy(field, attr->as.numbers, 3 * sizeof(double));
        break;
    case SHAPE_FLAG:
        *(bool *)field = attr->as.flag;
        break;
    case SHAPE_TEXT:
        *(const char **)field = attr->as.text.bytes;
        break;
    case SHAPE_WORD:
        *(int *)field = attr->as.word;
        break;
    default: // no record of a drawing node has a field of this shape
        break;
    }
}

static void store_default(const SchemaRow *row, char *record) {
    const AttrDefault *attr_default = &row->default_value;
    void *field = record + row->field;
    AttrShape shape = schema_types[row->type].shape;
    double x = attr_default->value;
    if (shape == SHAPE_VALUE || shape == SHAPE_NUMBERS)
        *(Value *)field = isnan(x) ? VALUE_NULL : value_number(x);
    else if (shape == SHAPE_VECTOR || shape == SHAPE_NORMAL)
        *(PhysVector *)field = NULL;
    else if (shape <= SHAPE_TIME)
        *(double *)field = x;
    else
        schema_store(&(AttrValue){.row = (uint16_t)(row - schema_rows),
                                  .as = shape == SHAPE_TEXT
                                            ? (union AttrData){.text = str_from(
                                                                   attr_default->string ? attr_default->string : "")}
                                        : shape == SHAPE_WORD   ? (union AttrData){.word = (int)x}
                                        : shape == SHAPE_FLAG   ? (union AttrData){.flag = x != 0}
                                        : shape == SHAPE_COLOR  ? (union AttrData){.numbers = {x, x, x, 1}}
                                        : shape == SHAPE_TRIPLE ? (union AttrData){.numbers = {x, x, x}}
                                                                : (union AttrData){.numbers = {x}}},
                     record);
}

void schema_defaults(NodeKind kind, void *record) {
    for (int i = 0; i < ROW_COUNT; i++)
        if (schema_rows[i].kind == kind && schema_rows[i].field != FIELD_NOWHERE)
            store_default(&schema_rows[i], record);
}
