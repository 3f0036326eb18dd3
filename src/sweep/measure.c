// measure.c: see measure.h.
#include "sweep/measure.h"

#include "cli/parameters.h"
#include "cli/script.h"

#include <inttypes.h>
#include <string.h>

static void on_diagnostic(void *user_data, const PetriDiagnostic *diagnostic) {
    Measure *measure = user_data;
    if (diagnostic->level == PETRI_ERROR) {
        byte_buffer_free(&measure->error);
        if (diagnostic->file) {
            byte_buffer_format(&measure->error, "%s:%" PRIu32 ":%" PRIu32 ": ", diagnostic->file, diagnostic->line,
                               diagnostic->column);
        }
        byte_buffer_add_text(&measure->error, diagnostic->text);
    }
    measure->invalid_definition = measure->invalid_definition || is_invalid_definition(diagnostic);
    if (!measure->silent)
        measure->on_diagnostic(measure->context, diagnostic->level, diagnostic->rendered);
}

bool measure_open(Measure *measure, const Sweep *sweep,
                  void (*report)(void *context, PetriLevel level, const char *rendered), void *context) {
    *measure = (Measure){.sweep = sweep, .on_diagnostic = report, .context = context, .silent = true};
    if (options_open(sweep->options, sweep->host, on_diagnostic, measure, &measure->session) != OPTIONS_READ)
        return false;
    // This may fail, for example if the script needs definitions. Each run then loads the script and reports errors.
    petri_load(measure->session, sweep->options->script);
    measure->base = petri_config_get(measure->session);
    if (!measure->base)
        message("out of memory");
    measure->silent = false;
    return measure->base;
}

void measure_close(Measure *measure) {
    petri_config_free(measure->base);
    petri_close(&measure->session);
    byte_buffer_free(&measure->rows);
    byte_buffer_free(&measure->error);
}

// Resets the session and applies the definitions of a run.
static PetriStatus begin_run(Measure *measure, size_t run) {
    const Design *design = &measure->sweep->design;
    petri_config_apply(measure->session, measure->base);
    petri_reset(measure->session);
    byte_buffer_free(&measure->error);
    PetriStatus status = PETRI_OK;
    for (size_t i = 0; status == PETRI_OK && i < design->axis_count; i++) {
        SCOPED_BYTE_BUFFER definition = {0};
        byte_buffer_format(&definition, "%s=%s", design->axes[i].name, design_value(design, run, i));
        status = petri_define(measure->session, definition.data);
        if (status == PETRI_INVALID)
            byte_buffer_format(&measure->error, "not NAME=VALUE: '%s'", definition.data);
    }
    if (status != PETRI_OK)
        return status;
    return petri_source_file(measure->session, 0) ? petri_reload(measure->session, NULL)
                                                  : script_load(measure->session, measure->sweep->options->script);
}

// Appends a cell. Replaces control characters, because tabs and line feeds separate cells and rows.
static void add_cell(ByteBuffer *rows, const char *text, size_t length) {
    size_t at = rows->length;
    byte_buffer_add(rows, text, length);
    for (; at < rows->length; at++)
        rows->data[at] = (unsigned char)rows->data[at] < ' ' ? ' ' : rows->data[at];
}

static PetriStatus add_metric(Measure *measure, const Metric *metric) {
    SCOPED_BYTE_BUFFER value = {0};
    PetriEvaluation result = {0};
    PetriStatus status = petri_evaluate(measure->session, metric->expression, PETRI_NUL_TERMINATED, &result,
                                        byte_buffer_collect, &value);
    byte_buffer_format(&measure->rows, "\t");
    if (status == PETRI_OK && result.length > 0)
        add_cell(&measure->rows, value.data, value.length);
    return status;
}

static void add_frame_number(Measure *measure) {
    byte_buffer_format(&measure->rows, "%" PRId64, measure->frames > 0 ? measure->frames - 1 : 0);
}

