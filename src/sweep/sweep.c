// sweep.c: `petri sweep`: runs a script with many values and measures what comes of them.
#include "sweep/sweep.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "cli/args.h"
#include "cli/hdf5.h"
#include "cli/mail.h"
#include "cli/mpirun.h"
#include "cli/pass_on.h"
#include "cli/script.h"
#include "petri.h"
#include "sweep/crew.h"
#include "sweep/extras.h"
#include "sweep/measure.h"
#include "sweep/table.h"

bool sweep_is_ours(const Sweep *sweep, size_t run) {
    return run % sweep->shards == sweep->shard;
}

void sweep_keep(Sweep *sweep, size_t run, int64_t frames, const char *rows, size_t length) {
    Result *result = &sweep->results[run];
    if (result->rows == NULL) {
        result->rows = memory_copied(rows, length);
        result->frames = frames;
    }
}

// Its last row tells.
bool sweep_is_failed(const Result *result) {
    size_t length = strlen(result->rows);
    return length > 1 && result->rows[length - 2] != '\t';
}

void sweep_tell(Sweep *sweep, PetriLevel level, const char *rendered) {
    enum { MOST = 100 };
    bool wanted = level == PETRI_ERROR || sweep->options->verbosity > LOG_QUIET;
    if (wanted && sweep->told.count < MOST && !texts_hold(&sweep->told, rendered)) {
        texts_add(&sweep->told, rendered);
        fputs(rendered, stderr);
    }
}

static void tell(void *context, PetriLevel level, const char *rendered) {
    sweep_tell(context, level, rendered);
}

// --- what is asked for

static bool is_column(const Sweep *sweep, const char *name, size_t metrics) {
    bool taken = strcmp(name, "run") == 0 || strcmp(name, "frame") == 0 || strcmp(name, "error") == 0;
    for (size_t i = 0; i < sweep->design.axis_count; i++) {
        taken = taken || strcmp(name, sweep->design.axes[i].name) == 0;
    }
    for (size_t i = 0; i < metrics; i++) {
        taken = taken || strcmp(name, sweep->metrics[i].name) == 0;
    }
    return taken;
}

static bool take_metrics(Sweep *sweep) {
    const TextList *texts = &sweep->options->metrics;
    sweep->metrics = memory_zeroed((texts->count + 1) * sizeof *sweep->metrics);
    for (; sweep->metric_count < texts->count; sweep->metric_count++) {
        const char *text = texts->items[sweep->metric_count];
        Metric *metric = &sweep->metrics[sweep->metric_count];
        size_t name = strcspn(text, "=");
        *metric = (Metric){memory_copied(text, name), text + name + 1};
        if (is_column(sweep, metric->name, sweep->metric_count)) {
            message("--metric %s: the table has a column of this name already", metric->name);
            sweep->metric_count++;
            return false;
        }
    }
    if (sweep->metric_count == 0 && sweep->options->until == NULL) {
        message(
            "nothing is measured: --metric NAME='EXPR' does, such as --metric speed='hypot($(:cells;0;:velocity))'");
        return false;
    }
    return true;
}

// `2/4`; without --shard, what mpirun says, where petri has no MPI to deal runs out.
static bool take_shard(Sweep *sweep) {
    const char *text = sweep->options->shard;
    int shard = 1, shards = 1, rank = 0, count = 0;
    char behind = '\0';
    if (text != NULL) {
        if (sscanf(text, "%d/%d%c", &shard, &shards, &behind) != 2 || shard < 1 || shard > shards) {
            message("option '--shard' expects I/N, such as 2/4 for the second of four, not '%s'", text);
            return false;
        }
    }
    if (text == NULL && sweep->host->mail == NULL && mpirun_rank(&rank, &count)) {
        shard = rank + 1;
        shards = count;
    }
    sweep->shard = (size_t)shard - 1;
    sweep->shards = (size_t)shards;
    if (shards > 1 && sweep->options->output == NULL) {
        message("a shard needs a table to be a part of: -o FILE.csv");
        return false;
    }
    return true;
}

