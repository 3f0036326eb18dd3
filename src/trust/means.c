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

// MIN_RUNS, MIN_BLOCKS: for the scatter of means of runs and of blocks. FIRST_RUNS, MAX_RUNS: with --within. An
// interval that happens to be too narrow must not end the search, so it starts with FIRST_RUNS runs, and ends when
// GOOD_CHECKS checks after each other have found narrow intervals.
enum { MIN_RUNS = 8, MIN_BLOCKS = 16, FIRST_RUNS = 20, MAX_RUNS = 100000, GOOD_CHECKS = 2, ROWS = 512 };

typedef struct RunMean {
    double mean;  // NaN: the run has failed
    double drift; // change of the mean from the third to the fourth quarter of the run
} RunMean;

typedef struct Mean {
    double mean;
    double half;        // half width of the 95 % interval
    double half_before; // that of the check before
    double independent; // number of independent values with the same interval
    size_t runs;
    Text by_run;       // a RunMean for each run
    bool alike;        // the runs do not differ enough to count as independent
    double drift;      // mean of those of the runs
    double drift_half; // half width of the 98 % interval of `drift`
} Mean;

typedef struct Means {
    Sweep sweep;     // first: `finish` gets its address
    Mean *means;     // by expression
    bool failed;     // a run has failed or is unstable
    size_t runs;     // number of executed runs
    int good_checks; // number of checks after each other in which all intervals were narrow enough
} Means;

// The values of an expression in the second half of the runs: run r has those from `starts[r]` to `starts[r + 1]`.
typedef struct Values {
    Text numbers;
    size_t *starts;
    size_t runs;
} Values;

static double mean_of(const double *x, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += x[i];
    return sum / (double)count; // NaN: no values
}

