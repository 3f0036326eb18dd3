// test_program_parameters.c: tests parameters, their defaults and their comments.
#include "compiling.h"

typedef struct ParameterRow {
    const char *script;
    // Each parameter is written as `name=default`, then `:value` if the default is constant, then ` min..max|step` and
    // ` -- comment` if they exist.
    const char *parameters;
} ParameterRow;

static const char *parameters_of(Desk *desk, const char *script) {
    Text out = text_new(&desk->world.arena);
    const Program *program = compile(desk, script);
    for (uint32_t i = 0; i < program->parameter_count; i++) {
        const Parameter *parameter = &program->parameters[i];
        text_add_format(&out, "%s%.*s=%.*s", i ? ", " : "", (int)parameter->name->name.len, parameter->name->name.bytes,
                        (int)parameter->default_text.len, parameter->default_text.bytes);
        if (parameter->is_static) {
            text_add_char(&out, ':');
            format_value(&out, &desk->world.symbols, parameter->value);
        }
        if (parameter->min > -INFINITY || parameter->max < INFINITY)
            text_add_format(&out, " %g..%g|%g", parameter->min, parameter->max, parameter->step);
        if (parameter->comment.len)
            text_add_format(&out, " -- %.*s", (int)parameter->comment.len, parameter->comment.bytes);
    }
    return text_c(&out);
}

static void test_parameters_are_found(void **state) {
    static const ParameterRow rows[] = {
        {"let n=n or 5\n!a v=n\n", "n=5:5"},
        {"let n=n or 2+3*4 -- 0..20|0.5 how many\n", "n=2+3*4:14 0..20|0.5 -- how many"},
        {"let n=n or 's' m=m or (1;2) -- both\n", "n='s':'s', m=(1;2):1;2 -- both"},
        {"let k=4\nlet n=n or k+1\n", "n=k+1:5"},
        {"let n=n or frame\n", "n=frame"},   // the default varies from frame to frame
        {"let n=n or 1-1\n", "n=1-1"},       // the test's evaluator cannot evaluate differences
        {"let n=n or 1 or 2\n", "n=1 or 2"}, // the syntax tree has no node for the whole default
        {"let n=m or 1\n", "m=1:1"},
        {"let n=m or -1\nlet k=m or 1\n", ""}, // the name occurs twice
        {"let n=m or frame\n", ""},            // the default is not plain
        {"let size=siz or 1\n", ""},           // probably misspelled
        {"let sin=sin or 1\nlet n=5\nlet n=n or 1\n", ""},
        {"if 1\n    let n=n or 1\n", ""}, // parameters exist only at the top level
    };
    Desk *desk = *state;
    for (int simplify = 1; simplify >= 0; simplify--) {
        desk->options.simplify = simplify;
        for (size_t i = 0; i < COUNT_OF(rows); i++)
            assert_text(rows[i].script, parameters_of(desk, rows[i].script), rows[i].parameters);
    }
}

// In `let n=n or 5`, the second `n` is not reported as unbound. A definition does not change the default.
static void test_definition_keeps_default(void **state) {
    Desk *desk = *state;
    assert_text("value", code_of(desk, "let n=n or 5\nn\n"), "move r0 = 5\nmove r1 = 5\nreturn r1\n");
    assert_text("value", text_c(&desk->reported), "");
    Define define = {.name = name_of(&desk->world, "n"), .value = value_number(7)};
    desk->options.defines = &define;
    desk->options.define_count = 1;
    for (int simplify = 1; simplify >= 0; simplify--) {
        desk->options.simplify = simplify;
        assert_text("default", parameters_of(desk, "let n=n or 5\n"), "n=5:5");
        assert_true(desk->compiled->define_uses[0].read);
    }
}

static void test_default_outside_range_is_reported(void **state) {
    static const ParameterRow rows[] = {
        {"let n=n or 5 -- 1..3 few\n!a v=n\n",
         "1:5 the default of 'n' is outside the range in its comment [out-of-range]\n"},
        {"let n=n or (1;2) -- 1..3 few\n!a v=n\n", ""},
        {"let n=n or frame -- 1..3 few\n!a v=n\n", ""},
    };
    Desk *desk = *state;
    desk->options.lint = true;
    for (int simplify = 1; simplify >= 0; simplify--) {
        desk->options.simplify = simplify;
        for (size_t i = 0; i < COUNT_OF(rows); i++) {
            compile(desk, rows[i].script);
            assert_text(rows[i].script, text_c(&desk->reported), rows[i].parameters);
        }
    }
}

TEST_GROUP(program_parameters) {
    const struct CMUnitTest tests[] = {DESK_TEST(test_parameters_are_found), DESK_TEST(test_definition_keeps_default),
                                       DESK_TEST(test_default_outside_range_is_reported)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
