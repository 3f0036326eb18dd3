// test_src_design.c: tests of the values and runs of a sweep: src/sweep/axis.c and src/sweep/design.c.
#include "captured.h"
#include "sweep/options.h"
#include "sweep/sweep.h"

#include <math.h>

static Captured captured;

// Returns the values of an axis, separated by blanks, or the message if it is invalid.
static const char *axis_values(const char *text) {
    static char values[1000];
    Axis axis;
    captured_begin(&captured, STDERR_FILENO);
    bool good = axis_read(&axis, text);
    const char *problem = captured_end(&captured);
    values[0] = '\0';
    for (size_t i = 0; i < axis.values.count; i++)
        snprintf(values + strlen(values), sizeof values - strlen(values), "%s%s", i == 0 ? "" : " ",
                 axis.values.items[i]);
    free(axis.name);
    texts_free(&axis.values);
    return good ? values : problem;
}

static void test_axis_lists_and_ranges(void **state) {
    (void)state;
    assert_string_equal(axis_values("N=1;5;20"), "1 5 20");
    assert_string_equal(axis_values("N=3"), "3");
    assert_string_equal(axis_values("N="), "");
    assert_string_equal(axis_values("N=1..4"), "1 2 3 4");
    assert_string_equal(axis_values("N=-1..1"), "-1 0 1");
    assert_string_equal(axis_values("N=2..2"), "2");
    assert_string_equal(axis_values("N=0..0.5|0.1"), "0 0.1 0.2 0.3 0.4 0.5"); // not 0.30000000000000004
    assert_string_equal(axis_values("N=0..1|0.4"), "0 0.4 0.8");
    assert_string_equal(axis_values("N=0.1..0.7|0.3"), "0.1 0.4 0.7");
    assert_string_equal(axis_values("N=1000000000001..1000000000003"), "1000000000001 1000000000002 1000000000003");
    assert_string_equal(axis_values("N=9007199254740990..9007199254740992|2"), "9007199254740990 9007199254740992");
    assert_string_equal(axis_values("N=1e12..3e12|1e12"), "1e+12 2e+12 3e+12");
    assert_string_equal(axis_values("N=7;1..3;red"), "7 1 2 3 red");
    assert_string_equal(axis_values("N=(1;2);(3;4)"), "1;2 3;4");
    assert_string_equal(axis_values("N=a..b"), "a..b"); // text, because it does not begin with a number
}

static void test_axis_reports_invalid_values(void **state) {
    (void)state;
    assert_string_equal(axis_values("N=1;;2"), "petri: -D N: empty value; write a list as 1;5;20\n");
    assert_string_equal(axis_values("N=4..1"), "petri: -D N: empty range 4..1\n");
    assert_string_equal(axis_values("N=1..x"),
                        "petri: -D N: not a range: '1..x'; write 1..10, or 1..10|0.5 with a positive step\n");
    assert_string_equal(axis_values("N=1..9|-1"),
                        "petri: -D N: not a range: '1..9|-1'; write 1..10, or 1..10|0.5 with a positive step\n");
    assert_string_equal(
        axis_values("N=0..1e9"),
        "petri: -D N: the range 0..1000000000 has more than a million values; use a larger step with '|STEP'\n");
}

