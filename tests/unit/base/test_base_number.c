// test_base_number.c: conversion of doubles to text and back, in any locale.
#include "base/number.h"
#include "check.h"

#include <locale.h>
#include <stdlib.h>

static const char *printed(double x) {
    static char text[NUMBER_TEXT];
    size_t len = number_format(x, text);
    assert_int_equal(len, strlen(text));
    return text;
}

static const char *printed_short(double x) {
    static char text[NUMBER_TEXT];
    size_t len = number_format_short(x, text);
    assert_int_equal(len, strlen(text));
    return text;
}

static const struct {
    double x;
    const char *shortest, *nine_digits;
} rows[] = {
    {0, "0", "0"},
    {-0.0, "-0", "-0"},
    {1, "1", "1"},
    {-17, "-17", "-17"},
    {0.1, "0.1", "0.1"},
    {-0.1, "-0.1", "-0.1"},
    {0.1 + 0.2, "0.30000000000000004", "0.3"},
    {1.0 / 3, "0.3333333333333333", "0.333333333"},
    {4.35, "4.35", "4.35"},
    {1e-4, "0.0001", "0.0001"},
    {1e-5, "1e-05", "1e-05"},
    {9.5e-5, "9.5e-05", "9.5e-05"},
    {123456789012, "123456789012", "1.23456789e+11"},
    {123456789, "123456789", "123456789"},
    {1e9, "1000000000", "1e+09"},
    {1e15, "1000000000000000", "1e+15"},
    {9007199254740991, "9007199254740991", "9.00719925e+15"},
    {9007199254740992, "9007199254740992", "9.00719925e+15"},
    {9999999999999998, "9999999999999998", "1e+16"},
    {1e16, "1e+16", "1e+16"},
    {1e21, "1e+21", "1e+21"},
    {1e23, "1e+23", "1e+23"},
    {1.2345678901234568e+17, "1.2345678901234568e+17", "1.23456789e+17"},
    {1.5e300, "1.5e+300", "1.5e+300"},
    {0x1p-44, "5.684341886080802e-14", "5.68434189e-14"}, // rounded to 16 digits, it would read back as another
                                                          // number
    {0x1p-24, "5.960464477539063e-08", "5.96046448e-08"},
    {0x1p60, "1.152921504606847e+18", "1.1529215e+18"},
    {0x1p1023, "8.98846567431158e+307", "8.98846567e+307"},
    {1.7976931348623157e308, "1.7976931348623157e+308", "1.79769313e+308"},
    {2.2250738585072014e-308, "2.2250738585072014e-308", "2.22507386e-308"},
    {5e-324, "5e-324", "4.94065646e-324"},
    {INFINITY, "inf", "inf"},
    {-INFINITY, "-inf", "-inf"},
    {NAN, "nan", "nan"},
};

static void test_known_numbers_are_printed(void **state) {
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        assert_text(rows[i].shortest, printed(rows[i].x), rows[i].shortest);
        assert_text(rows[i].nine_digits, printed_short(rows[i].x), rows[i].nine_digits);
    }
    assert_text("nan with a sign", printed(-NAN), "nan");
    assert_text("nan with a sign", printed_short(-NAN), "nan");
}

static uint64_t hash_line(uint64_t hash, const char *text) {
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * 0x100000001b3u;
    return (hash ^ '\n') * 0x100000001b3u;
}

