// table.h: the table of all runs, the command lines that repeat them, and the summary.
#pragma once

#include "sweep/sweep.h"

// Returns the number of metrics to summarise and plot; with --until and without --every, also the frame, as the last.
size_t row_numbers(const Sweep *sweep);
const char *row_number_name(const Sweep *sweep, size_t number);

// Appends the table: as CSV, or as cells for hdf5_table. The columns run and frame are integers, a parameter has the
// kind of its axis, metrics are numbers, unless some of their values are texts, symbols or vectors, and errors are
// texts.
void table_make(const Sweep *sweep, bool csv, Text *out);
// Appends one line for each run: the command that repeats the run.
void table_commands(const Sweep *sweep, Text *out);
// Appends the start of the command that compares a run with a second run.
void table_diff_command(const Sweep *sweep, size_t run, int64_t frames, Text *out);
// Appends mean, its 95 % interval, standard deviation and quantiles of each metric over runs that differ only in SEED.
void summary_make(const Sweep *sweep, Text *out);
