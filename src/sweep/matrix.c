// matrix.c: the plots of a sweep: a column for each name that takes several values and, with --every, for the frame; a
// row for each metric. A script draws them, by the same means as all pictures.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "petri-draw.h"
#include "sweep/extras.h"
#include "sweep/table.h"

enum { WIDTH = 220, HEIGHT = 160, LEFT = 80, TOP = 20, GAP_X = 90, GAP_Y = 60, MOST_POINTS = 5000, MOST_MEANS = 400 };

typedef struct Point {
    double x;
    double y;
} Point;

typedef struct Scale {
    double least;
    double most;
} Scale;

typedef struct Plot {
    Point *points;
    size_t count;
    Scale x;
    Scale y;
} Plot;

static const size_t FRAMES = SIZE_MAX; // in place of the number of a name

static void widen(Scale *scale, double x) {
    scale->least = x < scale->least ? x : scale->least;
    scale->most = x > scale->most ? x : scale->most;
}

static void pad(Scale *scale) {
    double margin = (scale->most - scale->least) * 0.04;
    scale->least -= margin;
    scale->most += margin;
}

// The value as a number, or where it stands in the list if they are not all numbers.
static double axis_number(const Axis *axis, uint32_t place) {
    double x = 0;
    for (size_t i = 0; i < axis->values.count; i++) {
        if (!petri_read_number(axis->values.items[i], &x)) {
            return place;
        }
    }
    petri_read_number(axis->values.items[place], &x);
    return x;
}

// All rows over the frame; over a name the last row of each run, which is the last that has a number.
static Plot collect(const Sweep *sweep, size_t axis, size_t metric) {
    const Design *design = &sweep->design;
    Plot plot = {.x = {INFINITY, -INFINITY}, .y = {INFINITY, -INFINITY}};
    size_t room = 0;
    for (size_t run = 0; run < design->run_count; run++) {
        Row row;
        size_t first = plot.count;
        double x =
            axis == FRAMES ? 0 : axis_number(&design->axes[axis], design->places[run * design->axis_count + axis]);
        for (const char *at = sweep->results[run].rows; row_next(&at, &row);) {
            double y = row_number(sweep, &row, metric);
            if (isnan(y)) {
                continue;
            }
            plot.count = axis == FRAMES ? plot.count : first;
            if (plot.count == room) {
                room = 2 * room + 64;
                plot.points = memory_resized(plot.points, room * sizeof *plot.points);
            }
            plot.points[plot.count++] = (Point){axis == FRAMES ? (double)row.frame : x, y};
        }
    }
    for (size_t i = 0; i < plot.count; i++) {
        widen(&plot.x, plot.points[i].x);
        widen(&plot.y, plot.points[i].y);
    }
    pad(&plot.x);
    pad(&plot.y);
    return plot;
}

static double place(const Scale *scale, double x, double length) {
    return scale->most > scale->least ? (x - scale->least) / (scale->most - scale->least) * length : length / 2;
}

// 1, 2 or 5 times a power of ten, so that there are some four of them.
static double tick_step(const Scale *scale) {
    double rough = (scale->most - scale->least) / 4, power = pow(10, floor(log10(rough)));
    double times = rough / power;
    return power * (times < 1.5 ? 1 : times < 3.5 ? 2 : times < 7.5 ? 5 : 10);
}

static void add_text(Bytes *out, const char *text, double x, double y, double rotate) {
    bytes_format(out,
                 "                    !transform translate=%.1f;%.1f rotate=%g\n                        !text text=", x,
                 y, rotate);
    axis_add_literal(out, text);
    bytes_format(out, "\n");
}

static void add_ticks(Bytes *out, const Scale *scale, bool across) {
    if (!(scale->most > scale->least)) {
        char label[32];
        snprintf(label, sizeof label, "%.4g", scale->least);
        add_text(out, label, across ? WIDTH / 2.0 : -26, across ? HEIGHT + 12 : HEIGHT / 2.0, 0);
        return;
    }
    double step = tick_step(scale);
    for (double k = ceil(scale->least / step - 1e-9); k * step <= scale->most + 1e-9 * step; k++) {
        double at = place(scale, k * step, across ? WIDTH : HEIGHT);
        char label[32];
        snprintf(label, sizeof label, "%.6g", k * step + 0.0); // no -0
        if (across) {
            bytes_format(out, "                    !line points=%.1f;%d;%.1f;%d stroke=true\n", at, HEIGHT, at,
                         HEIGHT + 4);
            add_text(out, label, at, HEIGHT + 12, 0);
        } else {
            bytes_format(out, "                    !line points=-4;%.1f;0;%.1f stroke=true\n", HEIGHT - at,
                         HEIGHT - at);
            add_text(out, label, -26, HEIGHT - at, 0);
        }
    }
}

