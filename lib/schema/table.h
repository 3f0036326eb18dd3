// table.h: the rows of schema_list.h: kinds of nodes, their attributes, the words that those take.
#ifndef PETRI_SCHEMA_TABLE_H
#define PETRI_SCHEMA_TABLE_H

#include "base/str.h"
#include "physics/system.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum NodeKind {
#define NODE(id, text, place, children, help) KIND_##id,
#include "schema/schema_list.h"
    KIND_COUNT // none of these
} NodeKind;

typedef enum AttrName {
    ATTR_NONE,
#define NAME(id, text) ATTR_##id,
#include "schema/schema_list.h"
    ATTR_COUNT
} AttrName;

typedef enum AttrType {
#define TYPE(id, shape, low, high, vital, text) TYPE_##id,
#include "schema/schema_list.h"
    TYPE_COUNT
} AttrType;

// The attributes, one row each. Those of a kind follow each other.
typedef enum AttrRow {
#define ATTR(kind, name, type, field, fallback, unit, help) ROW_##kind##_##name,
#include "schema/schema_list.h"
    ROW_COUNT
} AttrRow;

// Where a node may stand.
typedef enum PlaceKind {
    PLACE_NOTHING,
    PLACE_SCENE, // at the top; does something
    PLACE_PHYSICS,
    PLACE_TOP,      // at the top or where pictures may stand; shows something. From here on: in windows
    PLACE_WINDOW,   // as CHILDREN: pictures and hands
    PLACE_PICTURES, // as CHILDREN: pictures, those of the top included
    PLACE_PICTURE,
    PLACE_INPUT,   // pointer and keys
    PLACE_DRAWING, // sources, too, may stand where one draws
    PLACE_SOURCE,
    PLACE_FILTER, // likewise
    PLACE_EFFECT, // likewise
    PLACE_STOP,
    PLACE_SCENE3D,
} PlaceKind;

// What a value becomes.
typedef enum AttrShape {
    SHAPE_VALUE,   // Value
    SHAPE_NUMBERS, // Value of one number or more
    SHAPE_NUMBER,  // double, moved to the limits of its type
    SHAPE_INTEGER, // double, rounded down
    SHAPE_TIME,    // double; nan is taken
    SHAPE_VECTOR,  // PhysVector of as many elements as the system has dimensions; one number stands for all
    SHAPE_NORMAL,  // likewise, of length 1; NULL if it has no direction
    SHAPE_FINITE,  // double, finite
    SHAPE_PAIR,    // double[2]; one number stands for both
    SHAPE_TRIPLE,  // double[3]; likewise
    SHAPE_QUAD,    // double[4]; likewise
    SHAPE_LIST,    // any doubles, or as many as its limits say
    SHAPE_SEED,    // double: the seed hash of any value, / 2^48
    SHAPE_POINTS,  // an even number of doubles
    SHAPE_COLOR,   // double[4]
    SHAPE_FLAG,    // bool
    SHAPE_TEXT,    // const char *
    SHAPE_WEIGHT,  // double; a number or a word
    SHAPE_WORD,    // int
    SHAPE_OTHER,
} AttrShape;

// The meanings of words.
enum { JOIN_MITER, JOIN_ROUND, JOIN_BEVEL };
enum { CAP_BUTT, CAP_ROUND, CAP_SQUARE };
enum { FILL_WINDING, FILL_EVEN_ODD, FILL_INVERSE_WINDING, FILL_INVERSE_EVEN_ODD };
enum { SLANT_UPRIGHT, SLANT_OBLIQUE, SLANT_ITALIC };
enum { TONEMAP_NONE, TONEMAP_REINHARD, TONEMAP_ACES, TONEMAP_AGX, TONEMAP_AGX_PUNCHY };
enum { FADE_LINEAR, FADE_QUAD, FADE_CUBIC };
enum { FLIP_NOT, FLIP_HORIZONTAL, FLIP_VERTICAL, FLIP_BOTH };
enum { TURBULENCE_FRACTAL, TURBULENCE_FOLDED, TURBULENCE_IMPROVED };
enum { NOISE_PLANE, NOISE_CYLINDER, NOISE_SPHERE };
// How pictures combine, in linear light. UNKNOWN: another word was given.
enum { MIX_OVER, MIX_DEST_OVER, MIX_LIGHTEN, MIX_DARKEN, MIX_ADD, MIX_DIFFERENCE, MIX_MULTIPLY, MIX_UNKNOWN };
enum { FACE_BACK, FACE_FRONT };
enum { MIX3D_OVER, MIX3D_SOURCE, MIX3D_DEST, MIX3D_DEST_OVER, MIX3D_ADD, MIX3D_SUBTRACT, MIX3D_LIGHTEN, MIX3D_DARKEN };
enum { FOV_HORIZONTAL, FOV_VERTICAL, FOV_DIAGONAL, FOV_WIDE, FOV_NARROW };
enum { UV_STANDARD, UV_REPEAT };
enum { REMAP_NONE, REMAP_SPHERE, REMAP_PLANE, REMAP_BOOK };
typedef enum CompositeMode {
#define COMPOSITE(id, operator, text) COMPOSITE_##id,
#include "schema/composite_list.h"
    COMPOSITE_COUNT
} CompositeMode;

enum {
    WORD_COUNT = COMPOSITE_COUNT
#define WORD(type, text, value) +1
#include "schema/word_list.h"
};

typedef struct KindRow {
    const char *name;
    const char *help;
    PlaceKind place;
    PlaceKind children;
} KindRow;

typedef struct TypeRow {
    AttrShape shape;
    bool required; // a drawing node is left out if these are no finite numbers within limits
    double low;
    double high;
    const char *text;
} TypeRow;

typedef struct AttrDefault {
    double value;
    const char *text; // in words; "" for none
    bool inherited;   // `value` is where inheritance begins
    const char *string;
} AttrDefault;

enum { FIELD_NOWHERE = UINT16_MAX };

typedef struct SchemaRow {
    uint8_t kind;   // NodeKind
    uint8_t type;   // AttrType
    uint16_t name;  // AttrName
    uint16_t alias; // AttrName of the attribute that this one is another name of
    uint16_t field; // offset in the record of its kind, or FIELD_NOWHERE
    AttrDefault default_value;
    const char *unit; // "" for none, or where the help tells
    const char *help; // "" where the name says all
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

// The row of an attribute; NULL if the kind has none of this name.
const SchemaRow *schema_row(NodeKind kind, AttrName name);
// The force that a kind stands for; PHYS_FORCE_KINDS: none.
PhysForceKind schema_force(NodeKind kind);
// Of a force, in lines; "" of other nodes.
const char *schema_formula(NodeKind kind);
// The kind that stands for a force.
NodeKind schema_kind_of_force(PhysForceKind force);
// May a node of this kind stand where these may?
bool schema_can_contain(NodeKind kind, PlaceKind children);
// Is it one of the nodes that Flitter shows and petri does not?
bool schema_is_unsupported(Str name);

#endif
