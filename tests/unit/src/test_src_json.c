// test_src_json.c: tests of the reader and the writer of JSON: src/cli/json.c.
#include "captured.h"
#include "cli/json.h"

#include <locale.h>
#include <math.h>

static const JsonWriter STYLES[] = {{0}, {.spaced = true}, {.short_escapes = true}};

// Numbers of a fixed sequence.
static uint64_t next_random(uint64_t *random) {
    *random += 0x9e3779b97f4a7c15;
    uint64_t x = *random;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
    x = (x ^ x >> 27) * 0x94d049bb133111eb;
    return x ^ x >> 31;
}

// Adds what is read from the text, in a style. Returns false if the text is not JSON.
static bool rewrite(Text *out, Str text, JsonWriter style) {
    SCOPED_JSON document = {0};
    const Json *value = json_read(&document, text, 100);
    text_add_c(out, "");
    style.out = out;
    if (value)
        json_put(&style, NULL, value);
    return value;
}

static bool is_valid(const char *text) {
    SCOPED_TEXT out = {0};
    return rewrite(&out, str_from(text), STYLES[0]);
}

static void test_strings_are_escaped(void **state) {
    (void)state;
    static const char *const rows[][3] = {
        {NULL, "null", "null"},
        {"", "\"\"", "\"\""},
        {"a\"b\\c/d", "\"a\\\"b\\\\c/d\"", "\"a\\\"b\\\\c/d\""},
        {"\n\t\x01\x7f", "\"\\u000a\\u0009\\u0001\x7f\"", "\"\\n\\t\\u0001\x7f\""},
        {"\b\f\r", "\"\\u0008\\u000c\\u000d\"", "\"\\b\\f\\r\""},
        {"ä€😀", "\"ä€😀\"", "\"ä€😀\""},
        {"a\xff"
         "b\xc3",
         "\"a\\ufffdb\\ufffd\"", "\"a\\ufffdb\\ufffd\""},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        SCOPED_TEXT plain = {0}, shorter = {0};
        json_put_text(&(JsonWriter){.out = &plain}, NULL, rows[i][0]);
        json_put_text(&(JsonWriter){.out = &shorter, .short_escapes = true}, NULL, rows[i][0]);
        assert_text(rows[i][1], plain.bytes, rows[i][1]);
        assert_text(rows[i][2], shorter.bytes, rows[i][2]);
    }
}

static void test_commas_separate_values(void **state) {
    (void)state;
    SCOPED_TEXT out = {0};
    JsonWriter json = {.out = &out, .spaced = true};
    json_open(&json, NULL, "{");
    JSON_PUT_TEXTS(&json, "a:", "{", "b", "[");
    json_open(&json, "list", "[[");
    json_close(&json, "]");
    json_put_bool(&json, NULL, true);
    json_put_number(&json, NULL, INFINITY);
    json_put_integer(&json, NULL, INT64_MIN);
    json.spaced = false;
    json_put_written(&json, NULL, (Str){0});
    json_close(&json, "]}");
    assert_string_equal(out.bytes,
                        "{\"a:\": \"{\", \"b\": \"[\", \"list\": [[], true, null, -9223372036854775808,null]}");
}

static void test_canonical_texts_are_written_as_they_were_read(void **state) {
    (void)state;
    static const char *const texts[] = {
        "null",
        "true",
        "false",
        "0",
        "-0",
        "1.50e+007",
        "9223372036854775808",
        "1e999",
        "\"\"",
        "\"\\u0000\"",
        "[]",
        "{}",
        "[[[]]]",
        "[1,[2,{}],\"3\"]",
        "{\"\":null}",
        "{\"a\":{\"a\":[{\"a\":1}]},\"b\":false}",
        "{\"a\\u0000b\":1,\"a\":2,\"a\\u0000\":3}",
        "\"{[: \\u000a\"",
        "[\":\",\"{\",\" \"]",
    };
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        SCOPED_TEXT out = {0};
        assert_true(rewrite(&out, str_from(texts[i]), STYLES[0]));
        assert_text(texts[i], out.bytes, texts[i]);
    }
}