static void test_axis_literals(void **state) {
    (void)state;
    static const char *const rows[][2] = {
        {"1", "((1))"}, {"1;2", "((1);(2))"},   {"red", "('red')"},     {":name", "(:name)"},
        {":", "(':')"}, {"it's", "('it\\'s')"}, {"a\\b", "('a\\\\b')"}, {"0.1;x", "((0.10000000000000001);'x')"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        SCOPED_TEXT out = {0};
        axis_add_literal(&out, rows[i][0]);
        assert_string_equal(out.bytes, rows[i][1]);
    }
}

// The kind of an axis follows from the notation of its values, and all cells have it.
static void test_kinds_follow_from_the_notation(void **state) {
    (void)state;
    static const struct {
        const char *text;
        CellKind kind;
    } cases[] = {
        {"N=1;5;20", CELL_INTEGER},
        {"N=1..4", CELL_INTEGER},
        {"N=-9223372036854775808;9223372036854775807;1000000000000000001", CELL_INTEGER},
        {"N=9223372036854775808", CELL_NUMBER}, // 2^63
        {"N=0..2|0.5", CELL_NUMBER},
        {"N=1;2.0", CELL_NUMBER},
        {"N=-0", CELL_NUMBER},
        {"N=1k;2", CELL_NUMBER},
        {"N=inf", CELL_NUMBER},
        {"N=1;red", CELL_TEXT},
        {"N=0x10", CELL_TEXT},
        {"N=(1;2);(3;4)", CELL_TEXT},
        {"N=", CELL_TEXT},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        Axis axis;
        assert_true(axis_read(&axis, cases[i].text));
        for (size_t k = 0; k < axis.values.count; k++)
            if (axis_cell(&axis, axis.values.items[k]).kind != cases[i].kind)
                fail_msg("%s: '%s' has the kind %d", cases[i].text, axis.values.items[k], axis.kind);
        free(axis.name);
        texts_free(&axis.values);
    }
    Axis axis = {.kind = CELL_INTEGER};
    assert_true(axis_cell(&axis, "1000000000000000001").as.integer == 1000000000000000001);
    axis.kind = CELL_NUMBER;
    assert_true(signbit(axis_cell(&axis, "-0").as.number));
    assert_true(axis_cell(&axis, "9223372036854775808").as.number == 0x1p63);
    assert_true(axis_cell(&axis, "5").as.number == 5);
    axis.kind = CELL_TEXT;
    assert_string_equal(axis_cell(&axis, "5").as.text, "5");
}

typedef struct Study {
    SweepOptions own;
    Design design;
    bool good;
    const char *message;
} Study;

// Makes the design of the definitions, a list that ends with NULL.
static void make(Study *study, const char *const definitions[]) {
    const CommandContext host = {.stack_bytes = (size_t)1 << 20};
    for (size_t i = 0; definitions[i]; i++)
        texts_add(&study->own.axes, definitions[i]);
    captured_begin(&captured, STDERR_FILENO);
    study->good = design_make(&study->design, &(const Options){.own = &study->own}, &host);
    study->message = captured_end(&captured);
}

#define MAKE(study, ...) make(study, (const char *const[]){__VA_ARGS__, NULL})

static void finish(Study *study) {
    design_free(&study->design);
    texts_free(&study->own.axes);
}

// Checks the runs: values separated by commas, runs by blanks.
static void assert_runs(const Study *study, const char *expected) {
    SCOPED_TEXT runs = {0};
    assert_true(study->good);
    text_add_c(&runs, "");
    for (size_t run = 0; run < study->design.run_count; run++)
        for (size_t axis = 0; axis < study->design.axis_count; axis++)
            text_add_format(&runs, "%s%s",
                            axis > 0  ? ","
                            : run > 0 ? " "
                                      : "",
                            design_value(&study->design, run, axis));
    assert_string_equal(runs.bytes, expected);
}

static void test_grid_changes_the_last_name_fastest(void **state) {
    (void)state;
    Study study = {0};
    MAKE(&study, "A=1;2", "B=x;y;z");
    assert_runs(&study, "1,x 1,y 1,z 2,x 2,y 2,z");
    finish(&study);
    study = (Study){0};
    MAKE(&study, "A=1;2", "B=5", "A=7;8;9");
    assert_runs(&study, "7,5 8,5 9,5"); // a later definition replaces an earlier one
    finish(&study);
    study = (Study){0};
    MAKE(&study, NULL);
    assert_true(study.good);
    assert_int_equal(study.design.run_count, 1); // without definitions, a single run
    finish(&study);
}

static void test_seeds_are_the_last_axis(void **state) {
    (void)state;
    Study study = {.own.seeds = 3};
    MAKE(&study, "A=1;2");
    assert_true(study.design.seeded);
    assert_runs(&study, "1,1 1,2 1,3 2,1 2,2 2,3");
    finish(&study);
    study = (Study){.own.seeds = 3};
    MAKE(&study, "SEED=1;2");
    assert_false(study.good);
    assert_string_equal(study.message, "petri: cannot use both --seeds and -D SEED: --seeds N means -D SEED=1..N\n");
    finish(&study);
}

// Samples a continuous axis, a list and seeds.
static void test_latin_sample_uses_each_interval_once(void **state) {
    (void)state;
    Study study = {.own = {.sample = "latin:8:5", .seeds = 2}};
    MAKE(&study, "X=0..4", "L=a;b");
    assert_true(study.good);
    assert_int_equal(study.design.run_count, 16);
    int slices[8] = {0}, letters[2] = {0};
    for (size_t run = 0; run < 16; run++) {
        double x = strtod(design_value(&study.design, run, 0), NULL);
        assert_true(x >= 0 && x < 4);
        slices[(int)floor(2 * x)]++;
        letters[design_value(&study.design, run, 1)[0] - 'a']++;
        assert_int_equal(strtol(design_value(&study.design, run, 2), NULL, 10), run % 2 + 1);
        assert_string_equal(design_value(&study.design, run, 0), design_value(&study.design, run / 2 * 2, 0));
    }
    for (int i = 0; i < 8; i++)
        assert_int_equal(slices[i], 2); // once for each seed
    assert_int_equal(letters[0], 8);
    assert_int_equal(letters[1], 8);
    assert_int_equal(study.design.axes[0].kind, CELL_NUMBER); // although the values of 0..4 are integers
    assert_int_equal(study.design.axes[2].kind, CELL_INTEGER);

    Study again = {.own = {.sample = "latin:8:5", .seeds = 2}}, other = {.own = {.sample = "latin:8", .seeds = 2}};
    MAKE(&again, "X=0..4", "L=a;b");
    MAKE(&other, "X=0..4", "L=a;b");
    bool differs = false;
    for (size_t run = 0; run < 16; run++) {
        assert_string_equal(design_value(&study.design, run, 0), design_value(&again.design, run, 0));
        differs = differs || strcmp(design_value(&study.design, run, 0), design_value(&other.design, run, 0)) != 0;
    }
    assert_true(differs); // another seed
    finish(&study);
    finish(&again);
    finish(&other);
}

static void test_sample_reports_invalid_text(void **state) {
    (void)state;
    static const char *const invalid[] = {
        "latin", "latin:", "latin:0", "latin:3:", "latin:3:x", "latin:3x", "random:3"};
    for (size_t i = 0; i < sizeof invalid / sizeof invalid[0]; i++) {
        Study study = {.own.sample = invalid[i]};
        MAKE(&study, "X=0..4");
        assert_false(study.good);
        assert_non_null(strstr(study.message, "option '--sample' expects latin:COUNT or latin:COUNT:SEED"));
        finish(&study);
    }
}

static void test_too_many_runs_are_an_error(void **state) {
    (void)state;
    Study study = {0};
    MAKE(&study, "A=1..10000", "B=1..1001");
    assert_false(study.good);
    assert_string_equal(study.message,
                        "petri: too many runs: 10010000, at most 10000000; select some with --sample latin:N\n");
    finish(&study);
}

static void test_where_keeps_matching_runs(void **state) {
    (void)state;
    Study study = {.own.where = "A < B"};
    MAKE(&study, "A=1;2;3", "B=2;3");
    assert_runs(&study, "1,2 1,3 2,3");
    finish(&study);
    study = (Study){.own.where = "KIND == 'soft' or A == 1"};
    MAKE(&study, "A=1;2", "KIND=soft;hard");
    assert_runs(&study, "1,soft 1,hard 2,soft");
    finish(&study);
    study = (Study){.own.where = "A > 9"};
    MAKE(&study, "A=1;2");
    assert_false(study.good);
    assert_string_equal(study.message, "petri: no runs: 'A > 9' is never true\n");
    finish(&study);
    study = (Study){.own.where = "A <"};
    MAKE(&study, "A=1;2");
    assert_false(study.good);
    assert_non_null(strstr(study.message, "--where")); // the diagnostic shows the user's text
    assert_non_null(strstr(study.message, "petri: cannot evaluate the condition of '--where': 'A <'\n"));
    finish(&study);
}

TEST_GROUP(src_design) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_axis_lists_and_ranges),
        cmocka_unit_test(test_axis_reports_invalid_values),
        cmocka_unit_test(test_axis_literals),
        cmocka_unit_test(test_kinds_follow_from_the_notation),
        cmocka_unit_test(test_grid_changes_the_last_name_fastest),
        cmocka_unit_test(test_seeds_are_the_last_axis),
        cmocka_unit_test(test_latin_sample_uses_each_interval_once),
        cmocka_unit_test(test_sample_reports_invalid_text),
        cmocka_unit_test(test_too_many_runs_are_an_error),
        cmocka_unit_test(test_where_keeps_matching_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
