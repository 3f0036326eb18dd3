// drawing_reader.c: reads attributes of drawing nodes into lists; see reader.h.
//
// Numbers in a list are finite, within the limits of their type and not symbols. An attribute with another value is
// reported and left out, so that the default applies.
#include "schema/reader_internal.h"
#include "value/value_hash.h"

#include <math.h>
#include <string.h>

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
static bool read_drawing_word(const Reader *reader, Value v, AttrType type, int *word) {
    bool text = v.len == 1 && v.kind == VALUE_MIXED && v.as.items[0].type == ITEM_STRING;
    if (!text && !value_is_number(v))
        return false;
    for (int i = 0; i < WORD_COUNT; i++)
        if (schema_words[i].type == type && (text ? str_equal(schema_words[i].text, v.as.items[0].as.string->text)
                                                  : reader->schema->words[i] == v.as.number)) {
            *word = schema_words[i].value;
            return true;
        }
    return false;
}

static bool read_function(const Reader *reader, Value v, const SchemaRow *row, AttrValue *attr) {
    if (v.len != 1 || v.kind != VALUE_MIXED || v.as.items[0].type != ITEM_FUNCTION)
        return false;
    const Symbol *name = reader->schema->slots[row - schema_rows].name;
    attr->as.function = arena_alloc(reader->arena, sizeof *attr->as.function);
    *attr->as.function =
        (FunctionSamples){.function = v.as.items[0].as.function, .origin = node_origin(reader->node, name)};
    return true;
}

static bool read_weight(const Reader *reader, Value v, const SchemaRow *row, AttrValue *attr) {
    int weight = 0;
    if (!read_drawing_word(reader, v, row->type, &weight))
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
        reader_report_lint(reader, "colour-range", row, v,
                           " is brighter than white (1;1;1); if components go up to 255, divide them: (r;g;b)/255");
}

// Reads the value v of an attribute of a drawing node into `attr`. Returns false if the value is malformed.
static bool read_drawing_attr(const Reader *reader, const SchemaRow *row, Value v, AttrValue *attr) {
    const TypeRow *type = &schema_types[row->type];
    switch (type->shape) {
    case SHAPE_FINITE:
    case SHAPE_PAIR:
    case SHAPE_TRIPLE:
    case SHAPE_QUAD:
        return read_finite_numbers(v, type, 1 + type->shape - SHAPE_FINITE, attr);
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
        return read_drawing_word(reader, v, row->type, &attr->as.word);
    case SHAPE_FUNCTION:
        return read_function(reader, v, row, attr);
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

// Returns true if the node runs a shader program that the script writes.
static bool has_program(const Reader *reader) {
    static const AttrName names[] = {ATTR_VERTEX, ATTR_FRAGMENT};
    for (int i = 0; i < 2; i++) {
        const SchemaRow *row = schema_row(reader->kind, names[i]);
        if (row && node_get(reader->node, reader->schema->slots[row - schema_rows].name).len > 0)
            return true;
    }
    return false;
}

// Reads the id of a picture, for a texture uniform of a group's program.
static bool read_id(const Reader *reader, Value v, AttrValue *attr) {
    const SymbolTable *symbols = reader->schema->symbols;
    bool named = v.kind == VALUE_MIXED || (value_is_number(v) && symbol_of_number(symbols, v.as.number));
    if ((reader->kind != KIND_CANVAS3D && reader->kind != KIND_GROUP3D) || !named)
        return false;
    attr->as.text = str_from(str_to_c(reader->arena, value_text(reader->arena, symbols, v)));
    attr->count = 0;
    return true;
}

bool reader_list(const Reader *reader, AttrValue *attrs, uint32_t *count) {
    const Node *node = reader->node;
    const SchemaSlot *slots = reader->schema->slots;
    const SchemaSlot *first = slots + reader->schema->first_row[reader->kind], *guess = first;
    const SchemaSlot *end = slots + reader->schema->first_row[reader->kind + 1];
    bool good = true;
    for (uint32_t i = 0; i < node->attr_count; i++) {
        const Value v = node->attrs[i].value;
        const SchemaSlot *slot = reader_find_slot(first, end, guess, node->attrs[i].name);
        guess = slot < end ? slot + 1 : first;
        AttrValue *attr = &attrs[*count];
        if (slot == end) {
            *attr = (AttrValue){.name = ATTR_NONE};
            if (reader->kind != KIND_SHADER && !has_program(reader))
                reader_report_unknown(reader, node->attrs[i].name);
            else if (read_id(reader, v, attr) || read_numbers(reader, v, false, attr)) {
                // Programs can have uniforms of any name.
                attr->custom_name = str_to_c(reader->arena, node->attrs[i].name->name);
                ++*count;
            }
            continue;
        }
        const SchemaRow *found = &schema_rows[slot - slots];
        *attr = (AttrValue){.name = found->alias ? found->alias : found->name, .row = (uint16_t)(slot - slots)};
        if (!read_drawing_attr(reader, found, v, attr)) {
            reader_report_shape(reader, found, v);
            good &= !schema_types[found->type].required || !has_shape(found, v);
            if (found->type == TYPE_MIX) { // a node with an unknown mode is not drawn
                attr->as.word = MIX_UNKNOWN;
                ++*count;
            }
        } else {
            ++*count;
            // Without an effect in Flitter either, if the flag has its default value.
            if (schema_types[found->type].shape != SHAPE_FLAG || attr->as.flag != (found->default_value.value != 0))
                reader_report_ignored(reader, found);
        }
    }
    return good;
}
