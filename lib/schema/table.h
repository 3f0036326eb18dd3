// table.h: the rows of schema_list.h as tables: kinds of nodes, attributes, types and words.
#pragma once

#include "base/str.h"
#include "physics/system.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum NodeKind {
#define NODE(id, text, place, children, help) KIND_##id,
#include "schema/schema_list.h"
    KIND_COUNT // number of kinds; also used for unknown kinds
} NodeKind;

typedef enum AttrName {
    ATTR_NONE,
#define NAME(id, text) ATTR_##id,
#include "schema/attr_names.h"
#undef NAME
    ATTR_COUNT
} AttrName;

typedef enum AttrType {
#define TYPE(id, shape, low, high, required, text) TYPE_##id,
#include "schema/schema_list.h"
    TYPE_COUNT
} AttrType;

// The attributes, one row each. The rows of a kind are contiguous.
typedef enum AttrRow {
#define ATTR(kind, name, type, field, default_value, unit, help) ROW_##kind##_##name,
#include "schema/schema_list.h"
    ROW_COUNT
} AttrRow;

// Where a node is allowed in the tree, and (as CHILDREN in schema_list.h) which nodes are allowed as its children.
typedef enum PlaceKind {
    PLACE_NOTHING,
    PLACE_SCENE, // at the top level: systems and counters
    PLACE_PHYSICS,
    PLACE_TOP,      // at the top level or among pictures; this and all later places are in windows
    PLACE_WINDOW,   // as CHILDREN: pictures and input nodes
    PLACE_PICTURES, // as CHILDREN: pictures, including those of PLACE_TOP
    PLACE_PICTURE,
    PLACE_INPUT,   // pointer and key nodes
    PLACE_DRAWING, // as CHILDREN: drawing nodes, sources, filters and effects
    PLACE_SOURCE,
    PLACE_FILTER,
    PLACE_EFFECT,
    PLACE_STOP,
    PLACE_SCENE3D,
} PlaceKind;

// How the value of an attribute is checked and stored.
typedef enum AttrShape {
    SHAPE_VALUE,    // Value, not restricted
    SHAPE_NUMBERS,  // Value that consists of one or more numbers
    SHAPE_NUMBER,   // double, clamped to the limits of its type
    SHAPE_INTEGER,  // double, rounded down
    SHAPE_TIME,     // double; NaN is allowed
    SHAPE_VECTOR,   // PhysVector with one element per dimension of the system; a single number is repeated
    SHAPE_NORMAL,   // PhysVector of length 1; NULL if its direction is undefined
    SHAPE_FINITE,   // finite double; a value outside the limits of the attribute's type is an error
    SHAPE_PAIR,     // double[2]; a single number is repeated
    SHAPE_TRIPLE,   // double[3]; a single number is repeated
    SHAPE_QUAD,     // double[4]; a single number is repeated
    SHAPE_LIST,     // array of doubles; the limits of the type are the minimum and maximum number of elements
    SHAPE_SEED,     // double: hash of the value (value_exact_hash) as a signed integer, divided by 2^48
    SHAPE_POINTS,   // array of doubles x, y, x, y…; a last x without y is dropped
    SHAPE_COLOR,    // double[4]: red, green, blue, alpha
    SHAPE_FLAG,     // bool
    SHAPE_TEXT,     // const char *
    SHAPE_WEIGHT,   // double; scripts give a number or a word
    SHAPE_WORD,     // int: WordRow.value of a word
    SHAPE_FUNCTION, // FunctionSamples * (reader.h)
    SHAPE_OTHER,    // no attribute has this shape; see SchemaSlot
} AttrShape;

