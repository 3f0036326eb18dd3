// reader.h: reads the attributes of nodes as schema_list.h describes them, and reports each mistake once (spec
// physics.md 1).
//
// Attributes of systems, counters and input nodes are read into the record of the node's kind (records.h). Attributes
// of drawing nodes are read into a list, in the order in which they were written.
#pragma once

#include "base/diag.h"
#include "base/file_access.h"
#include "base/private_api.h"
#include "schema/records.h"
#include "schema/table.h"
#include "value/node.h"

typedef struct SchemaSink {
    void *user_data;
    // Reports a mistake in a node. Messages with the same node, code and key are reported only once, even if
    // `text` differs. So `text` can contain values that change from frame to frame.
    void (*report)(void *sink, DiagLevel level, const char *code, const Origin *origin, Str node, Str key, Str text);
} SchemaSink;

// What the fast path of reader_fill needs to know about a row of schema_rows.
typedef struct SchemaSlot {
    const Symbol *name;
    double low;  // minimum of a number
    double high; // maximum of a number
    uint16_t field;
    uint8_t plain; // AttrShape of the values; SHAPE_OTHER: an alias or a row without a field, not for the fast path
} SchemaSlot;

// The rows of table.h, with their names interned in the symbol table of a session.
typedef struct Schema {
    SymbolTable *symbols;
    SchemaSink sink;
    uint64_t report_count; // number of mistakes reported so far
    // Node that was read or updated last. When a limit is exceeded, the report gives its position. NULL: none.
    const Node *current_node;
    const FileAccess *file_access; // access to the files that nodes name; NULL: unrestricted
    bool lint;                     // true: also report values that are unlikely to be intended
    const Symbol *kinds[KIND_COUNT];
    SchemaSlot slots[ROW_COUNT];
    double words[WORD_COUNT];           // for each word: the number that represents it as a symbol
    uint16_t first_row[KIND_COUNT + 1]; // by kind: number of its first row in schema_rows
    int first_in_window;                // this kind and all later ones can be in windows
    uint8_t by_name[512]; // hash table by node name: 1 + first kind in windows that has this name; 0: empty slot
    uint8_t next_of_name[KIND_COUNT];    // by kind: 1 + next kind in windows that has the same name; 0: none
    bool has_vector_default[KIND_COUNT]; // by kind: true if a vector attribute has a default that is not 0
} Schema;

void schema_init(Schema *schema, SymbolTable *symbols, SchemaSink sink);
// Returns the kind of a node that can be inside `!physics` or, outside windows, at the top level. Returns KIND_COUNT
// for other nodes.
static inline NodeKind schema_kind(const Schema *schema, const Node *node) {
    for (int kind = 0; kind < schema->first_in_window; kind++)
        if (schema->kinds[kind] == node->kind)
            return (NodeKind)kind;
    return KIND_COUNT;
}
// Returns the first kind in windows with the node's name. Returns KIND_COUNT if there is none.
NodeKind schema_window_kind(const Schema *schema, const Node *node) PRIVATE_API(schema_window_kind);
// Returns the kind of a node whose parent accepts `children`. Returns KIND_COUNT if the parent does not accept the
// node.
NodeKind schema_kind_in(const Schema *schema, const Node *node, PlaceKind children) PRIVATE_API(schema_kind_in);

// The node being read, with its context.
typedef struct Reader {
    Schema *schema;
    Arena *arena; // memory for strings and vectors that are read
    const Node *node;
    NodeKind kind;
    uint32_t dimensions; // number of elements of a vector attribute
} Reader;

// Reports the warning "!kind id=…: text", once for each code and key.
void reader_report(const Reader *reader, const char *code, const char *key, Str text);
// Like reader_report, but an error if scripts are checked (Schema.lint).
void reader_report_error(const Reader *reader, const char *code, Str text);
// Like reader_report, but about an attribute, whose name is the key.
void reader_report_attr(const Reader *reader, const char *code, AttrName name, Str text);
// Like reader_report, but at a given origin.
void reader_report_at(const Reader *reader, const char *code, Origin place, Str key, Str text);
// Adds "; did you mean …?" if a kind that is accepted at `place` has a name similar to `kind`. PLACE_TOP also accepts
// every kind that can be in a window. `before` and `after` enclose the suggested name.
void schema_add_nearest_kind(Text *out, Str kind, PlaceKind place, const char *before, const char *after);

// Reports a child that the node does not accept.
void reader_report_child(const Reader *reader, const Node *child);
// Adds "; it belongs in '!canvas'" or another place where a kind with this name is accepted. Adds nothing if there is
// no such kind.
void schema_add_home(Text *out, Str kind);

// Returns true if the kind of the node has all its attributes. Otherwise a missing attribute may be misspelled, which
// is reported when the node is read.
bool reader_knows_attrs(const Reader *reader);

// Reports the unknown attributes and the unknown or misplaced nodes inside a system that is not read otherwise.
void reader_report_inside(const Reader *reader);

// Reports a vector attribute that has an infinite number or NaN in frame `frame`; `effect` says what happens instead.
// Returns false, and reports nothing, if all of its numbers are finite or if the node does not have the attribute.
bool reader_report_not_finite(const Reader *reader, AttrName name, PhysVector vector, int64_t frame,
                              const char *effect);

// Stores the defaults of a kind in its record. Vectors become NULL.
void schema_defaults(NodeKind kind, void *record);
// Reads the attributes into a record that contains the defaults. Unknown or malformed attributes are reported and keep
// the default. Vectors are borrowed from the node or allocated from the reader's arena.
void reader_fill(const Reader *reader, void *record);

// A function that is an attribute, and its results. Functions exist only as long as the frame, so lib/picture calls the
// function before the drawing leaves the session's thread.
typedef struct FunctionSamples {
    const Function *function; // valid as long as the frame
    Origin origin;            // of the attribute
    const double *values;     // results of the function; NULL: it was not called, or it failed
    uint64_t hash;            // hash of the results
    bool reported;            // true if a wrong result was reported
} FunctionSamples;

// An attribute of a drawing node.
typedef struct AttrValue {
    uint16_t name;  // AttrName
    uint16_t row;   // index in schema_rows
    uint32_t count; // number of elements that the script gives
    // For ATTR_NONE: name of a custom uniform of a shader. Its values are in `list`; if `count` is 0, `text` is an id.
    const char *custom_name;
    union {
        double numbers[4]; // points, sizes, weights, other shapes of up to four numbers; colours always have four
        const double *list;
        Str text; // NUL-terminated; schema_store stores only its address
        int word;
        bool flag;
        FunctionSamples *function;
    } as;
} AttrValue;

// Appends the node's attributes to `attrs`, which has space for all of them, and adds their number to *count. Returns
// false if a required attribute has numbers that are not finite or outside the limits.
bool reader_list(const Reader *reader, AttrValue *attrs, uint32_t *count);
// Stores an attribute in the record of its kind. Does nothing if its row names no field.
void schema_store(const AttrValue *attr, void *record);