// The options that a single run takes as well, without those that do not change what comes of it.
static bool take_shared(Sweep *sweep, const Command *command) {
    static const char *const free_ones[] = {"color", "quiet", "threads", "neighbours", NULL};
    Options again = *sweep->options;
    Args args = {.command = command, .options = &again, .argc = again.argc, .argv = again.argv};
    for (int id = args_next(&args); id != ARG_END; id = args_next(&args)) {
        if (id != ARG_OPTION || !(args.option->commands & FOR_RUN)) {
            continue;
        }
        bool counts = true;
        for (size_t i = 0; free_ones[i] != NULL; i++) {
            counts = counts && strcmp(args.option->name, free_ones[i]) != 0;
        }
        if (counts) {
            SCOPED_BYTES word = {0};
            bytes_format(&word, args.option->value == NULL ? "--%s" : "--%s=%s", args.option->name, args.value);
            bytes_format(&sweep->shared, " ");
            shell_add_word(&sweep->shared, word.data);
        }
    }
    bytes_add(&sweep->shared, "", 0);
    return true;
}

static bool take_plot(const Sweep *sweep) {
    const char *plot = sweep->options->plot;
    if (plot == NULL || sweep->host->sweep->plot_fits(plot)) {
        return true;
    }
    message("option '--plot' expects a file name that ends in .svg, .png or .pdf, not '%s'", plot);
    return false;
}

static bool take_output(const Sweep *sweep) {
    const char *output = sweep->options->output;
    if (output == NULL || script_suffix(output, ".nc .nc4 .cdf") < 0) {
        return true;
    }
    message("option '--output' expects a file name that ends in .csv or .h5, not '%s': NetCDF is not written", output);
    return false;
}

static void add_text(Sha256 *hash, const char *text) {
    sha256_add(hash, text == NULL ? "" : text, text == NULL ? 1 : strlen(text) + 1);
}

// All that the table depends on. Runs are told by their values, so a name that is left out is another sweep.
static void identify(Sweep *sweep, Measure *measure) {
    const Design *design = &sweep->design;
    Sha256 hash = sha256_new();
    add_text(&hash, petri_version());
    measure_identify(measure, &hash);
    add_text(&hash, sweep->shared.data);
    add_text(&hash, sweep->options->until);
    int64_t numbers[] = {sweep->options->frames, sweep->options->row_every, (int64_t)design->run_count};
    sha256_add(&hash, (const char *)numbers, sizeof numbers);
    for (size_t i = 0; i < sweep->metric_count; i++) {
        add_text(&hash, sweep->options->metrics.items[i]);
    }
    for (size_t i = 0; i < design->axis_count; i++) {
        add_text(&hash, design->axes[i].name);
    }
    for (size_t run = 0; run < design->run_count; run++) {
        for (size_t i = 0; i < design->axis_count; i++) {
            add_text(&hash, design_value(design, run, i));
        }
    }
    sha256_end(&hash, sweep->identity);
}

// Finds what is wrong with the script before work begins. Processes of the crew have sessions of their own.
static int rehearse(Sweep *sweep) {
    Measure measure;
    if (!measure_open(&measure, sweep, tell, sweep)) {
        return STATUS_FAILED;
    }
    int status = measure_rehearse(&measure);
    if (status == STATUS_DONE) {
        identify(sweep, &measure);
    }
    measure_close(&measure);
    return status;
}

// --- what comes of it

static bool write_file(const char *path, const Bytes *text) {
    const char *problem = file_replace(path, (Str){text->data, text->length}, 0);
    if (problem != NULL) {
        message("cannot write %s: %s", path, problem);
    }
    return problem == NULL;
}

static bool write_table(const Sweep *sweep) {
    SCOPED_BYTES table = {0}, commands = {0}, path = {0};
    const char *output = sweep->options->output;
    table_make(sweep, &table);
    if (output == NULL) {
        if (!file_write(STDOUT_FILENO, table.data, table.length) && errno != EPIPE) {
            message("cannot write standard output: %s", strerror(errno));
            return false;
        }
        return true;
    }
    table_commands(sweep, &commands);
    bytes_format(&path, "%s.runs", output);
    return write_file(path.data, &commands) &&
           (hdf5_is_wanted(output) ? hdf5_table(output, table.data, table.length) : write_file(output, &table));
}

static bool write_all(const Sweep *sweep) {
    SCOPED_BYTES summary = {0};
    bool good = true;
    if (sweep->options->summary != NULL) {
        summary_make(sweep, &summary);
        good = write_file(sweep->options->summary, &summary);
    }
    good = (sweep->options->plot == NULL || sweep->host->sweep->matrix_draw(sweep, sweep->options->plot)) && good;
    return write_table(sweep) && good;
}

