// overlay_text.c: see overlay_text.h.
//
// overlay_set removes escape sequences and control characters, which a message can contain, and replaces invalid UTF-8.
// So the other functions can count characters.
#include "view/overlay_text.h"

#include "base/str.h"

#include <string.h>

// Returns the length of the UTF-8 character at the start of a text, or 0 if it is invalid or empty.
static size_t character_length(const char *text) {
    size_t length = 0;
    return *text != '\0' && utf8_next((Str){text, strnlen(text, UTF8_MAX)}, &length) >= 0 ? length : 0;
}

// Returns the end of an escape sequence, such as one that colours a message.
static const char *skip_escape(const char *text) {
    if (text[1] != '[')
        return text + 1;
    text += 2;
    text += strspn(text, "0123456789;:?<=>!\"#$%&'()*+,-./ ");
    return *text == '\0' ? text : text + 1;
}

static bool is_control(const char *text, size_t length) {
    size_t at = 0;
    return utf8_is_control(utf8_next((Str){text, length}, &at));
}

bool overlay_set(char *text, size_t size, const char *from) {
    char clean[sizeof(Overlay)];
    size_t used = 0;
    size = size < sizeof clean ? size : sizeof clean;
    while (*from != '\0') {
        size_t length = character_length(from);
        if (*from == '\033') {
            from = skip_escape(from);
            continue;
        }
        bool blank = *from == '\t', kept = length > 0 && (*from == '\n' || !is_control(from, length));
        if (used + (length > 1 ? length : 1) >= size)
            break;
        if (blank || length == 0) {
            clean[used++] = blank ? ' ' : '?';
        } else if (kept) {
            memcpy(clean + used, from, length);
            used += length;
        }
        from += length > 0 ? length : 1;
    }
    while (used > 0 && clean[used - 1] == '\n')
        used--;
    clean[used] = '\0';
    bool changed = strcmp(text, clean) != 0;
    memcpy(text, clean, used + 1);
    return changed;
}

int overlay_lines(const char *text) {
    int lines = *text == '\0' ? 0 : 1;
    for (; *text != '\0'; text++)
        lines += *text == '\n';
    return lines;
}

// Returns the number of characters up to the end of the line.
static int line_columns(const char *line) {
    return (int)utf8_length((Str){line, strcspn(line, "\n")});
}

int overlay_columns(const char *text) {
    int max_columns = line_columns(text);
    while ((text = strchr(text, '\n'))) {
        int columns = line_columns(++text);
        max_columns = columns > max_columns ? columns : max_columns;
    }
    return max_columns;
}

// Returns the position after `columns` characters, or the end of the line.
static const char *skip_columns(const char *line, int columns) {
    Str rest = {line, strcspn(line, "\n")};
    size_t at = 0;
    while (columns-- > 0 && at < rest.len)
        utf8_next(rest, &at);
    return line + at;
}

// Returns the end of the part of a line that fits in one row.
static const char *row_end(const char *line, int columns) {
    const char *end = skip_columns(line, columns);
    if (*end == '\0' || *end == '\n')
        return end;
    for (const char *blank = end; blank > line; blank--)
        if (*blank == ' ')
            return blank;
    return end;
}

static size_t append_text(char *out, size_t size, size_t used, const char *text, size_t length) {
    if (used + length >= size)
        return used;
    memcpy(out + used, text, length);
    return used + length;
}

void overlay_fit(char *out, size_t size, const char *text, int columns) {
    static const char more[] = "…";
    size_t used = 0;
    columns = columns < 2 ? 2 : columns;
    while (*text != '\0') {
        bool cut = *text == ' ' && line_columns(text) > columns;
        const char *end = cut ? skip_columns(text, columns - 1) : row_end(text, columns);
        used = append_text(out, size, used, text, (size_t)(end - text));
        if (cut) {
            used = append_text(out, size, used, more, sizeof more - 1);
            end = skip_columns(text, line_columns(text));
        }
        text = *end == ' ' || *end == '\n' ? end + 1 : end;
        if (*text != '\0')
            used = append_text(out, size, used, "\n", 1);
    }
    out[used] = '\0';
}
