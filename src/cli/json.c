// json.c: see json.h.
#include "cli/json.h"

#include <string.h>

void json_add_text(Bytes *out, const char *text) {
    if (text == NULL) {
        bytes_add_text(out, "null");
        return;
    }
    Str all = str_from(text);
    bytes_add_text(out, "\"");
    for (size_t at = 0; at < all.len;) {
        size_t start = at;
        int32_t c = utf8_next(all, &at);
        if (c == '"' || c == '\\') {
            bytes_format(out, "\\%c", (char)c);
        } else if (c < 0) {
            bytes_add_text(out, "\\ufffd");
        } else if (c < 0x20) {
            bytes_format(out, "\\u%04x", (unsigned)c);
        } else {
            bytes_add(out, all.bytes + start, at - start);
        }
    }
    bytes_add_text(out, "\"");
}

const char *level_word(PetriLevel level) {
    static const char *const words[] = {"error", "warning", "note"};
    return words[level];
}

void json_add_diagnostic(Bytes *out, const PetriDiagnostic *diagnostic) {
    const struct {
        const char *name;
        const char *text;
    } fields[] = {{"file", diagnostic->file},
                  {"level", level_word(diagnostic->level)},
                  {"code", diagnostic->code},
                  {"text", diagnostic->text},
                  {"hint", diagnostic->hint[0] != '\0' ? diagnostic->hint : NULL}};
    bytes_add_text(out, "{");
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        bytes_format(out, "\"%s\": ", fields[i].name);
        json_add_text(out, fields[i].text);
        bytes_add_text(out, ", ");
    }
    bytes_format(out, "\"line\": %u, \"column\": %u, \"endLine\": %u, \"endColumn\": %u}", diagnostic->line,
                 diagnostic->column, diagnostic->end_line, diagnostic->end_column);
}