static size_t count_done(const Sweep *sweep, bool ours) {
    size_t count = 0;
    for (size_t run = 0; run < sweep->design.run_count; run++) {
        count += sweep->results[run].rows != NULL && (!ours || sweep_is_ours(sweep, run));
    }
    return count;
}

static void report(const Sweep *sweep, double seconds, size_t made) {
    size_t failed = 0, runs = sweep->design.run_count;
    for (size_t run = 0; run < runs; run++) {
        failed += sweep_is_failed(&sweep->results[run]);
    }
    if (failed > 0) {
        message("%zu of %zu runs failed; the column 'error' tells why", failed, runs);
    }
    if (sweep->options->verbosity > LOG_QUIET && sweep->options->output != NULL) {
        message("%zu run%s in %s, %zu of them in %.1f s now (%.1f runs/s)", runs, runs == 1 ? "" : "s",
                sweep->options->output, made, seconds, seconds > 0 ? (double)made / seconds : 0);
    }
}

// The one that makes the last run writes the table, for all shards.
static int end(Sweep *sweep, Journal *journal, double start, size_t made) {
    size_t done = count_done(sweep, false);
    if (done < sweep->design.run_count && journal->path != NULL) {
        journal_gather(journal, sweep);
        done = count_done(sweep, false);
    }
    if (done < sweep->design.run_count) {
        message("%zu of %zu runs are done; the shard that ends last writes %s", done, sweep->design.run_count,
                sweep->options->output);
        return STATUS_DONE;
    }
    if (!write_all(sweep)) {
        return STATUS_FAILED;
    }
    if (journal->path != NULL) {
        journal_remove(journal, sweep);
    }
    report(sweep, clock_seconds() - start, made);
    return STATUS_DONE;
}

static int64_t jobs_of(const Sweep *sweep) {
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    // Of those that mpirun has started, one for each processor.
    bool alone = sweep->host->mail == NULL && (sweep->shards == 1 || sweep->options->shard != NULL);
    return sweep->options->jobs > 0 ? sweep->options->jobs : alone && processors > 1 ? processors : 1;
}

static int make_runs(Sweep *sweep, Journal *journal) {
    double start = clock_seconds();
    size_t before = count_done(sweep, true);
    if (before > 0 && sweep->options->verbosity > LOG_QUIET) {
        message("%zu runs were done before", before);
    }
    int status = crew_work(sweep, journal, jobs_of(sweep));
    if (status == STATUS_DONE) {
        return end(sweep, journal, start, count_done(sweep, true) - before);
    }
    if (status > STATUS_SIGNAL) {
        message(journal->path == NULL ? "stopped; with -o FILE.csv, what is done would be kept"
                                      : "stopped; the same command goes on with what is missing");
    }
    return status;
}

// Before the work begins: a table that nothing is sent to is dropped.
static bool can_write(const char *output) {
    Hdf5 writer;
    return output == NULL || !hdf5_is_wanted(output) ||
           (hdf5_start(&writer, "table", output, NULL) && hdf5_end(&writer));
}

static int run_sweep(Sweep *sweep) {
    Journal journal = {.file = -1};
    int status = rehearse(sweep);
    if (status != STATUS_DONE) {
        return status;
    }
    if (sweep->host->mail != NULL && sweep->host->mail->rank > 0) {
        sweep->results = memory_zeroed(sweep->design.run_count * sizeof *sweep->results);
        return crew_work(sweep, &journal, jobs_of(sweep));
    }
    if (!can_write(sweep->options->output)) {
        return STATUS_FAILED;
    }
    sweep->results = memory_zeroed(sweep->design.run_count * sizeof *sweep->results);
    if (sweep->options->output != NULL) {
        status = journal_open(&journal, sweep, sweep->options->output);
    }
    status = status == STATUS_DONE ? make_runs(sweep, &journal) : status;
    journal_close(&journal);
    return status;
}

static void free_sweep(Sweep *sweep) {
    for (size_t i = 0; i < sweep->metric_count; i++) {
        free(sweep->metrics[i].name);
    }
    for (size_t run = 0; sweep->results != NULL && run < sweep->design.run_count; run++) {
        free(sweep->results[run].rows);
    }
    free(sweep->metrics);
    free(sweep->results);
    bytes_free(&sweep->shared);
    texts_free(&sweep->told);
    design_free(&sweep->design);
}

