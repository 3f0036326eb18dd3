// test_src_pack.c: tests of links, from text to link and back, and of damaged links: src/link/pack.c.
#include "captured.h"
#include "link/pack.h"

#include <zlib.h>

static Captured captured;

// Packs JSON in the same way as link_pack. Adds the link without `#`.
static void pack_json(Text *out, const char *json) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    static unsigned char packed[1 << 16];
    z_stream stream = {.next_in = (unsigned char *)json,
                       .avail_in = (unsigned)strlen(json),
                       .next_out = packed,
                       .avail_out = sizeof packed};
    assert_int_equal(deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY), Z_OK);
    assert_int_equal(deflate(&stream, Z_FINISH), Z_STREAM_END);
    deflateEnd(&stream);
    size_t length = sizeof packed - stream.avail_out;
    unsigned bits = 0, count = 0;
    for (size_t i = 0; i < length; i++) {
        bits = bits << 8 | packed[i];
        for (count += 8; count >= 6; count -= 6)
            text_add_char(out, digits[bits >> (count - 6) & 63]);
    }
    if (count > 0)
        text_add_char(out, digits[bits << (6 - count) & 63]);
}

// Reads a link. Returns "" or the message.
static const char *read_link(Linked *linked, const Text *link) {
    *linked = (Linked){.frame = -1};
    captured_begin(&captured, STDERR_FILENO);
    bool good = link_read(linked, link);
    captured_end(&captured);
    assert_int_equal(good, captured.text[0] == '\0');
    return captured.text;
}

static void assert_json(const char *json, const char *problem) {
    SCOPED_TEXT link = {0};
    Linked linked;
    pack_json(&link, json);
    assert_text(json, read_link(&linked, &link), problem);
    link_free(&linked);
}

#define NOT_A_LINK "petri: not a petri link\n"

static void test_a_link_keeps_text_name_changes_and_digest(void **state) {
    (void)state;
    LinkedChange changes[] = {{.frame = 5, .name = "A", .value = "2"},
                              {.frame = -1, .name = "B", .value = "'x'"},
                              {.frame = 5, .name = "A", .value = "3"}};
    Linked linked = {.name = "dish.fl", .changes = changes, .change_count = 3, .frame = 9, .digest = "abc"}, got;
    SCOPED_TEXT link = {0};
    text_add_c(&linked.text, "!window\n\t\"ä\"\n");
    text_add_c(&link, "https://example.org/");
    assert_true(link_pack(&link, &linked, LINK_MAX_LENGTH));
    assert_non_null(strstr(link.bytes, "/#"));
    assert_null(strpbrk(strchr(link.bytes, '#'), "+/= \n"));
    assert_string_equal(read_link(&got, &link), "");
    assert_string_equal(got.text.bytes, linked.text.bytes);
    assert_string_equal(got.name, "dish.fl");
    assert_string_equal(got.digest, "abc");
    assert_null(got.hash);
    assert_int_equal(got.frame, 9);
    assert_int_equal(got.change_count, 3);
    static const char *const ordered[][2] = {{"B", "'x'"}, {"A", "2"}, {"A", "3"}}; // by frame, then as in the link
    for (size_t i = 0; i < 3; i++) {
        assert_string_equal(got.changes[i].name, ordered[i][0]);
        assert_string_equal(got.changes[i].value, ordered[i][1]);
    }
    link_free(&got);
    text_free(&linked.text);
}

// Links of petri 0.2 contain the SHA-256 of the printed state.
static void test_a_link_with_a_hash_can_be_read(void **state) {
    (void)state;
    SCOPED_TEXT link = {0};
    Linked linked;
    pack_json(&link, "{\"v\":1,\"t\":\"!a\",\"f\":7,\"h\":\"abc\"}");
    assert_string_equal(read_link(&linked, &link), "");
    assert_string_equal(linked.hash, "abc");
    assert_null(linked.digest);
    assert_int_equal(linked.frame, 7);
    link_free(&linked);
}

static void test_line_breaks_and_plain_base64_are_accepted(void **state) {
    (void)state;
    SCOPED_TEXT link = {0}, broken = {0};
    Linked linked;
    pack_json(&link, "{\"v\":1,\"t\":\"debug(1;22;333;4444;55555;666666)?>~\"}");
    for (size_t i = 0; i < link.len; i++) {
        char c = link.bytes[i] == '-' ? '+' : link.bytes[i] == '_' ? '/' : link.bytes[i];
        text_add_char(&broken, c);
        text_add_c(&broken, i % 10 == 9 ? "\r\n " : "");
    }
    text_add_c(&broken, "==\n");
    assert_string_equal(read_link(&linked, &broken), "");
    assert_string_equal(linked.text.bytes, "debug(1;22;333;4444;55555;666666)?>~");
    assert_string_equal(linked.name, "script.fl"); // the default
    assert_null(linked.hash);
    assert_null(linked.digest);
    assert_int_equal(linked.frame, -1);
    link_free(&linked);
}

