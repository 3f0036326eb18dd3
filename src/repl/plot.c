// plot.c: .plot, which plots numbers over the last frames.
#include "repl/repl.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Size of the plot in character cells. A braille cell has 2 x 4 dots. Without UTF-8, a cell is one dot.
enum { MAX_CURVES = 4, MAX_WIDTH = 60, HEIGHT = 8, DEFAULT_FRAMES = 60, MAX_FRAMES = 1000000 };

typedef struct Canvas {
    int across;          // dots per cell, horizontally
    int down;            // dots per cell, vertically
    int columns;         // width in dots
    int rows;            // height in dots
    unsigned char *dots; // rows * columns values: 0, or 1 + the number of a curve; row 0 is the top
} Canvas;

// Sets the dots of a column in rows `from` to `to`, so that steep parts of the curve have no gaps.
static void draw_column(Canvas *canvas, unsigned curve, int x, int from, int to) {
    for (int y = from < to ? from : to; y <= (from < to ? to : from); y++)
        canvas->dots[y * canvas->columns + x] = (unsigned char)(curve + 1);
}

typedef struct Range {
    double min;
    double max;
} Range;

// The values of an expression in successive frames: one curve for each element.
typedef struct Series {
    int64_t first; // first frame
    int64_t count; // number of frames
    unsigned curves;
    double *values[MAX_CURVES]; // `count` numbers each; NaN: none
    Text last;                  // printed form of the last value
} Series;

static Range range_of(const Series *series) {
    Range range = {INFINITY, -INFINITY};
    for (unsigned curve = 0; curve < series->curves; curve++)
        for (int64_t i = 0; i < series->count; i++)
            if (isfinite(series->values[curve][i])) {
                range.min = fmin(range.min, series->values[curve][i]);
                range.max = fmax(range.max, series->values[curve][i]);
            }
    return range;
}

static int row_of(const Canvas *canvas, const Range *range, double value) {
    // The values are halved, so that the difference between the largest doubles does not overflow.
    double part = range->max > range->min ? (value / 2 - range->min / 2) / (range->max / 2 - range->min / 2) : 0.5;
    return canvas->rows - 1 - (int)(part * (canvas->rows - 1) + 0.5);
}

static void draw_curve(Canvas *canvas, const Range *range, unsigned curve, const double *values, int64_t count) {
    int last = -1;
    for (int x = 0; x < canvas->columns; x++) {
        // With fewer frames than columns, a frame can cover several columns. With more frames, some are skipped.
        double value = values[(int64_t)((double)x * (double)count / canvas->columns)];
        int row = isfinite(value) ? row_of(canvas, range, value) : -1;
        if (row >= 0) {
            int from = last < 0 || last == row ? row : last < row ? last + 1 : last - 1;
            draw_column(canvas, curve, x, from, row);
        }
        last = row;
    }
}

// Returns the dots of a cell as an offset from U+2800, the first braille character. Sets *curve to the number of a
// curve in the cell.
static unsigned cell_pattern(const Canvas *canvas, int row, int column, unsigned *curve) {
    static const unsigned char bits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    unsigned pattern = 0;
    for (int y = 0; y < canvas->down; y++) {
        for (int x = 0; x < canvas->across; x++) {
            unsigned dot = canvas->dots[(row * canvas->down + y) * canvas->columns + column * canvas->across + x];
            pattern |= dot > 0 ? bits[y][x] : 0;
            *curve = dot > 0 ? dot - 1 : *curve;
        }
    }
    return pattern;
}

static const char MARKS[] = "*+ox"; // of curves, in plots without braille characters

// Writes a character in the colour of a curve, or without colour.
static void write_mark(const Repl *repl, Output *output, unsigned curve, const char *text) {
    if (repl->options->colour && curve > 0)
        output_format(output, "\033[%um%s\033[0m", 31 + curve, text);
    else
        output_format(output, "%s", text);
}

static void write_canvas(const Repl *repl, Output *output, const Canvas *canvas, const Range *range) {
    int rows = canvas->rows / canvas->down, columns = canvas->columns / canvas->across;
    bool braille = canvas->down > 1;
    for (int row = 0; row < rows; row++) {
        char label[32] = "";
        if (row == 0 || row == rows - 1)
            snprintf(label, sizeof label, "%.6g", row == 0 ? range->max : range->min);
        output_format(output, "%12s %s", label, braille ? "\u2502" : "|");
        int blanks = 0; // blanks to write before the next character; trailing blanks are not written
        for (int column = 0; column < columns; column++) {
            unsigned curve = 0, pattern = cell_pattern(canvas, row, column, &curve);
            char character[UTF8_MAX + 1] = {MARKS[curve]};
            if (!braille && pattern == 0) {
                blanks++;
                continue;
            }
            if (braille)
                utf8_encode(0x2800 + pattern, character);
            output_format(output, "%*s", blanks, "");
            write_mark(repl, output, curve, character);
            blanks = 0;
        }
        output_write(output, "\n", 1);
    }
}

