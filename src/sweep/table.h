// table.h: what all runs have come to: the table, the command lines, the summary, the plots.
#ifndef PETRI_SRC_SWEEP_TABLE_H
#define PETRI_SRC_SWEEP_TABLE_H

#include "sweep/sweep.h"

// A row of a result: its frame and the cells behind that.
typedef struct Row {
    int64_t frame;
    Str cells;
} Row;
// The row at *at, and on to the next; false behind the last. Begin with *at = rows of a result.
bool row_next(const char **at, Row *row);
// The cell of a metric (or, behind the last, the error); empty if there is none.
Str row_cell(const Row *row, size_t number);
// The one number that a metric came to, else NaN. Where there are no metrics, the frame is number 0.
double row_number(const Integrator *sweep, const Row *row, size_t number);
// How many numbers a row has, and what they are called: the metrics, or the frame that --until was looking for.
size_t row_numbers(const Integrator *sweep);
const char *row_number_name(const Integrator *sweep, size_t number);

// A cell of a CSV file, quoted where RFC 4180 has it.
void csv_add(ByteBuffer *out, Str cell);

void table_make(const Integrator *sweep, ByteBuffer *out);
// A line for each run, which makes it again.
void table_commands(const Integrator *sweep, ByteBuffer *out);
// Mean, deviation and quantiles of each metric over the runs that differ in SEED alone.
void summary_make(const Integrator *sweep, ByteBuffer *out);

#endif
