// attrs.h: typed reading of node attributes, with one warning for each that has the wrong form (spec physics.md 1).
#ifndef PETRI_SCENE_ATTRS_H
#define PETRI_SCENE_ATTRS_H

#include "base/diag.h"
#include "value/node.h"

typedef enum SceneKind {
#define KIND(id, text) KIND_##id,
#include "scene/schema_list.h"
    KIND_COUNT_OF
} SceneKind;

// One row of the schema: an attribute of one kind of node.
typedef enum AttrRow {
#define ATTR(kind, id, text, fallback) ROW_##kind##_##id,
#include "scene/schema_list.h"
    ROW_COUNT
} AttrRow;

typedef struct SceneHost {
    void *host;
    // What is wrong with which node; `key` tells apart what may be wrong with one node, while the text may go on to
    // tell what was found and change from frame to frame.
    void (*report)(void *host, DiagLevel level, const char *code, const Origin *origin, Str node, Str key, Str text);
} SceneHost;

// The schema with its names interned in a session's symbol table.
typedef struct Schema {
    SymbolTable *symbols;
    SceneHost host;
    const Symbol *kinds[KIND_COUNT_OF];
    const Symbol *attrs[ROW_COUNT];
    int first_row[KIND_COUNT_OF]; // the rows of a kind follow each other
    int row_count[KIND_COUNT_OF];
    bool lint; // report what is hardly meant, too
} Schema;

void schema_init(Schema *schema, SymbolTable *symbols, SceneHost host);
// For help: names, types, defaults and meanings as words. False beyond the last attribute.
typedef struct SchemaHelp {
    const char *name;
    const char *type;
    const char *fallback;
    const char *help;
} SchemaHelp;
const char *schema_kind_name(SceneKind kind);
const char *schema_kind_help(SceneKind kind);
bool schema_attribute_help(SceneKind kind, size_t attribute, SchemaHelp *help);
// KIND_COUNT_OF if the schema does not know the node.
SceneKind schema_kind(const Schema *schema, const Node *node);

// What is being read, for messages.
typedef struct Reader {
    const Schema *schema;
    Arena *arena; // texts and vectors
    const Node *node;
    uint32_t dimensions; // n of vectors
} Reader;

// Reports "!kind id=…: text", a warning, once for each code and key.
void reader_report(const Reader *reader, const char *code, const char *key, Str text);
// The same about one of its attributes, which is the key.
void reader_report_attr(const Reader *reader, const char *code, const Symbol *attr, Str text);
// Reports numbers below 0 where they count as 0, if the schema lints.
void reader_lint(const Reader *reader, SceneKind kind);
// Reports attributes that the node's kind does not have.
void reader_check_names(const Reader *reader, SceneKind kind);

Value attr_value(const Reader *reader, AttrRow row);
// One number; the schema's default if absent, of another shape or nan (the latter two reported).
double attr_float(const Reader *reader, AttrRow row);
// The same with another default.
double attr_float_or(const Reader *reader, AttrRow row, double fallback);
// As attr_float, but a nan is returned as it is.
double attr_time(const Reader *reader, AttrRow row, double fallback);
// n numbers, or one that is repeated; NULL (all zero) if absent or malformed (reported).
const double *attr_vector(const Reader *reader, AttrRow row);
// The first well-formed of several attributes, by precedence; false if none is given.
bool attr_first(const Reader *reader, const AttrRow *rows, uint32_t count, double *x);

#endif
