// test_base_unicode.c: the character classes of language.md L2.4 and L18.1.
#include "base/unicode.h"
#include "check.h"

// Number of code points in each class of name_ranges.txt (Unicode 16.0), and their sum.
static void test_classes_match_name_ranges(void **state) {
    (void)state;
    uint64_t letters = 0, letter_hash = 0, digits = 0, digit_hash = 0;
    for (uint32_t c = 0; c <= 0x10ffff; c++) {
        bool starts = unicode_starts_name(c), continues = unicode_continues_name(c);
        if (c == '_') {
            assert_true(starts && continues);
        } else if (starts) {
            assert_true(continues);
            letters++;
            letter_hash = letter_hash * 31 + c;
        } else if (continues) {
            digits++;
            digit_hash = digit_hash * 31 + c;
        }
    }
    assert_int_equal(letters, 142759);
    assert_true(letter_hash == UINT64_C(0xd670d6c76944a0b));
    assert_int_equal(digits, 760);
    assert_true(digit_hash == UINT64_C(0xf217e0ea40761edc));
}

static void test_name_characters(void **state) {
    (void)state;
    static const uint32_t starts[] = {'a', 'Z', '_', 0xb5, 0xe9, 0x3c0, 0x1d70f, 0x2160, 0x345, 0x24b6, 0x4e00};
    static const uint32_t continues[] = {'0', '9', 0x660, 0x1d7ce};
    static const uint32_t neither[] = {'\'', ' ', '-', 0xb0, 0xb2, 0x300, 0xa0, 0x2028, 0xfeff, 0x1f600, 0x110000};
    for (size_t i = 0; i < COUNT_OF(starts); i++)
        assert_true(unicode_starts_name(starts[i]) && unicode_continues_name(starts[i]));
    for (size_t i = 0; i < COUNT_OF(continues); i++)
        assert_true(!unicode_starts_name(continues[i]) && unicode_continues_name(continues[i]));
    for (size_t i = 0; i < COUNT_OF(neither); i++)
        assert_true(!unicode_starts_name(neither[i]) && !unicode_continues_name(neither[i]));
}

static void test_printable_characters(void **state) {
    (void)state;
    static const uint32_t printable[] = {' ', '~', 0xa1, 0xe9, 0x300, 0xb2, 0xfffd, 0x1f600, 0x4e00};
    // The categories Cc, Cf, Cs, Co, Cn, Zl and Zp, and Zs except the space.
    static const uint32_t unprintable[] = {0,      9,      0x1f,   0x7f,   0x80,   0x9f,   0xa0,  0xad,    0x2003,
                                           0x3000, 0x2028, 0x2029, 0xfeff, 0xd800, 0xe000, 0x378, 0x10ffff};
    for (size_t i = 0; i < COUNT_OF(printable); i++)
        assert_true(unicode_is_printable(printable[i]));
    for (size_t i = 0; i < COUNT_OF(unprintable); i++)
        assert_false(unicode_is_printable(unprintable[i]));
}

TEST_GROUP(base_unicode) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_classes_match_name_ranges),
        cmocka_unit_test(test_name_characters),
        cmocka_unit_test(test_printable_characters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
