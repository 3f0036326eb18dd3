// summary.c: mean, its 95 % interval, standard deviation and quantiles of each metric over runs that differ only in
// SEED.
#include "cli/particles.h"
#include "sweep/options.h"
#include "sweep/table.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_rows(const void *a, const void *b) {
    const Row *x = a, *y = b;
    return x->frame != y->frame ? (x->frame > y->frame) - (x->frame < y->frame) : (x->x > y->x) - (x->x < y->x);
}

// Returns a quantile (fraction from 0 to 1) by linear interpolation.
static double quantile(const Row *sorted, size_t count, double fraction) {
    double position = fraction * (double)(count - 1), below = floor(position);
    size_t i = (size_t)below, next = i + 1 < count ? i + 1 : i;
    return sorted[i].x + (position - below) * (sorted[next].x - sorted[i].x);
}

// Appends the statistics of one metric in one frame. `sorted` contains the values in ascending order.
static void add_statistics(Text *out, const Row *sorted, size_t count) {
    double sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++)
        sum += sorted[i].x;
    double mean = sum / (double)count;
    for (size_t i = 0; i < count; i++)
        squares += (sorted[i].x - mean) * (sorted[i].x - mean);
    text_add_format(out, "%zu,%.12g,", count, mean);
    if (count > 1)
        text_add_format(out, "%.12g,%.12g", sqrt(squares / (double)(count - 1)),
                        student_half_width(0.95, (double)count, squares));
    else
        text_add_c(out, ",");
    for (int quarter = 0; quarter <= 4; quarter++)
        text_add_format(out, ",%.12g", quantile(sorted, count, quarter / 4.0));
    text_add_format(out, "\n");
}

static bool differ_in_seed_alone(const Design *design, size_t a, size_t b) {
    size_t width = design->axis_count, compared = width - design->seeded;
    return memcmp(&design->value_indices[a * width], &design->value_indices[b * width],
                  compared * sizeof *design->value_indices) == 0;
}

static void add_name(Text *out, const char *name) {
    csv_write(str_from(name), text_collect, out);
    text_add_char(out, ',');
}

static void add_metric(const Sweep *sweep, size_t first, size_t end, size_t metric, Text *out) {
    SCOPED_TEXT list = {0};
    const Design *design = &sweep->design;
    bool each_frame = sweep->own->row_every > 0;
    Row row;
    for (size_t run = first; run < end; run++) {
        for (Str rows = sweep->results[run].rows; row_next(sweep, &rows, metric, &row);) {
            row.frame = each_frame ? row.frame : -1; // each run has one row
            if (!isnan(row.x))
                text_add(&list, (Str){(const char *)&row, sizeof row});
        }
    }
    Row *sorted = (void *)list.bytes;
    size_t count = list.len / sizeof row;
    if (count > 0)
        qsort(sorted, count, sizeof row, compare_rows);
    for (size_t i = 0, next = 0; i < count; i = next) {
        while (next < count && sorted[next].frame == sorted[i].frame)
            next++;
        for (size_t k = 0; k < design->axis_count - design->seeded; k++)
            add_name(out, design_value(design, first, k));
        if (each_frame)
            text_add_format(out, "%" PRId64 ",", sorted[i].frame);
        add_name(out, row_number_name(sweep, metric));
        add_statistics(out, sorted + i, next - i);
    }
}

void summary_make(const Sweep *sweep, Text *out) {
    const Design *design = &sweep->design;
    for (size_t i = 0; i < design->axis_count - design->seeded; i++)
        add_name(out, design->axes[i].name);
    text_add_format(out, "%smetric,runs,mean,std,half_width,min,q1,median,q3,max\n",
                    sweep->own->row_every > 0 ? "frame," : "");
    for (size_t run = 0, end = 0; run < design->run_count; run = end) {
        while (end < design->run_count && differ_in_seed_alone(design, run, end))
            end++;
        for (size_t i = 0; i < row_numbers(sweep); i++)
            add_metric(sweep, run, end, i, out);
    }
}
