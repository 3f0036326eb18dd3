// test_syntax_literals.c: numbers, timecodes, strings, symbols and names (language.md L2.4 to L2.8).
#include "ast/literal.h"
#include "parsing.h"

// Each row contains a statement and its tree. Literals are written as printed.
static void check_shapes(World *world, const char *const (*rows)[2], size_t count) {
    for (size_t i = 0; i < count; i++)
        assert_text(rows[i][0], shape(world, rows[i][0]), rows[i][1]);
}

static void test_number_tokens(void **state) {
    static const char *const rows[][2] = {
        {"10m", "0.01"},
        {"5u", "4.9999999999999996e-06"},
        {"5µ", "4.9999999999999996e-06"},
        {"90°", "0.25"},
        {"10deg", "0.02777777777777778"},
        {"2.5e3k", "2500000"},
        {"1_0.5_5e1_0", "105500000000"},
        {"1e400", "inf"},
        {"1e-400", "0"},
        {"1p", "1e-12"},
        {"1n", "1e-09"},
        {"1k", "1000"},
        {"1M", "1000000"},
        {"1G", "1000000000"},
        {"1T", "1000000000000"},
        {".5", "0.5"},
        {"1E+3", "1000"},
        {"0007", "7"},
        {"1...5", "(range 1 0.5 _)"},
        {"1..5.5", "(range 1 5.5 _)"},
        {".5..2", "(range 0.5 2 _)"},
        {"1..5", "(range 1 5 _)"},
        {"1.5.5", "rejected"},
        {"1.", "rejected"},
        {"1_", "rejected"},
        {"1__0", "rejected"},
        {"1_.5", "rejected"},
        {"1._5", "rejected"},
        {"1_k", "rejected"},
        {"1e_5", "rejected"},
        {"0x10", "rejected"},
        {"!a x=1e5m y=2", "(decorate (node a) (attr x 100) (attr y 2))"},
        {"1ex=2", "(decorate 1 (attr ex 2))"}, // an `e` without digits after it is not part of the number
        {"9007199254740993", "9007199254740992"},
        {"5 m=1", "(decorate 5 (attr m 1))"},
        {"!a x=1km=2", "(decorate (node a) (attr x 1000) (attr m 2))"},
    };
    check_shapes(*state, rows, COUNT_OF(rows));
}

static void test_timecode_tokens(void **state) {
    static const char *const rows[][2] = {
        {"1:30", "90"},          {"12:3", "723"},
        {"1:2:3.4", "3723.4"},   {"100:00:00", "360000"},
        {"59:59.5", "3599.5"},   {"0:0", "0"},
        {"60:00", "rejected"},   {"1:60", "rejected"},
        {"1_0:00", "rejected"},  {"x[1:2]", "(index x 62)"},
        {"00:00:09.25", "9.25"}, {"1:2:3:4", "rejected"},
        {"99:59:59", "359999"},  {"1:30k", "rejected"},
    };
    check_shapes(*state, rows, COUNT_OF(rows));
}

static void test_string_tokens(void **state) {
    static const char *const rows[][2] = {
        {"'a'", "'a'"},
        {"\"it's\"", "\"it's\""},
        {"\"a\\x41\\n\\u00e9\\101\\q\"", "'aA\\néA\\\\q'"},
        {"'''a'b''c'''", "\"a'b''c\""},
        {"'''a\nb'''", "'a\\nb'"},
        {"\"\"\"a\"b\"\"c\"\"\"", "'a\"b\"\"c'"},
        {"''''a'''", "\"'a\""},
        {"'''a\\''''", "\"a'\""},
        {"''", "''"},
        {"''''''", "''"},
        {"\"\\0\\12\\400\\1234\"", "'\\x00\\nĀS4'"},
        {"'\\e\\ '", "'\\\\e\\\\ '"},
        {"'\\\\\\'\\\"\\a\\b\\t\\n\\v\\f\\r'", "'\\\\\\'\"\\x07\\x08\\t\\n\\x0b\\x0c\\r'"},
        {"'\\U0001F600'", "'😀'"},
        {"'\\é'", "'\\\\é'"},
        {"'é😀'", "'é😀'"},
        {"'\\x4'", "rejected"},
        {"'\\xg0'", "rejected"},
        {"'\\u12'", "rejected"},
        {"'\\U0001F60'", "rejected"},
        {"'\\U00110000'", "rejected"},
        {"'\\ud800'", "rejected"},
        {"'\\udfff'", "rejected"},
        {"'\\N{DASH}'", "rejected"},
        {"'\\N'", "'\\\\N'"},
        {"'a", "rejected"},
        {"'''abc", "rejected"},
        {"'''abc''", "rejected"},
        {"\"a\nb\"", "rejected"},
        {"'a\\\nb'", "rejected"}, // in a string, a backslash does not join lines
        {"'''a\\\nb'''", "rejected"},
        {"'a' 'b'", "rejected"},
        {"'a\"b'", "'a\"b'"},
    };
    check_shapes(*state, rows, COUNT_OF(rows));
}

