// plot_grid.c: the plots of a sweep, drawn by a generated script. The grid has one row per metric. It has one column
// per name with several values and, with --every, one for the frame. If two names vary, a last column has heat maps.
#include "petri-draw.h"
#include "petri-edit.h"
#include "sweep/options.h"
#include "sweep/plots.h"
#include "sweep/table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// A heat map leaves place for its colour bar.
enum { MAP_WIDTH = 150, BAR_LEFT = MAP_WIDTH + 12, BAR_WIDTH = 10, BAR_PARTS = 32 };
enum { WIDTH = 220, HEIGHT = 160, LEFT = 80, TOP = 20, GAP_X = 90, GAP_Y = 60, MAX_POINTS = 5000, MAX_MEANS = 400 };

typedef struct Point {
    double x;
    double y;
    double error; // of a mean: its standard error; 0: unknown
} Point;

// The range of an axis. If it is logarithmic, `min` and `max` are decimal logarithms.
typedef struct Scale {
    double min;
    double max;
    bool logarithmic;
} Scale;

typedef struct Plot {
    Text bytes; // of the points
    Point *points;
    size_t count;
    Scale x;
    Scale y;
} Plot;

static const size_t FRAMES = SIZE_MAX;  // axis index that means that the x axis shows the frame
static const size_t MAP = SIZE_MAX - 1; // means a heat map of the two names that vary

static void extend_scale(Scale *scale, double x) {
    scale->min = x < scale->min ? x : scale->min;
    scale->max = x > scale->max ? x : scale->max;
}

