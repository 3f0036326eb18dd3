// measure.c: see measure.h.
#include "sweep/measure.h"

#include "base/file.h"
#include "cli/archive.h"
#include "cli/parameters.h"
#include "cli/script.h"
#include "petri-inspect.h"
#include "sweep/options.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static bool has_code(const PetriDiagnostic *diagnostic, const char *code) {
    return diagnostic->code && strcmp(diagnostic->code, code) == 0;
}

// Returns the name of the axis that the script does not read according to the diagnostic, or NULL.
static const char *unread_axis(const Design *design, const PetriDiagnostic *diagnostic) {
    if (!has_code(diagnostic, "unknown-parameter") && !has_code(diagnostic, "unread-definition") &&
        !has_code(diagnostic, "unused-definition"))
        return NULL;
    for (size_t i = 0; i < design->axis_count; i++) {
        SCOPED_TEXT start = {0};
        text_add_format(&start, "unused definition '%s':", design->axes[i].name);
        if (strncmp(diagnostic->text, start.bytes, start.len) == 0)
            return design->axes[i].name;
    }
    return NULL;
}

static void store_reason(Measure *measure, const PetriDiagnostic *diagnostic) {
    text_free(&measure->error);
    if (diagnostic->file)
        text_add_format(&measure->error, "%s:%" PRIu32 ":%" PRIu32 ": ", diagnostic->file, diagnostic->line,
                        diagnostic->column);
    text_add_c(&measure->error, diagnostic->text);
}

static void on_diagnostic(void *user_data, const PetriDiagnostic *diagnostic) {
    Measure *measure = user_data;
    const char *unread = unread_axis(&measure->sweep->design, diagnostic);
    if (unread && (measure->sweep->moved || texts_contain(&measure->expression_names, unread)))
        return; // for example a limit that only --until reads, or SEED in runs that start at other places
    // A run with the script's default must not be listed with another value.
    bool false_definition = has_code(diagnostic, "false-definition");
    bool divergence = has_code(diagnostic, "divergence"), unstable = has_code(diagnostic, "unstable-force");
    bool unbound = has_code(diagnostic, "unbound-name");
    measure->unread = unread ? unread : measure->unread;
    measure->false_definition = measure->false_definition || false_definition;
    measure->diverged = measure->diverged || divergence;
    measure->unstable = measure->unstable || unstable;
    measure->unbound_name = measure->unbound_name || unbound;
    if (diagnostic->level == PETRI_ERROR || divergence || unstable)
        store_reason(measure, diagnostic);
    measure->invalid_definition = measure->invalid_definition || is_invalid_definition(diagnostic);
    // --quiet does not hide the reason why the sweep is not started.
    PetriLevel level = unread || (unbound && measure->strict) ? PETRI_ERROR : diagnostic->level;
    if (!measure->silent)
        measure->on_diagnostic(measure->context, level, diagnostic->rendered);
}

// The text whose names are collected.
typedef struct NameSource {
    const char *text;
    TextList *names;
} NameSource;

static void add_name(void *user_data, const PetriToken *token) {
    const NameSource *source = user_data;
    if (token->kind != PETRI_TOKEN_NAME)
        return;
    SCOPED_STRING name = memory_strndup(source->text + token->start, token->end - token->start);
    texts_add(source->names, name);
}

static void collect_names(Measure *measure, const char *expression) {
    NameSource source = {expression, &measure->expression_names};
    if (expression)
        petri_tokenise(measure->session, expression, PETRI_NUL_TERMINATED, add_name, &source);
}

static void on_file_read(void *user_data, const char *name, const char *bytes, size_t length) {
    Measure *measure = user_data;
    read_files_add(&measure->files, name, bytes, length);
}

// Loads the script of the archive with the configuration of its first keyframe. Returns false after a message.
static bool load_archive(Measure *measure) {
    PetriStatus status = petri_archive_load(measure->archive, measure->session, -1);
    petri_archive_end_replay(measure->archive);
    if (status != PETRI_OK && !archive_report_problem(measure->archive, measure->sweep->options->script))
        message("cannot read '%s': %s", measure->sweep->options->script, petri_status_text(status));
    return status == PETRI_OK;
}

// Opens an archive instead of a script. Returns false after a message.
static bool open_archive(Measure *measure, Options *options) {
    PetriArchiveInfo info;
    measure->archive = replay_archive(options, options->script);
    if (!measure->archive || !petri_archive_info(measure->archive, &info, sizeof info)) {
        archive_report_problem(measure->archive, options->script);
        return false;
    }
    measure->archive_sha256 = info.sha256;
    options->replayed = measure->archive;
    return true;
}

