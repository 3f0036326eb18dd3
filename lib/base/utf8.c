// utf8.c: UTF-8; see str.h.
//
// An invalid byte counts as one character, so that loops always advance and every text has a length.
#include "base/str.h"

int32_t utf8_next(Str text, size_t *at) {
    const unsigned char *bytes = (const unsigned char *)text.bytes + *at;
    size_t left = text.len - *at;
    unsigned char lead = bytes[0];
    (*at)++;
    if (lead < 0x80)
        return lead;
    int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : 1;
    if (lead < 0xc2 || lead > 0xf4 || left <= (size_t)more)
        return -1;
    int32_t code_point = lead & (0x3f >> more);
    for (int i = 1; i <= more; i++) {
        if ((bytes[i] & 0xc0) != 0x80)
            return -1;
        code_point = code_point << 6 | (bytes[i] & 0x3f);
    }
    static const int32_t min_code_point[4] = {0, 0x80, 0x800, 0x10000};
    if (code_point < min_code_point[more] || code_point > 0x10ffff || (code_point >= 0xd800 && code_point <= 0xdfff))
        return -1;
    *at += (size_t)more;
    return code_point;
}

bool utf8_is_control(int32_t c) {
    return c < 0x20 || (c >= 0x7f && c < 0xa0);
}

size_t utf8_encode(uint32_t code_point, char bytes[UTF8_MAX]) {
    if (code_point < 0x80) {
        bytes[0] = (char)code_point;
        return 1;
    }
    size_t more = code_point < 0x800 ? 1 : code_point < 0x10000 ? 2 : 3;
    static const unsigned char marks[4] = {0, 0xc0, 0xe0, 0xf0};
    for (size_t i = more; i > 0; i--, code_point >>= 6)
        bytes[i] = (char)(0x80 | (code_point & 0x3f));
    bytes[0] = (char)(marks[more] | code_point);
    return more + 1;
}

size_t utf8_find_error(Str text) {
    for (size_t at = 0; at < text.len;) {
        size_t start = at;
        if (utf8_next(text, &at) < 0)
            return start;
    }
    return text.len;
}

size_t utf8_length(Str text) {
    size_t count = 0;
    for (size_t at = 0; at < text.len; count++)
        utf8_next(text, &at);
    return count;
}
