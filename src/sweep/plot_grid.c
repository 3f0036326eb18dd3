// plot_grid.c: the plots of a sweep, drawn by a generated script. The grid has one row per metric. It has one column
// per name with several values and, with --every, one for the frame.
#include "petri-draw.h"
#include "petri-edit.h"
#include "sweep/options.h"
#include "sweep/plots.h"
#include "sweep/table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 220, HEIGHT = 160, LEFT = 80, TOP = 20, GAP_X = 90, GAP_Y = 60, MAX_POINTS = 5000, MAX_MEANS = 400 };

typedef struct Point {
    double x;
    double y;
} Point;

typedef struct Scale {
    double min;
    double max;
} Scale;

typedef struct Plot {
    Text bytes; // of the points
    Point *points;
    size_t count;
    Scale x;
    Scale y;
} Plot;

static const size_t FRAMES = SIZE_MAX; // axis index that means that the x axis shows the frame

static void extend_scale(Scale *scale, double x) {
    scale->min = x < scale->min ? x : scale->min;
    scale->max = x > scale->max ? x : scale->max;
}

static void pad_scale(Scale *scale) {
    double margin = (scale->max - scale->min) * 0.04;
    scale->min -= margin;
    scale->max += margin;
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
    Plot plot = {.x = {INFINITY, -INFINITY}, .y = {INFINITY, -INFINITY}};
    for (size_t run = 0; run < design->run_count; run++) {
        Row row;
        size_t first = plot.bytes.len;
        double x = axis == FRAMES
                       ? 0
                       : axis_number(&design->axes[axis], design->value_indices[run * design->axis_count + axis]);
        for (Str rows = sweep->results[run].rows; row_next(sweep, &rows, metric, &row);) {
            if (isnan(row.x))
                continue;
            Point point = {axis == FRAMES ? (double)row.frame : x, row.x};
            plot.bytes.len = axis == FRAMES ? plot.bytes.len : first;
            text_add(&plot.bytes, (Str){(const char *)&point, sizeof point});
        }
    }
    plot.points = (void *)plot.bytes.bytes;
    plot.count = plot.bytes.len / sizeof *plot.points;
    for (size_t i = 0; i < plot.count; i++) {
        extend_scale(&plot.x, plot.points[i].x);
        extend_scale(&plot.y, plot.points[i].y);
    }
    pad_scale(&plot.x);
    pad_scale(&plot.y);
    return plot;
}

static double scale_position(const Scale *scale, double x, double length) {
    return scale->max > scale->min ? (x - scale->min) / (scale->max - scale->min) * length : length / 2;
}

// Returns the distance between ticks: 1, 2 or 5 times a power of ten, chosen to give about four ticks.
static double tick_step(const Scale *scale) {
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
        double at = scale_position(scale, k * step, across ? WIDTH : HEIGHT);
        double x = across ? at : -4, y = across ? HEIGHT : HEIGHT - at;
        text_add_format(out, "                    !line points=%.1f;%.1f;%.1f;%.1f stroke=true\n", x, y,
                        across ? at : 0, across ? HEIGHT + 4 : y);
        snprintf(label, sizeof label, "%.6g", k * step + 0.0); // adding 0 changes -0 to 0
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

// Replaces points with the same x by their mean. Returns the number of means.
static size_t average_points(Plot *plot) {
    size_t means = 0;
    qsort(plot->points, plot->count, sizeof *plot->points, compare_points);
    for (size_t i = 0, next = 0; i < plot->count; i = next) {
        double sum = 0, x = plot->points[i].x;
        while (next < plot->count && plot->points[next].x == x)
            sum += plot->points[next++].y;
        plot->points[means++] = (Point){x, sum / (double)(next - i)};
    }
    return means;
}

static void add_plot(Text *out, Plot *plot) {
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
    }
}

static size_t find_columns(const Sweep *sweep, size_t *columns) {
    size_t count = 0;
    for (size_t i = 0; i < sweep->design.axis_count - sweep->design.seeded; i++)
        if (sweep->design.axes[i].values.count > 1)
            columns[count++] = i;
    if (sweep->own->row_every > 0 || count == 0)
        columns[count++] = FRAMES;
    return count;
}

// Writes the script that draws the grid.
static void write_script(const Sweep *sweep, Text *out) {
    size_t *columns = memory_calloc((sweep->design.axis_count + 1) * sizeof *columns);
    size_t across = find_columns(sweep, columns), down = row_numbers(sweep);
    text_add_format(out, "!window size=%zu;%zu\n    !canvas\n        !font size=11 family=\"DejaVu Sans\"\n",
                    across * (WIDTH + GAP_X), down * (HEIGHT + GAP_Y));
    text_add_format(out, "            !rect size=%zu;%zu fill=true color=1\n", across * (WIDTH + GAP_X),
                    down * (HEIGHT + GAP_Y));
    for (size_t i = 0; i < across * down; i++) {
        size_t column = i % across, row = i / across;
        text_add_format(out, "            !transform translate=%zu;%zu\n                !paint color=0.1\n",
                        LEFT + column * (WIDTH + GAP_X), TOP + row * (HEIGHT + GAP_Y));
        Plot plot = collect_points(sweep, columns[column], row);
        add_plot(out, &plot);
        text_free(&plot.bytes);
        add_text(out, columns[column] == FRAMES ? "frame" : sweep->design.axes[columns[column]].name, WIDTH / 2.0,
                 HEIGHT + 28, 0);
        add_text(out, row_number_name(sweep, row), -60, HEIGHT / 2.0, -0.25);
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
