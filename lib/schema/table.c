// table.c: see table.h.
//
// Each table is made from the same rows of schema_list.h by other macros, so that a fact is written once. All tables
// therefore have the order of the rows.
#include "schema/table.h"

#include "maths/random.h"
#include "schema/records.h"

#include <math.h>

const KindRow schema_kinds[KIND_COUNT] = {
#define NODE(id, text, place, children, help) {text, PLACE_##place, PLACE_##children},
#include "schema/schema_list.h"
};

const char *const schema_names[ATTR_COUNT] = {
    "",
#define NAME(id, text) text,
#include "schema/attr_names.h"
#undef NAME
};

const TypeRow schema_types[TYPE_COUNT] = {
#define TYPE(id, shape, low, high, required, text) {SHAPE_##shape, required, low, high, text},
#include "schema/schema_list.h"
};

#define TO_SYSTEM(field) offsetof(SystemAttrs, field)
#define TO_BODY(field) offsetof(BodyAttrs, field)
#define TO_FORCE(field) offsetof(ForceAttrs, field)
#define TO_COUNTER(field) offsetof(CounterAttrs, field)
#define TO_INPUT(field) offsetof(InputAttrs, field)
#define TO_GRAPHICS(field) offsetof(GraphicsState, field)
#define TO_GRAPHICS3D(field) offsetof(GraphicsState3D, field)
#define NOWHERE FIELD_NOWHERE
#define IS(x)                                                                                                          \
    { x, false, NULL }
#define DESCRIBED(x, text)                                                                                             \
    { x, false, NULL }
#define INHERITED(x, text)                                                                                             \
    { x, true, NULL }
#define INHERITED_TEXT(text)                                                                                           \
    { 0, true, text }
#define NONE                                                                                                           \
    { NAN, false, NULL }

const SchemaRow schema_rows[ROW_COUNT] = {
#define ATTR(kind, name, type, field, default_value, unit, help)                                                       \
    {KIND_##kind, TYPE_##type, ATTR_##name, ATTR_NONE, field, default_value},
#define ALIAS(kind, name, of, of_text, type, field, unit)                                                              \
    {KIND_##kind, TYPE_##type, ATTR_##name, ATTR_##of, field, NONE},
#include "schema/schema_list.h"
};

const WordRow schema_words[WORD_COUNT] = {
#define WORD(type, text, value) {TYPE_##type, value, {text, sizeof text - 1}},
#include "schema/word_list.h"
#define COMPOSITE(id, operator, mode, text) {TYPE_COMPOSITE, COMPOSITE_##id, {text, sizeof text - 1}},
#define MIX(id, text, colour, alpha) {TYPE_MIX, MIX_##id, {text, sizeof text - 1}},
#define MIX3D(id, text, equation, source, destination) {TYPE_MIX3D, MIX3D_##id, {text, sizeof text - 1}},
#include "schema/composite_list.h"
};

bool schema_find_word(AttrType type, Str word, int *value) {
    for (int i = 0; i < WORD_COUNT; i++)
        if (schema_words[i].type == type && str_equal(schema_words[i].text, word)) {
            *value = schema_words[i].value;
            return true;
        }
    return false;
}

const char *schema_word(AttrType type, int value) {
    for (int i = 0; i < WORD_COUNT; i++)
        if (schema_words[i].type == type && schema_words[i].value == value)
            return schema_words[i].text.bytes;
    return "";
}

const SchemaRow *schema_row(NodeKind kind, AttrName name) {
    static const uint16_t numbers[KIND_COUNT][ATTR_COUNT] = {
#define ATTR(kind, name, type, field, default_value, unit, help) [KIND_##kind][ATTR_##name] = ROW_##kind##_##name + 1,
#include "schema/schema_list.h"
    };
    return numbers[kind][name] ? &schema_rows[numbers[kind][name] - 1] : NULL;
}

bool schema_can_contain(NodeKind kind, PlaceKind children) {
    PlaceKind place = schema_kinds[kind].place;
    switch (children) {
    case PLACE_WINDOW:
        return place == PLACE_INPUT || place == PLACE_PICTURE || place == PLACE_TOP;
    case PLACE_PICTURES:
        return place == PLACE_PICTURE || place == PLACE_TOP;
    case PLACE_DRAWING:
        return place == PLACE_DRAWING || place == PLACE_SOURCE || place == PLACE_FILTER || place == PLACE_EFFECT;
    default:
        return place == children;
    }
}

PhysForceKind schema_force(NodeKind kind) {
    static const uint8_t forces[KIND_COUNT] = {
#define NODE(id, text, place, children, help) [KIND_##id] = PHYS_FORCE_KINDS,
#define FORCE(id, text, help, formula) [KIND_##id] = PHYS_##id,
#include "schema/schema_list.h"
    };
    return kind < KIND_COUNT ? forces[kind] : PHYS_FORCE_KINDS;
}

// Forces whose reach is INVERSE_SQUARE have an attribute `theta`, and other forces have none.
enum {
    THETA_ROWS = 0
#define ATTR(kind, name, type, field, default_value, unit, help) +(ATTR_##name == ATTR_THETA)
#include "schema/schema_list.h"
    ,
#define COUNT_CONTACT(KIND)
#define COUNT_FAR(KIND)
#define COUNT_INVERSE_SQUARE(KIND) +(ROW_##KIND##_THETA >= 0)
#define COUNT(KIND, name, SIGN, SOURCE, REACH) COUNT_##REACH(KIND)
    INVERSE_SQUARE_FORCES = 0 PHYS_FORCES(COUNT, PHYS_NO_ROW, PHYS_NO_ROW, PHYS_NO_ROW)
};
_Static_assert((int)THETA_ROWS == (int)INVERSE_SQUARE_FORCES, "theta works only if the reach is INVERSE_SQUARE");

NodeKind schema_kind_of_force(PhysForceKind force) {
    static const uint8_t kinds[PHYS_FORCE_KINDS] = {
#define KIND_OF(KIND, ...) [PHYS_##KIND] = KIND_##KIND,
        PHYS_FORCES(KIND_OF, KIND_OF, KIND_OF, KIND_OF)
#undef KIND_OF
    };
    return kinds[force];
}

const char *const schema_rejection_codes[NODE_REJECTION_COUNT] = {
    [NODE_MISPLACED] = "misplaced-node",
    [NODE_UNSUPPORTED] = "unsupported-node",
    [NODE_UNKNOWN] = "unknown-node",
};

NodeRejection schema_rejection(Str name) {
    static const char unsupported[] = "controller dmx laser osc video";
    for (int i = 0; i < KIND_COUNT; i++)
        if (str_equal(name, str_from(schema_kinds[i].name)))
            return NODE_MISPLACED;
    return str_word_number(name, unsupported) >= 0 ? NODE_UNSUPPORTED : NODE_UNKNOWN;
}
