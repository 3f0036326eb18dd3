// test_src_cells.c: tests of the cells of tables: src/cli/cells.c, and the rows of sweeps that consist of them:
// src/sweep/result.c.
#include "check.h"
#include "cli/cells.h"
#include "sweep/sweep.h"

#include <math.h>

static uint64_t next_random(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return *state ^ *state >> 29;
}

// Appends a cell and reads it again. Returns the bits of the number that was read.
static int64_t through(Cell cell) {
    SCOPED_TEXT bytes = {0};
    Cell read;
    cell_add(&bytes, cell);
    Str rest = text_str(&bytes);
    assert_true(cell_next(&rest, &read));
    assert_int_equal(rest.len, 0);
    assert_int_equal(read.kind, cell.kind);
    return read.as.integer;
}

static void test_numbers_keep_all_bits(void **state) {
    (void)state;
    static const int64_t hard[] = {0,
                                   1,
                                   -1,
                                   255,
                                   256,
                                   INT64_MAX,
                                   INT64_MIN,
                                   1LL << 53,
                                   (1LL << 53) + 1,
                                   9007199254740993,
                                   1000000000000000001,
                                   0x7ff8000000000001,
                                   (int64_t)0xfff8000000000000,
                                   0x0000000a0d000009};
    static const double doubles[] = {0.0,    -0.0,     5e-324,    -2.2250738585072011e-308, 0.1,
                                     0x1p63, INFINITY, -INFINITY, 1.7976931348623157e308,   0.30000000000000004};
    uint64_t random = 1;
    for (size_t i = 0; i < 10000; i++) {
        int64_t bits = i < COUNT_OF(hard) ? hard[i] : (int64_t)next_random(&random);
        assert_int_equal(through((Cell){CELL_INTEGER, {.integer = bits}}), bits);
        assert_int_equal(through((Cell){CELL_NUMBER, {.integer = bits}}), bits);
    }
    for (size_t i = 0; i < COUNT_OF(doubles); i++) {
        Cell cell = {CELL_NUMBER, {.number = doubles[i]}};
        assert_int_equal(through(cell), cell.as.integer);
    }
}

static void test_texts_are_one_line(void **state) {
    (void)state;
    SCOPED_TEXT bytes = {0};
    Cell cell;
    cell_add(&bytes, (Cell){CELL_TEXT, {.text = "a\tb\n\x1b[1mé"}});
    cell_add(&bytes, (Cell){CELL_TEXT, {.text = ""}});
    Str rest = text_str(&bytes);
    assert_true(cell_next(&rest, &cell));
    assert_string_equal(cell.as.text, "a b  [1mé");
    assert_true(cell_next(&rest, &cell));
    assert_string_equal(cell.as.text, "");
    assert_false(cell_next(&rest, &cell));
}

// Two rows: 3, 0.5, none, no error; 4, none, 'x', an error.
static void add_rows(const Sweep *sweep, Text *rows) {
    cell_add(rows, (Cell){CELL_INTEGER, {.integer = 3}});
    cell_add(rows, (Cell){CELL_NUMBER, {.number = 0.5}});
    cell_add(rows, (Cell){.kind = CELL_NONE});
    cell_add(rows, (Cell){.kind = CELL_NONE});
    row_add_failure(sweep, 4, "crashed", rows);
}

static Metric metrics[] = {{.name = "a", .expression = "1"}, {.name = "energy"}};
static const Sweep two_metrics = {.metrics = metrics, .metric_count = COUNT_OF(metrics)};

// Returns a sweep whose only run has these rows. It is valid until the next call.
static Sweep with_result(Str rows) {
    static Result result;
    result.rows = rows;
    return (Sweep){.metrics = metrics, .metric_count = COUNT_OF(metrics), .results = &result, .design.run_count = 1};
}

static void test_only_whole_rows_are_valid(void **state) {
    (void)state;
    SCOPED_TEXT rows = {0};
    size_t valid = 0;
    add_rows(&two_metrics, &rows);
    for (size_t length = 0; length <= rows.len; length++) {
        SCOPED_STRING part = memory_strndup(rows.bytes, length); // the address sanitizer sees reads beyond it
        valid += rows_are_valid(&two_metrics, (Str){part, length});
    }
    assert_int_equal(valid, 3); // no row, one row, two rows
    for (size_t at = 0; at < rows.len; at++) {
        SCOPED_STRING part = memory_strndup(rows.bytes, rows.len);
        part[at] = 4; // no kind of cell
        Sweep sweep = with_result((Str){part, rows.len});
        Row row;
        rows_are_valid(&sweep, sweep.results->rows);
        sweep_is_failed(&sweep, 0);
        for (Str rest = sweep.results->rows; row_next(&two_metrics, &rest, 0, &row);) {
        }
    }
    rows.bytes[0] = CELL_NUMBER;
    assert_false(rows_are_valid(&two_metrics, text_str(&rows)));
}

static void test_rows_have_the_numbers_of_metrics(void **state) {
    (void)state;
    static const struct {
        size_t metric;
        double first, second;
    } cases[] = {{0, 0.5, NAN}, {1, NAN, NAN}, {2, 3, NAN}};
    SCOPED_TEXT rows = {0};
    add_rows(&two_metrics, &rows);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        Str rest = text_str(&rows);
        Row row;
        assert_true(row_next(&two_metrics, &rest, cases[i].metric, &row));
        assert_true(row.frame == 3 && (isnan(cases[i].first) ? isnan(row.x) : row.x == cases[i].first));
        assert_true(row_next(&two_metrics, &rest, cases[i].metric, &row));
        assert_true(row.frame == 4 && isnan(row.x)); // the row has an error
        assert_false(row_next(&two_metrics, &rest, cases[i].metric, &row));
    }
    Sweep failed = with_result(text_str(&rows));
    assert_true(sweep_is_failed(&failed, 0));
    Sweep empty = with_result((Str){"", 0});
    assert_false(sweep_is_failed(&empty, 0));
}

// An expression is written like the language writes it, a quantity with 17 digits.
static void test_cells_are_written_as_in_csv(void **state) {
    (void)state;
    static const struct {
        size_t metric;
        Cell cell;
        const char *text;
    } cases[] = {
        {0, {CELL_NUMBER, {.number = 0.1}}, "0.1"},
        {1, {CELL_NUMBER, {.number = 0.1}}, "0.10000000000000001"},
        {0, {CELL_NUMBER, {.number = 0x1p63}}, "9.223372036854776e+18"},
        {0, {CELL_NUMBER, {.number = -0.0}}, "-0"},
        {0, {CELL_NUMBER, {.number = NAN}}, "nan"},
        {0, {CELL_NUMBER, {.number = 5e-324}}, "5e-324"},
        {2, {CELL_INTEGER, {.integer = INT64_MIN}}, "-9223372036854775808"},
        {0, {CELL_TEXT, {.text = "1;2"}}, "1;2"},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        SCOPED_TEXT text = {0};
        row_add_text(&two_metrics, cases[i].metric, cases[i].cell, &text);
        assert_string_equal(text.bytes, cases[i].text);
    }
}

TEST_GROUP(src_cells) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers_keep_all_bits),       cmocka_unit_test(test_texts_are_one_line),
        cmocka_unit_test(test_only_whole_rows_are_valid),   cmocka_unit_test(test_rows_have_the_numbers_of_metrics),
        cmocka_unit_test(test_cells_are_written_as_in_csv),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
