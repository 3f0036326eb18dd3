// literal.c: see literal.h.
//
// literal_number, literal_timecode and literal_string get tokens of the scanner, whose form is known.
// literal_parse_number and literal_parse_timecode get any text, and check all of it.
#include "ast/literal.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

typedef struct Suffix {
    const char *text;
    double factor;
} Suffix;

static const Suffix suffixes[] = {
    {"deg", 1.0 / 360}, {"\xc2\xb0", 1.0 / 360},
    {"\xc2\xb5", 1e-6}, {"p", 1e-12},
    {"n", 1e-9},        {"u", 1e-6},
    {"m", 1e-3},        {"k", 1e3},
    {"M", 1e6},         {"G", 1e9},
    {"T", 1e12},
};

static const Suffix *find_suffix(Str token) {
    for (size_t i = 0; i < sizeof suffixes / sizeof suffixes[0]; i++)
        if (str_ends_with(token, str_from(suffixes[i].text)))
            return &suffixes[i];
    return NULL;
}

const char *literal_number(Str token, double *x) {
    const Suffix *suffix = find_suffix(token);
    if (suffix)
        token.len -= strlen(suffix->text);
    for (size_t i = 0; i < token.len; i++)
        if (token.bytes[i] == '_' &&
            !(i > 0 && is_digit(token.bytes[i - 1]) && i + 1 < token.len && is_digit(token.bytes[i + 1])))
            return "an underscore in a number must be between two digits";
    *x = number_parse(token);
    if (suffix)
        *x = *x * suffix->factor; // rounds again, after number_parse has rounded
    return NULL;
}

// Returns the part of *rest up to the next colon or the end. Removes this part and the colon from *rest.
static Str next_part(Str *rest) {
    const char *colon = rest->len ? memchr(rest->bytes, ':', rest->len) : NULL;
    Str part = {rest->bytes, colon ? (size_t)(colon - rest->bytes) : rest->len};
    size_t skip = part.len + (colon != NULL);
    *rest = (Str){rest->bytes + skip, rest->len - skip};
    return part;
}

double literal_timecode(Str token) {
    double parts[3] = {0};
    int count = 0;
    while (token.len && count < 3)
        parts[count++] = number_parse(next_part(&token));
    double hours = count == 3 ? parts[0] : 0, minutes = parts[count - 2], seconds = parts[count - 1];
    return (seconds + 60 * minutes) + 3600 * hours;
}

// Decodes a \x, \u or \U escape, which has exactly `digits` hexadecimal digits. Returns NULL on success, else an error
// message.
static const char *hex_escape(Text *out, Str body, size_t *at, int digits) {
    uint32_t code_point = 0;
    for (int i = 0; i < digits; i++) {
        int digit = *at < body.len ? str_hex_digit(body.bytes[*at]) : -1;
        if (digit < 0)
            return "'\\x' needs exactly 2 hexadecimal digits, '\\u' needs 4 and '\\U' needs 8";
        code_point = code_point << 4 | (uint32_t)digit;
        ++*at;
    }
    if (code_point > 0x10ffff || (code_point >= 0xd800 && code_point <= 0xdfff))
        return "this escape is not a valid Unicode code point";
    text_add_code_point(out, code_point);
    return NULL;
}

static void octal_escape(Text *out, Str body, size_t *at) {
    uint32_t code_point = 0;
    for (int i = 0; i < 3 && *at < body.len && body.bytes[*at] >= '0' && body.bytes[*at] <= '7'; i++)
        code_point = code_point * 8 + (uint32_t)(body.bytes[(*at)++] - '0');
    text_add_code_point(out, code_point);
}

static const char *parse_escape(Text *out, Str body, size_t *at) {
    static const char letters[] = "\\'\"abtnvfr", meanings[] = "\\'\"\a\b\t\n\v\f\r";
    char c = body.bytes[*at];
    const char *simple = c ? strchr(letters, c) : NULL;
    if (c >= '0' && c <= '7') {
        octal_escape(out, body, at);
        return NULL;
    }
    ++*at;
    if (simple)
        text_add_char(out, meanings[simple - letters]);
    else if (c == 'x' || c == 'u' || c == 'U')
        return hex_escape(out, body, at, c == 'x' ? 2 : c == 'u' ? 4 : 8);
    else if (c == 'N' && *at < body.len && body.bytes[*at] == '{')
        return "'\\N{…}' is not supported: use '\\u' or '\\U'";
    else
        text_add_format(out, "\\%c", c); // before any other character the backslash is kept
    return NULL;
}