// The same words without `--plan FILE`, with those of the plan before them.
static int run_plan(const Host *host, const Options *options) {
    TextList words = {0};
    int status = STATUS_USAGE;
    if (host->sweep->plan_read(options->plan, &words)) {
        for (int i = 0; i < options->argc; i++) {
            bool is_plan = strcmp(options->argv[i], "--plan") == 0;
            if (!is_plan && strncmp(options->argv[i], "--plan=", 7) != 0) {
                texts_add(&words, options->argv[i]);
            }
            i += is_plan;
        }
        status = command_run(&SWEEP_COMMAND, host, (int)words.count, words.items);
    }
    texts_free(&words);
    return status;
}

// Becomes petri-pictures, with the same words.
static int run_elsewhere(const Host *host, const Options *options) {
    TextList words = {0};
    texts_add(&words, host->called);
    texts_add(&words, SWEEP_COMMAND.name);
    for (int i = 0; i < options->argc; i++) {
        texts_add(&words, options->argv[i]);
    }
    int status = pass_on(words.items);
    texts_free(&words);
    return status;
}

static int sweep_run(const Host *host, Options *options) {
    if (host->sweep == NULL && (options->plan != NULL || options->plot != NULL)) {
        return run_elsewhere(host, options);
    }
    if (options->plan != NULL) {
        return run_plan(host, options);
    }
    if (options->script == NULL) {
        message("no script was given; usage: petri sweep [options] SCRIPT.fl");
        return STATUS_USAGE;
    }
    options->threads = options->threads > 0 ? options->threads : 1;
    options->output = options->output != NULL && strcmp(options->output, "-") == 0 ? NULL : options->output;
    Sweep sweep = {.host = host, .options = options};
    bool good = design_make(&sweep.design, options, host) && take_metrics(&sweep) && take_shard(&sweep) &&
                take_plot(&sweep) && take_output(&sweep) && take_shared(&sweep, &SWEEP_COMMAND);
    int status = good ? run_sweep(&sweep) : STATUS_USAGE;
    free_sweep(&sweep);
    return status;
}

const Command SWEEP_COMMAND = {
    .name = "sweep",
    .operands = "SCRIPT.fl",
    .summary = "run a script with many values and tabulate what comes of it",
    .details =
        "Runs a script once for each combination of values and seeds, several runs at a time, and writes one table: "
        "run,\n"
        "values, frame, metrics, error. Without --every it has one row a run, of its last frame. A metric is an\n"
        "expression that sees the names of the script's top level and, with $, the state after the frame.\n"
        "\n"
        "-D NAME=1..10 stands for 1, 2 ... 10, both ends included, 0..1|0.05 has a step, 1;5;20 is a list, and all\n"
        "this may be mixed: 1;5..20|5. A vector is one value in parentheses: (1;2), or a list of them: (1;2);(3;4).\n"
        "The first name changes most slowly; SEED, which --seeds counts from 1, most quickly.\n"
        "\n"
        "A run that fails is a row with its message. With -o FILE, what is done is kept in FILE.part: after Ctrl-C or\n"
        "kill -9 the same command goes on, and the table is the same to the last byte. FILE.runs then has a line for\n"
        "each run: the command that makes it again. A table whose name ends in .h5 is in HDF5, as its set `table`.\n"
        "\n"
        "A plan is YAML: `script: dish.fl`, options by their names, and `define:` and `metric:` with lines NAME: "
        "VALUE\n"
        "below them; the command line adds to it. On many machines mpirun has the runs dealt out; with --shard I/N "
        "each\n"
        "makes one part of them in a folder that they share, and the one that ends last writes the table.",
    .examples =
        "  petri sweep dish.fl -D DROPS=20..200|20 -D SPEED='0.1;0.5;1' --frames 300 -o dish.csv \\\n"
        "      --metric spread='mean(hypot($(:drops;i)) for i in ..DROPS)'\n"
        "  petri sweep --plan dish.yaml --sample latin:200 --seeds 5 --summary means.csv --plot dish.svg -o dish.csv\n"
        "  mpirun -n 16 petri sweep --plan dish.yaml -o dish.csv\n"
        "  sbatch --array=1-8 --wrap 'petri sweep --plan dish.yaml -o dish.csv --shard $SLURM_ARRAY_TASK_ID/8'\n"
        "  parallel petri sweep --plan dish.yaml -o dish.csv --jobs 1 --shard {}/4 ::: 1 2 3 4\n",
    .no_stdin = "petri sweep takes a file: its processes each load the script",
    .options = FOR_SWEEP,
    .run = sweep_run,
};
