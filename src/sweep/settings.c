// settings.c: options of `petri sweep`: metrics, shards, files, and the options that are passed on to each run.
#include "cli/args.h"
#include "cli/mpirun.h"
#include "cli/script.h"
#include "petri-archive.h"
#include "sweep/options.h"
#include "sweep/plots.h"

#include <stdio.h>
#include <string.h>

static bool is_column(const Sweep *sweep, const char *name, size_t metrics) {
    bool found = strcmp(name, "run") == 0 || strcmp(name, "frame") == 0 || strcmp(name, "error") == 0;
    for (size_t i = 0; i < sweep->design.axis_count; i++)
        found = found || strcmp(name, sweep->design.axes[i].name) == 0;
    for (size_t i = 0; i < metrics; i++)
        found = found || strcmp(name, sweep->metrics[i].name) == 0;
    return found;
}

// Adds the columns of a metric. Returns false after a message if the table has another column with such a name.
static bool add_metric(Sweep *sweep, const char *text) {
    static const char *const suffixes[TRUST_COLUMNS] = {
        "", "_digits", "_error", "_order", "_spread", "_lyapunov_time", "_lyapunov_error", "_horizon", "_verdict"};
    size_t name = strcspn(text, "=");
    for (size_t column = 0; column < sweep->trust_columns; column++) {
        SCOPED_TEXT full = {0};
        text_add_format(&full, "%.*s%s", (int)name, text, suffixes[column]);
        bool exists = is_column(sweep, full.bytes, sweep->metric_count);
        sweep->metrics[sweep->metric_count++] = (Metric){.name = memory_strdup(full.bytes),
                                                         .expression = text[name] ? text + name + 1 : NULL,
                                                         .quantity = motion_quantity(text),
                                                         .column = (TrustColumn)column};
        if (exists) {
            message("--metric %s: the table already has a column with this name", full.bytes);
            return false;
        }
    }
    return true;
}

static bool read_metrics(Sweep *sweep) {
    const TextList *texts = &sweep->own->metrics;
    if (sweep->trust_columns == 0)
        sweep->trust_columns = sweep->own->trust ? TRUST_DIGITS + 1 : 1;
    sweep->metrics = memory_calloc((texts->count * sweep->trust_columns + 1) * sizeof *sweep->metrics);
    for (size_t i = 0; i < texts->count; i++)
        if (!add_metric(sweep, texts->items[i]))
            return false;
    if (sweep->metric_count == 0 && !sweep->own->until) {
        message("nothing to measure; add --metric NAME='EXPR', such as --metric speed='hypot($(:cells;0;:velocity))'");
        return false;
    }
    if (sweep->trust_columns > 1 && (sweep->own->until || sweep->options->frames < 1)) {
        message(sweep->own->until ? "option '--trust' compares runs of the same length; use --frames instead of --until"
                                  : "option '--trust' needs at least one frame");
        return false;
    }
    return true;
}

// Parses --shard, such as `2/4`. Without --shard, each process of mpirun executes one shard if petri was built
// without MPI.
static bool read_shard(Sweep *sweep) {
    const char *text = sweep->own->shard;
    int shard = 1, shards = 1, rank = 0, count = 0;
    char trailing = '\0';
    if (text) {
        if (sscanf(text, "%d/%d%c", &shard, &shards, &trailing) != 2 || shard < 1 || shard > shards) {
            message("option '--shard' expects I/N, such as 2/4 for the second of four, not '%s'", text);
            return false;
        }
    }
    if (!text && !sweep->host->channel && mpirun_rank(&rank, &count)) {
        shard = rank + 1;
        shards = count;
    }
    sweep->shard = (size_t)shard - 1;
    sweep->shards = (size_t)shards;
    if (shards > 1 && !sweep->own->output) {
        message("option '--shard' needs a file for the table; add -o FILE.csv");
        return false;
    }
    return true;
}

// Collects the options that apply to individual runs and can change their results.
static void read_shared_options(Sweep *sweep, const Command *command) {
    static const char *const free_ones[] = {"color", "quiet", "threads", "neighbours", "frames", NULL};
    Options again = *sweep->options;
    Args args = {.command = command, .options = &again, .argc = again.argc, .argv = again.argv};
    for (int id = args_next(&args); id != ARG_END; id = args_next(&args)) {
        if (id != ARG_OPTION || args.option->own)
            continue;
        bool counts = true;
        for (size_t i = 0; free_ones[i]; i++)
            counts = counts && strcmp(args.option->name, free_ones[i]) != 0;
        if (counts) {
            SCOPED_TEXT word = {0};
            text_add_format(&word, !args.option->value ? "--%s" : "--%s=%s", args.option->name, args.value);
            text_add_format(&sweep->shared, " ");
            shell_add_word(&sweep->shared, word.bytes);
        }
    }
    text_add_c(&sweep->shared, "");
}

static bool check_plot(const Sweep *sweep) {
    const char *plot = sweep->own->plot;
    if (!plot || plot_grid_fits(plot))
        return true;
    message("option '--plot' expects a file name that ends in .svg, .png or .pdf, not '%s'", plot);
    return false;
}

static bool check_cache(const Sweep *sweep) {
    if (sweep->own->verify_cache > 0 && !sweep->own->cache) {
        message("option '--verify-cache' needs a cache; add --cache DIR");
        return false;
    }
    if (sweep->own->cache && petri_archive_is(sweep->options->script)) {
        message("cannot use '--cache' with an archive; write its files to a folder with 'petri archive unpack'");
        return false;
    }
    return true;
}

static bool check_output(const Sweep *sweep) {
    const char *output = sweep->own->output;
    if (!output || script_suffix(output, ".nc .nc4 .cdf") < 0)
        return true;
    message("option '--output' expects a file name that ends in .csv or .h5, which tools for NetCDF can read, not '%s'",
            output);
    return false;
}

bool sweep_read_options(Sweep *sweep, const Command *command) {
    if (!design_make(&sweep->design, sweep->options, sweep->host) || !read_metrics(sweep) || !read_shard(sweep) ||
        !check_plot(sweep) || !check_output(sweep) || !check_cache(sweep))
        return false;
    read_shared_options(sweep, command);
    return true;
}