static double of_bits(uint64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

// Compares the FNV-1a hash of all lines with the hash from an independent implementation (Python's repr without ".0").
static void test_powers_of_two_read_back(void **state) {
    (void)state;
    uint64_t hash = 0xcbf29ce484222325u;
    for (int exponent = -1074; exponent <= 1023; exponent++) {
        double x = ldexp(1, exponent);
        assert_number("reads back", number_parse(str_from(printed(x))), x);
        hash = hash_line(hash, printed(x));
    }
    assert_true(hash == UINT64_C(0x3fc860b38cea65d5));
}

static void test_random_numbers_read_back(void **state) {
    (void)state;
    uint64_t seed = 1, hash = 0xcbf29ce484222325u;
    for (int i = 0; i < 100000; i++) {
        double x = of_bits(next_bits(&seed));
        if (!isfinite(x))
            continue;
        assert_number("reads back", number_parse(str_from(printed(x))), x);
        hash = hash_line(hash, printed(x));
    }
    assert_true(hash == UINT64_C(0x1fb3382a90909f4a));
}

// Writes the shortest decimal to `digits` and returns its exponent in d.ddde+XX, by search: the first precision of
// printf whose result reads back. At a power of two, the next higher decimal may be the only one that does.
static int search_shortest(double x, char digits[NUMBER_TEXT]) {
    char text[NUMBER_TEXT];
    for (int precision = x >= 0x1p-1022 ? 15 : 1; precision <= 17;
         precision++) { // 15 digits always have their own double
        snprintf(text, sizeof text, "%.*e", precision - 1, x);
        int binary_exponent;
        char *last = strchr(text, 'e') - 1;
        if (strtod(text, NULL) != x && frexp(x, &binary_exponent) == 0.5 && *last >= '0' && *last < '9')
            ++*last;
        if (strtod(text, NULL) == x)
            break;
    }
    size_t count = 0;
    for (const char *at = text; *at != 'e'; at++)
        if (*at >= '0' && *at <= '9')
            digits[count++] = *at;
    while (count > 1 && digits[count - 1] == '0')
        count--;
    digits[count] = 0;
    return atoi(strchr(text, 'e') + 1);
}

static void check_shortest(double x) {
    char digits[NUMBER_TEXT], wanted[2 * NUMBER_TEXT], *at = wanted;
    int exponent = search_shortest(x, digits), count = (int)strlen(digits);
    if (exponent < -4 || exponent > 15)
        sprintf(wanted, "%c%s%se%c%02d", digits[0], count > 1 ? "." : "", digits + 1, exponent < 0 ? '-' : '+',
                abs(exponent));
    else if (exponent < 0)
        sprintf(wanted, "0.%.*s%s", -exponent - 1, "000", digits);
    else
        for (int i = 0; i < count || i <= exponent; i++)
            at += sprintf(at, "%s%c", i == exponent + 1 ? "." : "", i < count ? digits[i] : '0');
    const char *found = printed(x);
    if (strcmp(found, wanted) != 0)
        fail_msg("%a: %s instead of %s", x, found, wanted);
    if (strtod(found, NULL) != x)
        fail_msg("%a: %s does not read back", x, found);
}

// All exponents, with the first, last and some other significands; these are powers of two, their neighbours, the
// largest and smallest subnormal numbers.
static void test_all_exponents_are_shortest(void **state) {
    (void)state;
    uint64_t seed = 4;
    const uint64_t END = UINT64_C(1) << 52;
    for (uint64_t field = 0; field < 2047; field++) {
        const uint64_t significands[] = {0, 1, 2, 3, END / 2, END - 2, END - 1, next_bits(&seed) % END};
        for (size_t i = 0; i < COUNT_OF(significands); i++)
            if (field > 0 || significands[i] > 0)
                check_shortest(of_bits(field << 52 | significands[i]));
    }
    for (uint64_t bits = 1; bits < 2000; bits++)
        check_shortest(of_bits(bits));
    for (int bit = 0; bit < 52; bit++)
        check_shortest(of_bits(UINT64_C(1) << bit));
}

// Powers of ten, their neighbours, and decimals of all lengths.
static void test_decimals_are_shortest(void **state) {
    (void)state;
    uint64_t seed = 5;
    for (int power = -323; power <= 308; power++) {
        char text[NUMBER_TEXT];
        snprintf(text, sizeof text, "1e%d", power);
        uint64_t bits;
        double x = strtod(text, NULL);
        memcpy(&bits, &x, sizeof bits);
        for (uint64_t near = bits > 4 ? bits - 4 : 1; near <= bits + 4; near++)
            check_shortest(of_bits(near));
        for (int digits = 1; digits <= 17; digits++) {
            uint64_t limit = 1;
            for (int i = 0; i < digits; i++)
                limit *= 10;
            snprintf(text, sizeof text, "%llue%d", (unsigned long long)(1 + next_bits(&seed) % limit), power - digits);
            x = strtod(text, NULL);
            if (x > 0 && isfinite(x))
                check_shortest(x);
        }
    }
}

// Random bits, fractions of the size of coordinates, and integers above 2^53, in equal parts. TRIES=100000000 tries
// that many.
static void test_random_numbers_are_shortest(void **state) {
    (void)state;
    const char *tries = getenv("TRIES");
    uint64_t seed = 6;
    for (long i = tries ? strtol(tries, NULL, 10) : 1000000; i > 0; i--) {
        uint64_t bits = next_bits(&seed);
        double x = i % 3 == 0   ? fabs(of_bits(bits))
                   : i % 3 == 1 ? ldexp((double)(bits >> 11), (int)(bits % 64) - 90)
                                : ldexp((double)(bits >> 11), (int)(bits % 40));
        if (isfinite(x) && x > 0)
            check_shortest(x);
    }
}

static void test_parse_rounds_correctly(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double x;
    } cases[] = {
        {"0", 0},
        {"1_000", 1000},
        {"1_0.5_5e1_0", 105500000000.0},
        {".5", 0.5},
        {"1e400", INFINITY},
        {"1e-400", 0},
        {"1E3", 1000},
        {"2.5e-3", 0.0025},
        {"0.1", 0.1},
        {"-1.5", -1.5},
        {"9007199254740993", 9007199254740992.0},
        {"2.2250738585072011e-308", 2.225073858507201e-308},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++)
        assert_number(cases[i].text, number_parse(str_from(cases[i].text)), cases[i].x);
    // The string may continue after the slice, and may be long.
    assert_number("slice", number_parse((Str){"12345", 2}), 12);
    char digits[501];
    memset(digits, '1', 500);
    digits[1] = '.';
    assert_number("500 digits", number_parse((Str){digits, 500}), 1.1111111111111112);
}

