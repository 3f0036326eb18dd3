// number.c: see number.h.
//
// number_format writes the shortest decimal that parses as the same double. It has three methods, from the fastest to
// the most general: for integers, for fractions in 128-bit integers, and by trial with printf.
#include "base/number.h"

#include "base/heap.h"

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

// A positive decimal number in the form d.ddd * 10^exponent. `digits` holds `count` digits, and the decimal point is
// after the first.
typedef struct Decimal {
    char digits[20];
    int count;
    int exponent;
} Decimal;

static void drop_zeros(Decimal *decimal) {
    while (decimal->count > 1 && decimal->digits[decimal->count - 1] == '0')
        decimal->count--;
}

__extension__ typedef unsigned __int128 Product;

enum { MAX_DIGITS = 17 };
// Smallest x for which integer arithmetic is used. Its scale (see Scaled) is 21, and 5^21 has 49 bits.
#define MIN_FRACTION 1e-5
#define MIN_17_DIGITS 10000000000000000u // smallest integer with 17 digits

// A double x = significand * 2^exponent, represented exactly as product * 2^-shift in units of 10^-scale. For x from
// MIN_FRACTION to 2^53 the product is below 2^53 * 5^21 < 2^102.
typedef struct Scaled {
    Product product;
    Product power; // 5^scale; also the distance between x and the next double, in the unit of `product`
    int shift;
} Scaled;

static bool scale_by(Scaled *scaled, uint64_t significand, int exponent, int scale) {
    scaled->power = 1;
    for (int i = 0; i < scale; i++)
        scaled->power *= 5;
    scaled->product = significand * scaled->power;
    scaled->shift = -(exponent + scale);
    return scale > 0 && scaled->shift > 0;
}

// Returns true if the decimal whole * 10^-scale parses as x. It does if its distance to x is less than half the
// distance between x and the next double.
static bool reads_back(const Scaled *scaled, uint64_t whole) {
    Product there = (Product)whole << scaled->shift;
    Product distance = there > scaled->product ? there - scaled->product : scaled->product - there;
    return 2 * distance < scaled->power; // never equal, because a power of five is odd
}

// Returns x in units of 10^-scale, rounded to a multiple of `unit`, which is a power of ten. Ties are rounded to the
// even multiple.
static uint64_t round_units(const Scaled *scaled, uint64_t unit) {
    Product rest = scaled->product & (((Product)1 << scaled->shift) - 1);
    uint64_t units = (uint64_t)(scaled->product >> scaled->shift), whole = units / unit;
    rest += (Product)(units % unit) << scaled->shift;
    Product half = ((Product)unit << scaled->shift) / 2;
    return (whole + (rest > half || (rest == half && whole % 2 == 1))) * unit;
}

// Uses integer arithmetic to find the shortest decimal that parses as x. Returns false for the few x to which this
// method does not apply.
static bool shortest_of_fraction(double x, Decimal *decimal) {
    int exponent;
    uint64_t significand = (uint64_t)ldexp(frexp(x, &exponent), 53);
    exponent -= 53;
    // Powers of two are excluded, because the next lower double is nearer to x than the next higher one.
    if (!(x >= MIN_FRACTION && x < 9007199254740992.0) || significand == UINT64_C(1) << 52)
        return false;
    // `first` estimates the decimal exponent of x, and is exact or too low by one. 78913 / 2^18 approximates log10(2).
    int first = (int)floor((exponent + 52) * (78913.0 / 262144));
    Scaled scaled;
    if (!scale_by(&scaled, significand, exponent, MAX_DIGITS - 1 - first))
        return false;
    if (scaled.product >> scaled.shift >= (Product)10 * MIN_17_DIGITS) {
        first++;
        if (!scale_by(&scaled, significand, exponent, MAX_DIGITS - 1 - first))
            return false;
    }
    uint64_t units = 0, unit = 100;
    for (; unit > 0; unit /= 10) {
        units = round_units(&scaled, unit);
        if (unit == 1 || reads_back(&scaled, units))
            break;
    }
    if (units < MIN_17_DIGITS || units >= 10 * MIN_17_DIGITS)
        return false;
    decimal->count = MAX_DIGITS;
    decimal->exponent = first;
    for (int i = MAX_DIGITS - 1; i >= 0; i--, units /= 10)
        decimal->digits[i] = (char)('0' + units % 10);
    drop_zeros(decimal);
    return true;
}

// Finds the shortest decimal for any finite x other than 0 by increasing the precision until the result parses as x.
static void shortest_by_trial(double x, Decimal *decimal) {
    char text[NUMBER_TEXT];
    char point = decimal_point();
    // 17 digits suffice for every normal double. 15 suffice for most, so the trial starts with 15 digits. Trailing
    // zeros are dropped below.
    int precision = fabs(x) >= 2.2250738585072014e-308 ? 15 : 1;
    for (;; precision++) {
        snprintf(text, sizeof text, "%.*e", precision - 1, x);
        if (precision >= 17 || strtod(text, NULL) == x)
            break;
        // At a power of two, the interval of decimals that parse as x is half as wide below x as above. So the nearest
        // decimal may be outside that interval while the next higher decimal of the same length is inside.
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
    decimal->count = 0;
    const char *at = text;
    for (; *at != 'e'; at++)
        if (*at >= '0' && *at <= '9')
            decimal->digits[decimal->count++] = *at;
    decimal->exponent = atoi(at + 1);
    drop_zeros(decimal);
}

// Writes an integer below 2^53, by far the most common case. Returns the length.
static size_t format_integer(long long whole, bool negative, char *text) {
    char digits[20], *first = digits + sizeof digits, *at = text;
    do
        *--first = (char)('0' + whole % 10);
    while ((whole /= 10) > 0);
    if (negative)
        *at++ = '-';
    size_t length = (size_t)(digits + sizeof digits - first);
    memcpy(at, first, length);
    at[length] = 0;
    return (size_t)(at - text) + length;
}

size_t number_format(double x, char text[NUMBER_TEXT]) {
    if (!isfinite(x))
        return format_special(x, text);
    double magnitude = fabs(x);
    if (magnitude < 9007199254740992.0 && magnitude == floor(magnitude))
        return format_integer((long long)magnitude, signbit(x), text);
    Decimal decimal;
    if (!shortest_of_fraction(magnitude, &decimal))
        shortest_by_trial(magnitude, &decimal);
    const char *digits = decimal.digits;
    int count = decimal.count, exponent = decimal.exponent;
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

void text_add_number(Text *text, double x) {
    char digits[NUMBER_TEXT];
    text_add(text, (Str){digits, number_format(x, digits)});
}

size_t number_format_short(double x, char text[NUMBER_TEXT]) {
    if (!isfinite(x))
        return format_special(x, text);
    int len = snprintf(text, NUMBER_TEXT, "%.9g", x);
    replace_char(text, decimal_point(), '.');
    return (size_t)len;
}
