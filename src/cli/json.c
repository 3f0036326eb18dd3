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
