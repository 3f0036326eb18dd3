// means.c: means of expressions over the second half of many runs, with intervals that allow for the correlation of
// values in time; see means.h. The runs differ in SEED, and start a tiny distance apart.
#include "trust/means.h"

#include "cli/json.h"
#include "cli/output.h"
#include "cli/text_table.h"
#include "sweep/sweep.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

// MIN_BLOCKS: for the scatter of block means. MAX_RUNS: with --within.
enum { MIN_RUNS = 8, MIN_BLOCKS = 16, MAX_RUNS = 100000, ROWS = 512 };

typedef struct Mean {
    double mean;
    double half;        // half width of the 95 % interval
    double independent; // number of independent values with the same interval
    size_t runs;
    Text by_run; // mean of each run, a double; NaN: it has failed
    bool alike;  // the runs do not differ enough to count as independent
} Mean;

typedef struct Means {
    Sweep sweep; // first: `finish` gets its address
    Mean *means; // by expression
    bool failed; // a run has failed or is unstable
} Means;

// The values of an expression in the second half of the runs: run r has those from `starts[r]` to `starts[r + 1]`.
typedef struct Values {
    Text numbers;
    size_t *starts;
    size_t runs;
} Values;

static Values collect(const Sweep *sweep, size_t metric, Text *by_run) {
    Values values = {.starts = memory_calloc((sweep->design.run_count + 1) * sizeof *values.starts)};
    for (size_t run = 0; run < sweep->design.run_count; run++) {
        Row row;
        double sum = 0;
        for (Str rows = sweep->results[run].rows; row_next(sweep, &rows, metric, &row);)
            if (!isnan(row.x) && row.frame >= sweep->options->frames / 2 && !sweep_is_failed(sweep, run)) {
                text_add(&values.numbers, (Str){(const char *)&row.x, sizeof row.x});
                sum += row.x;
            }
        size_t end = values.numbers.len / sizeof(double), rows = end - values.starts[values.runs];
        sum /= (double)rows; // NaN: no rows
        text_add(by_run, (Str){(const char *)&sum, sizeof sum});
        if (rows > 0)
            values.starts[++values.runs] = end;
    }
    return values;
}

// Returns the 97.5 % quantile of Student's distribution: the expansion of Cornish and Fisher, with an error below 0.1 %
// for at least 7 degrees of freedom.
static double student(double freedom) {
    static const double z = 1.959963984540054;
    double z3 = z * z * z, z5 = z3 * z * z;
    return z + (z3 + z) / (4 * freedom) + (5 * z5 + 16 * z3 + 3 * z) / (96 * freedom * freedom) +
           (3 * z5 * z * z + 19 * z5 + 17 * z3 - 15 * z) / (384 * freedom * freedom * freedom);
}

// Returns the half width that follows from the means of blocks of `length` values, or 0 if there are too few blocks.
static double half_width(const Values *values, double mean, size_t length) {
    const double *x = (const void *)values->numbers.bytes;
    double squares = 0, count = 0;
    for (size_t run = 0; run < values->runs; run++) {
        size_t first = values->starts[run], rows = values->starts[run + 1] - first;
        size_t block = length < rows ? length : rows;
        for (size_t i = 0; i + block <= rows; i += block, count++) {
            double sum = 0;
            for (size_t k = 0; k < block; k++)
                sum += x[first + i + k];
            squares += (sum / (double)block - mean) * (sum / (double)block - mean);
        }
    }
    bool enough = count >= (length == SIZE_MAX ? MIN_RUNS : MIN_BLOCKS);
    return enough ? student(count - 1) * sqrt(squares / (count - 1) / count) : 0;
}

// Returns true if the values of different runs in a frame differ less than values of different frames. So the runs have
// not forgotten their common start, or the values still drift. `variance` is that of all values.
static bool are_alike(const Values *values, double variance) {
    const double *x = (const void *)values->numbers.bytes;
    size_t rows = values->starts[1];
    double squares = 0, runs = (double)values->runs;
    for (size_t row = 0; row < rows && values->runs > 1; row++) {
        double sum = 0;
        for (size_t run = 0; run < values->runs; run++)
            sum += x[values->starts[run] + row];
        for (size_t run = 0; run < values->runs; run++) {
            double difference = x[values->starts[run] + row] - sum / runs;
            squares += difference * difference;
        }
    }
    return values->runs > 1 && squares / ((double)rows * (runs - 1)) < variance / 2;
}

