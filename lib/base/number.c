// number.c: see number.h.
//
// number_format does not use printf, which is ten times slower and depends on the locale.
#include "base/number.h"

#include "base/heap.h"
#include "base/shortest.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Returns the decimal point that printf and strtod use, which depends on the host's locale.
static char decimal_point(void) {
    const struct lconv *conventions = localeconv();
    return conventions->decimal_point && conventions->decimal_point[0] ? conventions->decimal_point[0] : '.';
}

static void replace_char(char *text, char from, char to) {
    if (from != to)
        for (char *at = strchr(text, from); at; at = strchr(at + 1, from))
            *at = to;
}

double number_parse(Str digits) {
    char local[128];
    char *copy = digits.len < sizeof local ? local : heap_alloc(digits.len + 1);
    if (!copy)
        return NAN;
    size_t len = 0;
    for (size_t i = 0; i < digits.len; i++)
        if (digits.bytes[i] != '_')
            copy[len++] = digits.bytes[i];
    copy[len] = 0;
    replace_char(copy, '.', decimal_point());
    double x = strtod(copy, NULL);
    if (copy != local)
        heap_free(copy);
    return x;
}

static size_t format_special(double x, char *text) {
    const char *word = isnan(x) ? "nan" : x < 0 ? "-inf" : "inf";
    strcpy(text, word);
    return strlen(word);
}

static const char digit_pairs[] = "0001020304050607080910111213141516171819202122232425262728293031323334353637383940"
                                  "4142434445464748495051525354555657585960616263646566676869707172737475767778798081"
                                  "828384858687888990919293949596979899";

static void write_pair(char *at, uint32_t pair) {
    memcpy(at, digit_pairs + 2 * pair, 2);
}

static int count_digits(uint64_t x) {
    int count = 1;
    for (uint64_t limit = 10; x >= limit; limit *= 10)
        count++;
    return count;
}

// Writes the digits of an integer before `end`.
static void write_digits(uint64_t digits, char *end) {
    const uint32_t EIGHT_DIGITS = 100000000;
    for (; digits >= EIGHT_DIGITS; digits /= EIGHT_DIGITS) {
        uint32_t part = (uint32_t)(digits % EIGHT_DIGITS), high = part / 10000, low = part % 10000;
        write_pair(end -= 2, low % 100);
        write_pair(end -= 2, low / 100);
        write_pair(end -= 2, high % 100);
        write_pair(end -= 2, high / 100);
    }
    uint32_t rest = (uint32_t)digits;
    for (; rest >= 100; rest /= 100)
        write_pair(end -= 2, rest % 100);
    if (rest >= 10)
        write_pair(end - 2, rest);
    else
        end[-1] = (char)('0' + rest);
}

// The first 17 digits of a number: one, then two words of eight. The first of eight is in the lowest byte.
typedef struct Digits {
    char first;
    uint64_t words[2];
    int count; // number of digits without zeros at the end
} Digits;

// Returns eight digits, each in a byte, from 0 to 9. Splits 32-bit halves into pairs of digits, and these into digits;
// the factors are 1/100 and 1/10 in binary, rounded up.
static uint64_t eight_digits(uint32_t x) {
    uint64_t parts = x / 10000 | (uint64_t)(x % 10000) << 32;
    uint64_t high = (parts * 5243 >> 19) & UINT64_C(0x0000007f0000007f);
    parts = high | (parts - 100 * high) << 16;
    high = (parts * 103 >> 10) & UINT64_C(0x000f000f000f000f);
    return high | (parts - 10 * high) << 8;
}

static Digits split_digits(uint64_t digits) {
    const uint32_t EIGHT_DIGITS = 100000000;
    uint64_t first = digits / ((uint64_t)EIGHT_DIGITS * EIGHT_DIGITS);
    digits %= (uint64_t)EIGHT_DIGITS * EIGHT_DIGITS;
    uint64_t high = eight_digits((uint32_t)(digits / EIGHT_DIGITS)),
             low = eight_digits((uint32_t)(digits % EIGHT_DIGITS));
    int count = low ? 17 - __builtin_clzll(low) / 8 : high ? 9 - __builtin_clzll(high) / 8 : 1;
    const uint64_t ZEROS = UINT64_C(0x3030303030303030);
    return (Digits){(char)('0' + first), {high | ZEROS, low | ZEROS}, count};
}

