// json.c: see json.h.
#include "cli/json.h"

#include <string.h>

void json_add_text(ByteBuffer *out, const char *text) {
    if (!text) {
        byte_buffer_add_text(out, "null");
        return;
    }
    Str all = str_from(text);
    byte_buffer_add_text(out, "\"");
    for (size_t at = 0; at < all.len;) {
        size_t start = at;
        int32_t c = utf8_next(all, &at);
        if (c == '"' || c == '\\')
            byte_buffer_format(out, "\\%c", (char)c);
        else if (c < 0)
            byte_buffer_add_text(out, "\\ufffd");
        else if (c < 0x20)
            byte_buffer_format(out, "\\u%04x", (unsigned)c);
        else
            byte_buffer_add(out, all.bytes + start, at - start);
    }
    byte_buffer_add_text(out, "\"");
}

const char *level_word(PetriLevel level) {
    static const char *const words[] = {"error", "warning", "note"};
    return words[level];
}

void json_add_diagnostic(ByteBuffer *out, const PetriDiagnostic *diagnostic) {
    const struct {
        const char *name;
        const char *text;
    } fields[] = {{"file", diagnostic->file},
                  {"level", level_word(diagnostic->level)},
                  {"code", diagnostic->code},
                  {"text", diagnostic->text},
                  {"hint", diagnostic->hint[0] != '\0' ? diagnostic->hint : NULL}};
    byte_buffer_add_text(out, "{");
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        byte_buffer_format(out, "\"%s\": ", fields[i].name);
        json_add_text(out, fields[i].text);
        byte_buffer_add_text(out, ", ");
    }
    byte_buffer_format(out, "\"line\": %u, \"column\": %u, \"endLine\": %u, \"endColumn\": %u}", diagnostic->line,
                       diagnostic->column, diagnostic->end_line, diagnostic->end_column);
}
