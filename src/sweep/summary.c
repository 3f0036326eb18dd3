// summary.c: mean, standard deviation and quantiles of each metric over runs that differ only in SEED.
#include "cli/particles.h"
#include "sweep/table.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Number {
    int64_t frame; // frame of the row; -1 without --every, because each run then has one row
    double x;
} Number;

typedef struct NumberList {
    Number *items;
    size_t count;
    size_t capacity;
} NumberList;

static void add_number(NumberList *list, Number number) {
    if (list->count == list->capacity) {
        list->capacity = 2 * list->capacity + 64;
        list->items = memory_realloc(list->items, list->capacity * sizeof *list->items);
    }
    list->items[list->count++] = number;
}

static int compare_numbers(const void *a, const void *b) {
    const Number *x = a, *y = b;
    return x->frame != y->frame ? (x->frame > y->frame) - (x->frame < y->frame) : (x->x > y->x) - (x->x < y->x);
}

// Returns a quantile (fraction from 0 to 1) by linear interpolation.
static double quantile(const Number *sorted, size_t count, double fraction) {
    double position = fraction * (double)(count - 1), below = floor(position);
    size_t i = (size_t)below, next = i + 1 < count ? i + 1 : i;
    return sorted[i].x + (position - below) * (sorted[next].x - sorted[i].x);
}

// Appends the statistics of one metric in one frame. `sorted` contains the values in ascending order.
static void add_statistics(Text *out, const Number *sorted, size_t count) {
    double sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++)
        sum += sorted[i].x;
    double mean = sum / (double)count;
    for (size_t i = 0; i < count; i++)
        squares += (sorted[i].x - mean) * (sorted[i].x - mean);
    text_add_format(out, ",%zu,%.12g,", count, mean);
    if (count > 1)
        text_add_format(out, "%.12g", sqrt(squares / (double)(count - 1)));
    for (int quarter = 0; quarter <= 4; quarter++)
        text_add_format(out, ",%.12g", quantile(sorted, count, quarter / 4.0));
    text_add_format(out, "\n");
}

static bool differ_in_seed_alone(const Design *design, size_t a, size_t b) {
    size_t width = design->axis_count, compared = width - design->seeded;
    return memcmp(&design->value_indices[a * width], &design->value_indices[b * width],
                  compared * sizeof *design->value_indices) == 0;
}

static void add_values(const Design *design, size_t run, Text *out) {
    for (size_t i = 0; i < design->axis_count - design->seeded; i++) {
        csv_write(str_from(design_value(design, run, i)), text_collect, out);
        text_add_format(out, ",");
    }
}

static void add_metric(const Sweep *sweep, size_t first, size_t end, size_t metric, Text *out) {
    NumberList list = {0};
    bool each_frame = sweep->options->row_every > 0;
    Row row;
    for (size_t run = first; run < end; run++) {
        for (const char *at = sweep->results[run].rows; row_next(&at, &row);) {
            double x = row_number(sweep, &row, metric);
            if (!isnan(x))
                add_number(&list, (Number){each_frame ? row.frame : -1, x});
        }
    }
    if (list.count > 0)
        qsort(list.items, list.count, sizeof *list.items, compare_numbers);
    for (size_t i = 0, next = 0; i < list.count; i = next) {
        while (next < list.count && list.items[next].frame == list.items[i].frame)
            next++;
        add_values(&sweep->design, first, out);
        if (each_frame)
            text_add_format(out, "%" PRId64 ",", list.items[i].frame);
        csv_write(str_from(row_number_name(sweep, metric)), text_collect, out);
        add_statistics(out, list.items + i, next - i);
    }
    free(list.items);
}

void summary_make(const Sweep *sweep, Text *out) {
    const Design *design = &sweep->design;
    for (size_t i = 0; i < design->axis_count - design->seeded; i++) {
        csv_write(str_from(design->axes[i].name), text_collect, out);
        text_add_format(out, ",");
    }
    text_add_format(out, "%smetric,runs,mean,std,min,q1,median,q3,max\n",
                    sweep->options->row_every > 0 ? "frame," : "");
    for (size_t run = 0, end = 0; run < design->run_count; run = end) {
        while (end < design->run_count && differ_in_seed_alone(design, run, end))
            end++;
        for (size_t i = 0; i < row_numbers(sweep); i++)
            add_metric(sweep, run, end, i, out);
    }
}
