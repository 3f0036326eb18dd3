// reader.h: reads nodes by the rows of schema_list.h, with one warning for each thing that is wrong (spec physics.md
// 1).
//
// The attributes of what drives something go into the record of the node's kind (records.h), those of what is drawn
// into a list, in the order in which they were written.
#ifndef PETRI_SCHEMA_READER_H
#define PETRI_SCHEMA_READER_H

#include "base/diag.h"
#include "base/file_access.h"
#include "schema/records.h"
#include "schema/table.h"
#include "value/node.h"

typedef struct SchemaSink {
    void *user_data;
    // What is wrong with which node; `key` tells apart what may be wrong with one node, while the text may go on to
    // tell what was found and change from frame to frame.
    void (*report)(void *sink, DiagLevel level, const char *code, const Origin *origin, Str node, Str key, Str text);
} SchemaSink;

// What the reader looks at first of a row.
typedef struct SchemaSlot {
    const Symbol *name;
    double low; // limits of a number
    double high;
    uint16_t field;
    uint8_t plain; // AttrShape, if values of this shape are simply stored
} SchemaSlot;

// The table with its names interned in a session's symbol table.
typedef struct Schema {
    SymbolTable *symbols;
    SchemaSink sink;
    uint64_t report_count; // given so far
    const Node
        *current_node; // that was begun to be read or updated last, to tell where a limit was reached; NULL: none
    const FileAccess *file_access; // of the files that nodes name; NULL: all may be used
    bool lint;                     // report what is hardly meant, too
    const Symbol *kinds[KIND_COUNT];
    SchemaSlot slots[ROW_COUNT];
    double words[WORD_COUNT];            // their values as symbols
    uint16_t first_row[KIND_COUNT + 1];  // by kind
    int first_in_window;                 // of the kinds
    uint8_t by_name[512];                // the first kind in windows of a name, + 1: a hash table, mostly empty
    uint8_t next_of_name[KIND_COUNT];    // the next one of the same name, + 1
    bool has_vector_default[KIND_COUNT]; // some vector of the kind has a default that is not 0
} Schema;

void schema_init(Schema *schema, SymbolTable *symbols, SchemaSink sink);
// KIND_COUNT if these nodes do nothing inside of `!physics` and at the top, or in a window.
static inline NodeKind schema_kind(const Schema *schema, const Node *node) {
    for (int kind = 0; kind < schema->first_in_window; kind++)
        if (schema->kinds[kind] == node->kind)
            return (NodeKind)kind;
    return KIND_COUNT;
}
NodeKind schema_window_kind(const Schema *schema, const Node *node);
// The kind of a node where `children` may stand; KIND_COUNT if this one may not.
NodeKind schema_kind_in(const Schema *schema, const Node *node, PlaceKind children);

// What is being read.
typedef struct Reader {
    Schema *schema;
    Arena *arena; // texts and vectors
    const Node *node;
    NodeKind kind;
    uint32_t dimensions; // n of vectors
} Reader;

// Reports "!kind id=…: text", a warning, once for each code and key.
void reader_report(const Reader *reader, const char *code, const char *key, Str text);
// The same about one of the attributes of its kind, which is the key.
void reader_report_attr(const Reader *reader, const char *code, AttrName name, Str text);
// The same of what stands at a place.
void reader_report_at(const Reader *reader, const char *code, Origin place, Str key, Str text);
// Adds ", did you mean …?" if one of the kinds that may stand at such a place, or in any place of drawings for
// PLACE_TOP, is spelled nearly like this one.
void schema_add_nearest_kind(Text *out, Str kind, PlaceKind place, const char *before, const char *after);

// Fills in the defaults of the fields that the rows of a kind name; vectors are NULL.
void schema_defaults(NodeKind kind, void *record);
// Reads the attributes into a record that holds the defaults. What is unknown or malformed is reported and leaves the
// default. Vectors are borrowed from the node or in the reader's arena.
void reader_fill(const Reader *reader, void *record);

// An attribute that was read.
typedef struct AttrValue {
    uint16_t name;           // AttrName
    uint16_t row;            // of its kind
    uint32_t count;          // of numbers
    const char *custom_name; // the name of an ATTR_NONE: what a program may ask for, in `list`
    union AttrData {
        double numbers[4]; // of points, sizes, colours (always four), a weight, up to four amounts
        const double *list;
        Str text; // NUL-terminated
        int word;
        bool flag;
    } as;
} AttrValue;

// Reads the attributes into an array that has room for all. False if one is malformed that is vital.
bool reader_list(const Reader *reader, AttrValue *attrs, uint32_t *count);
// Puts one into the record of its kind, if its row names a field there.
void schema_store(const AttrValue *attr, void *record);

#endif