static int compare_numbers(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Returns true if the range of positive numbers contains two powers of ten, for ticks, and if their logarithms are
// spread more evenly than the numbers, as those of 1, 10, 100: the largest gap between neighbours is a smaller part of
// the range.
static bool is_logarithmic(double *numbers, size_t count) {
    double gap = 0, log_gap = 0;
    qsort(numbers, count, sizeof *numbers, compare_numbers);
    if (count < 3 || !(numbers[0] > 0) || floor(log10(numbers[count - 1]) + 1e-9) <= ceil(log10(numbers[0]) - 1e-9))
        return false;
    for (size_t i = 1; i < count; i++) {
        gap = fmax(gap, numbers[i] - numbers[i - 1]);
        log_gap = fmax(log_gap, log(numbers[i] / numbers[i - 1]));
    }
    return log_gap / log(numbers[count - 1] / numbers[0]) < gap / (numbers[count - 1] - numbers[0]);
}

// Returns the scale of some numbers. Sorts them.
static Scale make_scale(double *numbers, size_t count) {
    Scale scale = {INFINITY, -INFINITY, is_logarithmic(numbers, count)};
    for (size_t i = 0; i < count; i++)
        extend_scale(&scale, scale.logarithmic ? log10(numbers[i]) : numbers[i]);
    double margin = (scale.max - scale.min) * 0.04;
    scale.min -= margin;
    scale.max += margin;
    return scale;
}

// Returns the value with this index as a number. If the values of the axis are texts, returns `index` itself.
static double axis_number(const Axis *axis, uint32_t index) {
    Cell cell = axis_cell(axis, axis->values.items[index]);
    return cell.kind == CELL_INTEGER ? (double)cell.as.integer : cell.kind == CELL_NUMBER ? cell.as.number : index;
}

// Collects the points of a plot of a metric. If the x axis is the frame, uses all rows. Otherwise uses one row
// per run: the last in which the metric is a number.
static Plot collect_points(const Sweep *sweep, size_t axis, size_t metric) {
    const Design *design = &sweep->design;
    Plot plot = {0};
    for (size_t run = 0; run < design->run_count; run++) {
        Row row;
        size_t first = plot.bytes.len;
        double x = axis == FRAMES
                       ? 0
                       : axis_number(&design->axes[axis], design->value_indices[run * design->axis_count + axis]);
        for (Str rows = sweep->results[run].rows; row_next(sweep, &rows, metric, &row);) {
            if (isnan(row.x))
                continue;
            Point point = {axis == FRAMES ? (double)row.frame : x, row.x, 0};
            plot.bytes.len = axis == FRAMES ? plot.bytes.len : first;
            text_add(&plot.bytes, (Str){(const char *)&point, sizeof point});
        }
    }
    plot.points = (void *)plot.bytes.bytes;
    plot.count = plot.bytes.len / sizeof *plot.points;
    double *numbers = memory_calloc((plot.count + 1) * sizeof *numbers);
    for (size_t i = 0; i < plot.count; i++)
        numbers[i] = plot.points[i].x;
    plot.x = make_scale(numbers, plot.count);
    for (size_t i = 0; i < plot.count; i++)
        numbers[i] = plot.points[i].y;
    plot.y = make_scale(numbers, plot.count);
    free(numbers);
    return plot;
}

// Returns the position of a number on an axis. Numbers that a logarithmic axis cannot show are at its start.
static double scale_position(const Scale *scale, double x, double length) {
    x = !scale->logarithmic ? x : x > 0 ? fmax(log10(x), scale->min) : scale->min;
    return scale->max > scale->min ? (x - scale->min) / (scale->max - scale->min) * length : length / 2;
}

// Returns the distance between ticks, chosen to give about four: 1, 2 or 5 times a power of ten, or whole decades.
static double tick_step(const Scale *scale) {
    if (scale->logarithmic)
        return fmax(1, floor((scale->max - scale->min) / 4));
    double rough = (scale->max - scale->min) / 4, power = pow(10, floor(log10(rough)));
    double times = rough / power;
    return power * (times < 1.5 ? 1 : times < 3.5 ? 2 : times < 7.5 ? 5 : 10);
}

static void add_text(Text *out, const char *text, double x, double y, double rotate) {
    text_add_format(
        out, "                    !transform translate=%.1f;%.1f rotate=%g\n                        !text text=", x, y,
        rotate);
    axis_add_literal(out, text);
    text_add_format(out, "\n");
}

static void add_ticks(Text *out, const Scale *scale, bool across) {
    char label[32];
    if (!(scale->max > scale->min)) {
        snprintf(label, sizeof label, "%.4g", scale->min);
        add_text(out, label, across ? WIDTH / 2.0 : -26, across ? HEIGHT + 12 : HEIGHT / 2.0, 0);
        return;
    }
    double step = tick_step(scale);
    for (double k = ceil(scale->min / step - 1e-9); k * step <= scale->max + 1e-9 * step; k++) {
        double number = scale->logarithmic ? pow(10, k * step) : k * step;
        double at = scale_position(scale, number, across ? WIDTH : HEIGHT);
        double x = across ? at : -4, y = across ? HEIGHT : HEIGHT - at;
        text_add_format(out, "                    !line points=%.1f;%.1f;%.1f;%.1f stroke=true\n", x, y,
                        across ? at : 0, across ? HEIGHT + 4 : y);
        snprintf(label, sizeof label, "%.6g", number + 0.0); // adding 0 changes -0 to 0
        add_text(out, label, across ? at : -26, across ? HEIGHT + 12 : y, 0);
    }
}

static void add_numbers(Text *out, const Plot *plot, const Point *points, size_t count, size_t step) {
    for (size_t i = 0; i < count; i += step) {
        text_add_format(out, "%s%.2f;%.2f", i == 0 ? "" : ";", scale_position(&plot->x, points[i].x, WIDTH),
                        HEIGHT - scale_position(&plot->y, points[i].y, HEIGHT));
    }
}

static int compare_points(const void *a, const void *b) {
    const Point *p = a, *q = b;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : (p->y > q->y) - (p->y < q->y);
}

// Replaces points with the same x by their mean and its standard error. Returns the number of means.
static size_t average_points(Plot *plot) {
    size_t means = 0;
    qsort(plot->points, plot->count, sizeof *plot->points, compare_points);
    for (size_t i = 0, next = 0; i < plot->count; i = next) {
        double sum = 0, squares = 0, x = plot->points[i].x;
        while (next < plot->count && plot->points[next].x == x)
            sum += plot->points[next++].y;
        double count = (double)(next - i), mean = sum / count;
        for (size_t k = i; k < next; k++)
            squares += (plot->points[k].y - mean) * (plot->points[k].y - mean);
        plot->points[means++] = (Point){x, mean, count > 1 ? sqrt(squares / (count - 1) / count) : 0};
    }
    return means;
}

// Draws bars of one standard error above and below each mean.
static void add_error_bars(Text *out, const Plot *plot, size_t means) {
    for (size_t i = 0; i < means; i++) {
        Point mean = plot->points[i];
        double x = scale_position(&plot->x, mean.x, WIDTH);
        double top = HEIGHT - scale_position(&plot->y, mean.y + mean.error, HEIGHT);
        double bottom = HEIGHT - scale_position(&plot->y, mean.y - mean.error, HEIGHT);
        if (mean.error > 0)
            text_add_format(out,
                            "                    !line stroke=true stroke_width=1.2 color=0.85;0.35;0.1 "
                            "points=%.2f;%.2f;%.2f;%.2f;%.2f;%.2f;%.2f;%.2f;%.2f;%.2f;%.2f;%.2f\n",
                            x - 3, top, x + 3, top, x, top, x, bottom, x - 3, bottom, x + 3, bottom);
    }
}

// Adds a plot. `bars`: the points of each mean differ only in their seeds, so the error of the mean is known.
static void add_plot(Text *out, Plot *plot, bool bars) {
    text_add_format(out, "                    !rect size=%d;%d stroke=true\n", WIDTH, HEIGHT);
    if (plot->count == 0)
        return;
    add_ticks(out, &plot->x, true);
    add_ticks(out, &plot->y, false);
    text_add_format(out, "                    for x;y in (");
    add_numbers(out, plot, plot->points, plot->count, plot->count / MAX_POINTS + 1);
    text_add_format(out,
                    ")\n                        !ellipse point=x;y radius=1.8 fill=true color=0.15;0.4;0.75;0.5\n");
    size_t means = average_points(plot);
    if (means > 1 && means <= MAX_MEANS && means < plot->count) {
        text_add_format(out, "                    !line stroke=true stroke_width=1.5 color=0.85;0.35;0.1 points=");
        add_numbers(out, plot, plot->points, means, 1);
        text_add_format(out, "\n");
        if (bars)
            add_error_bars(out, plot, means);
    }
}

// --- heat maps

// The mean of a metric in a cell of a heat map.
typedef struct MapCell {
    double sum;
    size_t count;
} MapCell;

// Adds the last value of each run to its cell: cells[y * width + x] for the values x and y of the two names.
static void sum_cells(const Sweep *sweep, const size_t *axes, size_t metric, MapCell *cells) {
    const Design *design = &sweep->design;
    size_t width = design->axes[axes[0]].values.count;
    for (size_t run = 0; run < design->run_count; run++) {
        const uint32_t *values = &design->value_indices[run * design->axis_count];
        MapCell *cell = &cells[values[axes[1]] * width + values[axes[0]]];
        double last = NAN;
        Row row;
        for (Str rows = sweep->results[run].rows; row_next(sweep, &rows, metric, &row);)
            last = isnan(row.x) ? last : row.x;
        cell->sum += isnan(last) ? 0 : last;
        cell->count += !isnan(last);
    }
}

// Writes about six values of an axis beside the cells to which they belong.
static void add_map_labels(Text *out, const Axis *axis, bool across) {
    size_t count = axis->values.count, step = (count + 5) / 6;
    for (size_t i = 0; i < count; i += step) {
        double part = ((double)i + 0.5) / (double)count;
        add_text(out, axis->values.items[i], across ? part * MAP_WIDTH : -26,
                 across ? HEIGHT + 12 : HEIGHT * (1 - part), 0);
    }
}

// Returns the scale of the means. It begins and ends with means, for the numbers at the ends of the colour bar.
static Scale map_scale(const MapCell *cells, size_t count) {
    double *means = memory_calloc((count + 1) * sizeof *means);
    size_t used = 0;
    for (size_t i = 0; i < count; i++)
        if (cells[i].count > 0)
            means[used++] = cells[i].sum / (double)cells[i].count;
    Scale scale = {INFINITY, -INFINITY, is_logarithmic(means, used)};
    for (size_t i = 0; i < used; i++)
        extend_scale(&scale, scale.logarithmic ? log10(means[i]) : means[i]);
    free(means);
    return scale;
}

// Adds a rectangle in the colour of a part of the scale, from blue (0) to yellow (1).
static void add_coloured(Text *out, double x, double y, double width, double height, double part) {
    text_add_format(out, "                    !rect point=%.3f;%.3f size=%.3f;%.3f fill=true color=%.3f;%.3f;%.3f\n", x,
                    y, width, height, 0.2 + 0.75 * part, 0.1 + 0.75 * part, 0.45 - 0.3 * part);
}

static void add_colour_bar(Text *out, const Scale *scale) {
    double part = (double)HEIGHT / BAR_PARTS;
    for (int i = 0; i < BAR_PARTS; i++) // each reaches below the next one, so that no gap is visible
        add_coloured(out, BAR_LEFT, i * part, BAR_WIDTH, HEIGHT - i * part, 1 - (i + 0.5) / BAR_PARTS);
    text_add_format(out, "                    !rect point=%d;0 size=%d;%d stroke=true\n", BAR_LEFT, BAR_WIDTH, HEIGHT);
    for (int top = 0; top < 2; top++) {
        char label[32];
        double end = top ? scale->max : scale->min;
        snprintf(label, sizeof label, "%.4g", scale->logarithmic ? pow(10, end) : end);
        add_text(out, label, BAR_LEFT + BAR_WIDTH + 32, top ? 5 : HEIGHT - 5, 0);
    }
}

// Adds a heat map of the means of a metric. Cells without a value stay empty.
static void add_map(const Sweep *sweep, const size_t *axes, size_t metric, Text *out) {
    const Axis *across = &sweep->design.axes[axes[0]], *up = &sweep->design.axes[axes[1]];
    size_t columns = across->values.count, count = columns * up->values.count;
    double width = (double)MAP_WIDTH / (double)columns, height = (double)HEIGHT / (double)up->values.count;
    MapCell *cells = memory_calloc(count * sizeof *cells);
    sum_cells(sweep, axes, metric, cells);
    Scale scale = map_scale(cells, count);
    for (size_t i = 0; i < count; i++)
        if (cells[i].count > 0)
            add_coloured(out, (double)(i % columns) * width, HEIGHT - (double)(i / columns + 1) * height, width, height,
                         scale_position(&scale, cells[i].sum / (double)cells[i].count, 1));
    free(cells);
    text_add_format(out, "                    !rect size=%d;%d stroke=true\n", MAP_WIDTH, HEIGHT);
    add_map_labels(out, across, true);
    add_map_labels(out, up, false);
    if (scale.min <= scale.max)
        add_colour_bar(out, &scale);
    add_text(out, scale.min <= scale.max ? row_number_name(sweep, metric) : "no values", MAP_WIDTH / 2.0, -8, 0);
}

// Finds the names that vary, and the other columns. Returns the number of columns.
static size_t find_columns(const Sweep *sweep, size_t *columns, size_t *varied) {
    enum { MAX_CELLS = 10000 };
    const Axis *axes = sweep->design.axes;
    size_t count = 0;
    for (size_t i = 0; i < sweep->design.axis_count - sweep->design.seeded; i++)
        if (axes[i].values.count > 1)
            columns[count++] = i;
    *varied = count;
    if (sweep->own->row_every > 0 || count == 0)
        columns[count++] = FRAMES;
    // With --sample, each run has other values, so nearly all cells would be empty.
    if (*varied == 2 && !sweep->own->sample &&
        axes[columns[0]].values.count * axes[columns[1]].values.count <= MAX_CELLS)
        columns[count++] = MAP;
    return count;
}

static const char *column_name(const Sweep *sweep, const size_t *columns, size_t column) {
    return columns[column] == FRAMES ? "frame" : sweep->design.axes[columns[columns[column] == MAP ? 0 : column]].name;
}

static void add_column(const Sweep *sweep, const size_t *columns, size_t column, bool bars, size_t row, Text *out) {
    bool map = columns[column] == MAP;
    if (map) {
        add_map(sweep, columns, row, out);
    } else {
        Plot plot = collect_points(sweep, columns[column], row);
        add_plot(out, &plot, bars);
        text_free(&plot.bytes);
    }
    add_text(out, column_name(sweep, columns, column), (map ? MAP_WIDTH : WIDTH) / 2.0, HEIGHT + 28, 0);
    add_text(out, map ? sweep->design.axes[columns[1]].name : row_number_name(sweep, row), -60, HEIGHT / 2.0, -0.25);
}

// Writes the script that draws the grid.
static void write_script(const Sweep *sweep, Text *out) {
    size_t *columns = memory_calloc((sweep->design.axis_count + 2) * sizeof *columns), varied = 0;
    size_t across = find_columns(sweep, columns, &varied), down = row_numbers(sweep);
    text_add_format(out, "!window size=%zu;%zu\n    !canvas\n        !font size=11 family=\"DejaVu Sans\"\n",
                    across * (WIDTH + GAP_X), down * (HEIGHT + GAP_Y));
    text_add_format(out, "            !rect size=%zu;%zu fill=true color=1\n", across * (WIDTH + GAP_X),
                    down * (HEIGHT + GAP_Y));
    for (size_t i = 0; i < across * down; i++) {
        size_t column = i % across, row = i / across;
        text_add_format(out, "            !transform translate=%zu;%zu\n                !paint color=0.1\n",
                        LEFT + column * (WIDTH + GAP_X), TOP + row * (HEIGHT + GAP_Y));
        add_column(sweep, columns, column, varied == (columns[column] != FRAMES), row, out);
    }
    free(columns);
}

static void on_diagnostic(void *user_data, const PetriDiagnostic *diagnostic) {
    (void)user_data;
    fputs(diagnostic->rendered, stderr);
}

bool plot_grid_fits(const char *path) {
    return petri_picture_can_save(path);
}

bool plot_grid_draw(const Sweep *sweep, const char *path) {
    SCOPED_TEXT script = {0};
    write_script(sweep, &script);
    PetriOptions wanted = petri_default_options();
    wanted.stack_limit = sweep->host->stack_bytes;
    wanted.no_files = true;
    wanted.on_diagnostic = on_diagnostic;
    PetriSession *session = petri_open(&wanted);
    PetriPainter *painter = petri_painter_open();
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    PetriStatus status = !session ? PETRI_OUT_OF_MEMORY : petri_load_text(session, "plot", script.bytes, script.len);
    status = status == PETRI_OK ? petri_step(session) : status;
    status = status == PETRI_OK ? petri_picture(session, &options, &picture) : status;
    status = status == PETRI_OK ? petri_picture_save(picture, painter, path) : status;
    petri_picture_report(session, picture);
    petri_picture_free(&picture);
    petri_painter_close(&painter);
    petri_close(&session);
    if (status != PETRI_OK)
        message("cannot draw the plot %s", path);
    return status == PETRI_OK;
}
