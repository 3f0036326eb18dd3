// number.c: see number.h.
#include "base/number.h"

#include "base/heap.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The host may have set a locale whose decimal point is not "."; printf and strtod obey it.
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
    char *copy = digits.len < sizeof local ? local : heap_take(digits.len + 1);
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
        heap_give(copy);
    return x;
}

static size_t format_special(double x, char *text) {
    const char *word = isnan(x) ? "nan" : x < 0 ? "-inf" : "inf";
    strcpy(text, word);
    return strlen(word);
}

// Digits and decimal exponent of the shortest decimal that reads back as x (finite, not 0); returns the digit count.
static int shortest_digits(double x, char digits[20], int *exponent) {
    char text[NUMBER_TEXT];
    char point = decimal_point();
    // A normal double always survives 17 digits, most survive 15, and what survives 15 loses only zeros.
    int precision = fabs(x) >= 2.2250738585072014e-308 ? 15 : 1;
    for (;; precision++) {
        snprintf(text, sizeof text, "%.*e", precision - 1, x);
        if (precision >= 17 || strtod(text, NULL) == x)
            break;
        // At a power of two the interval below is half as wide as that above, so the nearest decimal may miss it
        // while its upper neighbour of equal length does not.
        int binary_exponent;
        if (fabs(frexp(x, &binary_exponent)) == 0.5) {
            char *last = strchr(text, 'e') - 1;
            if (*last >= '0' && *last < '9') {
                ++*last;
                if (strtod(text, NULL) == x)
                    break;
            }
        }
    }
    replace_char(text, point, '.');
    int count = 0;
    const char *at = text;
    for (; *at != 'e'; at++)
        if (*at >= '0' && *at <= '9')
            digits[count++] = *at;
    *exponent = atoi(at + 1);
    while (count > 1 && digits[count - 1] == '0')
        count--;
    return count;
}

// Positional text of an integer below 2^53: the common case by far, without any trial.
static size_t format_integer(long long whole, bool negative, char *text) {
    return (size_t)snprintf(text, NUMBER_TEXT, "%s%lld", negative ? "-" : "", whole);
}

size_t number_format(double x, char text[NUMBER_TEXT]) {
    if (!isfinite(x))
        return format_special(x, text);
    double magnitude = fabs(x);
    if (magnitude < 9007199254740992.0 && magnitude == floor(magnitude))
        return format_integer((long long)magnitude, signbit(x), text);
    char digits[20];
    int exponent;
    int count = shortest_digits(magnitude, digits, &exponent);
    char *at = text;
    if (signbit(x))
        *at++ = '-';
    if (exponent < -4 || exponent > 15) {
        *at++ = digits[0];
        if (count > 1) {
            *at++ = '.';
            memcpy(at, digits + 1, (size_t)count - 1);
            at += count - 1;
        }
        at += sprintf(at, "e%c%02d", exponent < 0 ? '-' : '+', abs(exponent));
    } else if (exponent < 0) {
        *at++ = '0';
        *at++ = '.';
        for (int i = exponent; i < -1; i++)
            *at++ = '0';
        memcpy(at, digits, (size_t)count);
        at += count;
    } else {
        for (int i = 0; i < count || i <= exponent; i++) {
            if (i == exponent + 1)
                *at++ = '.';
            *at++ = i < count ? digits[i] : '0';
        }
    }
    *at = 0;
    return (size_t)(at - text);
}

size_t number_format_short(double x, char text[NUMBER_TEXT]) {
    if (!isfinite(x))
        return format_special(x, text);
    int len = snprintf(text, NUMBER_TEXT, "%.9g", x);
    replace_char(text, decimal_point(), '.');
    return (size_t)len;
}
