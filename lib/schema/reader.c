// reader.c: reads attributes of systems, counters and input nodes into records; see reader.h.
//
// A system can have millions of particles, so the common case has a fast path: attributes in the order of the table
// with values of the expected form are stored directly. Other attributes are read again by fill_checked, which reports
// mistakes.
#include "schema/reader_internal.h"
#include "value/node_batch.h"

#include <math.h>

// Symbols are numbers of at least this magnitude. fill_checked looks for symbols among such numbers.
#define MAX_PLAIN 0x1p1023

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
                .low = type->shape == SHAPE_NUMBER ? fmax(type->low, -MAX_PLAIN) : type->low,
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

static double clamp_to_limits(const Reader *reader, const SchemaRow *row, Value v) {
    const TypeRow *type = &schema_types[row->type];
    double x = v.as.number;
    if (x < type->low && type->low == 0 && reader->schema->lint)
        reader_report_lint(reader, "negative-value", row, v, " is below 0 and counts as 0");
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

// Returns false if some of the numbers are symbols, infinite, or not numbers. May also return false for huge numbers.
static inline bool are_plain(const double *numbers, uint32_t count) {
    bool plain = true;
    for (uint32_t k = 0; k < count; k++)
        plain &= fabs(numbers[k]) < MAX_PLAIN;
    return plain;
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
        if (v->kind != VALUE_NUMBERS || v->len != n || !are_plain(value_numbers(v), n))
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
        if (!value_is_number(*v) || (isnan(v->as.number) && shape != SHAPE_TIME))
            return false;
        *(double *)field = shape == SHAPE_INTEGER ? floor(v->as.number) : clamp_to_limits(reader, row, *v);
    }
    return true;
}

// Returns true if an attribute that wants a quantity has a symbol, such as :x. Symbols are numbers, but huge ones, so
// that they cannot be meant as quantities. Whole numbers can be symbols, because `run` may count with names.
static bool is_symbol_as_number(const Reader *reader, const SchemaRow *row, const Value *v) {
    AttrShape shape = schema_types[row->type].shape;
    if (shape != SHAPE_NUMBER && shape != SHAPE_TIME && shape != SHAPE_VECTOR)
        return false;
    for (uint32_t i = 0; i < v->len; i++)
        if (symbol_of_number(reader->schema->symbols, value_numbers(v)[i]))
            return true;
    return false;
}

// Stores one attribute that the fast path did not accept. If the attribute is unknown, `row` is the end of the kind's
// rows.
static __attribute__((noinline)) void fill_checked(const Reader *reader, const Attr *attr, int row, char *record) {
    const SchemaRow *found = &schema_rows[row];
    if (row == reader->schema->first_row[reader->kind + 1]) {
        reader_report_unknown(reader, attr->name);
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
    if (!store_checked(reader, found, &attr->value, record) || is_symbol_as_number(reader, found, &attr->value))
        reader_report_shape(reader, found, attr->value);
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

static __attribute__((noinline)) void report_children(const Reader *reader) {
    uint32_t count;
    const Node *const *children = node_children(reader->arena, reader->node, &count);
    for (uint32_t i = 0; i < count; i++)
        reader_report_child(reader, children[i]);
}

void reader_fill(const Reader *reader, void *record) {
    const Schema *schema = reader->schema;
    const SchemaSlot *first = schema->slots + schema->first_row[reader->kind], *guess = first;
    const SchemaSlot *end = schema->slots + schema->first_row[reader->kind + 1];
    const Attr *attr = reader->node->attrs, *last = attr ? attr + reader->node->attr_count : attr;
    for (; attr < last; attr++) {
        const SchemaSlot *slot = reader_find_slot(first, end, guess, attr->name);
        if (slot == end || !store_fast(slot, reader->dimensions, &attr->value, record))
            fill_checked(reader, attr, (int)(slot - schema->slots), record);
        guess = slot < end ? slot + 1 : first;
    }
    if (reader->node->child_count > 0 && schema_kinds[reader->kind].children == PLACE_NOTHING)
        report_children(reader);
    if (schema->has_vector_default[reader->kind])
        fill_vector_defaults(reader, record);
}
