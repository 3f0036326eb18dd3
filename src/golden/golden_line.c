// golden_line.c: whether two lines of output mean the same.
#include "golden/golden_line.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/str.h"

// An indent is white space at the start of a line, where its width means something.
typedef enum TokenKind { TOKEN_END, TOKEN_INDENT, TOKEN_SIGN, TOKEN_WORD, TOKEN_NUMBER, TOKEN_STRING } TokenKind;

typedef struct Token {
    TokenKind kind;
    size_t start;
    size_t length;
    double number;
} Token;

enum { LONGEST_NUMBER = 63 };

static bool is_number(const char *word, size_t length, double *number) {
    if (length == 0 || length > LONGEST_NUMBER) {
        return false;
    }
    char copy[LONGEST_NUMBER + 1];
    memcpy(copy, word, length);
    copy[length] = '\0';
    // The C library reads more than is ever printed, such as 0x10 and infinity.
    if (strspn(copy, "0123456789+-.e") != length && strcmp(copy, "nan") != 0 && strcmp(copy, "inf") != 0 &&
        strcmp(copy, "-inf") != 0) {
        return false;
    }
    char *end = NULL;
    *number = strtod(copy, &end);
    return *end == '\0';
}

static size_t string_length(const char *text, size_t length) {
    char quote = text[0];
    for (size_t i = 1; i < length; i++) {
        if (text[i] == '\\') {
            i++;
        } else if (text[i] == quote) {
            return i + 1;
        }
    }
    return length;
}

static size_t word_length(const char *text, size_t length) {
    static const char ends[] = {' ', '\t', '\n', ';', '=', '(', ')', '\'', '"'};
    size_t i = 0;
    while (i < length && memchr(ends, text[i], sizeof ends) == NULL) {
        i++;
    }
    return i;
}

static size_t blank_length(Slice line, size_t at) {
    size_t end = at;
    while (end < line.length && (line.text[end] == ' ' || line.text[end] == '\t')) {
        end++;
    }
    return end - at;
}

static Token next_token(Slice line, size_t at) {
    size_t blanks = blank_length(line, at);
    bool at_line_start = at == 0 || line.text[at - 1] == '\n';
    if (blanks > 0 && at_line_start) {
        return (Token){.kind = TOKEN_INDENT, .start = at, .length = blanks};
    }
    at += blanks;
    Token token = {.kind = TOKEN_END, .start = at};
    if (at == line.length) {
        return token;
    }
    const char *text = line.text + at;
    size_t rest = line.length - at;
    if (*text == '\'' || *text == '"') {
        token.kind = TOKEN_STRING;
        token.length = string_length(text, rest);
        return token;
    }
    token.length = word_length(text, rest);
    token.kind = is_number(text, token.length, &token.number) ? TOKEN_NUMBER : TOKEN_WORD;
    if (token.length == 0) {
        token.kind = TOKEN_SIGN;
        token.length = 1;
    }
    return token;
}

static uint32_t read_hex(const char *text, size_t digits) {
    uint32_t value = 0;
    for (size_t i = 0; i < digits; i++) {
        char c = text[i];
        uint32_t digit = c >= '0' && c <= '9' ? (uint32_t)(c - '0') : ((uint32_t)c | 32U) - 'a' + 10;
        value = value * 16 + digit;
    }
    return value;
}

// The bytes that one escape or one plain byte of a string stands for: 1 to 4 of them. Moves `text` on.
static size_t next_bytes(const char **text, const char *end, char *out) {
    char c = *(*text)++;
    if (c != '\\' || *text == end) {
        out[0] = c;
        return 1;
    }
    char escape = *(*text)++;
    size_t digits = escape == 'x' ? 2 : escape == 'u' ? 4 : escape == 'U' ? 8 : 0;
    if (digits > 0 && (size_t)(end - *text) >= digits) {
        uint32_t value = read_hex(*text, digits);
        *text += digits;
        return utf8_encode(value, out);
    }
    out[0] = escape == 'n' ? '\n' : escape == 'r' ? '\r' : escape == 't' ? '\t' : escape;
    return 1;
}

