// test_syntax_content_sniff.c: a file that is not a script gives a single error. A script with errors gives all of
// them.
#include "parsing.h"

// Returns the messages for a file of this name, one per line.
static const char *reports_of(World *world, const char *name, const char *path, Str bytes) {
    const Source *source = source_new(&world->arena, str_from(name), str_from(path), bytes);
    DiagSink diags = diag_sink_new(&world->arena, 50);
    const Ast *ast = parse_program(&world->arena, &world->symbols, source, &diags);
    assert_true((ast == NULL) == (diags.error_count > 0));
    Text out = text_new(&world->arena);
    for (uint32_t i = 0; i < diags.count; i++) {
        const Diag *diag = &diags.items[i];
        if (diag->at.source)
            text_add_format(&out, "%u: ", source_locate(diag->at.source, diag->at.span.start).line);
        text_add_format(&out, "%.*s", (int)diag->text.len, diag->text.bytes);
        if (diag->hint.len)
            text_add_format(&out, " | %.*s", (int)diag->hint.len, diag->hint.bytes);
        text_add_char(&out, '\n');
    }
    diag_sink_free(&diags);
    return text_c(&out);
}

static void check_bytes(World *world, Str bytes, const char *wanted) {
    assert_text(wanted, reports_of(world, "x.fl", "/x.fl", bytes), wanted);
}

static void test_other_encodings_are_named(void **state) {
    World *world = *state;
    check_bytes(world, STR("\xff\xfe!\0n\0\n\0"), "'x.fl' is UTF-16 text: save it as UTF-8\n");
    check_bytes(world, STR("\xfe\xff\0!\0n\0\n"), "'x.fl' is UTF-16 text: save it as UTF-8\n");
    check_bytes(world, STR("!\0n\0 \0a\0=\0001\0\n\0"), "'x.fl' is UTF-16 text: save it as UTF-8\n");
    check_bytes(world, STR("\0!\0n\0 \0a\0=\0001\0\n"), "'x.fl' is UTF-16 text: save it as UTF-8\n");
    check_bytes(world, STR("1\0\n\0"), "'x.fl' is UTF-16 text: save it as UTF-8\n"); // the shortest text
    check_bytes(world, STR("\xff\xfe\0\0!\0\0\0"), "'x.fl' is UTF-32 text: save it as UTF-8\n");
    check_bytes(world, STR("\xef\xbb\xbf!n a=1\n"), "");
}

static void test_binary_file_gives_one_error(void **state) {
    World *world = *state;
    check_bytes(world,
                STR("\x7f"
                    "ELF\2\1\1\0\0\0\x80\xff\n\0"),
                "'x.fl' is a binary file, not a script\n");
    check_bytes(world, STR("!n\0\n!m\0\n!k\0\n"), "'x.fl' is a binary file, not a script\n");
    check_bytes(world, STR("-- a\0b\n!n a='x\0y'\n"), ""); // NUL is allowed in comments and strings
}

static void test_other_text_gives_one_error(void **state) {
    World *world = *state;
    Str table = STR("root:x:0\nbin:y:1\n\nmail:z:2\n");
    const char *sum = "1: is this a Flitter script? 3 of 3 lines are invalid; the first error: "
                      "unexpected symbol :x\n";
    assert_text("a table", reports_of(world, "passwd", "/etc/passwd", table), sum);
    assert_text("a stream", reports_of(world, "<stdin>", "<stdin>", table), sum);
    const char *all = reports_of(world, "p.fl", "/p.fl", table);
    assert_non_null(strstr(all, "1: unexpected symbol :x\n"));
    assert_non_null(strstr(all, "2: unexpected symbol :y\n"));
    assert_text("a prompt", reports_of(world, "prompt", "prompt", table), all);
    Str begun = STR("#!/usr/bin/env petri\n)\n)\n)\n");
    assert_text("a hashbang marks a script", reports_of(world, "tool", "/bin/tool", begun),
                "2: unexpected ')'\n3: unexpected ')'\n4: unexpected ')'\n");
    assert_text("a hashbang of another program", reports_of(world, "tool", "/bin/tool", STR("#!/bin/sh\n)\n)\n)\n")),
                "2: is this a Flitter script? 3 of 4 lines are invalid; the first error: unexpected ')'\n");
    assert_text("the hint of the first error is omitted",
                reports_of(world, "passwd", "/etc/passwd", STR("x = 1\ny = 2\nz = 3\n")),
                "1: is this a Flitter script? 3 of 3 lines are invalid; the first error: unexpected '='\n");
    assert_text(
        "half of the lines", reports_of(world, "old", "/old", STR("!a )\n!b\n!c )\n!d\n!e\n!f )\n")),
        "1: is this a Flitter script? 3 of 6 lines are invalid; the first error: unexpected ')', expected end of "
        "line or '<<'\n");
    Str few = STR("!a\n!b )\n!c\n!d )\n!e\n!f )\n!g\n!h\n!i )\n");
    assert_text("too few errors are kept", reports_of(world, "old.fl.bak", "/old.fl.bak", STR("!a )\n!b )\n!c\n")),
                "1: unexpected ')', expected end of line or '<<'\n2: unexpected ')', expected end of line or '<<'\n");
    assert_non_null(strstr(reports_of(world, "old", "/old", few), "9: unexpected ')'"));
}

TEST_GROUP(syntax_content_sniff) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_other_encodings_are_named),
        WORLD_TEST(test_binary_file_gives_one_error),
        WORLD_TEST(test_other_text_gives_one_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
