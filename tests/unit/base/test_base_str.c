// test_base_str.c: text slices, UTF-8 and the text buffer.
#include "base/str.h"
#include "check.h"

static int32_t decode(const char *bytes, size_t len, size_t *used) {
    size_t at = 0;
    int32_t c = utf8_next((Str){bytes, len}, &at);
    *used = at;
    return c;
}

// Every code point is unchanged after encoding and decoding, and its encoding has the right length.
static void test_utf8_round_trip(void **state) {
    (void)state;
    for (uint32_t c = 0; c <= 0x10ffff; c += c < 0x3000 ? 1 : 97) {
        if (c >= 0xd800 && c <= 0xdfff)
            continue;
        char bytes[UTF8_MAX];
        size_t used, len = utf8_encode(c, bytes);
        assert_int_equal(len, c < 0x80 ? 1 : c < 0x800 ? 2 : c < 0x10000 ? 3 : 4);
        assert_int_equal(decode(bytes, len, &used), c);
        assert_int_equal(used, len);
    }
}

// The first byte of each string is ill-formed: utf8_next returns -1 and skips one byte.
static void test_utf8_rejects_ill_formed_bytes(void **state) {
    (void)state;
    static const struct {
        const char *bytes;
        size_t len;
        const char *why;
    } rows[] = {
        {"\x80", 1, "continuation alone"},
        {"\xbf", 1, "last continuation alone"},
        {"\xc0\x80", 2, "overlong NUL"},
        {"\xc1\xbf", 2, "overlong, two bytes"},
        {"\xe0\x80\x80", 3, "overlong, three bytes"},
        {"\xe0\x9f\xbf", 3, "overlong U+07FF"},
        {"\xf0\x80\x80\x80", 4, "overlong, four bytes"},
        {"\xf0\x8f\xbf\xbf", 4, "overlong U+FFFF"},
        {"\xed\xa0\x80", 3, "first surrogate"},
        {"\xed\xbf\xbf", 3, "last surrogate"},
        {"\xf4\x90\x80\x80", 4, "U+110000"},
        {"\xf5\x80\x80\x80", 4, "lead byte too large"},
        {"\xfe", 1, "FE"},
        {"\xff", 1, "FF"},
        {"\xc3", 1, "cut after one of two"},
        {"\xe2\x82", 2, "cut after two of three"},
        {"\xf0\x9f\x98", 3, "cut after three of four"},
        {"\xc3(", 2, "bad second byte"},
        {"\xe2\x82(", 3, "bad third byte"},
        {"\xf0\x9f\x98(", 4, "bad fourth byte"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        size_t used;
        assert_claim(rows[i].why, decode(rows[i].bytes, rows[i].len, &used) == -1);
        assert_claim(rows[i].why, used == 1);
        assert_claim(rows[i].why, utf8_find_error((Str){rows[i].bytes, rows[i].len}) == 0);
    }
    // First and last well-formed sequences of each length.
    static const char *const good[] = {"\x7f",         "\xc2\x80",         "\xe0\xa0\x80",     "\xed\x9f\xbf",
                                       "\xee\x80\x80", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf", "\xef\xbf\xbf"};
    for (size_t i = 0; i < COUNT_OF(good); i++)
        assert_int_equal(utf8_find_error(str_from(good[i])), strlen(good[i]));
}

static void test_utf8_find_error_and_length(void **state) {
    (void)state;
    assert_int_equal(utf8_find_error(STR("aé\xff"
                                         "b")),
                     3);
    assert_int_equal(utf8_find_error(STR("")), 0);
    assert_int_equal(utf8_length(STR("")), 0);
    assert_int_equal(utf8_length(STR("aé€😀")), 4);
    assert_int_equal(utf8_length(STR("\xff\xfe"
                                     "a")),
                     3);
    assert_int_equal(utf8_length(STR("a\0b")), 3);
}

static void test_compare_orders_by_bytes(void **state) {
    (void)state;
    static const struct {
        const char *a, *b;
        int order;
    } rows[] = {{"", "", 0},   {"", "a", -1},     {"a", "a", 0},  {"a", "b", -1}, {"ab", "a", 1},    {"B", "a", -1},
                {"é", "z", 1}, {"\x7f", "é", -1}, {"ﬀ", "😀", -1}, {"a", "", 1},   {"abc", "abd", -1}};
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        assert_claim(rows[i].a, str_compare(str_from(rows[i].a), str_from(rows[i].b)) == rows[i].order);
        assert_claim(rows[i].a, str_equal(str_from(rows[i].a), str_from(rows[i].b)) == (rows[i].order == 0));
    }
    assert_true(str_equal((Str){0}, STR("")));
    assert_false(str_equal(STR("a\0b"), STR("a\0c")));
}

static void test_prefix_suffix_trim(void **state) {
    (void)state;
    assert_true(str_starts_with(STR("inf"), STR("in")));
    assert_false(str_starts_with(STR("i"), STR("in")));
    assert_true(str_ends_with(STR("90deg"), STR("deg")));
    assert_false(str_ends_with(STR("eg"), STR("deg")));
    assert_true(str_starts_with(STR("x"), STR("")));
    assert_true(str_ends_with(STR("x"), STR("")));
    assert_true(str_starts_with((Str){0}, (Str){0})); // an empty slice may have a NULL pointer, which must not be read
    assert_true(str_ends_with((Str){0}, (Str){0}));
    assert_true(str_equal(str_trim(STR(" \t\r\n\v\f x y \n")), STR("x y")));
    assert_int_equal(str_trim(STR(" \t ")).len, 0);
    assert_int_equal(str_trim((Str){0}).len, 0);
}

static void test_edit_distance_counts_edits(void **state) {
    (void)state;
    static const struct {
        const char *a, *b;
        int distance;
    } rows[] = {
        {"", "", 0},
        {"abc", "abc", 0},
        {"", "abc", 3},
        {"abc", "", 3},
        {"mass", "mas", 1},
        {"mass", "masss", 1},
        {"mass", "muss", 1},
        {"mass", "amss", 1},
        {"ab", "ba", 1},
        {"ca", "abc", 3},
        {"kitten", "sitting", 3},
        {"strenght", "strength", 1},
        {"radius", "charge", 6},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        assert_claim(rows[i].a, str_edit_distance(str_from(rows[i].a), str_from(rows[i].b)) == rows[i].distance);
        assert_claim(rows[i].a, str_edit_distance(str_from(rows[i].b), str_from(rows[i].a)) == rows[i].distance);
    }
    char longer[65], shorter[64];
    memset(longer, 'x', sizeof longer);
    memset(shorter, 'x', sizeof shorter);
    assert_int_equal(str_edit_distance((Str){longer, 65}, (Str){longer, 65}),
                     64); // strings longer than 64 bytes have the maximum distance
    assert_int_equal(str_edit_distance((Str){shorter, 64}, (Str){shorter, 63}), 1);
}

static void test_text_buffer_grows(void **state) {
    (void)state;
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    Text text = text_new(&arena);
    assert_int_equal(text_str(&text).len, 0);
    text_add(&text, STR("a"));
    text_add(&text, (Str){0});
    text_add_c(&text, "b");
    text_add_char(&text, 'c');
    text_add_code_point(&text, 0x1f600);
    text_add_format(&text, "%d-%s", 12, "x");
    assert_true(str_equal(text_str(&text), STR("abc😀12-x")));
    for (int i = 0; i < 1000; i++)
        text_add_format(&text, "%03d", i);
    assert_int_equal(text_str(&text).len, 3 + 4 + 4 + 3000);
    assert_true(str_ends_with(text_str(&text), STR("997998999")));
    assert_true(str_equal(str_format(&arena, "%s=%g", "x", 0.5), STR("x=0.5")));
    char *copy = str_to_c(&arena, (Str){"petrify", 5});
    assert_string_equal(copy, "petri");
    assert_string_equal(str_to_c(&arena, (Str){0}), "");
    arena_free(&arena);
}

static void test_bytes_become_hexadecimal_digits(void **state) {
    (void)state;
    Text text = {0};
    uint8_t bytes[256];
    for (int i = 0; i < 256; i++)
        bytes[i] = (uint8_t)i;
    text_add_c(&text, "");
    text_add_hex(&text, bytes, 0);
    assert_string_equal(text.bytes, "");
    text_add_hex(&text, bytes, sizeof bytes);
    assert_int_equal(text.len, 512);
    for (size_t i = 0; i < 256; i++) {
        char digits[3];
        snprintf(digits, sizeof digits, "%02x", bytes[i]);
        assert_memory_equal(text.bytes + 2 * i, digits, 2);
    }
    text_free(&text);
}

static void test_hex_colours_become_numbers(void **state) {
    (void)state;
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    static const struct {
        const char *text, *wanted;
    } rows[] = {
        {"#ff8800", "1;0.533;0"},
        {"#f80", "1;0.533;0"},
        {"0xFF8800", "1;0.533;0"},
        {"#000", "0;0;0"},
        {"#fff8", "1;1;1;0.533"},
        {"#01020380", "0.004;0.008;0.012;0.502"},
        {"#f80 a=1", "1;0.533;0"},
        {"#f80)", "1;0.533;0"},
        {"#f8", ""},
        {"#f8000", ""},
        {"#ffg", ""},
        {"#", ""},
        {"ff8800", ""},
        {"", ""},
        {"#ff8800f_", ""},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        Text text = text_new(&arena);
        bool added = text_add_hex_colour(&text, str_from(rows[i].text));
        assert_string_equal(str_to_c(&arena, text_str(&text)), rows[i].wanted);
        assert_true(added == (rows[i].wanted[0] != 0));
    }
    arena_free(&arena);
}

static void test_word_number_is_index_in_list(void **state) {
    (void)state;
    assert_int_equal(str_word_number(STR("one"), "one two three"), 0);
    assert_int_equal(str_word_number(STR("three"), "one two three"), 2);
    assert_int_equal(str_word_number(STR("thre"), "one two three"), -1);
    assert_int_equal(str_word_number(STR(""), "one two three"), -1);
    assert_int_equal(str_word_number(STR("one"), ""), -1);
}

static void test_split_keeps_empty_parts(void **state) {
    (void)state;
    char text[] = "one,,two,";
    char *rest = text;
    assert_string_equal(str_split(&rest, ','), "one");
    assert_string_equal(str_split(&rest, ','), "");
    assert_string_equal(str_split(&rest, ','), "two");
    assert_string_equal(str_split(&rest, ','), "");
    assert_null(rest);
    assert_null(str_split(&rest, ','));
}

TEST_GROUP(base_str) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_utf8_round_trip),
        cmocka_unit_test(test_utf8_rejects_ill_formed_bytes),
        cmocka_unit_test(test_utf8_find_error_and_length),
        cmocka_unit_test(test_compare_orders_by_bytes),
        cmocka_unit_test(test_prefix_suffix_trim),
        cmocka_unit_test(test_edit_distance_counts_edits),
        cmocka_unit_test(test_text_buffer_grows),
        cmocka_unit_test(test_bytes_become_hexadecimal_digits),
        cmocka_unit_test(test_hex_colours_become_numbers),
        cmocka_unit_test(test_split_keeps_empty_parts),
        cmocka_unit_test(test_word_number_is_index_in_list),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