static void write_number_word(char *at, uint64_t word) {
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    word = __builtin_bswap64(word);
#endif
    memcpy(at, &word, sizeof word);
}

static void write_all(char *at, const Digits *digits) {
    *at = digits->first;
    write_number_word(at + 1, digits->words[0]);
    write_number_word(at + 9, digits->words[1]);
}

static char *write_scientific(char *at, const Digits *digits, int exponent) {
    write_all(at + 1, digits);
    at[0] = at[1];
    at[1] = '.';
    at += digits->count > 1 ? digits->count + 1 : 1;
    *at++ = 'e';
    *at++ = exponent < 0 ? '-' : '+';
    uint32_t magnitude = (uint32_t)abs(exponent);
    if (magnitude >= 100)
        *at++ = (char)('0' + magnitude / 100);
    write_pair(at, magnitude % 100);
    return at + 2;
}

// Writes the decimal point after `whole` digits.
static char *write_fixed(char *at, const Digits *digits, int whole) {
    if (digits->count <= whole) {
        write_all(at, digits);
        return at + whole;
    }
    write_all(at + 1, digits);
    if (whole < 8) { // the usual case; reading the bytes again would wait for the processor to write them
        uint64_t first = (unsigned char)digits->first | digits->words[0] << 8;
        uint64_t mask = ((uint64_t)1 << 8 * whole) - 1;
        write_number_word(at, (first & mask) | (uint64_t)'.' << 8 * whole | (first & ~mask) << 8);
    } else {
        memmove(at, at + 1, (size_t)whole);
        at[whole] = '.';
    }
    return at + digits->count + 1;
}

// Writes a positive number. Returns its end.
static char *write_decimal(char *at, Decimal decimal) {
    const uint64_t MIN_17_DIGITS = 10000000000000000;
    bool shorter = decimal.digits < MIN_17_DIGITS; // often, so without a branch
    int exponent = decimal.exponent + 16 - shorter;
    decimal.digits *= shorter ? 10 : 1;
    for (; decimal.digits < MIN_17_DIGITS; decimal.digits *= 10)
        exponent--;
    Digits digits = split_digits(decimal.digits);
    if (exponent < -4 || exponent > 15)
        return write_scientific(at, &digits, exponent);
    if (exponent >= 0)
        return write_fixed(at, &digits, exponent + 1);
    static const char zeros[] = {'0', '.', '0', '0', '0'};
    memcpy(at, zeros, sizeof zeros);
    at += 1 - exponent;
    write_all(at, &digits);
    return at + digits.count;
}

size_t number_format(double x, char text[NUMBER_TEXT]) {
    if (!isfinite(x))
        return format_special(x, text);
    double magnitude = fabs(x);
    char *at = text;
    if (signbit(x))
        *at++ = '-';
    uint64_t whole = magnitude < 9007199254740992.0 ? (uint64_t)magnitude : 0;
    if (magnitude != (double)whole) {
        at = write_decimal(at, number_shortest(magnitude));
    } else if (whole < 10) { // by far the most common case
        *at++ = (char)('0' + whole);
    } else {
        at += count_digits(whole);
        write_digits(whole, at);
    }
    *at = 0;
    return (size_t)(at - text);
}

void text_add_number(Text *text, double x) {
    text->len += number_format(x, text_reserve(text, NUMBER_TEXT));
}

size_t number_format_short(double x, char text[NUMBER_TEXT]) {
    if (!isfinite(x))
        return format_special(x, text);
    int len = snprintf(text, NUMBER_TEXT, "%.9g", x);
    replace_char(text, decimal_point(), '.');
    return (size_t)len;
}