// A string as the bytes between its quotes, escapes resolved; one or a few bytes at a time.
typedef struct StringReader {
    const char *at;
    const char *end;
    char bytes[4];
    size_t count;
    size_t used;
} StringReader;

static StringReader read_string(const char *text, size_t length) {
    bool is_closed = length > 1 && text[length - 1] == text[0];
    return (StringReader){.at = text + 1, .end = text + length - (is_closed ? 1 : 0)};
}

// -1 at the end.
static int next_byte(StringReader *reader) {
    if (reader->used == reader->count) {
        if (reader->at == reader->end) {
            return -1;
        }
        reader->count = next_bytes(&reader->at, reader->end, reader->bytes);
        reader->used = 0;
    }
    return (unsigned char)reader->bytes[reader->used++];
}

static bool strings_same(const char *a, size_t a_length, const char *b, size_t b_length) {
    StringReader first = read_string(a, a_length);
    StringReader second = read_string(b, b_length);
    for (;;) {
        int c = next_byte(&first);
        if (c != next_byte(&second)) {
            return false;
        }
        if (c == -1) {
            return true;
        }
    }
}

// How far the numbers of one value are apart, and how large they are.
typedef struct Spread {
    double distance;
    double size;
    LineDifference widest; // where the distance was found
} Spread;

static bool numbers_same(double a, double b) {
    return a == b || (isnan(a) && isnan(b));
}

static void widen(Spread *spread, const Token *expected, const Token *got) {
    double distance = fabs(expected->number - got->number);
    if (distance > spread->distance) {
        spread->distance = distance;
        spread->widest = (LineDifference){expected->start, got->start};
    }
    spread->size = fmax(spread->size, fmax(fabs(expected->number), fabs(got->number)));
}

static bool tokens_same(Slice a, const Token *expected, Slice b, const Token *got) {
    if (expected->kind != got->kind) {
        return false;
    }
    const char *first = a.text + expected->start;
    const char *second = b.text + got->start;
    if (expected->kind == TOKEN_NUMBER) {
        return numbers_same(expected->number, got->number);
    }
    if (expected->kind == TOKEN_STRING) {
        return strings_same(first, expected->length, second, got->length);
    }
    return expected->length == got->length && memcmp(first, second, expected->length) == 0;
}

static bool is_near_number(const Token *expected, const Token *got) {
    return expected->kind == TOKEN_NUMBER && got->kind == TOKEN_NUMBER && isfinite(expected->number) &&
           isfinite(got->number);
}

bool line_same(Slice expected, Slice got, double tolerance, LineDifference *difference) {
    *difference = (LineDifference){0};
    if (expected.length == got.length && memcmp(expected.text, got.text, got.length) == 0) {
        return true;
    }
    // A hash is no number, even if its digits look like one, such as 1e99….
    if (expected.length > 0 && expected.text[0] == '=') {
        return false;
    }
    bool in_key = expected.length > 0 && expected.text[0] == '$';
    Spread spread = {.size = 1};
    size_t a = 0;
    size_t b = 0;
    for (;;) {
        Token first = next_token(expected, a);
        Token second = next_token(got, b);
        if (!in_key && tolerance > 0 && is_near_number(&first, &second)) {
            widen(&spread, &first, &second);
        } else if (!tokens_same(expected, &first, got, &second)) {
            *difference = (LineDifference){first.start, second.start};
            return false;
        }
        if (first.kind == TOKEN_END) {
            *difference = spread.widest;
            return spread.distance <= tolerance * spread.size;
        }
        in_key = in_key && expected.text[first.start] != '=';
        a = first.start + first.length;
        b = second.start + second.length;
    }
}