// Results do not depend on the locale. The test uses one with a decimal comma if it is installed.
static void test_locale_has_no_effect(void **state) {
    static const char *const locales[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "nl_NL.UTF-8"};
    const char *found = NULL;
    for (size_t i = 0; i < COUNT_OF(locales) && !found; i++)
        found = setlocale(LC_NUMERIC, locales[i]);
    if (!found)
        skip();
    assert_string_equal(localeconv()->decimal_point, ",");
    test_known_numbers_are_printed(state);
    test_parse_rounds_correctly(state);
    test_powers_of_two_read_back(state);
    setlocale(LC_NUMERIC, "C");
}

// The result has the same bits as floor of the C library, including the sign of zero.
static void test_floor_matches_c(void **state) {
    (void)state;
    static const double numbers[] = {0.0,
                                     -0.0,
                                     0.5,
                                     -0.5,
                                     1,
                                     -1,
                                     1.5,
                                     -1.5,
                                     1e15 + 0.5,
                                     -1e15 - 0.5,
                                     4.5e15,
                                     -4.6e15,
                                     1e300,
                                     -1e300,
                                     INFINITY,
                                     -INFINITY,
                                     NAN,
                                     5e-324,
                                     -5e-324,
                                     0.99999999999999989,
                                     -0.99999999999999989,
                                     2147483648.5,
                                     -2147483648.5};
    for (size_t i = 0; i < COUNT_OF(numbers); i++) {
        double found = number_floor(numbers[i]), wanted = floor(numbers[i]);
        assert_memory_equal(&found, &wanted, sizeof found);
    }
}

TEST_GROUP(base_number) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_floor_matches_c),
        cmocka_unit_test(test_known_numbers_are_printed),
        cmocka_unit_test(test_powers_of_two_read_back),
        cmocka_unit_test(test_random_numbers_read_back),
        cmocka_unit_test(test_all_exponents_are_shortest),
        cmocka_unit_test(test_decimals_are_shortest),
        cmocka_unit_test(test_random_numbers_are_shortest),
        cmocka_unit_test(test_parse_rounds_correctly),
        cmocka_unit_test(test_locale_has_no_effect),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
