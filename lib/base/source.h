// source.h: source files and positions in them.
//
// Tokens and syntax nodes store only byte offsets. Line and column are computed when a diagnostic needs them.
#pragma once

#include "base/str.h"

typedef struct Source {
    Str name;                    // name in messages: the path as the user gave it
    Str path;                    // unique path: absolute, or the name of a source that is not a file
    Str directory;               // folder in which relative file names are resolved; "": the working directory
    Str text;                    // each line ends with LF; a NUL byte follows the text
    const uint32_t *line_starts; // byte offset of each line
    uint32_t line_count;
} Source;

// A half-open range of byte offsets.
typedef struct Span {
    uint32_t start;
    uint32_t end;
} Span;

// The span of source code from which an instruction, node or attribute originates.
typedef struct Origin {
    const Source *source;
    Span span;
} Origin;

typedef struct SourcePosition {
    uint32_t line;   // line number, from 1
    uint32_t column; // column in characters, from 1
    Str text;        // the line without its LF
} SourcePosition;

// Creates a source and copies all strings into the arena. Removes a byte-order mark, converts CR LF and CR to LF and
// ends the last line with LF. The text must be smaller than 4 GiB.
const Source *source_new(Arena *arena, Str name, Str path, Str text);
// Converts CR LF and CR to LF in the array `bytes` itself. Returns the new length.
size_t source_unify_lines(char *bytes, size_t len);
// Returns the position of a byte offset. Offsets at or beyond the end return the end of the last line.
SourcePosition source_locate(const Source *source, uint32_t offset);
// Returns only the line number. Unlike source_locate, its cost does not depend on the length of the line.
uint32_t source_line(const Source *source, uint32_t offset);
// Returns the part of a path up to and including the last slash.
Str path_directory(Str path);
// Returns `path` if it is absolute or `directory` is empty, else both joined by a slash.
Str path_join(Arena *arena, Str directory, Str path);
