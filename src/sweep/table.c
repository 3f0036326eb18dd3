// table.c: see table.h.
#include "sweep/table.h"

#include "cli/particles.h"
#include "cli/script.h"
#include "petri-archive.h"
#include "sweep/options.h"

#include <inttypes.h>

size_t row_numbers(const Sweep *sweep) {
    return sweep->metric_count + (sweep->own->until && sweep->own->row_every == 0);
}

const char *row_number_name(const Sweep *sweep, size_t number) {
    return number < sweep->metric_count ? sweep->metrics[number].name : "frame";
}

typedef struct Column {
    const char *name;
    CellKind kind;
} Column;

static Column column_at(const Sweep *sweep, size_t number) {
    size_t axes = sweep->design.axis_count, metric = number - axes - 2;
    if (number == 0 || number == axes + 1)
        return (Column){number == 0 ? "run" : "frame", CELL_INTEGER};
    if (number <= axes)
        return (Column){sweep->design.axes[number - 1].name, sweep->design.axes[number - 1].kind};
    return metric < sweep->metric_count ? (Column){sweep->metrics[metric].name, CELL_NUMBER}
                                        : (Column){"error", CELL_TEXT};
}

// Appends a cell of a column: as CSV, or with its kind.
static void add_cell(const Sweep *sweep, bool csv, size_t column, Cell cell, Text *out) {
    size_t first = sweep->design.axis_count + 2; // the column of the first metric
    if (!csv) {
        cell_add(out, cell);
        return;
    }
    if (cell.kind == CELL_TEXT)
        csv_write(str_from(cell.as.text), text_collect, out);
    else
        row_add_text(sweep, column < first ? sweep->metric_count : column - first, cell, out);
    text_add_char(out, column < first + sweep->metric_count ? ',' : '\n');
}

static void add_run(const Sweep *sweep, bool csv, size_t run, Text *out) {
    const Design *design = &sweep->design;
    Cell cell;
    for (Str rows = sweep->results[run].rows; cell_next(&rows, &cell);) {
        size_t column = 0;
        add_cell(sweep, csv, column++, (Cell){CELL_INTEGER, {.integer = (int64_t)run + 1}}, out);
        for (; column <= design->axis_count; column++) {
            const Axis *axis = &design->axes[column - 1];
            Cell written = {CELL_TEXT, {.text = design_value(design, run, column - 1)}};
            add_cell(sweep, csv, column, csv ? written : axis_cell(axis, written.as.text), out);
        }
        add_cell(sweep, csv, column++, cell, out);
        for (size_t i = 0; i <= sweep->metric_count && cell_next(&rows, &cell); i++)
            add_cell(sweep, csv, column++, cell, out);
    }
}

void table_make(const Sweep *sweep, bool csv, Text *out) {
    size_t width = sweep->design.axis_count + sweep->metric_count + 3;
    if (!csv) {
        cell_add(out, (Cell){CELL_INTEGER, {.integer = (int64_t)width}});
        cell_add(out, (Cell){CELL_INTEGER, {.integer = (int64_t)sweep->design.axis_count}});
    }
    for (size_t i = 0; i < width; i++) {
        Column column = column_at(sweep, i);
        add_cell(sweep, csv, i, (Cell){CELL_TEXT, {.text = column.name}}, out);
        if (!csv)
            cell_add(out, (Cell){CELL_INTEGER, {.integer = column.kind}});
    }
    for (size_t run = 0; run < sweep->design.run_count; run++)
        add_run(sweep, csv, run, out);
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
    for (size_t i = 0; archived && i < sweep->own->metrics.count; i++) {
        text_add_c(&head, " --metric ");
        shell_add_word(&head, sweep->own->metrics.items[i]);
    }
    for (size_t run = 0; run < design->run_count; run++) {
        text_add(out, text_str(&head));
        add_definitions(design, run, out);
        text_add_format(out, " --frames %" PRId64 "\n", sweep->results[run].frames);
    }
}
