// result.c: the results of runs and their rows; see sweep.h.
#include "base/number.h"
#include "sweep/sweep.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

bool sweep_owns_run(const Sweep *sweep, size_t run) {
    return run % sweep->shards == sweep->shard;
}

bool sweep_has_result(const Sweep *sweep, size_t run) {
    return sweep->results[run].rows.bytes;
}

bool sweep_wants_run(const Sweep *sweep, size_t run) {
    return sweep_owns_run(sweep, run) && !sweep_has_result(sweep, run);
}

void sweep_store_result(Sweep *sweep, size_t run, int64_t frames, Str rows) {
    Result *result = &sweep->results[run];
    if (!sweep_has_result(sweep, run)) {
        result->rows = (Str){memory_strndup(rows.bytes, rows.len), rows.len};
        result->frames = frames;
    }
}

// A run has failed if its last row has an error, which is the last cell.
bool sweep_is_failed(const Sweep *sweep, size_t run) {
    Cell cell = {.kind = CELL_NONE};
    for (Str rows = sweep->results[run].rows; cell_next(&rows, &cell);) {
    }
    return cell.kind == CELL_TEXT;
}

size_t sweep_count_runs(const Sweep *sweep, bool (*has)(const Sweep *sweep, size_t run)) {
    size_t count = 0;
    for (size_t run = 0; run < sweep->design.run_count; run++)
        count += has(sweep, run);
    return count;
}

void sweep_report(void *context, PetriLevel level, const char *rendered) {
    enum { MAX_REPORTED = 100 };
    Sweep *sweep = context;
    bool wanted = level == PETRI_ERROR || sweep->options->verbosity > LOG_QUIET;
    if (wanted && sweep->reported.count < MAX_REPORTED && !texts_contain(&sweep->reported, rendered)) {
        texts_add(&sweep->reported, rendered);
        fputs(rendered, stderr);
    }
}

bool row_next(const Sweep *sweep, Str *rows, size_t metric, Row *row) {
    Cell cell;
    if (!cell_next(rows, &cell))
        return false;
    *row = (Row){cell.as.integer, metric == sweep->metric_count ? (double)cell.as.integer : NAN};
    for (size_t i = 0; i <= sweep->metric_count && cell_next(rows, &cell); i++)
        if (i == metric && cell.kind == CELL_NUMBER && isfinite(cell.as.number))
            row->x = cell.as.number;
    if (cell.kind == CELL_TEXT)
        row->x = NAN;
    return true;
}

void row_add_failure(const Sweep *sweep, int64_t frame, const char *error, Text *rows) {
    cell_add(rows, (Cell){CELL_INTEGER, {.integer = frame}});
    for (size_t i = 0; i < sweep->metric_count; i++)
        cell_add(rows, (Cell){.kind = CELL_NONE});
    cell_add(rows, (Cell){CELL_TEXT, {.text = error}});
}

void row_add_text(const Sweep *sweep, size_t metric, Cell cell, Text *out) {
    if (cell.kind == CELL_TEXT)
        text_add_c(out, cell.as.text);
    else if (cell.kind == CELL_NUMBER && metric < sweep->metric_count && !sweep->metrics[metric].expression)
        text_add_format(out, "%.17g", cell.as.number);
    else if (cell.kind == CELL_NUMBER)
        text_add_number(out, cell.as.number);
    else if (cell.kind == CELL_INTEGER)
        text_add_format(out, "%" PRId64, cell.as.integer);
}

bool rows_are_valid(const Sweep *sweep, Str rows) {
    size_t width = sweep->metric_count + 2, count = 0;
    for (Cell cell; cell_next(&rows, &cell); count++)
        if ((count % width == 0) != (cell.kind == CELL_INTEGER))
            return false;
    return rows.len == 0 && count % width == 0;
}
