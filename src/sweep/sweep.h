// sweep.h: internal declarations of `petri sweep`: the runs of a sweep and their results. The files of the room, from
// those that call to those that are called:
//
//   sweep.c                              the command, which writes the files at the end
//   settings.c; plan.c, plot_grid.c      its options; plans and plots, which petri itself does not link (plots.h)
//   worker_pool.c or worker_sequence.c   workers that execute runs; worker_result.c: the results that they send
//   journal.c                            results of finished runs, to resume from
//   dry_run.c, late_metrics.c            checks before the first run
//   measure.c                            execution of a run
//   cache.c, read_files.c                results of earlier sweeps
//   summary.c, table.c                   the table, commands and statistics
//   result.c                             the cells of results
//   student.c                            confidence intervals of means
//   design.c, axis.c                     runs and their values
#pragma once

#include "base/sha256.h"
#include "cli/cells.h"
#include "cli/motion.h"
#include "cli/options.h"

// A name given with -D and its values, as strings that `petri run -D` accepts.
typedef struct Axis {
    char *name;
    TextList values;
    CellKind kind;   // of its column: integers, if all values are; numbers, if all are or are sampled; else texts
    bool continuous; // true for a range without a step: --sample chooses any number in the range
    double min;
    double max;
} Axis;

// The runs of a sweep and the values of the axes in each run.
typedef struct Design {
    Axis *axes;
    size_t axis_count;
    bool seeded;             // true with --seeds: the last axis is SEED
    uint32_t *value_indices; // [run * axis_count + axis]: index into the values of the axis
    size_t run_count;
} Design;

// What a column shows of a metric: its value, or how far it can be trusted (petri_trust).
typedef enum TrustColumn {
    TRUST_VALUE,
    TRUST_DIGITS, // the columns up to this one are those of `petri sweep --trust`, the others of `petri trust`
    TRUST_ERROR,
    TRUST_ORDER,
    TRUST_SPREAD,
    TRUST_LYAPUNOV_TIME,
    TRUST_LYAPUNOV_ERROR,
    TRUST_HORIZON,
    TRUST_VERDICT,
    TRUST_COLUMNS
} TrustColumn;

typedef struct Metric {
    char *name;
    const char *expression;  // NULL: a quantity
    MotionQuantity quantity; // for metrics without an expression
    TrustColumn column;
} Metric;

// The result of a run.
typedef struct Result {
    Str rows;       // cells of each row: frame, value of each metric, error; rows.bytes is NULL: not done yet
    int64_t frames; // number of computed frames, with the one that failed
    bool killed;    // true if the process of the run was killed by SIGKILL; the run is then repeated once
} Result;

// Where the result of a run comes from, if there is a cache.
typedef enum ResultOrigin {
    RESULT_COMPUTED, // the cache had no result
    RESULT_CACHED,
    RESULT_VERIFIED, // computed, and equal to the result in the cache
    RESULT_DIFFERS,  // computed, and different from the result in the cache
    RESULT_ORIGINS
} ResultOrigin;

enum { SWEEP_CONTINUE = -2 };

typedef struct Sweep {
    const CommandContext *host;
    Options *options;
    const struct SweepOptions *own; // sweep/options.h
    Design design;
    Metric *metrics;     // each with `trust_columns` columns that follow each other, the value first
    size_t metric_count; // number of columns
    size_t trust_columns;
    bool moved;        // starting positions are moved by 1e-9 of the size, in each run in other directions
    uint32_t parts;    // equal parts into which each step is divided; 0: 1
    size_t first_runs; // number of runs before the first call of `finish`; 0: all
    // Processes the results and returns the exit status, or SWEEP_CONTINUE after it has increased design.run_count.
    // NULL: writes the table.
    int (*finish)(struct Sweep *sweep);
    Text shared;                      // options that apply to every run, quoted for a shell
    char settings[SHA256_DIGITS + 1]; // hash of everything that the result of each run depends on, except values
    char identity[SHA256_DIGITS + 1]; // hash of everything that the table depends on
    Result *results;                  // indexed by run
    size_t shard;                     // shard of this process, from 0; it executes the runs with run % shards == shard
    size_t shards;
    size_t origins[RESULT_ORIGINS]; // by origin: number of results of this command
    TextList reported;              // diagnostics that were already shown
} Sweep;

// Creates the design from the options. Returns false after a message. The caller frees *design with design_free even
// after a failure.
bool design_make(Design *design, const Options *options, const CommandContext *context);
void design_free(Design *design);
// Returns the value of an axis in a run.
const char *design_value(const Design *design, size_t run, size_t axis);
// Parses `NAME=VALUES`. Returns false after a message.
bool axis_read(Axis *axis, const char *text);
// Returns a value of the axis as a cell of the kind of the axis.
Cell axis_cell(const Axis *axis, const char *value);
// Appends a value as an expression of the language.
void axis_add_literal(Text *out, const char *value);

// Returns the half width of the confidence interval of a mean by Student's distribution, or INFINITY if `count` is
// below
// 2. `level` is its probability, such as 0.95, `count` the number of independent values, and `squares` the sum of their
// squared differences from their mean.
double student_half_width(double level, double count, double squares);

// Executes the runs of a sweep whose fields up to `own` are set, and `trust_columns` and `finish` for another command
// than `petri sweep`. Returns the exit status.
int sweep_execute(Sweep *sweep, const Command *command);

// Creates the design and reads the metrics and all other options of a sweep. Returns false after a message.
bool sweep_read_options(Sweep *sweep, const Command *command);

// Properties of a run: it belongs to the shard of this process; it has a result; it belongs to the shard and has none;
// it has failed or is unstable.
bool sweep_owns_run(const Sweep *sweep, size_t run);
bool sweep_has_result(const Sweep *sweep, size_t run);
bool sweep_wants_run(const Sweep *sweep, size_t run);
bool sweep_is_failed(const Sweep *sweep, size_t run);
// Returns the number of runs with a property.
size_t sweep_count_runs(const Sweep *sweep, bool (*has)(const Sweep *sweep, size_t run));
// Stores the result of a run and copies `rows`. Does nothing if the run already has a result.
void sweep_store_result(Sweep *sweep, size_t run, int64_t frames, Str rows);
// Shows a diagnostic, unless it was shown before or --quiet hides it. `sweep` points to the Sweep. For measure_open.
void sweep_report(void *sweep, PetriLevel level, const char *rendered);

// A row of a result, and the value of one metric in it.
typedef struct Row {
    int64_t frame;
    double x; // NaN if the row has an error or if the value is not one finite number
} Row;
// Removes the first row from *rows, which starts as Result.rows. Row.x is the value of a metric, or the frame if
// `metric` is metric_count. Returns false after the last row.
bool row_next(const Sweep *sweep, Str *rows, size_t metric, Row *row);
// Appends a row for a run that failed.
void row_add_failure(const Sweep *sweep, int64_t frame, const char *error, Text *rows);
// Appends a cell of a metric, or another cell if `metric` is metric_count, as in CSV but without quotes.
void row_add_text(const Sweep *sweep, size_t metric, Cell cell, Text *out);
// Returns true if the bytes of a journal or a cache are rows of this sweep.
bool rows_are_valid(const Sweep *sweep, Str rows);
