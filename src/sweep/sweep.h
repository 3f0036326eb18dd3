// sweep.h: what the parts of `petri sweep` share: the runs that are asked for and what has come of each.
#ifndef PETRI_SRC_SWEEP_H
#define PETRI_SRC_SWEEP_H

#include "base/sha256.h"
#include "cli/byte_buffer.h"
#include "cli/options.h"
#include "cli/progress.h"

// A name of -D with the values that it takes, as `petri run -D` takes each.
typedef struct Axis {
    char *name;
    TextList values;
    bool continuous; // a range without a step: --sample takes any number between its ends
    double min;
    double max;
} Axis;

// All runs: which value each axis has in each.
typedef struct Design {
    Axis *axes; // with --seeds the last one is SEED
    size_t axis_count;
    bool seeded;
    uint32_t *value_indices; // run after run, of each axis the number of its value
    size_t run_count;
} Design;

typedef struct Metric {
    char *name;
    const char *expression;
} Metric;

// What came of a run: lines `FRAME TAB value of each metric TAB … TAB error`.
typedef struct Result {
    char *rows;     // NULL: it is not done yet
    int64_t frames; // that it made
    bool killed;    // once, by a signal from outside: it is tried again
} Result;

typedef struct Integrator {
    const CommandContext *host;
    const Options *options;
    Design design;
    Metric *metrics;
    size_t metric_count;
    ByteBuffer shared;                // options of all runs, as words for a shell
    char identity[SHA256_DIGITS + 1]; // another for each other script, design and measurement
    Result *results;                  // of each run
    size_t shard;                     // from 0: the runs whose number leaves this remainder are made here
    size_t shards;
    TextList reported; // diagnostics that were shown: each is once
} Integrator;

// Finds out the design from the options. False after a message; to be freed in any case.
bool design_make(Design *design, const Options *options, const CommandContext *context);
void design_free(Design *design);
const char *design_value(const Design *design, size_t run, size_t axis);
// Reads `NAME=VALUES`; false after a message.
bool axis_read(Axis *axis, const char *text);
// A value as an expression of the language.
void axis_add_literal(ByteBuffer *out, const char *value);

// Whether this process is to make the run.
bool sweep_owns_run(const Integrator *sweep, size_t run);
void sweep_store_result(Integrator *sweep, size_t run, int64_t frames, const char *rows, size_t length);
bool sweep_is_failed(const Result *result);
// Shows a diagnostic if it was not shown before and is wanted.
void sweep_report(Integrator *sweep, PetriLevel level, const char *rendered);

#endif
