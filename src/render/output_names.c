// output_names.c: see output_names.h.
#include "render/output_names.h"

#include "base/str.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static const char WINDOW[] = "{window}";

// Returns the start of the placeholder for the frame number and sets *end to its end. Returns NULL if there is none.
static const char *find_number(const char *name, const char **end) {
    const char *at = strchr(name, '%');
    if (!at)
        return NULL;
    const char *after = at + 1 + strspn(at + 1, "0123456789");
    *end = after + 1;
    return *after == 'd' && after - at <= 3 ? at : NULL;
}

static const char *find_window(const char *name) {
    const char *slash = strrchr(name, '/');
    return strstr(slash ? slash : name, WINDOW);
}

bool output_has_number(const char *pattern) {
    const char *end;
    return find_number(pattern, &end);
}

bool output_has_window(const char *pattern) {
    return find_window(pattern);
}

static bool is_plain(char byte, bool first) {
    unsigned char c = (unsigned char)byte;
    return c >= 0x80 || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
           c == '_' || (c == '.' && !first);
}

static void add_window(Text *text, int window, const char *id) {
    if (!id[0])
        text_add_format(text, "%d", window < 0 ? 0 : window);
    for (const char *at = id; *at; at++)
        text_add(text, (Str){is_plain(*at, at == id) ? at : "_", 1});
}

static void add_number(Text *text, const char *placeholder, int64_t frame) {
    int width = (int)strtol(placeholder + 1, NULL, 10);
    if (placeholder[1] == '0')
        text_add_format(text, "%0*" PRId64, width, frame);
    else
        text_add_format(text, "%*" PRId64, width, frame);
}

char *output_name(const char *pattern, int64_t frame, int window, const char *id) {
    Text text = {0};
    const char *number_end = NULL, *number = frame < 0 ? NULL : find_number(pattern, &number_end);
    const char *place = find_window(pattern);
    for (const char *at = pattern; *at;) {
        if (at == number) {
            add_number(&text, number, frame);
            at = number_end;
        } else if (at == place) {
            add_window(&text, window, id);
            at += sizeof WINDOW - 1;
        } else {
            text_add(&text, (Str){at++, 1});
        }
    }
    return text.bytes;
}
