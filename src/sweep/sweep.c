// sweep.c: `petri sweep`, which runs a script over many parameter values and measures the results.
#include "sweep/sweep.h"

#include "base/clock.h"
#include "cli/hdf5.h"
#include "cli/mpi_channel.h"
#include "cli/output.h"
#include "cli/subprocess.h"
#include "cli/words.h"
#include "petri.h"
#include "sweep/cache.h"
#include "sweep/measure.h"
#include "sweep/options.h"
#include "sweep/plots.h"
#include "sweep/table.h"
#include "sweep/workers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void add_text(Sha256 *hash, const char *text) {
    sha256_add(hash, !text ? "" : text, !text ? 1 : strlen(text) + 1);
}

// Hashes everything that all runs have in common: petri's version, source files, options, metrics and names.
static void compute_settings(Sweep *sweep, Measure *measure) {
    const Design *design = &sweep->design;
    Sha256 hash = sha256_new();
    add_text(&hash, petri_version());
    measure_hash_sources(measure, &hash);
    add_text(&hash, sweep->shared.bytes);
    add_text(&hash, sweep->own->until);
    int64_t numbers[] = {sweep->options->frames, sweep->own->row_every, (int64_t)sweep->trust_columns, sweep->moved,
                         sweep->parts};
    sha256_add(&hash, (const char *)numbers, sizeof numbers);
    for (size_t i = 0; i < sweep->own->metrics.count; i++)
        add_text(&hash, sweep->own->metrics.items[i]);
    for (size_t i = 0; i < design->axis_count; i++)
        add_text(&hash, design->axes[i].name);
    sha256_end(&hash, sweep->settings);
}

// Hashes everything that the table depends on.
static void compute_identity(Sweep *sweep) {
    const Design *design = &sweep->design;
    Sha256 hash = sha256_new();
    add_text(&hash, sweep->settings);
    for (size_t run = 0; run < design->run_count; run++)
        for (size_t i = 0; i < design->axis_count; i++)
            add_text(&hash, design_value(design, run, i));
    sha256_end(&hash, sweep->identity);
}

// Finds errors in the script before the runs start. Uses a temporary session, because each worker has its own.
static int dry_run(Sweep *sweep) {
    Measure measure;
    if (!measure_open(&measure, sweep, sweep_report, sweep))
        return STATUS_FAILED;
    int status = measure_dry_run(&measure);
    if (status == STATUS_DONE) {
        compute_settings(sweep, &measure);
        compute_identity(sweep);
    }
    measure_close(&measure);
    return status;
}

static void print_cache_report(const Sweep *sweep) {
    size_t verified = sweep->origins[RESULT_VERIFIED], differs = sweep->origins[RESULT_DIFFERS];
    if (differs > 0)
        message("%zu of %zu verified runs differ from their results in the cache", differs, verified + differs);
    if (sweep->own->cache && sweep->options->verbosity > LOG_QUIET)
        message("%s%zu runs computed, %zu from the cache, %zu verified",
                sweep->parts > 1 ? "with halves of the steps: " : "", sweep->origins[RESULT_COMPUTED],
                sweep->origins[RESULT_CACHED], verified + differs);
}

static void print_report(const Sweep *sweep, double seconds, size_t executed, size_t failed) {
    size_t runs = sweep->design.run_count;
    if (failed > 0)
        message("%zu of %zu runs failed or are unstable; see the column 'error'", failed, runs);
    if (sweep->options->verbosity > LOG_QUIET && sweep->own->output) {
        message("%zu run%s in %s, %zu of them done now in %.1f s (%.1f runs/s)", runs, runs == 1 ? "" : "s",
                sweep->own->output, executed, seconds, seconds > 0 ? (double)executed / seconds : 0);
    }
}

// Checks early that petri-hdf5 can write the table. Nothing is written, because petri-hdf5 discards a table without
// data. Returns false after a message.
static bool can_write(const Sweep *sweep) {
    const char *output = sweep->own->output;
    Hdf5 writer;
    return !output || !hdf5_has_suffix(output) ||
           (hdf5_start(&writer, "table", output, NULL, NULL) && hdf5_end(&writer));
}

static bool write_table(const Sweep *sweep) {
    SCOPED_TEXT table = {0}, commands = {0}, path = {0};
    const char *output = sweep->own->output;
    bool csv = !output || !hdf5_has_suffix(output);
    table_make(sweep, csv, &table);
    if (!output)
        return output_text(table.bytes, table.len, STATUS_DONE) == STATUS_DONE;
    table_commands(sweep, &commands);
    text_add_format(&path, "%s.runs", output);
    return output_file(path.bytes, text_str(&commands)) &&
           (csv ? output_file(output, text_str(&table)) : hdf5_table(output, text_str(&table), worker_signal));
}