bool measure_open(Measure *measure, const Sweep *sweep,
                  void (*report)(void *context, PetriLevel level, const char *rendered), void *context) {
    *measure = (Measure){.sweep = sweep, .on_diagnostic = report, .context = context, .silent = true};
    Options options = *sweep->options;
    options.on_file_read = sweep->own->cache ? on_file_read : NULL;
    if (petri_archive_is(options.script) && !open_archive(measure, &options))
        return false;
    if (options_open(&options, sweep->host, on_diagnostic, measure, &measure->session) != OPTIONS_READ)
        return false;
    collect_names(measure, sweep->own->until);
    for (size_t i = 0; i < sweep->metric_count; i++)
        collect_names(measure, sweep->metrics[i].expression);
    if (measure->archive) {
        if (!load_archive(measure))
            return false;
    } else {
        // This may fail, for example if the script needs definitions. Each run then loads it and reports errors.
        petri_load(measure->session, sweep->options->script);
    }
    measure->base = petri_config_get(measure->session);
    if (!measure->base)
        message("out of memory");
    measure->silent = false;
    return measure->base;
}

void measure_close(Measure *measure) {
    petri_config_free(measure->base);
    petri_close(&measure->session);
    petri_archive_close(&measure->archive);
    cache_entry_free(&measure->result);
    text_free(&measure->error);
    texts_free(&measure->expression_names);
    read_files_free(&measure->files);
    known_hashes_free(&measure->known);
}

static PetriStatus vary(Measure *measure, size_t run) {
    const Sweep *sweep = measure->sweep;
    return petri_vary(measure->session, &(PetriVariation){.size = sizeof(PetriVariation),
                                                          .parts = sweep->parts,
                                                          .shift = sweep->moved ? 1e-9 : 0,
                                                          .seed = run});
}

PetriStatus measure_begin_run(Measure *measure, size_t run) {
    const Design *design = &measure->sweep->design;
    petri_config_apply(measure->session, measure->base);
    petri_reset(measure->session);
    text_free(&measure->error);
    measure->false_definition = measure->diverged = measure->unstable = false;
    PetriStatus status = PETRI_OK;
    for (size_t i = 0; status == PETRI_OK && i < design->axis_count; i++) {
        SCOPED_TEXT definition = {0};
        text_add_format(&definition, "%s=%s", design->axes[i].name, design_value(design, run, i));
        status = petri_define(measure->session, definition.bytes);
        if (status == PETRI_INVALID)
            text_add_format(&measure->error, "not NAME=VALUE: '%s'", definition.bytes);
    }
    if (status == PETRI_OK)
        status = vary(measure, run);
    if (status != PETRI_OK)
        return status;
    status = petri_source_file(measure->session, 0) ? petri_reload(measure->session, NULL)
                                                    : script_load(measure->session, measure->sweep->options->script);
    return measure->false_definition ? PETRI_INVALID : status;
}

// Appends the value of an expression as a cell.
static PetriStatus add_value(Measure *measure, const char *expression) {
    SCOPED_TEXT value = {0};
    PetriEvaluation result = {0};
    PetriStatus status = petri_evaluate(measure->session, expression, PETRI_NUL_TERMINATED, &result, sizeof result,
                                        text_collect, &value);
    if (status != PETRI_OK)
        return status;
    bool number = result.length == 1 && (isnan(result.number) ? strcmp(value.bytes, "nan") == 0
                                                              : !petri_symbol_name(measure->session, result.number));
    cell_add(&measure->result.rows, number ? (Cell){CELL_NUMBER, {.number = isnan(result.number) ? NAN : result.number}}
                                    : result.length > 0 ? (Cell){CELL_TEXT, {.text = value.bytes}}
                                                        : (Cell){.kind = CELL_NONE});
    return PETRI_OK;
}

static PetriStatus add_metric(Measure *measure, const Metric *metric) {
    return metric->expression ? add_value(measure, metric->expression)
                              : motion_add_quantity(measure->session, metric->quantity, &measure->result.rows);
}

// Returns the number of the last frame, or 0 if there is none.
static int64_t frame_number(const Measure *measure) {
    return measure->result.frames > 0 ? measure->result.frames - 1 : 0;
}

