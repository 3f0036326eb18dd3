// plot.c: .plot, which plots a number over the last frames.
#include "repl/repl.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Size of the plot in character cells. A braille cell has 2 x 4 dots. Without UTF-8, a cell is one dot.
enum { MAX_WIDTH = 60, HEIGHT = 8, DEFAULT_FRAMES = 60, MAX_FRAMES = 1000000 };

typedef struct Canvas {
    int across;          // dots per cell, horizontally
    int down;            // dots per cell, vertically
    int columns;         // width in dots
    int rows;            // height in dots
    unsigned char *dots; // rows * columns values, each 0 or 1; row 0 is the top
} Canvas;

// Sets the dots of a column in rows `from` to `to`, so that steep parts of the curve have no gaps.
static void draw_column(Canvas *canvas, int x, int from, int to) {
    for (int y = from < to ? from : to; y <= (from < to ? to : from); y++)
        canvas->dots[y * canvas->columns + x] = 1;
}

typedef struct Range {
    double min;
    double max;
} Range;

static Range range_of(const double *values, int64_t count) {
    Range range = {INFINITY, -INFINITY};
    for (int64_t i = 0; i < count; i++) {
        if (isfinite(values[i])) {
            range.min = fmin(range.min, values[i]);
            range.max = fmax(range.max, values[i]);
        }
    }
    return range;
}

static int row_of(const Canvas *canvas, const Range *range, double value) {
    // The values are halved, so that the difference between the largest doubles does not overflow.
    double part = range->max > range->min ? (value / 2 - range->min / 2) / (range->max / 2 - range->min / 2) : 0.5;
    return canvas->rows - 1 - (int)(part * (canvas->rows - 1) + 0.5);
}

static void draw_curve(Canvas *canvas, const Range *range, const double *values, int64_t count) {
    int last = -1;
    for (int x = 0; x < canvas->columns; x++) {
        // With fewer frames than columns, a frame can cover several columns. With more frames, some are skipped.
        double value = values[(int64_t)((double)x * (double)count / canvas->columns)];
        int row = isfinite(value) ? row_of(canvas, range, value) : -1;
        if (row >= 0) {
            int from = last < 0 || last == row ? row : last < row ? last + 1 : last - 1;
            draw_column(canvas, x, from, row);
        }
        last = row;
    }
}

// Returns the dots of a cell as an offset from U+2800, the first braille character.
static unsigned cell_pattern(const Canvas *canvas, int row, int column) {
    static const unsigned char bits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    unsigned pattern = 0;
    for (int y = 0; y < canvas->down; y++) {
        for (int x = 0; x < canvas->across; x++) {
            bool set = canvas->dots[(row * canvas->down + y) * canvas->columns + column * canvas->across + x];
            pattern |= set ? bits[y][x] : 0;
        }
    }
    return pattern;
}

static void write_canvas(Output *output, const Canvas *canvas, const Range *range) {
    int rows = canvas->rows / canvas->down, columns = canvas->columns / canvas->across;
    bool braille = canvas->down > 1;
    for (int row = 0; row < rows; row++) {
        char label[32] = "";
        if (row == 0 || row == rows - 1)
            snprintf(label, sizeof label, "%.6g", row == 0 ? range->max : range->min);
        output_format(output, "%12s %s", label, braille ? "\u2502" : "|");
        int blanks = 0; // blanks to write before the next character; trailing blanks are not written
        for (int column = 0; column < columns; column++) {
            unsigned pattern = cell_pattern(canvas, row, column);
            char character[UTF8_MAX] = "*";
            if (!braille && pattern == 0) {
                blanks++;
                continue;
            }
            size_t length = braille ? utf8_encode(0x2800 + pattern, character) : 1;
            output_format(output, "%*s%.*s", blanks, "", (int)length, character);
            blanks = 0;
        }
        output_write(output, "\n", 1);
    }
}

static void print_plot(Repl *repl, const double *values, int64_t first, int64_t count) {
    Range range = range_of(values, count);
    if (range.min > range.max) {
        prompt_fail(&repl->prompt, "nothing to plot: no value is a finite number");
        return;
    }
    Canvas canvas = {.across = repl->utf8 ? 2 : 1, .down = repl->utf8 ? 4 : 1};
    int columns = count > MAX_WIDTH ? MAX_WIDTH : count < 20 ? 20 : (int)count;
    canvas.columns = columns * canvas.across;
    canvas.rows = HEIGHT * canvas.down;
    canvas.dots = memory_calloc((size_t)canvas.columns * (size_t)canvas.rows);
    draw_curve(&canvas, &range, values, count);
    write_canvas(&repl->output, &canvas, &range);
    char from[24], to[24];
    snprintf(from, sizeof from, "@%" PRId64, first);
    snprintf(to, sizeof to, "@%" PRId64, first + count - 1);
    output_format(&repl->output, "%14s%-*s%s\n", "", columns - (int)strlen(to), from, to);
    free(canvas.dots);
}

// Recomputes `count` frames, ending with the current frame, and evaluates the expression in each of them.
static PetriStatus evaluate_frames(Prompt *prompt, const char *expression, int64_t first, int64_t count,
                                   double *values) {
    PetriStatus status = PETRI_OK;
    for (int64_t i = 0; i < count && status == PETRI_OK; i++) {
        PetriEvaluation result = {0};
        status = prompt_go_to(prompt, first + i);
        if (status == PETRI_OK)
            status =
                petri_evaluate(prompt->session, expression, PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL);
        values[i] = result.number;
    }
    return status;
}

static bool plot_frames(Prompt *prompt, const char *expression, int64_t count) {
    int64_t now = petri_frame_number(prompt->session), first = now - count + 1;
    int64_t min = prompt_timeline(prompt).first + 1;
    first = first < min ? min : first;
    if (now < first)
        return prompt_fail(prompt, "no frames to plot; run .step first");
    double *values = memory_calloc((size_t)(now - first + 1) * sizeof *values);
    prompt_busy(prompt);
    PetriStatus status = evaluate_frames(prompt, expression, first, now - first + 1, values);
    bool stopped = prompt_idle(prompt);
    if (status == PETRI_OK) {
        print_plot(prompt->user_data, values, first, now - first + 1);
    } else {
        prompt_go_to(prompt, now);
        prompt_fail(prompt, "%s",
                    stopped                         ? "interrupted"
                    : status == PETRI_OUT_OF_MEMORY ? "out of memory"
                                                    : "nothing to plot");
    }
    free(values);
    return status == PETRI_OK && !prompt->failed;
}

bool repl_run_plot(Prompt *prompt, const char *rest) {
    SCOPED_STRING expression = memory_strdup(rest);
    int64_t count = DEFAULT_FRAMES;
    argument_last_count(expression, &count);
    if (count > MAX_FRAMES)
        return prompt_fail(prompt, "too many frames: the maximum is %d", MAX_FRAMES);
    PetriEvaluation result; // unused: this only checks the expression
    return prompt_status(prompt, petri_evaluate(prompt->session, expression, PETRI_NUL_TERMINATED, &result,
                                                sizeof result, NULL, NULL)) &&
           plot_frames(prompt, expression, count);
}