// Adds a random value. A third of the values above depth 0 are arrays and objects.
static void put_random(JsonWriter *json, const char *name, uint64_t *random, unsigned depth) {
    uint64_t kind = next_random(random) % (depth > 0 ? 9 : 6), count = next_random(random) % 5;
    if (kind >= 6) {
        json_open(json, name, kind == 6 ? "[" : "{");
        for (uint64_t i = 0; i < count; i++) {
            char member[40];
            snprintf(member, sizeof member, "%d\n\"€%d", (int)i, (int)(next_random(random) % 100));
            put_random(json, kind == 6 ? NULL : member, random, depth - 1);
        }
        json_close(json, kind == 6 ? "]" : "}");
    } else if (kind == 5) {
        char bytes[5];
        for (size_t i = 0; i < sizeof bytes; i++)
            bytes[i] = (char)next_random(random);
        json_put_str(json, name, (Str){bytes, count});
    } else if (kind == 4) {
        double x;
        uint64_t bits = next_random(random);
        memcpy(&x, &bits, sizeof x);
        json_put_number(json, name, x);
    } else {
        static const Str words[] = {{"null", 4}, {"true", 4}, {"false", 5}, {"-12", 3}};
        json_put_written(json, name, words[kind]);
    }
}

static void test_random_values_are_written_as_they_were_read(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 3000; seed++) {
        SCOPED_TEXT text = {0}, again = {0}, other = {0}, back = {0};
        uint64_t random = seed;
        JsonWriter json = STYLES[seed % COUNT_OF(STYLES)];
        json.out = &text;
        put_random(&json, NULL, &random, 6);
        assert_true(rewrite(&again, text_str(&text), json));
        // Invalid UTF-8 is written as an escape, which is read as U+FFFD.
        assert_true(rewrite(&other, text_str(&again), STYLES[(seed + 1) % COUNT_OF(STYLES)]));
        assert_true(rewrite(&back, text_str(&other), json));
        assert_string_equal(back.bytes, again.bytes);
        if (!strstr(text.bytes, "ufffd"))
            assert_string_equal(again.bytes, text.bytes);
    }
}

static void test_doubles_keep_their_bits(void **state) {
    (void)state;
    bool comma = setlocale(LC_NUMERIC, "de_DE.UTF-8");
    (void)comma; // if the system has this locale, its decimal comma must not matter
    for (uint64_t seed = 0; seed < 3000; seed++) {
        SCOPED_TEXT text = {0};
        SCOPED_JSON document = {0};
        uint64_t random = seed, bits = next_random(&random);
        double x, y;
        memcpy(&x, &bits, sizeof x);
        if (!isfinite(x))
            continue;
        json_put_number(&(JsonWriter){.out = &text}, NULL, x);
        y = json_number(json_read(&document, text_str(&text), 0));
        assert_memory_equal(&x, &y, sizeof x);
    }
    setlocale(LC_NUMERIC, "C");
}

static void test_texts_that_are_not_json_are_rejected(void **state) {
    (void)state;
    static const char *const texts[] = {
        // structure
        "",
        " ",
        "[",
        "]",
        "{",
        "}",
        "[}",
        "{]",
        "[1",
        "[1}",
        "{\"a\":1",
        "{\"a\":1]",
        "1 2",
        "[]]",
        "{}{}",
        "[1 2]",
        "[1,]",
        "[,1]",
        "[,]",
        "[1,,2]",
        "{\"a\" 1}",
        "{\"a\":}",
        "{\"a\"}",
        "{\"a\":1,}",
        "{,}",
        "{\"a\":1 \"b\":2}",
        "{\"a\":1,,\"b\":2}",
        "{\"a\":1:2}",
        "{\"a\"::1}",
        "{1:2}",
        "{a:1}",
        "{null:1}",
        "{[]:1}",
        "[\"a\":1]",
        ":",
        ",",
        "\"a\":1",
        "[1]x",
        "x",
        "{\"a\":1}}",
        "[[1]",
        "{\"a\",\"b\"}",
        "{\"a\":1,\"b\"}",
        // words
        "nul",
        "nulll",
        "True",
        "NULL",
        "NaN",
        "Infinity",
        "-Infinity",
        "undefined",
        "truefalse",
        "t",
        "[tru]",
        // numbers
        "01",
        "-",
        "-a",
        "+1",
        "1.",
        ".5",
        "-.5",
        "1e",
        "1e+",
        "1.e3",
        "1.5.2",
        "1e5.5",
        "0x10",
        "1_000",
        "--1",
        "1-",
        "00",
        "-01",
        "1,5",
        "[1.]",
        "١",
        // strings
        "\"",
        "\"a",
        "'a'",
        "\"\\\"",
        "\"\\x41\"",
        "\"\\a\"",
        "\"\\u12\"",
        "\"\\u12g4\"",
        "\"\\u",
        "\"\\",
        "\"\\U0041\"",
        "\"a\nb\"",
        "\"\t\"",
        "\"\x01\"",
        "\"\xff\"",
        "\"\xc0\xaf\"",
        "\"\xed\xa0\x80\"",
        "\"\xf4\x90\x80\x80\"",
        "[\"\\uD800\\u12\"]",
        // other characters
        "\xef\xbb\xbf[]",
        "[1]\x0b",
        "\f1",
        "[1]\xc2\xa0",
        "// a\n1",
        "/* a */ 1",
        "[1/**/]",
        "#1",
        "\xff",
    };
    for (size_t i = 0; i < COUNT_OF(texts); i++)
        assert_text(texts[i], is_valid(texts[i]) ? "accepted" : "rejected", "rejected");
    SCOPED_TEXT out = {0};
    assert_false(rewrite(&out, (Str){"1\0", 2}, STYLES[0]));
    assert_false(rewrite(&out, (Str){"[1]\0 ", 5}, STYLES[0]));
    assert_false(rewrite(&out, (Str){"\"a\0b\"", 5}, STYLES[0]));
    assert_false(rewrite(&out, (Str){NULL, 0}, STYLES[0]));
}

