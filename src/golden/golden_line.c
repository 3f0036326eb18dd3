// golden_line.c: comparison of two lines of output (golden.h).
#include "cli/memory.h"
#include "golden/golden.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// TOKEN_INDENT is white space at the start of a line. Its width is significant.
typedef enum TokenKind { TOKEN_END, TOKEN_INDENT, TOKEN_SIGN, TOKEN_WORD, TOKEN_NUMBER, TOKEN_STRING } TokenKind;

typedef struct Token {
    TokenKind kind;
    size_t start;
    size_t length;
    double number;
} Token;

enum { MAX_NUMBER_LENGTH = 63 };

static bool is_number(const char *word, size_t length, double *number) {
    if (length == 0 || length > MAX_NUMBER_LENGTH)
        return false;
    char copy[MAX_NUMBER_LENGTH + 1];
    memcpy(copy, word, length);
    copy[length] = '\0';
    // strtod also accepts forms that petri never prints, such as 0x10 and infinity.
    if (strspn(copy, "0123456789+-.e") != length && strcmp(copy, "nan") != 0 && strcmp(copy, "inf") != 0 &&
        strcmp(copy, "-inf") != 0)
        return false;
    char *end = NULL;
    *number = strtod(copy, &end);
    return *end == '\0';
}

static size_t string_length(const char *text, size_t length) {
    char quote = text[0];
    for (size_t i = 1; i < length; i++)
        if (text[i] == '\\')
            i++;
        else if (text[i] == quote)
            return i + 1;
    return length;
}

static Token next_token(Str line, size_t at) {
    size_t blanks = strspn(line.bytes + at, " \t");
    bool at_line_start = at == 0 || line.bytes[at - 1] == '\n';
    if (blanks > 0 && at_line_start)
        return (Token){.kind = TOKEN_INDENT, .start = at, .length = blanks};
    at += blanks;
    Token token = {.kind = TOKEN_END, .start = at};
    if (at == line.len)
        return token;
    const char *text = line.bytes + at;
    if (*text == '\'' || *text == '"') {
        token.kind = TOKEN_STRING;
        token.length = string_length(text, line.len - at);
        return token;
    }
    token.length = strcspn(text, " \t\n;=()'\"");
    token.kind = is_number(text, token.length, &token.number) ? TOKEN_NUMBER : TOKEN_WORD;
    if (token.length == 0) {
        token.kind = TOKEN_SIGN;
        token.length = 1;
    }
    return token;
}

// Adds the contents of a quoted string.
static void unquote(Text *out, const char *text, size_t length) {
    const char *end = text + length - (length > 1 && text[length - 1] == text[0]);
    for (const char *at = text + 1; at < end; at++) {
        char plain[UTF8_MAX] = {*at}, hex[9] = "";
        size_t count = 1;
        if (*at == '\\' && at + 1 < end) {
            char escape = *++at;
            size_t digits = escape == 'x' ? 2 : escape == 'u' ? 4 : escape == 'U' ? 8 : 0;
            plain[0] = escape == 'n' ? '\n' : escape == 'r' ? '\r' : escape == 't' ? '\t' : escape;
            if (digits > 0 && (size_t)(end - at) > digits) {
                memcpy(hex, at + 1, digits);
                count = utf8_encode((uint32_t)strtoul(hex, NULL, 16), plain);
                at += digits;
            }
        }
        text_add(out, (Str){plain, count});
    }
}

static bool strings_same(const char *a, size_t a_length, const char *b, size_t b_length) {
    SCOPED_TEXT first = {0}, second = {0};
    unquote(&first, a, a_length);
    unquote(&second, b, b_length);
    return str_equal(text_str(&first), text_str(&second));
}

// Differences between the numbers of two lines.
typedef struct Spread {
    double distance;             // largest difference between corresponding numbers
    double size;                 // largest absolute value of a number in either line, at least 1
    LineDifference max_position; // position of the largest difference
} Spread;

static bool numbers_same(double a, double b) {
    return a == b || (isnan(a) && isnan(b));
}

static void update_spread(Spread *spread, const Token *expected, const Token *got) {
    double distance = fabs(expected->number - got->number);
    if (distance > spread->distance) {
        spread->distance = distance;
        spread->max_position = (LineDifference){expected->start, got->start};
    }
    spread->size = fmax(spread->size, fmax(fabs(expected->number), fabs(got->number)));
}

static bool tokens_same(Str a, const Token *expected, Str b, const Token *got) {
    if (expected->kind != got->kind)
        return false;
    const char *first = a.bytes + expected->start;
    const char *second = b.bytes + got->start;
    if (expected->kind == TOKEN_NUMBER)
        return numbers_same(expected->number, got->number);
    if (expected->kind == TOKEN_STRING)
        return strings_same(first, expected->length, second, got->length);
    return expected->length == got->length && memcmp(first, second, expected->length) == 0;
}

static bool is_near_number(const Token *expected, const Token *got) {
    return expected->kind == TOKEN_NUMBER && got->kind == TOKEN_NUMBER && isfinite(expected->number) &&
           isfinite(got->number);
}

bool line_same(Str expected, Str got, double tolerance, LineDifference *difference) {
    *difference = (LineDifference){0};
    if (str_equal(expected, got))
        return true;
    // A hash is compared as text, even if its digits look like a number such as 1e99.
    if (expected.len > 0 && expected.bytes[0] == '=')
        return false;
    bool in_key = expected.len > 0 && expected.bytes[0] == '$';
    Spread spread = {.size = 1};
    size_t a = 0, b = 0;
    for (;;) {
        Token first = next_token(expected, a);
        Token second = next_token(got, b);
        if (!in_key && tolerance > 0 && is_near_number(&first, &second)) {
            update_spread(&spread, &first, &second);
        } else if (!tokens_same(expected, &first, got, &second)) {
            *difference = (LineDifference){first.start, second.start};
            return false;
        }
        if (first.kind == TOKEN_END) {
            *difference = spread.max_position;
            return spread.distance <= tolerance * spread.size;
        }
        in_key = in_key && expected.bytes[first.start] != '=';
        a = first.start + first.length;
        b = second.start + second.length;
    }
}