static void add_numbers(Bytes *out, const Plot *plot, const Point *points, size_t count, size_t step) {
    for (size_t i = 0; i < count; i += step) {
        bytes_format(out, "%s%.2f;%.2f", i == 0 ? "" : ";", place(&plot->x, points[i].x, WIDTH),
                     HEIGHT - place(&plot->y, points[i].y, HEIGHT));
    }
}

static int compare(const void *a, const void *b) {
    const Point *p = a, *q = b;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : (p->y > q->y) - (p->y < q->y);
}

// The mean of the points of each place, in their place; returns how many those are.
static size_t average(Plot *plot) {
    size_t means = 0;
    qsort(plot->points, plot->count, sizeof *plot->points, compare);
    for (size_t i = 0, next = 0; i < plot->count; i = next) {
        double sum = 0, x = plot->points[i].x;
        while (next < plot->count && plot->points[next].x == x) {
            sum += plot->points[next++].y;
        }
        plot->points[means++] = (Point){x, sum / (double)(next - i)};
    }
    return means;
}

static void add_plot(Bytes *out, Plot *plot) {
    bytes_format(out, "                    !rect size=%d;%d stroke=true\n", WIDTH, HEIGHT);
    if (plot->count == 0) {
        return;
    }
    add_ticks(out, &plot->x, true);
    add_ticks(out, &plot->y, false);
    bytes_format(out, "                    for x;y in (");
    add_numbers(out, plot, plot->points, plot->count, plot->count / MOST_POINTS + 1);
    bytes_format(out, ")\n                        !ellipse point=x;y radius=1.8 fill=true color=0.15;0.4;0.75;0.5\n");
    size_t means = average(plot);
    if (means > 1 && means <= MOST_MEANS && means < plot->count) {
        bytes_format(out, "                    !line stroke=true stroke_width=1.5 color=0.85;0.35;0.1 points=");
        add_numbers(out, plot, plot->points, means, 1);
        bytes_format(out, "\n");
    }
}

static size_t find_columns(const Sweep *sweep, size_t *columns) {
    size_t count = 0;
    for (size_t i = 0; i < sweep->design.axis_count - sweep->design.seeded; i++) {
        if (sweep->design.axes[i].values.count > 1) {
            columns[count++] = i;
        }
    }
    if (sweep->options->row_every > 0 || count == 0) {
        columns[count++] = FRAMES;
    }
    return count;
}

// The script that draws the matrix.
static void write_script(const Sweep *sweep, Bytes *out) {
    size_t *columns = memory_zeroed((sweep->design.axis_count + 1) * sizeof *columns);
    size_t across = find_columns(sweep, columns), down = row_numbers(sweep);
    bytes_format(out, "!window size=%zu;%zu\n    !canvas\n        !font size=11 family=\"DejaVu Sans\"\n",
                 across * (WIDTH + GAP_X), down * (HEIGHT + GAP_Y));
    bytes_format(out, "            !rect size=%zu;%zu fill=true color=1\n", across * (WIDTH + GAP_X),
                 down * (HEIGHT + GAP_Y));
    for (size_t i = 0; i < across * down; i++) {
        size_t column = i % across, row = i / across;
        bytes_format(out, "            !transform translate=%zu;%zu\n                !paint color=0.1\n",
                     LEFT + column * (WIDTH + GAP_X), TOP + row * (HEIGHT + GAP_Y));
        Plot plot = collect(sweep, columns[column], row);
        add_plot(out, &plot);
        free(plot.points);
        add_text(out, columns[column] == FRAMES ? "frame" : sweep->design.axes[columns[column]].name, WIDTH / 2.0,
                 HEIGHT + 28, 0);
        add_text(out, row_number_name(sweep, row), -60, HEIGHT / 2.0, -0.25);
    }
    free(columns);
}

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    (void)host;
    fputs(diagnostic->rendered, stderr);
}

bool matrix_draw(const Sweep *sweep, const char *path) {
    SCOPED_BYTES script = {0};
    write_script(sweep, &script);
    PetriOptions wanted = petri_default_options();
    wanted.stack_bytes = sweep->host->stack_bytes;
    wanted.no_files = true;
    wanted.diagnostic = on_diagnostic;
    PetriSession *session = petri_open(&wanted);
    PetriPainter *painter = petri_painter_open();
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    PetriStatus status = session == NULL ? PETRI_MEMORY : petri_load_text(session, "plot", script.data, script.length);
    status = status == PETRI_OK ? petri_step(session) : status;
    status = status == PETRI_OK ? petri_picture(session, &options, &picture) : status;
    status = status == PETRI_OK ? petri_picture_save(picture, painter, path) : status;
    petri_picture_tell(session, picture);
    petri_picture_free(&picture);
    petri_painter_close(&painter);
    petri_close(&session);
    if (status != PETRI_OK) {
        message("%s was not drawn", path);
    }
    return status == PETRI_OK;
}
