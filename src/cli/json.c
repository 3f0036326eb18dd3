// json.c: see json.h.
#include "cli/json.h"

#include <string.h>

void json_add_text(Text *out, const char *text) {
    if (!text) {
        text_add_c(out, "null");
        return;
    }
    Str all = str_from(text);
    text_add_c(out, "\"");
    for (size_t at = 0; at < all.len;) {
        size_t start = at;
        int32_t c = utf8_next(all, &at);
        if (c == '"' || c == '\\')
            text_add_format(out, "\\%c", (char)c);
        else if (c < 0)
            text_add_c(out, "\\ufffd");
        else if (c < 0x20)
            text_add_format(out, "\\u%04x", (unsigned)c);
        else
            text_add(out, (Str){all.bytes + start, at - start});
    }
    text_add_c(out, "\"");
}

const char *level_word(PetriLevel level) {
    static const char *const words[] = {"error", "warning", "note"};
    return words[level];
}

void json_add_members(Text *out, const char *const members[]) {
    for (; members[0]; members += 2) {
        text_add_format(out, "%s\"%s\": ", out->bytes[out->len - 1] == '{' ? "" : ", ", members[0]);
        json_add_text(out, members[1]);
    }
}

void json_add_diagnostic(Text *out, const PetriDiagnostic *diagnostic) {
    text_add_c(out, "{");
    JSON_ADD(out, "file", diagnostic->file, "level", level_word(diagnostic->level), "code", diagnostic->code, "text",
             diagnostic->text, "hint", diagnostic->hint[0] != '\0' ? diagnostic->hint : NULL);
    text_add_format(out, ", \"line\": %u, \"column\": %u, \"endLine\": %u, \"endColumn\": %u}", diagnostic->line,
                    diagnostic->column, diagnostic->end_line, diagnostic->end_column);
}
