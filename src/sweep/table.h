// table.h: access to the results of runs, and their output: the table, the command lines and the summary.
#pragma once

#include "sweep/sweep.h"

// A row of a result: its frame and the text of the other cells, each preceded by a tab.
typedef struct Row {
    int64_t frame;
    Str cells;
} Row;
// Reads the row at *at and advances *at; start with *at = Result.rows. Returns false after the last row.
bool row_next(const char **at, Row *row);
// Returns the value of a metric, or the frame if `number` is metric_count. Returns NaN if the value is not one finite
// number.
double row_number(const Sweep *sweep, const Row *row, size_t number);
// Returns the number of numeric cells per row: one per metric, and the frame if --until was given without --every.
size_t row_numbers(const Sweep *sweep);
const char *row_number_name(const Sweep *sweep, size_t number);

// Appends all rows, the first with the names of the columns: as CSV or, if `csv` is false, as NUL-terminated cells
// (hdf5_table).
void table_make(const Sweep *sweep, bool csv, Text *out);
// Returns the number of columns of the table.
size_t table_width(const Sweep *sweep);
// Appends one line for each run: the command that repeats the run.
void table_commands(const Sweep *sweep, Text *out);
// Appends the start of the command that compares a run with a second run.
void table_diff_command(const Sweep *sweep, size_t run, int64_t frames, Text *out);
// Appends mean, standard deviation and quantiles of each metric over runs that differ only in SEED.
void summary_make(const Sweep *sweep, Text *out);
