// test_src_terminal_picture.c: tests that pictures are written to terminals in the format that the environment selects.
#include "check.h"
#include "view/terminal_picture.h"

#include <stdlib.h>

static TerminalPicture *new_picture_for(const char *term, const char *locale, bool colour) {
    static const char *const names[] = {"LC_CTYPE",     "LANG",          "TMUX",         "COLORTERM",
                                        "TERM_PROGRAM", "KITTY_PID",     "WINDOWID",     "VTE_VERSION",
                                        "MLTERM",       "XTERM_VERSION", "TERMINAL_NAME"};
    for (size_t i = 0; i < COUNT_OF(names); i++)
        unsetenv(names[i]);
    setenv("TERM", term, 1);
    setenv("LC_ALL", locale, 1);
    TerminalPicture *renderer = terminal_picture_new(-1, colour); // not a terminal: assumes cells of 8 by 16 pixels
    assert_non_null(renderer);
    return renderer;
}

static void test_fit_keeps_aspect_ratio(void **state) {
    static const struct {
        int columns;
        int rows;
        int width;
        int height;
        int wanted_columns;
        int wanted_rows;
    } rows[] = {
        {80, 24, 640, 384, 80, 24}, {80, 24, 1000, 1000, 48, 24}, {80, 24, 10000, 100, 80, 1},
        {80, 24, 1, 1, 48, 24},     {80, 24, 1, 10000, 1, 24},    {1, 1, 500, 500, 1, 1},
    };
    (void)state;
    TerminalPicture *renderer = new_picture_for("xterm-256color", "C.UTF-8", true);
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        TerminalCells cells =
            terminal_picture_fit(renderer, rows[i].columns, rows[i].rows, rows[i].width, rows[i].height);
        assert_int_equal(cells.columns, rows[i].wanted_columns);
        assert_int_equal(cells.rows, rows[i].wanted_rows);
        assert_true(cells.width >= cells.columns && cells.height >= cells.rows);
    }
    terminal_picture_free(renderer);
}

// Returns the output for a picture whose left half is white and whose right half is black.
static char *draw_halves(TerminalPicture *renderer, const TerminalCells *cells) {
    uint32_t *pixels = calloc((size_t)cells->width * (size_t)cells->height, sizeof *pixels);
    assert_non_null(pixels);
    for (int i = 0; i < cells->width * cells->height; i++)
        pixels[i] = i % cells->width < cells->width / 2 ? 0xFFFFFFFF : 0xFF000000;
    size_t length = 0;
    char *text = terminal_picture_text(renderer, pixels, cells, &length);
    assert_non_null(text);
    assert_int_equal(strlen(text), length);
    free(pixels);
    return text;
}

static int count(const char *text, char wanted) {
    int found = 0;
    for (; *text; text++)
        found += *text == wanted;
    return found;
}

static void test_cells_are_coloured_lines(void **state) {
    (void)state;
    TerminalPicture *renderer = new_picture_for("xterm-256color", "C.UTF-8", true);
    assert_false(terminal_picture_is_graphics(renderer));
    TerminalCells cells = terminal_picture_fit(renderer, 20, 5, 320, 160);
    char *text = draw_halves(renderer, &cells);
    assert_int_equal(count(text, '\n'), cells.rows - 1);
    assert_non_null(strstr(text, "\033[")); // the output is coloured
    free(text);
    terminal_picture_free(renderer);
}

static void test_other_locales_give_ascii(void **state) {
    static const char *const locales[] = {"C", "POSIX", "de_DE.ISO-8859-1", "xx"};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(locales); i++) {
        TerminalPicture *renderer = new_picture_for("xterm-256color", locales[i], false);
        TerminalCells cells = terminal_picture_fit(renderer, 20, 5, 320, 160);
        char *text = draw_halves(renderer, &cells);
        for (const char *at = text; *at; at++)
            assert_claim(locales[i], (unsigned char)*at < 128);
        free(text);
        terminal_picture_free(renderer);
    }
}

static void test_graphics_protocol_by_terminal(void **state) {
    (void)state;
    TerminalPicture *renderer = new_picture_for("xterm-kitty", "C.UTF-8", true);
    assert_true(terminal_picture_is_graphics(renderer));
    TerminalCells cells = terminal_picture_fit(renderer, 20, 5, 320, 160);
    char *text = draw_halves(renderer, &cells);
    assert_non_null(strstr(text, "\033_G"));
    free(text);
    terminal_picture_free(renderer);
    renderer = new_picture_for("mlterm", "C.UTF-8", true);
    assert_true(terminal_picture_is_graphics(renderer));
    text = draw_halves(renderer, &cells);
    assert_non_null(strstr(text, "\033P"));
    free(text);
    terminal_picture_free(renderer);
    renderer = new_picture_for("xterm-kitty", "C.UTF-8", false); // colours are off, as with NO_COLOR
    assert_false(terminal_picture_is_graphics(renderer));
    terminal_picture_free(renderer);
    renderer = new_picture_for("screen-256color", "C.UTF-8", true);
    assert_false(terminal_picture_is_graphics(renderer));
    terminal_picture_free(renderer);
}

static void test_unknown_terminals_work(void **state) {
    static const char *const terms[] = {"", "dumb", "no such terminal", "linux", "vt100"};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(terms); i++) {
        TerminalPicture *renderer = new_picture_for(terms[i], "C.UTF-8", true);
        TerminalCells cells = terminal_picture_fit(renderer, 20, 5, 320, 160);
        free(draw_halves(renderer, &cells));
        terminal_picture_free(renderer);
    }
    terminal_picture_free(NULL);
}

TEST_GROUP(src_terminal_picture) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fit_keeps_aspect_ratio),   cmocka_unit_test(test_cells_are_coloured_lines),
        cmocka_unit_test(test_other_locales_give_ascii), cmocka_unit_test(test_graphics_protocol_by_terminal),
        cmocka_unit_test(test_unknown_terminals_work),
    };
    if (!terminal_picture_possible()) {
        print_message("built without libchafa\n");
        return GROUP_SKIPPED;
    }
    return cmocka_run_group_tests_name("terminal_picture", tests, NULL, NULL);
}
