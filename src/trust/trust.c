// trust.c: `petri trust`, which says how many digits of a script's results are true. The runs are those of a sweep with
// one combination of values.
#include "base/number.h"
#include "cli/json.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "cli/text_table.h"
#include "cli/words.h"
#include "petri-archive.h"
#include "sweep/sweep.h"
#include "trust/means.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

// The cells of an expression after a frame, in the order of TrustColumn.
typedef struct Finding {
    int64_t frame;
    const char *expression;
    Cell cells[TRUST_COLUMNS];
} Finding;

static double number_in(const Finding *finding, TrustColumn column) {
    return finding->cells[column].as.number;
}

static void add_value(const Sweep *sweep, const Finding *finding, Text *text) {
    row_add_text(sweep, sweep->metric_count, finding->cells[TRUST_VALUE], text);
}

static void put_finding(const Sweep *sweep, const Finding *finding, JsonWriter *json) {
    SCOPED_TEXT value = {0};
    double digits = number_in(finding, TRUST_DIGITS);
    Cell cell = finding->cells[TRUST_VALUE];
    add_value(sweep, finding, &value);
    json_break(json, "\n  ");
    json_open(json, NULL, "{");
    json_put_integer(json, "frame", finding->frame);
    json_put_text(json, "expression", finding->expression);
    if (cell.kind == CELL_NUMBER)
        json_put_number(json, "value", cell.as.number);
    else
        json_put_text(json, "value", value.len > 0 ? value.bytes : NULL);
    json_put_number(json, "error", number_in(finding, TRUST_ERROR));
    json_put_number(json, "order", number_in(finding, TRUST_ORDER));
    json_put_number(json, "spread", number_in(finding, TRUST_SPREAD));
    json_put_number(json, "digits", digits < 0 ? NAN : digits);
    json_put_number(json, "lyapunov_time", number_in(finding, TRUST_LYAPUNOV_TIME));
    json_put_number(json, "lyapunov_error", number_in(finding, TRUST_LYAPUNOV_ERROR));
    json_put_number(json, "horizon", number_in(finding, TRUST_HORIZON));
    json_put_text(json, "verdict", finding->cells[TRUST_VERDICT].as.text);
    json_close(json, "}");
}

static void add_cell(TextTable *table, const char *format, double x) {
    SCOPED_TEXT text = {0};
    if (isnan(x))
        text_add_c(&text, "-");
    else
        text_add_format(&text, format, x);
    text_table_add(table, text.bytes);
}

static void add_row(const Sweep *sweep, const Finding *finding, TextTable *table) {
    SCOPED_TEXT frame = {0}, value = {0};
    double digits = number_in(finding, TRUST_DIGITS);
    text_add_format(&frame, "%" PRId64, finding->frame);
    add_value(sweep, finding, &value);
    text_table_add(table, frame.bytes);
    text_table_add(table, finding->expression);
    text_table_add(table, value.len > 0 ? value.bytes : "null");
    add_cell(table, "%.2g", number_in(finding, TRUST_ERROR));
    add_cell(table, "%.2f", number_in(finding, TRUST_ORDER));
    add_cell(table, "%.2g", number_in(finding, TRUST_SPREAD));
    add_cell(table, "%.0f", digits < 0 ? NAN : digits);
}

// Reads the next finding. Returns false at the end.
static bool next_finding(const Sweep *sweep, Str *rows, size_t *column, Finding *finding) {
    Cell cell;
    if (*column == sweep->metric_count)
        cell_next(rows, &cell); // the error
    if (*column == 0 || *column == sweep->metric_count) {
        *column = 0;
        if (!cell_next(rows, &cell))
            return false;
        finding->frame = cell.as.integer;
    }
    const Metric *metric = &sweep->metrics[*column];
    finding->expression = metric->expression ? metric->expression : metric->name;
    for (size_t i = 0; i < TRUST_COLUMNS; i++)
        cell_next(rows, &finding->cells[i]);
    *column += TRUST_COLUMNS;
    return true;
}

static void add_growth(const Finding *finding, Text *out) {
    double time = number_in(finding, TRUST_LYAPUNOV_TIME), horizon = number_in(finding, TRUST_HORIZON);
    if (!isnan(time))
        text_add_format(out, "Lyapunov time: %.2g s, standard error %.1g s\n", time,
                        number_in(finding, TRUST_LYAPUNOV_ERROR));
    if (!isnan(horizon))
        text_add_format(out, "single runs mean nothing after %.3g s\n", horizon);
}

static int print_findings(Sweep *sweep) {
    SCOPED_TEXT out = {0}, verdicts = {0};
    static const char *const heads[] = {"frame", "expression", "value", "error", "order", "spread", "digits"};
    SCOPED_TEXT_TABLE table = text_table_new(sizeof heads / sizeof heads[0]);
    JsonWriter json = {.out = &out, .spaced = true};
    bool as_json = ((const TrustOptions *)sweep->own)->json;
    Finding finding = {.frame = 0};
    Str rows = sweep->results[0].rows;
    if (sweep_is_failed(sweep, 0) && rows.len == 0)
        return STATUS_FAILED;
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        text_table_add(&table, heads[i]);
    json_open(&json, NULL, "[");
    for (size_t column = 0; next_finding(sweep, &rows, &column, &finding);) {
        if (finding.cells[TRUST_VERDICT].kind != CELL_TEXT)
            return STATUS_FAILED; // the run has failed after a message
        put_finding(sweep, &finding, &json);
        add_row(sweep, &finding, &table);
        if (rows.len > 0 && column <= sweep->metric_count)
            text_add_format(&verdicts, "%s: %s\n", finding.expression, finding.cells[TRUST_VERDICT].as.text);
        if (column == TRUST_COLUMNS)
            verdicts.len = 0;
        if (column == TRUST_COLUMNS)
            text_add_format(&verdicts, "%s: %s\n", finding.expression, finding.cells[TRUST_VERDICT].as.text);
    }
    text_add_c(&out, "\n");
    json_close(&json, "]");
    text_add_char(&out, '\n');
    if (!as_json) {
        out.len = 0;
        table_text(&table, &out);
        add_growth(&finding, &out);
        text_add(&out, text_str(&verdicts));
    }
    return output_text(out.bytes, out.len, sweep_is_failed(sweep, 0) ? STATUS_FAILED : STATUS_DONE);
}