// Values of the words in word_list.h.
enum { JOIN_MITER, JOIN_ROUND, JOIN_BEVEL };
enum { CAP_BUTT, CAP_ROUND, CAP_SQUARE };
enum { FILL_WINDING, FILL_EVEN_ODD, FILL_INVERSE_WINDING, FILL_INVERSE_EVEN_ODD };
enum { SLANT_UPRIGHT, SLANT_OBLIQUE, SLANT_ITALIC };
enum { TONEMAP_NONE, TONEMAP_REINHARD, TONEMAP_ACES, TONEMAP_AGX, TONEMAP_AGX_PUNCHY };
enum { FADE_LINEAR, FADE_QUAD, FADE_CUBIC };
enum { FLIP_NOT, FLIP_HORIZONTAL, FLIP_VERTICAL, FLIP_BOTH };
enum { TURBULENCE_FRACTAL, TURBULENCE_FOLDED, TURBULENCE_IMPROVED };
enum { NOISE_PLANE, NOISE_CYLINDER, NOISE_SPHERE };
enum {
#define MIX(id, text, colour, alpha) MIX_##id,
#include "schema/composite_list.h"
    MIX_UNKNOWN // the script gives an unknown word
};
enum { FACE_BACK, FACE_FRONT };
enum {
#define MIX3D(id, text, equation, source, destination) MIX3D_##id,
#include "schema/composite_list.h"
    MIX3D_COUNT
};
enum { FOV_HORIZONTAL, FOV_VERTICAL, FOV_DIAGONAL, FOV_WIDE, FOV_NARROW };
enum { UV_STANDARD, UV_REPEAT };
enum { REMAP_NONE, REMAP_SPHERE, REMAP_PLANE, REMAP_BOOK };
typedef enum CompositeMode {
#define COMPOSITE(id, operator, mode, text) COMPOSITE_##id,
#include "schema/composite_list.h"
    COMPOSITE_COUNT
} CompositeMode;

enum {
    WORD_COUNT = COMPOSITE_COUNT + MIX_UNKNOWN + MIX3D_COUNT
#define WORD(type, text, value) +1
#include "schema/word_list.h"
};

typedef struct KindRow {
    const char *name;
    PlaceKind place;
    PlaceKind children;
} KindRow;

typedef struct TypeRow {
    AttrShape shape;
    bool required; // a drawing node is omitted if this attribute has numbers that are not finite or outside the limits
    double low;
    double high;
    const char *text;
} TypeRow;

typedef struct AttrDefault {
    double value;
    bool inherited;     // true: the default is the value of the enclosing node; `value` applies if no such node sets it
    const char *string; // default of a text attribute; NULL: ""
} AttrDefault;

enum { FIELD_NOWHERE = UINT16_MAX };

typedef struct SchemaRow {
    uint8_t kind;   // NodeKind
    uint8_t type;   // AttrType
    uint16_t name;  // AttrName
    uint16_t alias; // AttrName of the attribute that this row is an alias for; ATTR_NONE: not an alias
    uint16_t field; // offset of the field in the record of its kind, or FIELD_NOWHERE
    AttrDefault default_value;
} SchemaRow;

typedef struct WordRow {
    AttrType type;
    int value;
    Str text;
} WordRow;

extern const KindRow schema_kinds[KIND_COUNT];
extern const char *const schema_names[ATTR_COUNT];
extern const TypeRow schema_types[TYPE_COUNT];
extern const SchemaRow schema_rows[ROW_COUNT];
extern const WordRow schema_words[WORD_COUNT];

// Returns the preferred word with a value, or "" if there is none.
const char *schema_word(AttrType type, int value);
// Stores the value of a word in *value. Returns false if the type does not have this word.
bool schema_find_word(AttrType type, Str word, int *value);
// Returns the row of an attribute, or NULL if the kind has no such attribute.
const SchemaRow *schema_row(NodeKind kind, AttrName name);
// Returns the force that nodes of a kind describe, or PHYS_FORCE_KINDS if the kind is not a force.
PhysForceKind schema_force(NodeKind kind);
// Returns the kind of the nodes that describe a force.
NodeKind schema_kind_of_force(PhysForceKind force);
// Returns true if a node of this kind is allowed as a child of a node that accepts `children`.
bool schema_can_contain(NodeKind kind, PlaceKind children);
// Why a node is ignored.
typedef enum NodeRejection {
    NODE_MISPLACED,   // its kind is accepted elsewhere
    NODE_UNSUPPORTED, // Flitter has the kind, but petri does not
    NODE_UNKNOWN,
    NODE_REJECTION_COUNT
} NodeRejection;
// Returns why a node with this name is ignored at a place that does not accept it.
NodeRejection schema_rejection(Str name);
// Code of the diagnostic for each rejection.
extern const char *const schema_rejection_codes[NODE_REJECTION_COUNT];