// Estimates the mean. The interval is the widest that follows from blocks of 1, 2, 4 ... values and from whole runs:
// blocks that are shorter than the correlation give intervals that are too narrow.
static Mean estimate(const Sweep *sweep, size_t metric) {
    Mean found = {.mean = NAN, .half = INFINITY};
    Values values = collect(sweep, metric, &found.by_run);
    const double *x = (const void *)values.numbers.bytes;
    size_t count = values.numbers.len / sizeof *x;
    found.runs = values.runs;
    double sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++)
        sum += x[i];
    if (count > 0)
        found.mean = sum / (double)count;
    for (size_t i = 0; i < count; i++)
        squares += (x[i] - found.mean) * (x[i] - found.mean);
    double widest = half_width(&values, found.mean, SIZE_MAX);
    for (size_t length = 1; length <= ROWS; length *= 2)
        widest = fmax(widest, half_width(&values, found.mean, length));
    found.alike = count > 1 && squares > 0 && are_alike(&values, squares / (double)(count - 1));
    if (count > 1 && !found.alike && (widest > 0 || squares == 0)) {
        found.half = widest;
        found.independent = widest > 0 ? squares / (double)(count - 1) * 3.84 / (widest * widest) : (double)count;
    }
    free(values.starts);
    text_free(&values.numbers);
    return found;
}

// Returns the number of runs that gives the wanted width for a mean.
static double runs_for(const Mean *mean, double within) {
    if (mean->alike)
        return 0; // more runs would not help
    double ratio = mean->half / (within / 100 * fabs(mean->mean));
    return ratio > 0 ? ceil((double)mean->runs * ratio * ratio) : 0;
}

static int keep_means(Sweep *sweep) {
    Means *all = (Means *)sweep;
    double within = ((const TrustOptions *)sweep->own)->within, wanted = 0;
    size_t runs = sweep->design.run_count, limit = (size_t)sweep->own->seeds;
    for (size_t i = 0; i < sweep->metric_count; i++) {
        text_free(&all->means[i].by_run);
        all->means[i] = estimate(sweep, i);
        wanted = fmax(wanted, within > 0 ? runs_for(&all->means[i], within) : 0);
    }
    if (wanted > (double)runs && runs < limit) {
        double next = fmin(fmin(wanted * 1.1, 2 * (double)runs), (double)limit);
        sweep->design.run_count = next > (double)runs ? (size_t)next : runs + 1;
        return SWEEP_CONTINUE;
    }
    all->failed = sweep_count_runs(sweep, sweep_is_failed) > 0;
    return STATUS_DONE;
}

// Executes the runs with steps that are divided into `parts`.
static int execute(Means *all, const CommandContext *host, Options *options, uint32_t parts) {
    TrustOptions *own = options->own;
    *all = (Means){.sweep = {.host = host,
                             .options = options,
                             .own = &own->sweep,
                             .trust_columns = 1,
                             .moved = true,
                             .parts = parts,
                             .first_runs = own->within > 0 ? MIN_RUNS : 0,
                             .finish = keep_means},
                   .means = memory_calloc(own->sweep.metrics.count * sizeof *all->means)};
    return sweep_execute(&all->sweep, &TRUST_COMMAND);
}

static void add_number(TextTable *table, const char *format, double x) {
    SCOPED_TEXT text = {0};
    if (isfinite(x))
        text_add_format(&text, format, x);
    else
        text_add_c(&text, "-");
    text_table_add(table, text.bytes);
}