static void test_damaged_links_are_rejected(void **state) {
    (void)state;
    static const char damaged[] = "petri: the link is damaged; check that it was copied completely\n";
    SCOPED_TEXT link = {0}, empty = {0}, shortened = {0}, odd = {0};
    Linked linked;
    pack_json(&link, "{\"v\":1,\"t\":\"debug(1)\"}");
    text_add(&shortened, (Str){link.bytes, link.len - 4});
    text_add_c(&odd, "#%");
    assert_string_equal(read_link(&linked, &empty), damaged);
    link_free(&linked);
    assert_string_equal(read_link(&linked, &shortened), damaged);
    link_free(&linked);
    assert_string_equal(read_link(&linked, &odd), damaged);
    link_free(&linked);
    text_add(&link, (Str){"AAAA", 4}); // more after the end
    assert_string_equal(read_link(&linked, &link), damaged);
    link_free(&linked);
}

static void test_other_json_is_rejected(void **state) {
    (void)state;
    assert_json("{\"v\":1,\"t\":\"x\",\"c\":[[0,\"A\",\"1\"]]}", "");
    assert_json("{\"v\":2,\"t\":1}", "petri: the link is from a newer petri; update petri to open it\n");
    static const char *const others[] = {
        "[]",
        "{",
        "{\"v\":1}",
        "{\"v\":1,\"t\":1}",
        "{\"v\":1,\"t\":\"x\"} y",
        "{\"v\":1,\"t\":\"a\\u0000b\"}",
        "{\"v\":1,\"t\":\"x\",\"n\":\"a\\nb\"}",
        "{\"v\":1,\"t\":\"x\",\"n\":\"a\\u007fb\"}",
        "{\"v\":1,\"t\":\"x\",\"n\":3}",
        "{\"v\":1,\"t\":\"x\",\"h\":3}",
        "{\"v\":1,\"t\":\"x\",\"f\":-2}",
        "{\"v\":1,\"t\":\"x\",\"f\":1000001}",
        "{\"v\":1,\"t\":\"x\",\"f\":1.5}",
        "{\"v\":1,\"t\":\"x\",\"c\":3}",
        "{\"v\":1,\"t\":\"x\",\"c\":[3]}",
        "{\"v\":1,\"t\":\"x\",\"c\":[[0,\"A\"]]}",
        "{\"v\":1,\"t\":\"x\",\"c\":[[\"0\",\"A\",\"1\"]]}",
        "{\"v\":1,\"t\":\"x\",\"c\":[[0,\"A\",1]]}",
        "{\"v\":1,\"t\":\"x\",\"c\":[[0,\"A\",\"1\"],[0,1,\"1\"]]}",
    };
    for (size_t i = 0; i < COUNT_OF(others); i++)
        assert_json(others[i], NOT_A_LINK);
}

static void test_sizes_are_limited(void **state) {
    (void)state;
    SCOPED_TEXT json = {0}, link = {0};
    text_add_c(&json, "{\"v\":1,\"t\":\"\",\"c\":[");
    for (int i = 0; i < 10001; i++)
        text_add_format(&json, "%s[0,\"A\",\"1\"]", i == 0 ? "" : ",");
    text_add_c(&json, "]}");
    assert_json(json.bytes, "petri: the link has more than 10000 changes of parameters\n");
    json.len = 0;
    text_add_c(&json, "{\"v\":1,\"t\":\"");
    for (int i = 0; i < (4 << 20) / 64 + 1; i++)
        text_add_format(&json, "%064d", 0);
    text_add_c(&json, "\"}");
    assert_json(json.bytes, "petri: the link unpacks to more than 4 MiB\n");

    Linked linked = {.name = "x"};
    uint64_t seed = 1; // for 192 000 hexadecimal digits, which need at least 96 000 bytes
    for (int i = 0; i < 12000; i++)
        text_add_format(&linked.text, "%016llx", (unsigned long long)next_bits(&seed));
    captured_begin(&captured, STDERR_FILENO);
    bool packed = link_pack(&link, &linked, LINK_MAX_LENGTH);
    captured_end(&captured);
    assert_false(packed);
    assert_non_null(strstr(captured.text, "petri: the script is too long for a link: "));
    Linked got;
    assert_non_null(strstr(read_link(&got, &link), "petri: the link is too long: "));
    link_free(&got);
    text_free(&linked.text);
}

TEST_GROUP(src_pack) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_link_keeps_text_name_changes_and_digest),
        cmocka_unit_test(test_a_link_with_a_hash_can_be_read),
        cmocka_unit_test(test_line_breaks_and_plain_base64_are_accepted),
        cmocka_unit_test(test_damaged_links_are_rejected),
        cmocka_unit_test(test_other_json_is_rejected),
        cmocka_unit_test(test_sizes_are_limited),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
