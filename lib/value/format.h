// format.h: conversion of values and trees to text (spec language.md L18, cli.md 3.1 and 3.2).
#pragma once

#include "value/node.h"

// All functions charge their work to the arena of the text.
//
// Appends the printed form of a value (L18.1). Parsing the text of numbers, symbols and strings gives the same value.
void format_value(Text *out, const SymbolTable *symbols, Value v);
// Returns the printed form as a new NUL-terminated string.
Str format_text(Arena *arena, const SymbolTable *symbols, Value v);
// Appends the text that debug() prints (L18.3).
void format_debug(Text *out, const SymbolTable *symbols, Value v);
// A callback that format_tree calls after each line. It may output the text in `out` and then clear it. Returns false
// to stop the printing.
typedef bool FormatLine(void *user_data, Text *out);
// Appends one line per node (L18.2), indented by `depth` levels of four spaces. A shared node is printed each time it
// occurs, so the text can be too large for memory. `line`, if not NULL, is called after each line. Returns false if
// `line` stopped the printing.
bool format_tree(Text *out, const SymbolTable *symbols, const Node *node, int depth, FormatLine *line, void *user_data);
// Compares state keys in canonical order (L18.4), element by element. Symbols sort before numbers, and numbers before
// strings. A prefix sorts before the longer key. If `symbols` is NULL, symbols sort like other numbers.
int format_key_compare(const SymbolTable *symbols, Value a, Value b);