static void test_white_space_and_escapes_are_removed(void **state) {
    (void)state;
    static const char *const rows[][2] = {
        {" \t\r\n[ 1 , 2\n]\n", "[1,2]"},
        {"{ \"a\" : { } , \"b\" : [ ] }", "{\"a\":{},\"b\":[]}"},
        {"\"\\\"\\\\\\/\\b\\f\\n\\r\\t\"", "\"\\\"\\\\/\\u0008\\u000c\\u000a\\u000d\\u0009\""},
        {"\"\\u00e4\\u20AC\\ud83D\\uDE00\"", "\"ä€😀\""},
        {"\"\\uD800\"", "\"\uFFFD\""},
        {"\"\\uDC00\\uD800\"", "\"\uFFFD\uFFFD\""},
        {"\"\\uD800\\u0041\\uD83D\\n\"", "\"\uFFFDA\uFFFD\\u000a\""},
        {"\"\\uD800\\uD83D\\uDE00\"", "\"\uFFFD😀\""},
        {"{\"\\u0061\":1,\"A\":2}", "{\"a\":1,\"A\":2}"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        SCOPED_TEXT out = {0};
        assert_true(rewrite(&out, str_from(rows[i][0]), STYLES[0]));
        assert_text(rows[i][0], out.bytes, rows[i][1]);
    }
}

static void test_nesting_is_limited(void **state) {
    (void)state;
    SCOPED_TEXT text = {0};
    for (unsigned depth = 0; depth <= 20; depth++) {
        SCOPED_JSON document = {0};
        text.len = 0;
        for (unsigned i = 0; i < depth; i++)
            text_add_c(&text, i % 2 == 0 ? "[" : "{\"a\":");
        text_add_c(&text, "1");
        for (unsigned i = depth; i > 0; i--)
            text_add_c(&text, i % 2 == 0 ? "}" : "]");
        assert_non_null(json_read(&document, text_str(&text), depth));
        if (depth > 0)
            assert_null(json_read(&document, text_str(&text), depth - 1));
    }
    text.len = 0;
    for (size_t i = 0; i < 1000000; i++)
        text_add_c(&text, "[");
    SCOPED_JSON document = {0};
    assert_null(json_read(&document, text_str(&text), 255));
    assert_null(json_read(&document, STR("{}"), 0));
    assert_non_null(json_read(&document, STR("{}"), 1));
}

// Changes a few bytes of texts. What is still JSON is written and read back without a change.
static void test_changed_texts_are_read_or_rejected(void **state) {
    (void)state;
    static const char bytes[] = "{}[],:\"\\u0D8e-+.1 tfn\n\xc3\xa4";
    size_t accepted = 0;
    for (uint64_t seed = 0; seed < 30000; seed++) {
        SCOPED_TEXT text = {0}, out = {0}, again = {0};
        uint64_t random = seed / 10;
        JsonWriter json = STYLES[seed % COUNT_OF(STYLES)];
        json.out = &text;
        put_random(&json, NULL, &random, 4);
        random += seed;
        for (uint64_t k = next_random(&random) % 4; k < 4; k++) {
            char *at = text.bytes + next_random(&random) % text.len,
                 c = bytes[next_random(&random) % (sizeof bytes - 1)];
            switch (next_random(&random) % 3) {
            case 0:
                *at = c;
                break;
            case 1: // removes a byte, but not the last one
                text.len -= text.len > 1;
                memmove(at, at + 1, (size_t)(text.bytes + text.len - at));
                break;
            default: // swaps two bytes
                c = *at;
                *at = text.bytes[0];
                text.bytes[0] = c;
            }
        }
        if (!rewrite(&out, text_str(&text), STYLES[0]))
            continue;
        accepted++;
        assert_true(rewrite(&again, text_str(&out), STYLES[0]));
        assert_string_equal(again.bytes, out.bytes);
    }
    assert_in_range(accepted, 1000, 29000); // the test tries both
}

static void test_members_of_other_types_are_missing(void **state) {
    (void)state;
    SCOPED_JSON document = {0};
    const Json *object = json_read(
        &document,
        STR("{\"a\": {\"b\": {\"c\": \"deep\"}}, \"n\": 1.5, \"t\": \"text\", \"i\": 3, \"z\": null, \"l\": [[], 1]}"),
        3);
    assert_string_equal(json_text(json_path(object, "a.b"), "c"), "deep");
    assert_null(json_path(object, "a.x.c"));
    assert_null(json_path(object, "t.b"));
    assert_null(json_get(NULL, "a"));
    assert_null(json_get(object, "z"));
    assert_null(json_get(object, "deep"));
    assert_null(json_text(object, "i"));
    assert_int_equal(json_integer_or(object, "i", -1), 3);
    assert_int_equal(json_integer_or(object, "n", -1), -1);
    assert_int_equal(json_integer_or(object, "t", -1), -1);
    assert_true(json_number(json_get(object, "n")) == 1.5);
    assert_true(json_number(json_get(object, "t")) == 0);
    assert_int_equal(json_length(json_get(object, "l")), 2);
    assert_int_equal(json_length(object), 0);
    assert_null(json_next(object, NULL));
}

static void test_last_of_several_members_counts(void **state) {
    (void)state;
    SCOPED_JSON document = {0};
    const Json *object = json_read(&document, STR("{\"a\":1,\"b\":{\"a\":[]},\"\\u0061\":2,\"a\\u0000\":3}"), 3);
    assert_int_equal(json_integer_or(object, "a", -1), 2);
    assert_non_null(json_get(json_read(&document, STR("{\"a\":null,\"a\":[]}"), 3), "a"));
    assert_null(json_get(json_read(&document, STR("{\"a\":[],\"a\":null}"), 3), "a"));
}

static void test_lines_begin_after_commas(void **state) {
    (void)state;
    SCOPED_TEXT out = {0};
    JsonWriter json = {.out = &out, .spaced = true};
    json_break(&json, "\n");
    json_open(&json, NULL, "[{");
    for (int i = 0; i < 2; i++) {
        json_break(&json, "\n  ");
        json_put_bool(&json, "a", i > 0);
        json_put_text(&json, "b", " ");
    }
    json_close(&json, "}");
    json_break(&json, "\n");
    json_open(&json, NULL, "{}");
    json_put_bool(&json, NULL, false);
    json_close(&json, "]");
    assert_string_equal(out.bytes, "\n[{\n  \"a\": false, \"b\": \" \",\n  \"a\": true, \"b\": \" \"},\n{}, false]");
}

static void test_integers_must_fit(void **state) {
    (void)state;
    static const char *const others[] = {"9223372036854775808", "-9223372036854775809", "1e3", "1.0", "\"1\"", "true"};
    SCOPED_JSON document = {0};
    int64_t number = 0;
    assert_true(json_integer(json_read(&document, STR("-9223372036854775808"), 0), &number));
    assert_true(number == INT64_MIN);
    assert_true(json_integer(json_read(&document, STR("9223372036854775807"), 0), &number));
    assert_true(number == INT64_MAX);
    for (size_t i = 0; i < COUNT_OF(others); i++)
        assert_false(json_integer(json_read(&document, str_from(others[i]), 0), &number));
    assert_false(json_integer(NULL, &number));
}

TEST_GROUP(src_json) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_strings_are_escaped),
        cmocka_unit_test(test_commas_separate_values),
        cmocka_unit_test(test_canonical_texts_are_written_as_they_were_read),
        cmocka_unit_test(test_random_values_are_written_as_they_were_read),
        cmocka_unit_test(test_doubles_keep_their_bits),
        cmocka_unit_test(test_texts_that_are_not_json_are_rejected),
        cmocka_unit_test(test_white_space_and_escapes_are_removed),
        cmocka_unit_test(test_nesting_is_limited),
        cmocka_unit_test(test_changed_texts_are_read_or_rejected),
        cmocka_unit_test(test_members_of_other_types_are_missing),
        cmocka_unit_test(test_last_of_several_members_counts),
        cmocka_unit_test(test_lines_begin_after_commas),
        cmocka_unit_test(test_integers_must_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
