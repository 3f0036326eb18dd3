// table.c: the table of all runs, and the command lines that repeat them.
#include "sweep/table.h"

#include "cli/particles.h"
#include "cli/script.h"
#include "petri-archive.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool row_next(const char **at, Row *row) {
    if (**at == '\0')
        return false;
    char *cells = NULL;
    row->frame = strtoll(*at, &cells, 10);
    size_t length = strcspn(cells, "\n");
    row->cells = (Str){cells, length};
    *at = cells + length + (cells[length] == '\n');
    return true;
}

// Returns the cell of a metric, or the error if `number` is metric_count. The cell can be empty.
static Str row_cell(const Row *row, size_t number) {
    Str cells = row->cells;
    if (cells.len == 0)
        return cells; // a damaged journal can contain rows without cells
    for (;; number--) {
        cells = (Str){cells.bytes + 1, cells.len - 1}; // skip the tab
        const char *end = memchr(cells.bytes, '\t', cells.len);
        size_t length = !end ? cells.len : (size_t)(end - cells.bytes);
        if (number == 0 || !end)
            return (Str){cells.bytes, number == 0 ? length : 0};
        cells = (Str){end, cells.len - length};
    }
}

size_t row_numbers(const Sweep *sweep) {
    return sweep->metric_count + (sweep->options->until && sweep->options->row_every == 0);
}

const char *row_number_name(const Sweep *sweep, size_t number) {
    return number < sweep->metric_count ? sweep->metrics[number].name : "frame";
}

double row_number(const Sweep *sweep, const Row *row, size_t number) {
    if (row_cell(row, sweep->metric_count).len > 0)
        return NAN; // the row has an error
    if (number == sweep->metric_count)
        return (double)row->frame;
    Str cell = row_cell(row, number);
    char *end = NULL;
    double x = cell.len == 0 ? NAN : strtod(cell.bytes, &end);
    return end == cell.bytes + cell.len && isfinite(x) ? x : NAN;
}

// Appends a cell and, for CSV, the character that follows it.
static void add_cell(Text *out, bool csv, Str cell, char end) {
    if (csv)
        csv_write(cell, text_collect, out);
    else
        text_add(out, cell);
    text_add_char(out, csv ? end : '\0');
}

static void add_number(Text *out, bool csv, int64_t number) {
    char text[24];
    snprintf(text, sizeof text, "%" PRId64, number);
    add_cell(out, csv, str_from(text), ',');
}

static void add_run(const Sweep *sweep, size_t run, bool csv, Text *out) {
    const Design *design = &sweep->design;
    SCOPED_TEXT head = {0};
    add_number(&head, csv, (int64_t)run + 1);
    for (size_t i = 0; i < design->axis_count; i++)
        add_cell(&head, csv, str_from(design_value(design, run, i)), ',');
    Row row;
    for (const char *at = sweep->results[run].rows; row_next(&at, &row);) {
        text_add(out, text_str(&head));
        add_number(out, csv, row.frame);
        for (size_t i = 0; i <= sweep->metric_count; i++)
            add_cell(out, csv, row_cell(&row, i), i < sweep->metric_count ? ',' : '\n');
    }
}

void table_make(const Sweep *sweep, bool csv, Text *out) {
    add_cell(out, csv, STR("run"), ',');
    for (size_t i = 0; i < sweep->design.axis_count; i++)
        add_cell(out, csv, str_from(sweep->design.axes[i].name), ',');
    add_cell(out, csv, STR("frame"), ',');
    for (size_t i = 0; i < sweep->metric_count; i++)
        add_cell(out, csv, str_from(sweep->metrics[i].name), ',');
    add_cell(out, csv, STR("error"), '\n');
    for (size_t run = 0; run < sweep->design.run_count; run++)
        add_run(sweep, run, csv, out);
}

size_t table_width(const Sweep *sweep) {
    return sweep->design.axis_count + sweep->metric_count + 3;
}

static void add_definitions(const Design *design, size_t run, Text *out) {
    for (size_t i = 0; i < design->axis_count; i++) {
        SCOPED_TEXT word = {0};
        text_add_format(&word, "%s=%s", design->axes[i].name, design_value(design, run, i));
        text_add_format(out, " -D ");
        shell_add_word(out, word.bytes);
    }
}

void table_diff_command(const Sweep *sweep, size_t run, int64_t frames, Text *out) {
    text_add_c(out, "petri diff ");
    shell_add_word(out, sweep->options->script);
    text_add(out, text_str(&sweep->shared));
    add_definitions(&sweep->design, run, out);
    text_add_format(out, " --frames %" PRId64, frames);
}

void table_commands(const Sweep *sweep, Text *out) {
    const Design *design = &sweep->design;
    SCOPED_TEXT head = {0};
    shell_add_program(&head, sweep->host->invoked_as);
    // petri run replays an archive with its own parameters.
    bool archived = petri_archive_is(sweep->options->script);
    text_add_format(&head, archived ? " sweep " : " run ");
    shell_add_word(&head, sweep->options->script);
    text_add(&head, text_str(&sweep->shared));
    for (size_t i = 0; archived && i < sweep->options->metrics.count; i++) {
        text_add_c(&head, " --metric ");
        shell_add_word(&head, sweep->options->metrics.items[i]);
    }
    for (size_t run = 0; run < design->run_count; run++) {
        text_add(out, text_str(&head));
        add_definitions(design, run, out);
        // `frames` does not count the frame in which a run failed, but the command must compute it as well.
        const Result *result = &sweep->results[run];
        text_add_format(out, " --frames %" PRId64 "\n", result->frames + sweep_is_failed(result));
    }
}