static Values collect(const Sweep *sweep, size_t metric, Text *by_run) {
    Values values = {.starts = memory_calloc((sweep->design.run_count + 1) * sizeof *values.starts)};
    for (size_t run = 0; run < sweep->design.run_count; run++) {
        Row row;
        for (Str rows = sweep->results[run].rows; row_next(sweep, &rows, metric, &row);)
            if (!isnan(row.x) && row.frame >= sweep->options->frames / 2 && !sweep_is_failed(sweep, run))
                text_add(&values.numbers, (Str){(const char *)&row.x, sizeof row.x});
        size_t start = values.starts[values.runs], rows = values.numbers.len / sizeof(double) - start, half = rows / 2;
        RunMean found = {NAN, NAN};
        if (rows > 0) {
            const double *x = (const double *)(const void *)values.numbers.bytes + start;
            found = (RunMean){mean_of(x, rows), mean_of(x + half, rows - half) - mean_of(x, half)};
            values.starts[++values.runs] = start + rows;
        }
        text_add(by_run, (Str){(const char *)&found, sizeof found});
    }
    return values;
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
    return enough ? student_half_width(0.95, count, squares) : 0;
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

// The sums that the mean of differences and its interval need.
typedef struct Differences {
    double count;
    double sum;
    double squares;
} Differences;

static void add_difference(Differences *all, double difference) {
    bool valid = !isnan(difference);
    all->count += valid;
    all->sum += valid ? difference : 0;
    all->squares += valid ? difference * difference : 0;
}

static double difference_half_width(const Differences *all, double level) {
    return student_half_width(level, all->count, fmax(0, all->squares - all->sum * all->sum / all->count));
}

// Returns the number of runs of both means, and a run of each.
static size_t run_pairs(const Mean *a, const Mean *b, const RunMean **runs_a, const RunMean **runs_b) {
    *runs_a = (const void *)a->by_run.bytes;
    *runs_b = (const void *)b->by_run.bytes;
    return (a->by_run.len < b->by_run.len ? a->by_run.len : b->by_run.len) / sizeof **runs_a;
}

// Measures the drift of a mean, over the same runs with whole and with half steps: with chaos, they are independent.
static void measure_drift(Mean *whole, const Mean *half) {
    Differences all = {.count = 0};
    const RunMean *a, *b;
    size_t runs = run_pairs(whole, half, &a, &b);
    for (size_t run = 0; run < runs; run++)
        add_difference(&all, (a[run].drift + b[run].drift) / 2);
    whole->drift = all.sum / all.count;
    whole->drift_half = difference_half_width(&all, 0.98);
}

// Returns true if the values drift by more than chance explains. `margin` is 1, or more to be surer.
static bool drifts(const Mean *mean, double margin) {
    return fabs(mean->drift) > margin * mean->drift_half;
}

// Estimates the mean. The interval is the widest that follows from blocks of 1, 2, 4 ... values and from whole runs:
// blocks that are shorter than the correlation give intervals that are too narrow.
static Mean estimate(const Sweep *sweep, size_t metric) {
    Mean found = {.mean = NAN, .half = INFINITY};
    Values values = collect(sweep, metric, &found.by_run);
    const double *x = (const void *)values.numbers.bytes;
    size_t count = values.numbers.len / sizeof *x;
    found.runs = values.runs;
    double squares = 0;
    if (count > 0)
        found.mean = mean_of(x, count);
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
    if (mean->alike || drifts(mean, 2))
        return 0; // more runs would not help
    double ratio = mean->half / (within / 100 * fabs(mean->mean));
    return ratio > 0 ? ceil((double)mean->runs * ratio * ratio) : 0;
}

// The search ends when intervals are narrow, which they may be by chance. The wider one of two checks makes up for it.
static void widen(Mean *mean, double half) {
    if (half <= mean->half)
        return;
    mean->independent *= mean->half * mean->half / (half * half);
    mean->half = half;
}

// Returns the number of runs after the next check of the widths: `runs`, if there is none.
static size_t next_runs(Means *all, double within) {
    size_t runs = all->runs, limit = (size_t)all->sweep.own->seeds;
    double wanted = 0;
    for (size_t i = 0; i < all->sweep.metric_count; i++)
        wanted = fmax(wanted, runs_for(&all->means[i], within));
    bool good = wanted <= (double)runs;
    all->good_checks = good ? all->good_checks + 1 : 0;
    for (size_t i = 0; all->good_checks == GOOD_CHECKS && i < all->sweep.metric_count; i++)
        widen(&all->means[i], all->means[i].half_before);
    if (runs == limit || wanted == 0 || all->good_checks == GOOD_CHECKS)
        return runs;
    double next = good ? 1.125 * (double)runs : fmin(wanted * 1.1, 2 * (double)runs);
    return (size_t)fmin(fmax(next, (double)runs + 1), (double)limit);
}

static int keep_means(Sweep *sweep) {
    Means *all = (Means *)sweep;
    double within = ((const TrustOptions *)sweep->own)->within;
    all->runs = sweep->design.run_count;
    for (size_t i = 0; i < sweep->metric_count; i++) {
        text_free(&all->means[i].by_run);
        double before = all->means[i].half;
        all->means[i] = estimate(sweep, i);
        all->means[i].half_before = before;
        measure_drift(&all->means[i], &all->means[i]);
    }
    if (within > 0 && sweep->parts == 1)
        sweep->design.run_count = next_runs(all, within);
    if (sweep->design.run_count > all->runs)
        return SWEEP_CONTINUE;
    all->failed = sweep_count_runs(sweep, sweep_is_failed) > 0;
    return STATUS_DONE;
}

// Executes the runs with steps that are divided into `parts`. `first_runs`: as in Sweep.
static int execute(Means *all, const CommandContext *host, Options *options, uint32_t parts, size_t first_runs) {
    TrustOptions *own = options->own;
    *all = (Means){.sweep = {.host = host,
                             .options = options,
                             .own = &own->sweep,
                             .trust_columns = 1,
                             .moved = true,
                             .parts = parts,
                             .first_runs = first_runs,
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

// Returns the differences between the means of runs with the same SEED, because many such runs are similar.
static Differences compare_steps(const Mean *whole, const Mean *half) {
    Differences all = {.count = 0};
    const RunMean *a, *b;
    size_t runs = run_pairs(whole, half, &a, &b);
    for (size_t run = 0; run < runs; run++)
        add_difference(&all, a[run].mean - b[run].mean);
    return all;
}

// Returns a bound of the error of the step. It is of order 1, so it is twice the difference to the mean with halves of
// the steps.
static double step_error(const Differences *all) {
    return 2 * (fabs(all->sum / all->count) + difference_half_width(all, 0.95));
}

// Returns the half width to state: that of a drifting mean would be a lie.
static double stated_half(const Mean *mean) {
    return drifts(mean, 1) ? INFINITY : mean->half;
}

static double percentage(const Mean *mean, double width) {
    return width > 0 ? 100 * width / fabs(mean->mean) : 0;
}

// Returns false if the mean has no interval, or one that is wider than the user wants.
static bool is_within(const Options *options, const Mean *mean) {
    double within = ((const TrustOptions *)options->own)->within;
    return within == 0 || percentage(mean, stated_half(mean)) <= within;
}

static void add_verdict(const Options *options, const Mean *mean, const Differences *step, Text *out) {
    double within = ((const TrustOptions *)options->own)->within, percent = percentage(mean, mean->half);
    if (mean->alike)
        text_add_format(out, "the runs are alike; let SEED change them, or use more frames");
    else if (drifts(mean, 1))
        text_add_format(out, "still drifts, by %.2g from the third to the fourth quarter; use more frames",
                        mean->drift);
    else if (!isfinite(mean->half))
        text_add_format(out, "no interval; use more runs");
    else if (!is_within(options, mean))
        text_add_format(out, "misses %g %%: within %.2g %%; %.0f runs would give %g %%", within, percent,
                        runs_for(mean, within), within);
    else
        text_add_format(out, "within %.2g %%", percent);
    double error = step_error(step);
    if (isfinite(stated_half(mean)) && isfinite(error) && error > mean->half) {
        bool certain = fabs(step->sum / step->count) > difference_half_width(step, 0.95);
        text_add_format(out, "; the step adds up to %.2g %%: use %s", percentage(mean, error),
                        certain ? "a smaller resolution" : "more runs to know it better");
    }
}

static int print_means(const Options *options, const Means *whole, const Means *half) {
    SCOPED_TEXT out = {0}, sentences = {0};
    static const char *const heads[] = {"expression", "mean", "+-", "step", "runs", "independent"};
    SCOPED_TEXT_TABLE table = text_table_new(sizeof heads / sizeof heads[0]);
    JsonWriter json = {.out = &out, .spaced = true};
    bool missed = whole->failed || half->failed;
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        text_table_add(&table, heads[i]);
    json_open(&json, NULL, "[");
    for (size_t i = 0; i < options->expressions.count; i++) {
        const Mean *mean = &whole->means[i];
        measure_drift(&whole->means[i], &half->means[i]);
        SCOPED_TEXT verdict = {0};
        Differences differences = compare_steps(mean, &half->means[i]);
        double step = step_error(&differences);
        add_verdict(options, mean, &differences, &verdict);
        text_add_format(&sentences, "%s: %s\n", options->expressions.items[i], verdict.bytes);
        missed = missed || !is_within(options, mean);
        text_table_add(&table, options->expressions.items[i]);
        add_number(&table, "%.6g", mean->mean);
        add_number(&table, "%.2g", stated_half(mean));
        add_number(&table, "%.2g", step);
        add_number(&table, "%.0f", (double)mean->runs);
        add_number(&table, "%.0f", mean->independent);
        json_break(&json, "\n  ");
        json_open(&json, NULL, "{");
        json_put_text(&json, "expression", options->expressions.items[i]);
        json_put_number(&json, "mean", mean->mean);
        json_put_number(&json, "half_width", stated_half(mean));
        json_put_number(&json, "step", step);
        json_put_integer(&json, "runs", (int64_t)mean->runs);
        json_put_number(&json, "independent", mean->independent);
        json_put_text(&json, "verdict", verdict.bytes);
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
    return output_text(out.bytes, out.len, missed ? STATUS_FAILED : STATUS_DONE);
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
    int status = execute(&whole, host, options, 1, own->within > 0 ? FIRST_RUNS : 0);
    if (status == STATUS_DONE)
        status = execute(&half, host, options, 2, whole.runs);
    if (status == STATUS_DONE)
        status = print_means(options, &whole, &half);
    free_means(&whole, options);
    free_means(&half, options);
    return status;
}
