// plot.c: a number over the last frames, drawn as a line, and how long things take.
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/progress.h"
#include "repl/repl.h"
#include "repl/words.h"

// Cells of the picture. A braille cell is 2 dots wide and 4 high; without Unicode a cell is one dot.
enum { WIDEST = 60, HEIGHT = 8, DEFAULT_FRAMES = 60, MOST_FRAMES = 1000000 };

typedef struct Canvas {
    bool braille;
    int columns; // of dots
    int rows;
    unsigned char *dots;
} Canvas;

static void set_dot(Canvas *canvas, int x, int y) {
    canvas->dots[y * canvas->columns + x] = 1;
}

// The dots of a column from one height to another, so that steep parts stay a line.
static void draw_column(Canvas *canvas, int x, int from, int to) {
    int step = from < to ? 1 : -1;
    for (int y = from; y != to; y += step) {
        set_dot(canvas, x, y);
    }
    set_dot(canvas, x, to);
}

typedef struct Range {
    double least;
    double most;
} Range;

static Range range_of(const double *values, int64_t count) {
    Range range = {INFINITY, -INFINITY};
    for (int64_t i = 0; i < count; i++) {
        if (isfinite(values[i])) {
            range.least = fmin(range.least, values[i]);
            range.most = fmax(range.most, values[i]);
        }
    }
    return range;
}

static int row_of(const Canvas *canvas, const Range *range, double value) {
    double part = range->most > range->least ? (value - range->least) / (range->most - range->least) : 0.5;
    return canvas->rows - 1 - (int)(part * (canvas->rows - 1) + 0.5);
}

static void draw(Canvas *canvas, const Range *range, const double *values, int64_t count) {
    int last = -1;
    for (int x = 0; x < canvas->columns; x++) {
        // Where frames are fewer than dots, each has several; where they are more, some are passed over.
        double value = values[(int64_t)((double)x * (double)count / canvas->columns)];
        int row = isfinite(value) ? row_of(canvas, range, value) : -1;
        if (row >= 0) {
            int from = last < 0 || last == row ? row : last < row ? last + 1 : last - 1;
            draw_column(canvas, x, from, row);
        }
        last = row;
    }
}

static void write_braille(Output *output, const Canvas *canvas, int row, int column) {
    static const unsigned char bits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    unsigned pattern = 0;
    for (int y = 0; y < 4; y++) {
        for (int x = 0; x < 2; x++) {
            bool set = canvas->dots[(row * 4 + y) * canvas->columns + column * 2 + x];
            pattern |= set ? bits[y][x] : 0;
        }
    }
    // U+2800 and what follows.
    const char utf8[3] = {(char)0xe2, (char)(0xa0 | pattern >> 6), (char)(0x80 | (pattern & 0x3f))};
    output_write(output, utf8, sizeof utf8);
}

static void write_canvas(Output *output, const Canvas *canvas, const Range *range) {
    int rows = canvas->braille ? canvas->rows / 4 : canvas->rows;
    int columns = canvas->braille ? canvas->columns / 2 : canvas->columns;
    for (int row = 0; row < rows; row++) {
        const unsigned char *dots = canvas->dots + row * canvas->columns;
        int last = columns; // blanks at the end say nothing
        while (!canvas->braille && last > 0 && !dots[last - 1]) {
            last--;
        }
        char label[32] = "";
        if (row == 0 || row == rows - 1) {
            snprintf(label, sizeof label, "%.6g", row == 0 ? range->most : range->least);
        }
        output_format(output, "%12s %s", label, canvas->braille ? "\u2502" : "|");
        for (int column = 0; column < last; column++) {
            if (canvas->braille) {
                write_braille(output, canvas, row, column);
            } else {
                output_write(output, dots[column] ? "*" : " ", 1);
            }
        }
        output_write(output, "\n", 1);
    }
}

static void plot(Repl *repl, const double *values, int64_t first, int64_t count) {
    Range range = range_of(values, count);
    if (range.least > range.most) {
        repl_fail(repl, "there is no number to plot");
        return;
    }
    Canvas canvas = {.braille = repl->utf8};
    int columns = count > WIDEST ? WIDEST : count < 20 ? 20 : (int)count;
    canvas.columns = canvas.braille ? columns * 2 : columns;
    canvas.rows = canvas.braille ? HEIGHT * 4 : HEIGHT;
    canvas.dots = memory_zeroed((size_t)(canvas.columns * canvas.rows));
    draw(&canvas, &range, values, count);
    write_canvas(&repl->output, &canvas, &range);
    char from[24], to[24];
    snprintf(from, sizeof from, "@%" PRId64, first);
    snprintf(to, sizeof to, "@%" PRId64, first + count - 1);
    output_format(&repl->output, "%14s%-*s%s\n", "", columns - (int)strlen(to), from, to);
    free(canvas.dots);
}

