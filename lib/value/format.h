// format.h: values and trees as text (spec language.md L18, cli.md 3.1 and 3.2).
#ifndef PETRI_VALUE_FORMAT_H
#define PETRI_VALUE_FORMAT_H

#include "value/node.h"

// The printed form (L18.1); reads back as the same value for numbers, symbols and strings. All of these
// charge their text's arena for work.
void format_value(Text *out, const SymbolTable *symbols, Value v);
// The same as a text of its own, followed by a NUL byte.
Str format_text(Arena *arena, const SymbolTable *symbols, Value v);
// The text of debug() (L18.3).
void format_debug(Text *out, const SymbolTable *symbols, Value v);
// Takes what the text has, after a line of a tree, and may empty it; false ends the tree there.
typedef bool FormatLine(void *user_data, Text *out);
// One line per node (L18.2), starting at `depth` levels of four spaces. A shared node is printed wherever it is, so the
// text may be far longer than there is memory for: `line` (or NULL) passes it on. False if that has ended it.
bool format_tree(Text *out, const SymbolTable *symbols, const Node *node, int depth, FormatLine *line, void *user_data);
// Canonical order of state keys (L18.4): element by element symbols, numbers, strings; a prefix comes first.
int format_key_compare(const SymbolTable *symbols, Value a, Value b);

#endif