const char *literal_string(Arena *arena, Str token, Str *text) {
    size_t quotes = token.len >= 6 && token.bytes[1] == token.bytes[0] && token.bytes[2] == token.bytes[0] ? 3 : 1;
    Str body = {token.bytes + quotes, token.len - 2 * quotes};
    if (!memchr(body.bytes, '\\', body.len)) {
        *text = body;
        return NULL;
    }
    Text out = text_new(arena);
    for (size_t at = 0; at < body.len;) {
        char c = body.bytes[at++];
        if (c != '\\') {
            text_add_char(&out, c);
            continue;
        }
        const char *complaint = parse_escape(&out, body, &at);
        if (complaint)
            return complaint;
    }
    *text = text_str(&out);
    return NULL;
}

// Returns the number of digits and underscores at an offset, or 0 if the first character is not a digit.
static size_t skip_digits(Str text, size_t at) {
    size_t start = at;
    while (at < text.len && (is_digit(text.bytes[at]) || (at > start && text.bytes[at] == '_')))
        at++;
    return at - start;
}

bool literal_parse_number(Str text, double *x) {
    text = str_trim(text);
    bool negative = text.len && text.bytes[0] == '-';
    if (text.len && (negative || text.bytes[0] == '+'))
        text = (Str){text.bytes + 1, text.len - 1};
    if (str_equal(text, STR("inf")) || str_equal(text, STR("nan"))) {
        *x = text.bytes[0] == 'i' ? INFINITY : NAN;
    } else {
        const Suffix *suffix = find_suffix(text);
        Str digits = {text.bytes, text.len - (suffix ? strlen(suffix->text) : 0)};
        size_t at = skip_digits(digits, 0), whole = at;
        if (at < digits.len && digits.bytes[at] == '.') {
            size_t fraction = skip_digits(digits, at + 1);
            if (fraction == 0)
                return false;
            at += 1 + fraction;
        } else if (whole == 0) {
            return false;
        }
        if (at < digits.len && (digits.bytes[at] == 'e' || digits.bytes[at] == 'E')) {
            at++;
            at += at < digits.len && (digits.bytes[at] == '-' || digits.bytes[at] == '+');
            size_t exponent = skip_digits(digits, at);
            if (exponent == 0)
                return false;
            at += exponent;
        }
        if (at != digits.len || literal_number(text, x))
            return false;
    }
    if (negative)
        *x = -*x;
    return true;
}

// Returns true for one or two digits with a value below 60.
static bool is_sixtieth(Str part) {
    return (part.len == 1 && is_digit(part.bytes[0])) ||
           (part.len == 2 && part.bytes[0] >= '0' && part.bytes[0] <= '5' && is_digit(part.bytes[1]));
}

static bool is_digits(Str part) {
    for (size_t i = 0; i < part.len; i++)
        if (!is_digit(part.bytes[i]))
            return false;
    return part.len > 0;
}

bool literal_parse_timecode(Str text, double *x) {
    Str rest = text, parts[3];
    int count = 0;
    while (rest.len && count < 3)
        parts[count++] = next_part(&rest);
    if (rest.len || count < 2)
        return false;
    Str seconds = parts[count - 1], fraction = {0};
    const char *point = seconds.len ? memchr(seconds.bytes, '.', seconds.len) : NULL;
    if (point) {
        size_t whole = (size_t)(point - seconds.bytes);
        fraction = (Str){point + 1, seconds.len - whole - 1};
        seconds.len = whole;
        if (!is_digits(fraction))
            return false;
    }
    if (!is_sixtieth(seconds) || !is_sixtieth(parts[count - 2]) || (count == 3 && !is_digits(parts[0])))
        return false;
    *x = literal_timecode(text);
    return true;
}
