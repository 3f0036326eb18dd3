// source.c: see source.h.
//
// The text of a source always ends with a line feed and a NUL byte, on which the scanner and source_locate rely.
#include "base/source.h"

#include <string.h>

size_t source_unify_lines(char *bytes, size_t len) {
    size_t kept = 0;
    for (size_t i = 0; i < len; i++) {
        bool line_feed_follows = i + 1 < len && bytes[i + 1] == '\n';
        if (bytes[i] != '\r')
            bytes[kept++] = bytes[i];
        else if (!line_feed_follows)
            bytes[kept++] = '\n';
    }
    return kept;
}

// Returns a copy without byte-order mark, with LF line endings, a final LF and a NUL byte after it.
static Str normalise_lines(Arena *arena, Str text) {
    if (str_starts_with(text, STR("\xef\xbb\xbf")))
        text = (Str){text.bytes + 3, text.len - 3};
    char *bytes = arena_alloc(arena, text.len + 2);
    if (text.len)
        memcpy(bytes, text.bytes, text.len);
    size_t len = source_unify_lines(bytes, text.len);
    if (len == 0 || bytes[len - 1] != '\n')
        bytes[len++] = '\n';
    bytes[len] = 0;
    return (Str){bytes, len};
}

const Source *source_new(Arena *arena, Str name, Str path, Str text) {
    Source *source = arena_alloc(arena, sizeof *source);
    Str normal = normalise_lines(arena, text);
    uint32_t count = 0;
    for (size_t i = 0; i < normal.len; i++)
        count += normal.bytes[i] == '\n';
    uint32_t *starts = arena_alloc_array(arena, count, sizeof *starts);
    uint32_t line = 0;
    starts[line++] = 0;
    for (size_t i = 0; i + 1 < normal.len; i++)
        if (normal.bytes[i] == '\n')
            starts[line++] = (uint32_t)i + 1;
    name = str_copy(arena, name);
    *source = (Source){.name = name,
                       .path = str_copy(arena, path),
                       .directory = path_directory(name),
                       .text = normal,
                       .line_starts = starts,
                       .line_count = count};
    return source;
}

uint32_t source_line(const Source *source, uint32_t offset) {
    uint32_t low = 0, high = source->line_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (source->line_starts[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    return low + 1;
}

SourcePosition source_locate(const Source *source, uint32_t offset) {
    if (offset >= source->text.len)
        offset = (uint32_t)source->text.len - 1;
    uint32_t number = source_line(source, offset), start = source->line_starts[number - 1];
    const char *line = source->text.bytes + start;
    size_t len = (size_t)((const char *)memchr(line, '\n', source->text.len - start) - line);
    return (SourcePosition){number, (uint32_t)utf8_length((Str){line, offset - start}) + 1, {line, len}};
}

Str path_directory(Str path) {
    while (path.len && path.bytes[path.len - 1] != '/')
        path.len--;
    return path;
}

Str path_join(Arena *arena, Str directory, Str path) {
    if (directory.len == 0 || (path.len && path.bytes[0] == '/'))
        return path;
    const char *slash = directory.bytes[directory.len - 1] == '/' ? "" : "/";
    return str_format(arena, "%.*s%s%.*s", STR_ARGS(directory), slash, STR_ARGS(path));
}
