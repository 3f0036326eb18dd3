// mesh_text.c: words, lines and numbers of model files; see mesh_file.h.
#include "base/number.h"
#include "scene3d/mesh_file.h"

#include <math.h>
#include <string.h>

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

Str mesh_next_word(Str *line) {
    while (line->len > 0 && is_blank(*line->bytes))
        *line = (Str){line->bytes + 1, line->len - 1};
    size_t len = 0;
    while (len < line->len && !is_blank(line->bytes[len]))
        len++;
    Str word = {line->bytes, len};
    *line = (Str){line->bytes + len, line->len - len};
    return word;
}

Str mesh_next_line(Str *text) {
    const char *end = memchr(text->bytes, '\n', text->len);
    size_t len = end ? (size_t)(end - text->bytes) : text->len;
    Str line = {text->bytes, len};
    *text = (Str){text->bytes + len + (end != NULL), text->len - len - (end != NULL)};
    return line;
}

static size_t skip_digits(Str word, size_t at) {
    while (at < word.len && word.bytes[at] >= '0' && word.bytes[at] <= '9')
        at++;
    return at;
}

static size_t skip_one_of(Str word, size_t at, const char *which) {
    return at < word.len && strchr(which, word.bytes[at]) ? at + 1 : at;
}

bool mesh_read_number(Str word, float *out) {
    size_t start = skip_one_of(word, 0, "+-"), whole = skip_digits(word, start), point = skip_one_of(word, whole, ".");
    size_t end = skip_digits(word, point), mark = skip_one_of(word, end, "eE");
    if ((whole == start && end == point) || word.len > 60)
        return false;
    if (mark > end) {
        size_t sign = skip_one_of(word, mark, "+-");
        if ((end = skip_digits(word, sign)) == sign)
            return false;
    }
    *out = (float)number_parse(word);
    return end == word.len && fabsf(*out) < 1e30f;
}
