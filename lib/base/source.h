// source.h: a named text with a table of its line starts.
//
// Tokens and nodes carry byte offsets only; a position is resolved to line and column when somebody reads it.
#ifndef PETRI_BASE_SOURCE_H
#define PETRI_BASE_SOURCE_H

#include "base/str.h"

typedef struct Source {
    Str name;                    // how to call it in messages: the path as the user gave it
    Str path;                    // what identifies it: the absolute path, or the name of a text that is no file
    Str directory;               // what relative file names in it are resolved against; "" is the working directory
    Str text;                    // LF line ends, the last line ended; followed by one NUL byte
    const uint32_t *line_starts; // offsets, ascending
    uint32_t line_count;
} Source;

// A half-open range of byte offsets.
typedef struct Span {
    uint32_t start;
    uint32_t end;
} Span;

// Where something in a script came from.
typedef struct Origin {
    const Source *source;
    Span span;
} Origin;

typedef struct SourcePosition {
    uint32_t line;   // from 1
    uint32_t column; // in characters, from 1
    Str text;        // the line without its LF
} SourcePosition;

// Copies everything into the arena, leaves a byte-order mark out, turns CR LF and CR into LF and ends the last line.
// Text must be below 4 GiB.
const Source *source_new(Arena *arena, Str name, Str path, Str text);
// CR LF and CR become LF, in place; returns the length then.
size_t source_unify_lines(char *bytes, size_t len);
SourcePosition source_locate(const Source *source, uint32_t offset);
// The number of the line alone, which takes no longer where lines are long.
uint32_t source_line(const Source *source, uint32_t offset);
// The part of a path up to and including the last slash.
Str path_directory(Str path);
// `path` itself if absolute or `directory` is empty, else directory + path.
Str path_join(Arena *arena, Str directory, Str path);

#endif
