// dry_run.c: checks before the first run of a sweep; see measure.h. A table must not have equal rows because of a name
// that is not read, empty columns because of a misspelling, or values that the script has replaced by its default.
#include "sweep/measure.h"
#include "sweep/options.h"

#include <math.h>
#include <string.h>

// Returns true if the script may reject the value or replace it by its default. It always uses numbers other than 0.
static bool may_be_refused(const char *value) {
    double x = 0;
    return !petri_parse_number(value, &x) || x == 0;
}

// Returns the first run in which an axis has a value. If --where excludes the value, returns run_count.
static size_t find_run(const Design *design, size_t axis, size_t value) {
    size_t run = 0;
    while (run < design->run_count && design->value_indices[run * design->axis_count + axis] != value)
        run++;
    return run;
}

// Loads the script with each value that it may reject. Returns false after a message if it rejects one.
static bool try_values(Measure *measure) {
    const Design *design = &measure->sweep->design;
    for (size_t axis = 0; axis < design->axis_count; axis++) {
        const TextList *values = &design->axes[axis].values;
        for (size_t i = 0; i < values->count; i++) {
            size_t run = may_be_refused(values->items[i]) ? find_run(design, axis, i) : design->run_count;
            if (run == design->run_count)
                continue;
            measure_begin_run(measure, run);
            if (measure->false_definition || measure->invalid_definition) {
                message("cannot start the sweep: the script does not %s %s=%s",
                        measure->false_definition ? "use" : "accept", design->axes[axis].name, values->items[i]);
                return false;
            }
        }
    }
    return true;
}

// Returns true if the expression is valid. Also returns true if its evaluation exceeded a limit, because the runs
// report such errors; without a frame, checks only names. Otherwise returns false after a message.
// `option`: the option that contains it, or NULL.
static bool try_expression(Measure *measure, const char *option, const char *expression, bool has_frame) {
    PetriEvaluation result = {0};
    uint64_t errors = petri_diagnostic_count(measure->session, PETRI_ERROR);
    measure->unbound_name = false;
    PetriStatus status =
        petri_evaluate(measure->session, expression, PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL);
    bool aborted = status == PETRI_OUT_OF_MEMORY || status == PETRI_LIMIT_EXCEEDED || status == PETRI_INTERRUPTED;
    bool good = status != PETRI_INVALID && petri_diagnostic_count(measure->session, PETRI_ERROR) == errors;
    if (!measure->unbound_name && (aborted || good || !has_frame))
        return true;
    if (option)
        message("cannot evaluate the expression of '--%s': '%s'", option, expression);
    else
        message("cannot evaluate the expression: '%s'", expression);
    return false;
}

// Shows a hint for each definition that looks like the values of a sweep. It is a vector for other commands.
static void hint_vectors(Measure *measure) {
    const Sweep *sweep = measure->sweep;
    PetriParameter parameter;
    if (!sweep->finish || sweep->parts > 1 || sweep->options->verbosity <= LOG_QUIET)
        return;
    for (size_t i = 0; petri_parameter(measure->session, i, &parameter, sizeof parameter); i++)
        if (parameter.defined && !isnan(parameter.default_number) && strchr(parameter.value, ';'))
            message("%s=%s is a vector, but the default %s is one number; petri trust takes one value for each name, "
                    "petri sweep --trust varies it",
                    parameter.name, parameter.value, parameter.default_value);
}

int measure_dry_run(Measure *measure) {
    const Sweep *sweep = measure->sweep;
    if (!try_values(measure))
        return STATUS_USAGE;
    if (measure_begin_run(measure, 0) != PETRI_OK)
        return STATUS_FAILED;
    if (measure->unread) {
        message("cannot start the sweep: the script does not read '%s', so all its values would give the same result",
                measure->unread);
        return STATUS_USAGE;
    }
    // A failed run becomes a row of the table. The expressions are then checked in the last run.
    size_t last = sweep->design.run_count - 1;
    bool has_frame = petri_step(measure->session) == PETRI_OK ||
                     (measure_begin_run(measure, last) == PETRI_OK && petri_step(measure->session) == PETRI_OK);
    measure_hint_late_metrics(measure);
    hint_vectors(measure);
    measure->strict = true;
    bool good = !sweep->own->until || try_expression(measure, "until", sweep->own->until, has_frame);
    for (size_t i = 0; i < sweep->metric_count; i++) {
        const char *expression = sweep->metrics[i].expression, *option = sweep->finish ? NULL : "metric";
        good = (!expression || try_expression(measure, option, expression, has_frame)) && good;
    }
    return good ? STATUS_DONE : STATUS_USAGE;
}