// Returns a bound of the error of the step. It is of order 1, so it is twice the difference to the mean with halves of
// the steps. Runs with the same SEED are compared, because many are similar.
static double step_error(const Mean *whole, const Mean *half) {
    const double *a = (const void *)whole->by_run.bytes, *b = (const void *)half->by_run.bytes;
    size_t shorter = whole->by_run.len < half->by_run.len ? whole->by_run.len : half->by_run.len;
    double count = 0, sum = 0, squares = 0;
    for (size_t run = 0; run < shorter / sizeof *a; run++) {
        double difference = a[run] - b[run];
        count += !isnan(difference);
        sum += isnan(difference) ? 0 : difference;
        squares += isnan(difference) ? 0 : difference * difference;
    }
    double mean = sum / count, variance = fmax(0, squares / count - mean * mean) / (count - 1);
    return 2 * (fabs(mean) + student(count - 1) * sqrt(variance));
}

static void add_sentence(const Options *options, const Mean *mean, const char *expression, Text *out) {
    double within = ((const TrustOptions *)options->own)->within, percent = 100 * mean->half / fabs(mean->mean);
    if (mean->alike)
        text_add_format(out, "%s: the runs are alike; let SEED change them, or use more frames\n", expression);
    else if (!isfinite(percent))
        text_add_format(out, "%s: no interval; use more runs\n", expression);
    else if (within > 0 && percent > within)
        text_add_format(out, "%s: within %.2g %%; %.0f runs would give %g %%\n", expression, percent,
                        runs_for(mean, within), within);
    else
        text_add_format(out, "%s: within %.2g %%\n", expression, percent);
}

static int print_means(const Options *options, const Means *whole, const Means *half) {
    SCOPED_TEXT out = {0}, sentences = {0};
    static const char *const heads[] = {"expression", "mean", "+-", "step", "runs", "independent"};
    SCOPED_TEXT_TABLE table = text_table_new(sizeof heads / sizeof heads[0]);
    JsonWriter json = {.out = &out, .spaced = true};
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        text_table_add(&table, heads[i]);
    json_open(&json, NULL, "[");
    for (size_t i = 0; i < options->expressions.count; i++) {
        const Mean *mean = &whole->means[i];
        double step = step_error(mean, &half->means[i]);
        text_table_add(&table, options->expressions.items[i]);
        add_number(&table, "%.6g", mean->mean);
        add_number(&table, "%.2g", mean->half);
        add_number(&table, "%.2g", step);
        add_number(&table, "%.0f", (double)mean->runs);
        add_number(&table, "%.0f", mean->independent);
        add_sentence(options, mean, options->expressions.items[i], &sentences);
        json_break(&json, "\n  ");
        json_open(&json, NULL, "{");
        json_put_text(&json, "expression", options->expressions.items[i]);
        json_put_number(&json, "mean", mean->mean);
        json_put_number(&json, "half_width", mean->half);
        json_put_number(&json, "step", step);
        json_put_integer(&json, "runs", (int64_t)mean->runs);
        json_put_number(&json, "independent", mean->independent);
        json_close(&json, "}");
    }
    text_add_c(&out, "\n");
    json_close(&json, "]");
    text_add_c(&out, "\n");
    if (!((const TrustOptions *)options->own)->json) {
        out.len = 0;
        table_text(&table, &out);
        text_add(&out, text_str(&sentences));
    }
    return output_text(out.bytes, out.len, whole->failed || half->failed ? STATUS_FAILED : STATUS_DONE);
}

static void free_means(Means *all, const Options *options) {
    for (size_t i = 0; all->means && i < options->expressions.count; i++)
        text_free(&all->means[i].by_run);
    free(all->means);
}

int means_run(const CommandContext *host, Options *options) {
    TrustOptions *own = options->own;
    Means whole, half = {.means = NULL};
    own->sweep.row_every = options->frames / ROWS + 1;
    own->sweep.seeds = own->sweep.seeds > 0 ? own->sweep.seeds : MAX_RUNS;
    int status = execute(&whole, host, options, 1);
    if (status == STATUS_DONE)
        status = execute(&half, host, options, 2);
    if (status == STATUS_DONE)
        status = print_means(options, &whole, &half);
    free_means(&whole, options);
    free_means(&half, options);
    return status;
}
