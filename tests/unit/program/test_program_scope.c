// test_program_scope.c: tests name resolution: slots, captures, global names of the engine, definitions, built-ins and
// unbound names.
#include "compiling.h"

static void test_slot_is_reused_after_its_scope(void **state) {
    static const CodeRow rows[] = {
        {"let x=frame\n!a v=x\n", "global r0 = frame\nnode r1 = (v=r0) none a\nreturn r1\n"},
        // A name is visible after its value has been evaluated. Its slot is reused after its scope ends.
        {"let x=frame\nlet x=x+1\nx\n", "global r0 = frame\nadd r1 = r0 1\nmove r2 = r1\nreturn r2\n"},
        {"(x where x=frame)*(y where y=time)\n",
         "global r0 = frame\nmove r2 = r0\nglobal r0 = time\nmove r3 = r0\nmul r1 = r2 r3\nreturn r1\n"},
    };
    Desk *desk = *state;
    desk->options.simplify = false;
    check_code(desk, rows, COUNT_OF(rows));
}

static void test_function_captures_each_outer_name_once(void **state) {
    Desk *desk = *state;
    compile(desk, "let x=frame y=time\nfunc f(a)\n    func g()\n        x+x+y+a;f\n    x\n!a v=f(1)\n");
    const Code *code = desk->compiled->code;
    const FunctionCode *f = NULL, *g = NULL;
    for (uint32_t i = 0; i < code->count; i++)
        if (code->instrs[i].op == OP_CLOSURE)
            f = code->instrs[i].as.function;
    assert_non_null(f);
    for (uint32_t i = 0; i < f->code->count; i++)
        if (f->code->instrs[i].op == OP_CLOSURE)
            g = f->code->instrs[i].as.function;
    assert_non_null(g);
    assert_int_equal(f->param_count, 1);
    assert_int_equal(f->capture_count, 2);
    assert_int_equal(f->captures[0].kind, CAPTURE_SLOT);
    assert_int_equal(f->captures[0].slot, 0);
    assert_int_equal(f->captures[1].slot, 1);
    static const Capture wanted[] = {{CAPTURE_OUTER, 0}, {CAPTURE_OUTER, 1}, {CAPTURE_SLOT, 0}, {CAPTURE_SELF, 0}};
    assert_int_equal(g->capture_count, COUNT_OF(wanted));
    for (size_t i = 0; i < COUNT_OF(wanted); i++)
        assert_true(g->captures[i].kind == wanted[i].kind && g->captures[i].slot == wanted[i].slot);
}

// A script's own names shadow those of the engine, which shadow definitions, which shadow built-ins (L8.1).
static void test_order_of_predefined_names(void **state) {
    Desk *desk = *state;
    const Define defines[] = {{.name = name_of(&desk->world, "d"), .value = value_number(1)},
                              {.name = name_of(&desk->world, "frame"), .value = value_number(2)},
                              {.name = name_of(&desk->world, "pi"), .value = value_number(3)},
                              {.name = name_of(&desk->world, "d"), .value = value_number(4)}};
    static const CodeRow rows[] = {
        {"frame\n", "global r0 = frame\nreturn r0\n"}, {"d\n", "move r0 = 4\nreturn r0\n"},
        {"pi\n", "move r0 = 3\nreturn r0\n"},          {"let d=7\nd\n", "move r0 = 7\nmove r1 = 7\nreturn r1\n"},
        {"true\n", "move r0 = 1\nreturn r0\n"},        {"sin\n", "move r0 = (sin)\nreturn r0\n"},
    };
    desk->options.defines = defines;
    desk->options.define_count = COUNT_OF(defines);
    check_code(desk, rows, COUNT_OF(rows));
    compile(desk, "d\nlet pi=5\n");
    assert_true(desk->compiled->define_uses[3].read && !desk->compiled->define_uses[0].read);
    assert_true(desk->compiled->define_uses[2].by_let && desk->compiled->define_uses[2].bound.span.start == 6);
    // A module sees neither engine names nor definitions. An unbound name is reported when it is evaluated.
    desk->options.module = true;
    assert_text("module", code_of(desk, "frame\n"), "unbound r0 = frame\nreturn r0\n");
    assert_text("module", code_of(desk, "d\n"), "unbound r0 = d\nreturn r0\n");
    assert_text("module", text_c(&desk->reported), "");
}

