// design.c: the runs of a sweep: all combinations of values, or a sample of them, each repeated for all seeds.
#include "base/hash_index.h"
#include "petri-edit.h"
#include "sweep/options.h"
#include "sweep/sweep.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_RUNS = 10000000 };

const char *design_value(const Design *design, size_t run, size_t axis) {
    return design->axes[axis].values.items[design->value_indices[run * design->axis_count + axis]];
}

static Axis *find_axis(const Design *design, const char *name) {
    for (size_t i = 0; i < design->axis_count; i++)
        if (strcmp(design->axes[i].name, name) == 0)
            return &design->axes[i];
    return NULL;
}

static void free_axis(Axis *axis) {
    free(axis->name);
    texts_free(&axis->values);
}

void design_free(Design *design) {
    for (size_t i = 0; i < design->axis_count; i++)
        free_axis(&design->axes[i]);
    free(design->axes);
    free(design->value_indices);
}

// Adds the axis that `text` defines. A later definition of a name replaces an earlier one, so the command line
// overrides a plan.
static bool read_axis(Design *design, const char *text) {
    Axis axis;
    bool good = axis_read(&axis, text);
    Axis *entry = find_axis(design, axis.name);
    if (!entry)
        entry = &design->axes[design->axis_count++];
    else
        free_axis(entry);
    *entry = axis;
    return good;
}

static bool read_axes(Design *design, const Options *options) {
    const SweepOptions *own = sweep_options(options);
    design->axes = memory_calloc((own->axes.count + 1) * sizeof *design->axes);
    for (size_t i = 0; i < own->axes.count; i++)
        if (!read_axis(design, own->axes.items[i]))
            return false;
    if (own->seeds == 0)
        return true;
    if (find_axis(design, "SEED")) {
        message("cannot use both --seeds and -D SEED: --seeds N means -D SEED=1..N");
        return false;
    }
    char seeds[48];
    snprintf(seeds, sizeof seeds, "SEED=1..%" PRId64, own->seeds);
    design->seeded = true;
    return read_axis(design, seeds);
}

// Allocates the runs. Returns false after a message if there are too many.
static bool alloc_runs(Design *design, double runs) {
    if (runs > MAX_RUNS) {
        message("too many runs: %.0f, at most %d; select some with --sample latin:N", runs, MAX_RUNS);
        return false;
    }
    design->run_count = (size_t)runs;
    design->value_indices = memory_calloc(design->run_count * (design->axis_count + 1) * sizeof *design->value_indices);
    return true;
}

// Creates a run for every combination of values. From run to run, the value of the first name changes least often.
static bool make_grid(Design *design) {
    double runs = 1;
    for (size_t i = 0; i < design->axis_count; i++)
        runs *= (double)design->axes[i].values.count;
    if (!alloc_runs(design, runs))
        return false;
    for (size_t run = 0; run < design->run_count; run++) {
        size_t rest = run;
        for (size_t i = design->axis_count; i > 0; i--) {
            size_t count = design->axes[i - 1].values.count;
            design->value_indices[run * design->axis_count + i - 1] = (uint32_t)(rest % count);
            rest /= count;
        }
    }
    return true;
}

typedef struct Sample {
    size_t count;
    uint64_t seed;
} Sample;

// Parses `latin:COUNT` or `latin:COUNT:SEED`. Returns false after a message.
static bool read_sample(const char *text, Sample *sample) {
    char *end = NULL;
    long count = strncmp(text, "latin:", 6) == 0 ? strtol(text + 6, &end, 10) : 0;
    bool good = count >= 1 && count <= MAX_RUNS;
    sample->count = (size_t)count;
    sample->seed = 0;
    if (good && *end == ':' && end[1] >= '0' && end[1] <= '9')
        sample->seed = strtoull(end + 1, &end, 10);
    if (!good || *end != '\0') {
        message("option '--sample' expects latin:COUNT or latin:COUNT:SEED, not '%s'", text);
        return false;
    }
    return true;
}

static uint64_t next_random(uint64_t *random) {
    return hash_mix(*random += UINT64_C(0x9e3779b97f4a7c15));
}