static PetriStatus add_row(Measure *measure) {
    size_t before = measure->rows.length;
    PetriStatus status = PETRI_OK;
    add_frame_number(measure);
    for (size_t i = 0; status == PETRI_OK && i < measure->sweep->metric_count; i++)
        status = add_metric(measure, &measure->sweep->metrics[i]);
    byte_buffer_format(&measure->rows, "\t\n");
    measure->rows.length = status == PETRI_OK ? measure->rows.length : before;
    return status;
}

static void add_failure(Measure *measure, PetriStatus status) {
    const char *reason = measure->error.length > 0       ? measure->error.data
                         : status == PETRI_OUT_OF_MEMORY ? "out of memory"
                                                         : "aborted";
    add_frame_number(measure);
    for (size_t i = 0; i <= measure->sweep->metric_count; i++)
        byte_buffer_format(&measure->rows, "\t");
    add_cell(&measure->rows, reason, strlen(reason));
    byte_buffer_format(&measure->rows, "\n");
}

static PetriStatus step_frame(Measure *measure, bool *ends, bool *measured) {
    const Options *options = measure->sweep->options;
    PetriEvaluation until = {0};
    PetriStatus status = petri_step(measure->session);
    if (status != PETRI_OK)
        return status;
    *measured = options->row_every > 0 && measure->frames % options->row_every == 0;
    measure->frames++;
    if (options->until)
        status = petri_evaluate(measure->session, options->until, PETRI_NUL_TERMINATED, &until, NULL, NULL);
    *ends = until.is_true || measure->frames == options->frames;
    *measured = *measured || *ends;
    return status == PETRI_OK && *measured ? add_row(measure) : status;
}

void measure_run(Measure *measure, size_t run) {
    byte_buffer_free(&measure->rows);
    measure->frames = 0;
    PetriStatus status = begin_run(measure, run);
    bool ends = measure->sweep->options->frames == 0, measured = false;
    while (status == PETRI_OK && !ends)
        status = step_frame(measure, &ends, &measured);
    if (status != PETRI_OK)
        add_failure(measure, status);
    byte_buffer_add(&measure->rows, "", 0);
}

// Returns true if the expression is valid. Also returns true if its evaluation exceeded a limit, because the runs
// report such errors. Otherwise returns false after a message.
static bool try_expression(Measure *measure, const char *option, const char *expression) {
    PetriEvaluation result = {0};
    uint64_t errors = petri_diagnostic_count(measure->session, PETRI_ERROR);
    PetriStatus status = petri_evaluate(measure->session, expression, PETRI_NUL_TERMINATED, &result, NULL, NULL);
    bool aborted = status == PETRI_OUT_OF_MEMORY || status == PETRI_LIMIT_EXCEEDED || status == PETRI_INTERRUPTED;
    if (aborted || (status != PETRI_INVALID && petri_diagnostic_count(measure->session, PETRI_ERROR) == errors))
        return true;
    message("cannot evaluate the expression of '--%s': '%s'", option, expression);
    return false;
}

int measure_dry_run(Measure *measure) {
    const Sweep *sweep = measure->sweep;
    if (begin_run(measure, 0) != PETRI_OK)
        return measure->invalid_definition ? STATUS_USAGE : STATUS_FAILED;
    if (petri_step(measure->session) != PETRI_OK)
        return STATUS_DONE; // a failed run becomes a row of the table
    bool good = !sweep->options->until || try_expression(measure, "until", sweep->options->until);
    for (size_t i = 0; i < sweep->metric_count; i++)
        good = try_expression(measure, "metric", sweep->metrics[i].expression) && good;
    return good ? STATUS_DONE : STATUS_USAGE;
}

void measure_hash_sources(Measure *measure, Sha256 *hash) {
    const char *path = NULL;
    for (size_t i = 0; (path = petri_source_file(measure->session, i)); i++) {
        SCOPED_BYTE_BUFFER text = {0};
        byte_buffer_add(&text, "", 0);
        byte_buffer_read_file(&text, path, SIZE_MAX);
        sha256_add(hash, (const char *)&text.length, sizeof text.length);
        sha256_add(hash, text.data, text.length);
    }
}