// Writes which curve is which element of the vector.
static void write_legend(Repl *repl, unsigned curves) {
    output_format(&repl->output, "%14selement", "");
    for (unsigned curve = 0; curve < curves; curve++) {
        char name[16];
        snprintf(name, sizeof name, " %u %c", curve, repl->utf8 ? ' ' : MARKS[curve]);
        write_mark(repl, &repl->output, curve, name);
    }
    output_write(&repl->output, "\n", 1);
}

static void print_plot(Repl *repl, const Series *series) {
    Range range = range_of(series);
    if (range.min > range.max) {
        prompt_fail(&repl->prompt, "nothing to plot: in frame %" PRId64 ", the value is %.40s",
                    series->first + series->count - 1, series->last.len > 0 ? series->last.bytes : "empty");
        return;
    }
    Canvas canvas = {.across = repl->utf8 ? 2 : 1, .down = repl->utf8 ? 4 : 1};
    int64_t count = series->count;
    int columns = count > MAX_WIDTH ? MAX_WIDTH : count < 20 ? 20 : (int)count;
    canvas.columns = columns * canvas.across;
    canvas.rows = HEIGHT * canvas.down;
    canvas.dots = memory_calloc((size_t)canvas.columns * (size_t)canvas.rows);
    for (unsigned curve = series->curves; curve-- > 0;)
        draw_curve(&canvas, &range, curve, series->values[curve], count);
    write_canvas(repl, &repl->output, &canvas, &range);
    char from[24], to[24];
    snprintf(from, sizeof from, "@%" PRId64, series->first);
    snprintf(to, sizeof to, "@%" PRId64, series->first + count - 1);
    output_format(&repl->output, "%14s%-*s%s\n", "", columns - (int)strlen(to), from, to);
    if (series->curves > 1)
        write_legend(repl, series->curves);
    free(canvas.dots);
}

// Stores the elements of the value in series->last as the values of a frame.
static void store_elements(Series *series, int64_t frame, const PetriEvaluation *result) {
    const char *at = series->last.len > 0 ? series->last.bytes : "";
    for (unsigned curve = 0; curve < MAX_CURVES; curve++) {
        char *end = NULL;
        double value = curve < result->length ? strtod(at, &end) : NAN;
        bool given = end && end > at && (*end == ';' || *end == '\0');
        series->values[curve][frame] = given ? value : NAN;
        series->curves = given && curve >= series->curves ? curve + 1 : series->curves;
        at = given && *end == ';' ? end + 1 : "";
    }
}

// Recomputes the frames of the series and evaluates the expression in each of them.
static PetriStatus evaluate_frames(Prompt *prompt, const char *expression, Series *series) {
    PetriStatus status = PETRI_OK;
    for (int64_t i = 0; i < series->count && status == PETRI_OK; i++) {
        PetriEvaluation result = {0};
        series->last.len = 0;
        status = prompt_go_to(prompt, series->first + i);
        if (status == PETRI_OK)
            status = petri_evaluate(prompt->session, expression, PETRI_NUL_TERMINATED, &result, sizeof result,
                                    text_collect, &series->last);
        store_elements(series, i, &result);
    }
    return status;
}

static bool plot_frames(Prompt *prompt, const char *expression, int64_t count) {
    int64_t now = petri_frame_number(prompt->session), first = now - count + 1;
    int64_t min = prompt_timeline(prompt).first + 1;
    Series series = {.first = first < min ? min : first, .curves = 1};
    if (now < series.first)
        return prompt_fail(prompt, "no frames to plot; run .step first");
    series.count = now - series.first + 1;
    for (unsigned curve = 0; curve < MAX_CURVES; curve++)
        series.values[curve] = memory_calloc((size_t)series.count * sizeof(double));
    prompt_busy(prompt);
    PetriStatus status = evaluate_frames(prompt, expression, &series);
    bool stopped = prompt_idle(prompt);
    if (status == PETRI_OK) {
        print_plot(prompt->user_data, &series);
    } else {
        prompt_go_to(prompt, now);
        prompt_fail(prompt, "%s",
                    stopped                         ? "interrupted"
                    : status == PETRI_OUT_OF_MEMORY ? "out of memory"
                                                    : "nothing to plot");
    }
    for (unsigned curve = 0; curve < MAX_CURVES; curve++)
        free(series.values[curve]);
    text_free(&series.last);
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