// Samples an axis of a Latin hypercube. The axis is divided into `count` equal intervals; each sample is at a random
// position in a different interval.
static void sample_axis(Design *design, size_t number, const Sample *sample, size_t seeds) {
    Axis *axis = &design->axes[number];
    uint64_t random = hash_bytes(sample->seed, axis->name, strlen(axis->name));
    uint32_t *slices = memory_calloc(sample->count * sizeof *slices);
    for (uint32_t i = 0; i < sample->count; i++) {
        uint32_t other = (uint32_t)(next_random(&random) % (i + 1));
        slices[i] = slices[other];
        slices[other] = i;
    }
    size_t listed = axis->values.count;
    if (axis->continuous) {
        texts_free(&axis->values);
        axis->kind = CELL_NUMBER;
    }
    for (size_t i = 0; i < sample->count; i++) {
        double within = (double)(next_random(&random) >> 11) * 0x1p-53;
        double part = (slices[i] + within) / (double)sample->count;
        uint32_t entry = axis->continuous ? (uint32_t)i : (uint32_t)(part * (double)listed);
        if (axis->continuous) {
            char value[32];
            snprintf(value, sizeof value, "%.12g", axis->min + part * (axis->max - axis->min));
            texts_add(&axis->values, value);
        }
        for (size_t seed = 0; seed < seeds; seed++)
            design->value_indices[(i * seeds + seed) * design->axis_count + number] = entry;
    }
    free(slices);
}

static bool make_sample(Design *design, const char *text) {
    Sample sample;
    size_t seeds = design->seeded ? design->axes[design->axis_count - 1].values.count : 1;
    if (!read_sample(text, &sample) || !alloc_runs(design, (double)sample.count * (double)seeds))
        return false;
    for (size_t i = 0; i < design->axis_count - design->seeded; i++)
        sample_axis(design, i, &sample, seeds);
    for (size_t run = 0; design->seeded && run < design->run_count; run++)
        design->value_indices[(run + 1) * design->axis_count - 1] = (uint32_t)(run % seeds);
    return true;
}

// --- runs excluded by --where

typedef struct ConditionDiagnostics {
    bool any;
    bool shown;
} ConditionDiagnostics;

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    ConditionDiagnostics *diagnostics = host;
    diagnostics->any = true;
    if (diagnostics->shown)
        fputs(diagnostic->rendered, stderr);
}

// Evaluates the condition with the values of a run: `(A < B) where A=(1) B=(2)`.
static bool evaluate_condition(PetriSession *session, const Design *design, size_t run, const char *where,
                               PetriEvaluation *result) {
    SCOPED_TEXT text = {0};
    text_add_format(&text, "(%s)%s", where, design->axis_count > 0 ? " where" : "");
    for (size_t i = 0; i < design->axis_count; i++) {
        text_add_format(&text, " %s=", design->axes[i].name);
        axis_add_literal(&text, design_value(design, run, i));
    }
    return petri_evaluate(session, text.bytes, text.len, result, sizeof *result, NULL, NULL) == PETRI_OK;
}

// Evaluates the condition as the user wrote it, so that diagnostics show the user's text.
static void report_condition_error(PetriSession *session, const Design *design, size_t run, const char *where) {
    PetriEvaluation result;
    for (size_t i = 0; i < design->axis_count; i++) {
        SCOPED_TEXT definition = {0};
        text_add_format(&definition, "%s=%s", design->axes[i].name, design_value(design, run, i));
        petri_define(session, definition.bytes);
    }
    petri_evaluate(session, where, PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL);
}

static bool filter_runs(Design *design, const char *where, const CommandContext *host) {
    ConditionDiagnostics diagnostics = {0};
    bool good = true;
    PetriOptions wanted = petri_default_options();
    wanted.stack_limit = host->stack_bytes;
    wanted.no_files = true;
    wanted.on_diagnostic = on_diagnostic;
    wanted.user_data = &diagnostics;
    PetriSession *session = petri_open(&wanted);
    good = session && petri_load_text(session, "--where", "", 0) == PETRI_OK;
    size_t left = 0, width = design->axis_count;
    for (size_t run = 0; good && run < design->run_count; run++) {
        PetriEvaluation result = {0};
        good = evaluate_condition(session, design, run, where, &result) && !diagnostics.any;
        if (good && result.is_true) {
            memmove(&design->value_indices[left++ * width], &design->value_indices[run * width],
                    width * sizeof *design->value_indices);
        } else if (!good) {
            diagnostics.shown = true;
            report_condition_error(session, design, run, where);
        }
    }
    petri_close(&session);
    design->run_count = left;
    if (!good || left == 0)
        message(good ? "no runs: '%s' is never true" : "cannot evaluate the condition of '--where': '%s'", where);
    return good && left > 0;
}

bool design_make(Design *design, const Options *options, const CommandContext *host) {
    const SweepOptions *own = sweep_options(options);
    *design = (Design){0};
    return read_axes(design, options) && (!own->sample ? make_grid(design) : make_sample(design, own->sample)) &&
           (!own->where || filter_runs(design, own->where, host));
}