// Goes through the frames again, which ends where it began.
static PetriStatus gather(Repl *repl, const char *expression, int64_t first, int64_t count, double *values,
                          Bytes *why) {
    PetriStatus status = PETRI_OK;
    for (int64_t i = 0; i < count && status == PETRI_OK; i++) {
        PetriResult result = {0};
        status = history_goto(&repl->history, repl->session, first + i, why);
        if (status == PETRI_OK) {
            status = petri_evaluate(repl->session, expression, PETRI_Z, &result, NULL, NULL);
        }
        values[i] = result.number;
    }
    return status;
}

static bool plot_frames(Repl *repl, const char *expression, int64_t count) {
    int64_t now = petri_frame(repl->session).number, first = now - count + 1;
    int64_t least = repl->history.first + 1;
    first = first < least ? least : first;
    if (now < first) {
        return repl_fail(repl, "there are no frames to plot; .step makes some");
    }
    Bytes why = {0};
    double *values = memory_zeroed((size_t)(now - first + 1) * sizeof *values);
    repl_busy(repl);
    PetriStatus status = gather(repl, expression, first, now - first + 1, values, &why);
    bool stopped = repl_idle(repl);
    if (status == PETRI_OK) {
        plot(repl, values, first, now - first + 1);
    } else {
        history_goto(&repl->history, repl->session, now, &why);
        repl_fail(repl, "%s", stopped ? "interrupted" : why.length > 0 ? why.data : "there is nothing to plot");
    }
    free(values);
    bytes_free(&why);
    return status == PETRI_OK && !repl->failed;
}

bool repl_plot(Repl *repl, const char *rest) {
    char *expression = memory_copied(rest, strlen(rest));
    int64_t count = DEFAULT_FRAMES;
    word_last_count(expression, &count);
    bool good = expression[0] != '\0' || repl_fail(repl, ".plot needs an expression");
    if (good && count > MOST_FRAMES) {
        good = repl_fail(repl, "at most %d frames are plotted", MOST_FRAMES);
    }
    PetriResult result; // of the present frame: whether it is an expression at all
    good = good && repl_status(repl, petri_evaluate(repl->session, expression, PETRI_Z, &result, NULL, NULL));
    good = good && plot_frames(repl, expression, count);
    free(expression);
    return good;
}

static void say_seconds(Repl *repl, double seconds, const char *more) {
    static const struct {
        double unit;
        const char *name;
    } units[] = {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}};
    size_t i = 0;
    while (i < 3 && seconds < units[i].unit) {
        i++;
    }
    repl_say(repl, "%.3g %s%s", seconds / units[i].unit, units[i].name, more);
}

// The best of many, since other programs can only make it slower.
static bool time_expression(Repl *repl, const char *expression) {
    double best = INFINITY, start = clock_seconds();
    int64_t count = 0;
    PetriStatus status = PETRI_OK;
    repl_busy(repl);
    while (status == PETRI_OK && count < 100000 && (count < 3 || clock_seconds() - start < 0.2)) {
        PetriResult result;
        status = petri_evaluate(repl->session, expression, PETRI_Z, &result, NULL, NULL);
        best = status == PETRI_OK ? fmin(best, result.seconds) : best;
        count++;
    }
    repl_idle(repl);
    if (repl_status(repl, status)) {
        say_seconds(repl, best, ", the best of several evaluations");
    }
    return status == PETRI_OK;
}

bool repl_time(Repl *repl, const char *rest) {
    if (rest[0] == '\0') {
        return repl_fail(repl, ".time needs an expression, or a command");
    }
    if (rest[0] != '.' || (rest[1] >= '0' && rest[1] <= '9') || rest[1] == '.') {
        return time_expression(repl, rest);
    }
    double start = clock_seconds();
    repl_command(repl, rest);
    double seconds = clock_seconds() - start;
    say_seconds(repl, seconds, "");
    return !repl->failed;
}
