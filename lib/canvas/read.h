// read.h: from a window's nodes to a drawing.
#ifndef PETRI_CANVAS_READ_H
#define PETRI_CANVAS_READ_H

#include "base/diag.h"
#include "canvas/drawing.h"
#include "value/node.h"

typedef struct CanvasHost {
    void *host;
    // What is wrong with which node; `key` tells apart what may be wrong with one kind of node, while the text may go
    // on to tell what was found and change from frame to frame.
    void (*report)(void *host, DiagLevel level, const char *code, const Origin *origin, Str node, Str key, Str text);
} CanvasHost;

// The words that attributes take, one entry each.
enum {
    WORD_COUNT = 0
#define WORD(type, text, value) +1
#include "canvas/word_list.h"
};

// The list of nodes with its names interned in a session's symbol table.
typedef struct CanvasSchema {
    SymbolTable *symbols;
    CanvasHost host;
    const Symbol *kinds[DRAW_KIND_COUNT];
    const Symbol *names[DRAW_NAME_COUNT];
    double words[WORD_COUNT];           // their values as symbols
    int first_row[DRAW_KIND_COUNT + 1]; // of the list of attributes, by kind
    bool lint;                          // report what is hardly meant, too
} CanvasSchema;

void canvas_schema_init(CanvasSchema *schema, SymbolTable *symbols, CanvasHost host);
// DRAW_KIND_COUNT if nothing is drawn for such nodes.
DrawKind canvas_kind(const CanvasSchema *schema, const Node *node);

// Copies a `!window` or `!offscreen` into the arena. What is unknown, misplaced or malformed is reported and left out.
const DrawNode *canvas_read(const CanvasSchema *schema, Arena *arena, const Node *window);

// The list, for help: a kind, or an attribute of one, by number; false beyond the last.
typedef struct CanvasHelp {
    const char *name;
    const char *type; // of an attribute
    const char *fallback;
    const char *help;
} CanvasHelp;
bool canvas_help_kind(size_t kind, CanvasHelp *help);
bool canvas_help_attribute(size_t kind, size_t attribute, CanvasHelp *help);

#endif