static int trust_run(const CommandContext *host, Options *options) {
    TrustOptions *own = options->own;
    bool means = own->sweep.seeds > 0 || own->within > 0;
    if (means && own->sweep.row_every > 0) {
        message("option '--every' reports frames of a single run; leave it out with --seeds and --within");
        return STATUS_USAGE;
    }
    if (options->expressions.count == 0)
        texts_add(&options->expressions, "energy");
    for (size_t i = 0; i < options->expressions.count; i++) {
        SCOPED_TEXT metric = {0};
        const char *expression = options->expressions.items[i];
        if (motion_quantity(expression) == MOTION_QUANTITIES)
            text_add_format(&metric, "e%zu=", i + 1);
        text_add_c(&metric, expression);
        texts_add(&own->sweep.metrics, metric.bytes);
    }
    if (means) {
        int result = means_run(host, options);
        texts_free(&own->sweep.metrics);
        return result;
    }
    own->sweep.trust = true;
    Sweep sweep = {
        .host = host, .options = options, .own = &own->sweep, .trust_columns = TRUST_COLUMNS, .finish = print_findings};
    int status = sweep_execute(&sweep, &TRUST_COMMAND);
    texts_free(&own->sweep.metrics);
    return status;
}

static bool trust_needs_pictures(char *const *words) {
    return words_name_archive(words);
}

typedef TrustOptions Own;

static bool read_width(const Args *args, void *field) {
    char *end = NULL;
    double value = *(double *)field = strtod(args->value, &end);
    bool good = end != args->value && end[*end == '%'] == '\0' && value > 0 && value <= 1000;
    return good || option_invalid(args, "a percentage above 0 such as 1%");
}

// clang-format off
static const OptionSpec ROWS[] = {
    DEFINE_OPTION
    SHARED("frames", 0, "N", WHOLE(1, INT64_MAX), frames, "compare runs of N frames (default: 600)")
    OWN("every", 0, "K", WHOLE(1, INT64_MAX), sweep.row_every, "also report every K-th frame (default: only the last)")
    OWN("seeds", 0, "N", WHOLE(1, 100000), sweep.seeds, "print means over N runs, with SEED from 1 to N; with --within: at most N")
    OWN("within", 0, "P%", read_width, within, "add runs until the 95 % interval of each mean is within P % of it")
    OWN("jobs", 0, "N", WHOLE(1, 1024), sweep.jobs, "execute N runs in parallel (default: number of CPUs)")
    OWN("json", 0, NULL, option_flag, json, "print a list of objects")
    OWN("cache", 0, "DIR", option_text, sweep.cache, "store the results in the folder DIR, and use those that are there")
    FPS_OPTION READ_OPTIONS
    SHARED("threads", 0, "N", WHOLE(1, 1024), threads, "use N worker threads (default: 1); does not change results")
    LIMIT_OPTIONS METHOD_OPTIONS QUIET_OPTION COLOUR_OPTION NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable TRUST_OPTIONS = {ROWS, sizeof(Own), NULL};

const Command TRUST_COMMAND = {
    .name = "trust",
    .operands = "SCRIPT.fl [EXPR...]",
    .summary = "find out how many digits of results are true",
    .details =
        "Runs a script with its own time steps, with halves and quarters of them, and with starting positions that\n"
        "are moved by one unit in the last place and by 1e-9 of the size of the system. Prints for each EXPR after "
        "the\n"
        "last frame: its value, a bound of the error of the step, the order that was observed, the spread by "
        "rounding,\n"
        "and the number of digits that are true; --json prints these, lyapunov_time, lyapunov_error, horizon and "
        "verdict.\n"
        "EXPR is an expression as for --metric of petri sweep, or one of\n"
        "energy, kinetic_energy, potential_energy, momentum, angular_momentum (default: energy).\n"
        "\n"
        "--seeds N prints means over N runs instead, with 95 % intervals that allow for correlation in time; --within "
        "1%\n"
        "executes as many runs as the means need, and the same command with --cache DIR resumes. The objects of "
        "--json\n"
        "then have expression, mean, half_width, step, runs, independent, verdict.\n"
        "\n"
        "The last lines say whether the value has converged, which step to use instead, from when on a chaotic system\n"
        "has no predictable values, or which force is unstable. The exit status is 1 if the run is unstable or fails, "
        "or misses --within.",
    .examples = "  petri trust dish.fl\n"
                "  petri trust dish.fl 'place(0)' 'mean(hypot(place(i)) for i in ..DROPS)' --every 100\n"
                "  petri trust dish.fl energy --frames 2000 --json\n"
                "  petri trust dish.fl kinetic_energy --frames 6000 --within 1% --cache results\n",
    .missing_operand = "no script given",
    .no_stdin = "cannot read the script from standard input: each process loads it; use a file",
    .accepts_expressions = true,
    .options = &TRUST_OPTIONS,
    .needs_pictures = trust_needs_pictures,
    .run = trust_run,
};
