// sweep.h: internal declarations of `petri sweep`: the runs of a sweep and their results.
#pragma once

#include "base/sha256.h"
#include "cli/memory.h"
#include "cli/motion.h"
#include "cli/options.h"

// A name given with -D and its values, as strings that `petri run -D` accepts.
typedef struct Axis {
    char *name;
    TextList values;
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

typedef struct Metric {
    char *name;
    const char *expression;  // NULL: a quantity
    MotionQuantity quantity; // for metrics without an expression
} Metric;

// The result of a run.
typedef struct Result {
    char *rows;     // lines of tab-separated cells: frame, value of each metric, error; NULL: not done yet
    int64_t frames; // number of computed frames
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

typedef struct Sweep {
    const CommandContext *host;
    const Options *options;
    Design design;
    Metric *metrics;
    size_t metric_count;
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
// Appends a value as an expression of the language.
void axis_add_literal(Text *out, const char *value);

// Creates the design and reads the metrics and all other options of a sweep. Returns false after a message.
bool sweep_read_options(Sweep *sweep, const Command *command);
// Checks early that petri-hdf5 can write the table. Nothing is written, because petri-hdf5 discards a table without
// data. Returns false after a message.
bool sweep_can_write(const Sweep *sweep);
// Writes the summary, the plot and the table. Returns false after a message.
bool sweep_write_all(const Sweep *sweep);

// Returns true if the run belongs to the shard of this process.
bool sweep_owns_run(const Sweep *sweep, size_t run);
// Stores the result of a run and copies `rows`. Does nothing if the run already has a result.
void sweep_store_result(Sweep *sweep, size_t run, int64_t frames, const char *rows, size_t length);
bool sweep_is_failed(const Result *result);
// Shows a diagnostic, unless it was shown before or --quiet hides it.
void sweep_report(Sweep *sweep, PetriLevel level, const char *rendered);