// Writes the summary, the plot and the table. Returns false after a message.
static bool write_all(const Sweep *sweep) {
    SCOPED_TEXT summary = {0};
    bool good = true;
    if (sweep->own->summary) {
        summary_make(sweep, &summary);
        good = output_file(sweep->own->summary, text_str(&summary));
    }
    good = (!sweep->own->plot || plot_grid_draw(sweep, sweep->own->plot)) && good;
    return write_table(sweep) && good;
}

// Writes the table if all runs of all shards are done. The shard that finishes last therefore writes the table.
static int finish_sweep(Sweep *sweep, Journal *journal, double start, size_t executed) {
    size_t done = sweep_count_runs(sweep, sweep_has_result);
    if (done < sweep->design.run_count && journal->path) {
        journal_merge(journal, sweep);
        done = sweep_count_runs(sweep, sweep_has_result);
    }
    if (done < sweep->design.run_count) {
        message("%zu of %zu runs are done; the last shard to finish writes %s", done, sweep->design.run_count,
                sweep->own->output);
        return STATUS_DONE;
    }
    if (sweep->finish) {
        int status = sweep->finish(sweep);
        if (status != SWEEP_CONTINUE)
            print_cache_report(sweep);
        return status;
    }
    if (!write_all(sweep))
        return worker_signal() != 0 ? STATUS_SIGNAL + worker_signal() : STATUS_FAILED;
    if (journal->path)
        journal_remove(journal, sweep);
    size_t failed = sweep_count_runs(sweep, sweep_is_failed);
    print_report(sweep, clock_seconds() - start, executed, failed);
    print_cache_report(sweep);
    return failed > 0 || sweep->origins[RESULT_DIFFERS] > 0 ? STATUS_FAILED : STATUS_DONE;
}

static int64_t jobs_of(const Sweep *sweep) {
    // Under mpirun, which starts one process per processor, each process executes one run at a time.
    bool alone = !sweep->host->channel && (sweep->shards == 1 || sweep->own->shard);
    return sweep->own->jobs > 0 ? sweep->own->jobs : alone ? subprocess_default_jobs() : 1;
}

static int make_runs(Sweep *sweep, Journal *journal) {
    double start = clock_seconds();
    size_t wanted = sweep_count_runs(sweep, sweep_wants_run);
    size_t before = sweep_count_runs(sweep, sweep_owns_run) - wanted;
    if (before > 0 && sweep->options->verbosity > LOG_QUIET)
        message("%zu runs are already done", before);
    int status = SWEEP_CONTINUE;
    while (status == SWEEP_CONTINUE) {
        status = worker_pool_run(sweep, journal, jobs_of(sweep));
        if (status == STATUS_DONE)
            status = finish_sweep(sweep, journal, start, wanted - sweep_count_runs(sweep, sweep_wants_run));
    }
    if (status > STATUS_SIGNAL) {
        message(!journal->path ? "stopped; to keep finished runs, use -o FILE.csv"
                               : "stopped; run the same command to resume");
    }
    return status;
}

static int run_sweep(Sweep *sweep) {
    Journal journal = {.file = -1};
    int status = cache_open(sweep) ? dry_run(sweep) : STATUS_FAILED;
    if (status != STATUS_DONE)
        return status;
    sweep->results = memory_calloc(sweep->design.run_count * sizeof *sweep->results);
    if (sweep->first_runs > 0 && sweep->first_runs < sweep->design.run_count)
        sweep->design.run_count = sweep->first_runs;
    if (worker_pool_is_remote(sweep))
        return worker_pool_run(sweep, &journal, jobs_of(sweep));
    if (!can_write(sweep))
        return STATUS_FAILED;
    if (sweep->own->output)
        status = journal_open(&journal, sweep, sweep->own->output);
    status = status == STATUS_DONE ? make_runs(sweep, &journal) : status;
    journal_close(&journal);
    return status;
}

static void free_sweep(Sweep *sweep) {
    for (size_t i = 0; i < sweep->metric_count; i++)
        free(sweep->metrics[i].name);
    for (size_t run = 0; sweep->results && run < sweep->design.run_count; run++)
        free((char *)sweep->results[run].rows.bytes);
    free(sweep->metrics);
    free(sweep->results);
    text_free(&sweep->shared);
    texts_free(&sweep->reported);
    design_free(&sweep->design);
}