static PetriStatus add_row(Measure *measure) {
    size_t before = measure->result.rows.len;
    PetriStatus status = PETRI_OK;
    cell_add(&measure->result.rows, (Cell){CELL_INTEGER, {.integer = frame_number(measure)}});
    for (size_t i = 0; status == PETRI_OK && i < measure->sweep->metric_count; i++)
        status = add_metric(measure, &measure->sweep->metrics[i]);
    cell_add(&measure->result.rows,
             measure->unstable ? (Cell){CELL_TEXT, {.text = measure->error.bytes}} : (Cell){.kind = CELL_NONE});
    measure->result.rows.len = status == PETRI_OK ? measure->result.rows.len : before;
    return status;
}

static void add_failure(Measure *measure, PetriStatus status) {
    const char *reason = measure->error.len > 0          ? measure->error.bytes
                         : status == PETRI_OUT_OF_MEMORY ? "out of memory"
                                                         : "aborted";
    row_add_failure(measure->sweep, frame_number(measure), reason, &measure->result.rows);
}

static PetriStatus step_frame(Measure *measure, bool *ends, bool *measured) {
    const SweepOptions *own = measure->sweep->own;
    PetriEvaluation until = {0};
    PetriStatus status = petri_step(measure->session);
    if (status != PETRI_OK || measure->diverged)
        return status != PETRI_OK ? status : PETRI_INVALID;
    *measured = own->row_every > 0 && measure->result.frames % own->row_every == 0;
    measure->result.frames++;
    if (own->until)
        status = petri_evaluate(measure->session, own->until, PETRI_NUL_TERMINATED, &until, sizeof until, NULL, NULL);
    *ends = until.is_true || measure->result.frames == measure->sweep->options->frames;
    *measured = *measured || *ends;
    return status == PETRI_OK && *measured ? add_row(measure) : status;
}

// --- runs with --trust

static PetriStatus write_metric(void *context, uint32_t number, PetriWriteCallback *write, void *user_data) {
    Measure *measure = context;
    const Metric *metric = &measure->sweep->metrics[number * measure->sweep->trust_columns];
    PetriEvaluation result = {0};
    if (metric->expression)
        return petri_evaluate(measure->session, metric->expression, PETRI_NUL_TERMINATED, &result, sizeof result, write,
                              user_data);
    SCOPED_TEXT cells = {0}, text = {0};
    Cell cell = {.kind = CELL_NONE};
    PetriStatus status = motion_add_quantity(measure->session, metric->quantity, &cells);
    Str rest = text_str(&cells);
    if (status == PETRI_OK && cell_next(&rest, &cell))
        row_add_text(measure->sweep, 0, cell, &text);
    if (text.len > 0)
        write(user_data, text.bytes, text.len);
    return status;
}

// Returns a value as the cell of its column.
static Cell trust_cell(const PetriTrust *trust, TrustColumn column) {
    const double numbers[TRUST_COLUMNS] = {
        [TRUST_ERROR] = trust->error,
        [TRUST_ORDER] = trust->order,
        [TRUST_SPREAD] = trust->spread,
        [TRUST_DIGITS] = trust->digits,
        [TRUST_LYAPUNOV_TIME] = trust->lyapunov_time,
        [TRUST_LYAPUNOV_ERROR] = trust->lyapunov_error,
        [TRUST_HORIZON] = trust->horizon,
    };
    double value = 0;
    if (column == TRUST_VERDICT)
        return (Cell){CELL_TEXT, {.text = trust->sentence}};
    if (column == TRUST_VALUE && !petri_parse_number(trust->value, &value))
        return trust->value[0] == '\0' ? (Cell){.kind = CELL_NONE} : (Cell){CELL_TEXT, {.text = trust->value}};
    return (Cell){CELL_NUMBER, {.number = column == TRUST_VALUE ? value : numbers[column]}};
}

// Adds the columns of a metric, and the cells around them.
static void add_trust(void *context, const PetriTrust *trust) {
    Measure *measure = context;
    Text *rows = &measure->result.rows;
    size_t columns = measure->sweep->trust_columns;
    if (trust->expression == 0)
        cell_add(rows, (Cell){CELL_INTEGER, {.integer = trust->frame}});
    for (size_t column = 0; column < columns; column++)
        cell_add(rows, trust_cell(trust, (TrustColumn)column));
    if ((trust->expression + 1) * columns == measure->sweep->metric_count)
        cell_add(rows,
                 measure->unstable ? (Cell){CELL_TEXT, {.text = measure->error.bytes}} : (Cell){.kind = CELL_NONE});
}