static void test_unbound_name_is_reported_with_its_position(void **state) {
    static const CodeRow rows[] = {
        {"!a v=fraem\n", "1:6 unbound name 'fraem' is null [unbound-name]\n"},
        {"let x=x\n", "1:7 unbound name 'x' is null [unbound-name]\n"},
        {"(y where y=1)\ny\n", "2:1 unbound name 'y' is null [unbound-name]\n"},
        {"let x=1\n!a v=x\n", ""},
    };
    Desk *desk = *state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        compile(desk, rows[i].script);
        assert_text(rows[i].script, text_c(&desk->reported), rows[i].code);
    }
}

// An unbound name is reported where it is not only tested, and where a name is similar.
static void test_optional_definitions(void **state) {
    static const CodeRow rows[] = {
        {"let size=RECORD or 5\n!a v=size w=(1 if RECORD)\n", ""},
        {"!a v=(1 if X else 2) w=(not X) x=(X and 5)\n", ""},
        {"if X\n    !a\nelif not Y\n    !b\nelse\n    !c\n", ""},
        {"!a v=(0 or (X or 5))\n", ""},
        {"!a v=X or 5\n!a v=X\n", "2:6 unbound name 'X' is null [unbound-name]\n"},
        {"!a v=5 or X\n!a v=(1 if X and frame > 3)\n", "1:11 unbound name 'X' is null [unbound-name]\n"},
        {"!a v=5 or X\n", "1:11 unbound name 'X' is null [unbound-name]\n"},
        {"!a v=(X if 1)\n", "1:7 unbound name 'X' is null [unbound-name]\n"},
        {"if 1\n    X\n", "2:5 unbound name 'X' is null [unbound-name]\n"},
        {"if 1\n    !a\nelse\n    X\n", "4:5 unbound name 'X' is null [unbound-name]\n"},
        {"!a v=fraem or 5\n", "1:6 unbound name 'fraem' is null [unbound-name]\n"},
    };
    Desk *desk = *state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        compile(desk, rows[i].script);
        assert_text(rows[i].script, text_c(&desk->reported), rows[i].code);
    }
    desk->options.lint = true;
    compile(desk, "!a v=RECORD or 5 w=(1 if RECORD)\n"); // listed once
    assert_text("lint", text_c(&desk->reported),
                "1:6 'RECORD' is optional; to set it, use -D RECORD=VALUE [optional-definition]\n");
}

static void test_last_binding_of_a_top_level_name_is_exported(void **state) {
    Desk *desk = *state;
    const Symbol *params[] = {name_of(&desk->world, "p"), name_of(&desk->world, "q")};
    desk->options.params = params;
    desk->options.param_count = 2;
    const Program *program = compile(desk, "let a=p b=2\nfunc c()\n    1\nlet a=q\nif 1\n    let hidden=1\n");
    assert_int_equal(program->param_count, 2);
    assert_int_equal(program->export_count, 4);
    assert_int_equal(program_find_export(program, name_of(&desk->world, "b"))->slot, 3);
    assert_int_equal(program_find_export(program, name_of(&desk->world, "a"))->slot, 5); // the last binding is exported
    assert_null(program_find_export(program, name_of(&desk->world, "hidden")));
    assert_null(program_find_export(program, name_of(&desk->world, "p")));
}

TEST_GROUP(program_scope) {
    const struct CMUnitTest tests[] = {
        DESK_TEST(test_slot_is_reused_after_its_scope), DESK_TEST(test_function_captures_each_outer_name_once),
        DESK_TEST(test_order_of_predefined_names),      DESK_TEST(test_unbound_name_is_reported_with_its_position),
        DESK_TEST(test_optional_definitions),           DESK_TEST(test_last_binding_of_a_top_level_name_is_exported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