// Runs the command with the arguments of the plan, followed by the command-line arguments except `--plan FILE`.
static int run_plan(const CommandContext *host, const Options *options) {
    TextList words = {0};
    int status = STATUS_USAGE;
    if (plan_read(sweep_options(options)->plan, &words)) {
        for (int i = 0; i < options->argc; i++) {
            bool is_plan = strcmp(options->argv[i], "--plan") == 0;
            if (!is_plan && strncmp(options->argv[i], "--plan=", 7) != 0)
                texts_add(&words, options->argv[i]);
            i += is_plan;
        }
        status = command_run(&SWEEP_COMMAND, host, (int)words.count, words.items);
    }
    texts_free(&words);
    return status;
}

int sweep_execute(Sweep *sweep, const Command *command) {
    sweep->options->threads = sweep->options->threads > 0 ? sweep->options->threads : 1;
    int status = sweep_read_options(sweep, command) ? run_sweep(sweep) : STATUS_USAGE;
    free_sweep(sweep);
    return status;
}

static bool sweep_needs_pictures(char *const *words) {
    return words_have_option(words, "plan") || words_have_option(words, "plot") || words_name_archive(words);
}

static int sweep_run(const CommandContext *host, Options *options) {
    if (sweep_options(options)->plan)
        return run_plan(host, options);
    if (!options->script) {
        message("no script given; usage: petri sweep [options] SCRIPT.fl");
        return STATUS_USAGE;
    }
    SweepOptions *own = sweep_options(options);
    own->output = own->output && strcmp(own->output, "-") == 0 ? NULL : own->output;
    Sweep sweep = {.host = host, .options = options, .own = own};
    return sweep_execute(&sweep, &SWEEP_COMMAND);
}

const Command SWEEP_COMMAND = {
    .name = "sweep",
    .operands = "SCRIPT.fl",
    .summary = "run a script over many parameter values",
    .details =
        "Runs a script for each combination of values and seeds, several runs in parallel, and writes one table with\n"
        "columns run, values, frame, metrics, error. Without --every it has one row per run, for the last frame. A\n"
        "metric is an expression that can use the script's top-level names and, with $, the state after the frame,\n"
        "or a quantity of all systems: energy, kinetic_energy, potential_energy, momentum, angular_momentum.\n"
        "\n"
        "-D NAME=1..10 means 1, 2 ... 10; 0..1|0.05 is a range with a step; 1;5;20 is a list. Mix them: 1;5..20|5.\n"
        "Write a vector in parentheses, (1;2), and a list of vectors as (1;2);(3;4). The first name changes most\n"
        "slowly. SEED, which --seeds counts from 1, changes most quickly.\n"
        "\n"
        "A misspelt metric or parameter is an error before the first run. A run that fails or is unstable has a\n"
        "message in the column error, and the command exits with 1. With -o FILE, finished runs are stored in\n"
        "FILE.part: after Ctrl-C or kill -9, run the same command to resume; the table is then the same to the last\n"
        "byte. FILE.runs lists the command of each run. If FILE ends in .h5, the table is the HDF5 data set `table`.\n"
        "If it has one row for each combination, each metric is also an array whose dimensions are the parameters.\n"
        "\n"
        "With --cache DIR, results of runs are stored in DIR. A run is not computed again if the script, the files "
        "that\n"
        "it reads, its values, options and metrics are the same. Several sweeps and machines can use the same folder.\n"
        "--verify-cache 1% computes 1 % of these runs nevertheless; the command exits with 1 if a result differs.\n"
        "\n"
        "A plan is YAML: `script: dish.fl`, options by name, and `define:` and `metric:` with lines NAME: VALUE below\n"
        "them; the command line overrides it. On several machines, use mpirun, which distributes the runs, or start\n"
        "each shard with --shard I/N in a shared folder; the last shard to finish writes the table.",
    .examples =
        "  petri sweep dish.fl -D DROPS=20..200|20 -D SPEED='0.1;0.5;1' --frames 300 -o dish.csv \\\n"
        "      --metric spread='mean(hypot($(:drops;i)) for i in ..DROPS)'\n"
        "  petri sweep --plan dish.yaml --sample latin:200 --seeds 5 --summary means.csv --plot dish.svg -o dish.csv\n"
        "  mpirun -n 16 petri sweep --plan dish.yaml -o dish.csv\n"
        "  sbatch --array=1-8 --wrap 'petri sweep --plan dish.yaml -o dish.csv --shard $SLURM_ARRAY_TASK_ID/8'\n"
        "  parallel petri sweep --plan dish.yaml -o dish.csv --jobs 1 --shard {}/4 ::: 1 2 3 4\n",
    .no_stdin = "cannot read the script from standard input: each process loads it; use a file",
    .options = &SWEEP_OPTIONS,
    .needs_pictures = sweep_needs_pictures,
    .run = sweep_run,
};