static PetriStatus measure_trust(Measure *measure) {
    const Sweep *sweep = measure->sweep;
    const PetriTrustOptions options = {.size = sizeof options,
                                       .count = (uint32_t)(sweep->metric_count / sweep->trust_columns),
                                       .frames = sweep->options->frames,
                                       .every = sweep->own->row_every,
                                       .report = add_trust,
                                       .user_data = measure,
                                       .measure = write_metric};
    measure->result.frames = sweep->options->frames;
    return petri_trust(measure->session, &options);
}

// Executes a run. Returns false if it failed or is unstable.
static bool execute_run(Measure *measure, size_t run) {
    measure->result.frames = 0;
    measure->result.rows.len = 0;
    PetriStatus status = measure_begin_run(measure, run);
    bool ends = measure->sweep->options->frames == 0, measured = false;
    if (measure->sweep->trust_columns > 1 && status == PETRI_OK) {
        status = measure_trust(measure);
        ends = true;
    }
    while (status == PETRI_OK && !ends)
        status = step_frame(measure, &ends, &measured);
    if (status != PETRI_OK)
        add_failure(measure, status);
    measure->result.frames += status != PETRI_OK; // a repetition must also compute the frame that failed
    return status == PETRI_OK && !measure->unstable;
}

static void report_warning(Measure *measure, const char *rendered) {
    measure->on_diagnostic(measure->context, PETRI_WARNING, rendered);
}

// Sets the digest of the result. Returns false if it cannot be computed.
static bool compute_digest(Measure *measure) {
    uint8_t digest[CACHE_DIGEST_DIGITS / 2];
    if (petri_digest(measure->session, digest) != PETRI_OK)
        return false;
    for (size_t i = 0; i < sizeof digest; i++)
        snprintf(measure->result.digest + 2 * i, 3, "%02x", digest[i]);
    return true;
}

// Executes a run and stores its result, unless it fails. `stored` is the result to verify; NULL: none.
static void execute_and_store(Measure *measure, size_t run, const char *key, const CacheEntry *stored) {
    const Sweep *sweep = measure->sweep;
    SCOPED_TEXT report = {0};
    measure->files.changed = false;
    if (!execute_run(measure, run)) {
        measure->origin = stored ? RESULT_DIFFERS : RESULT_COMPUTED;
        if (stored)
            text_add_format(&report, "petri: run %zu failed, but has a result in the cache\n", run + 1);
    } else if (compute_digest(measure)) {
        if (stored)
            cache_compare(sweep, run, stored, &measure->result, &report);
        measure->origin = !stored ? RESULT_COMPUTED : report.len > 0 ? RESULT_DIFFERS : RESULT_VERIFIED;
        const char *problem = stored ? NULL : cache_store(sweep, key, &measure->files, &measure->result);
        if (problem)
            text_add_format(&report, "petri: cannot write to the cache '%s': %s\n", sweep->own->cache, problem);
    }
    if (report.len > 0)
        report_warning(measure, report.bytes);
}

void measure_run(Measure *measure, size_t run) {
    const Sweep *sweep = measure->sweep;
    char key[SHA256_DIGITS + 1];
    CacheEntry stored;
    measure->origin = RESULT_COMPUTED;
    if (!sweep->own->cache) {
        execute_run(measure, run);
        return;
    }
    cache_key(sweep, run, key);
    CacheAnswer answer = cache_find(sweep, key, &measure->known, &stored);
    if (answer == CACHE_DAMAGED)
        report_warning(measure, "petri: the cache has a damaged result, which is computed again\n");
    if (answer == CACHE_FOUND && !cache_should_verify(sweep, key)) {
        cache_entry_free(&measure->result);
        measure->result = stored;
        measure->origin = RESULT_CACHED;
        return;
    }
    execute_and_store(measure, run, key, answer == CACHE_FOUND ? &stored : NULL);
    cache_entry_free(&stored);
}

void measure_hash_sources(Measure *measure, Sha256 *hash) {
    const char *path = NULL;
    if (measure->archive_sha256)
        sha256_add(hash, measure->archive_sha256, strlen(measure->archive_sha256));
    for (size_t i = 0; (path = petri_source_file(measure->session, i)); i++) {
        SCOPED_TEXT text = {0};
        text_read_file(&text, path, SIZE_MAX);
        sha256_add(hash, (const char *)&text.len, sizeof text.len);
        sha256_add(hash, text.bytes, text.len);
    }
}