static void test_name_tokens(void **state) {
    static const char *const rows[][2] = {
        {"a' ;b", "(compose a' b)"},
        {"x''", "x''"},
        {"a'b", "rejected"},
        {"π;𝜏;_x;é9", "(compose π 𝜏 _x é9)"},
        {"a²", "rejected"},
        {"9a", "rejected"},
        {"x\u0660", "x\u0660"},
        {"\u0660", "rejected"},
        {":a'", ":a'"},
        {"!é", "(node é)"},
        {"!a #t'", "(decorate (node a) (tag t'))"},
        {": a", "rejected"},
        {"!1", "rejected"},
        {"#t", "rejected"},
        {"a!=b", "(!= a b)"},
        {"a !=!b", "(!= a (node b))"},
        {":let", ":let"},
        {"!if", "(node if)"},
        {"a<<b", "(append a b)"},
        {"a< <b", "rejected"},
        {"a**b//c", "(// (** a b) c)"},
        {"\ufeffa", "a"}, // a byte-order mark at the start is skipped
        {"a\ufeff", "rejected"},
        {"a~b", "rejected"},
    };
    check_shapes(*state, rows, COUNT_OF(rows));
}

// L16.3: strings that -D, pragmas and the command line accept as numbers.
static void test_texts_parsed_as_numbers(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double x;
    } good[] = {{"1", 1},     {" -1.5 ", -1.5}, {"+2k", 2000}, {"inf", INFINITY}, {"-inf", -INFINITY},
                {"nan", NAN}, {"1_000", 1000},  {"1e3m", 1},   {".5", 0.5},       {"10deg", 10 * (1.0 / 360)},
                {"-0", -0.0}, {"1E5", 1e5}};
    static const char *const bad[] = {"",   " ",   "-",   "1.",       ".",    "1 2", "1x",   "1__0", "1_",  "_1",  "e5",
                                      "1e", "--1", "Inf", "infinity", "0x10", "k",   "1:30", "1kk",  "1,5", "1\n2"};
    double x;
    for (size_t i = 0; i < COUNT_OF(good); i++) {
        assert_claim(good[i].text, literal_parse_number(str_from(good[i].text), &x));
        assert_number(good[i].text, x, good[i].x);
    }
    for (size_t i = 0; i < COUNT_OF(bad); i++)
        assert_claim(bad[i], !literal_parse_number(str_from(bad[i]), &x));
}

static void test_texts_parsed_as_timecodes(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double x;
    } good[] = {{"1:30", 90}, {"0:5", 5}, {"100:00:00", 360000}, {"1:2:3.25", 3723.25}};
    static const char *const bad[] = {"",     ":",     "1",     "1:",     ":1",    "60:00",   "1:60", "1:2:3:4",
                                      "1:2.", "1:2.x", "-1:30", "1.5:30", "1:123", "x:10:10", "1::2"};
    double x;
    for (size_t i = 0; i < COUNT_OF(good); i++) {
        assert_claim(good[i].text, literal_parse_timecode(str_from(good[i].text), &x));
        assert_number(good[i].text, x, good[i].x);
    }
    for (size_t i = 0; i < COUNT_OF(bad); i++)
        assert_claim(bad[i], !literal_parse_timecode(str_from(bad[i]), &x));
}

TEST_GROUP(syntax_literals) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_number_tokens),           WORLD_TEST(test_timecode_tokens),
        WORLD_TEST(test_string_tokens),           WORLD_TEST(test_name_tokens),
        WORLD_TEST(test_texts_parsed_as_numbers), WORLD_TEST(test_texts_parsed_as_timecodes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
