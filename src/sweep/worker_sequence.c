// worker_sequence.c: replaces worker_pool.c where there are no processes: executes the runs one after the other.
#include "base/clock.h"
#include "cli/progress.h"
#include "sweep/measure.h"
#include "sweep/worker_pool.h"

#include <signal.h>

static volatile sig_atomic_t stopped; // number of the signal that stops the sweep; 0: none

static void on_signal(int number) {
    stopped = number;
}

static void report(void *context, PetriLevel level, const char *rendered) {
    sweep_report(context, level, rendered);
}

// Returns true if the run has to be executed.
static bool is_wanted(const Sweep *sweep, size_t run) {
    return sweep_owns_run(sweep, run) && !sweep->results[run].rows;
}

static bool execute(Sweep *sweep, Journal *journal, Measure *measure, size_t run) {
    measure_run(measure, run);
    sweep->origins[measure->origin]++;
    sweep_store_result(sweep, run, measure->frames, measure->rows.bytes, measure->rows.len);
    return journal_add(journal, (int64_t)run, &sweep->results[run]);
}

int worker_pool_run(Sweep *sweep, Journal *journal, int64_t jobs) {
    (void)jobs;
    Measure measure;
    Progress progress;
    int64_t wanted = 0, done = 0;
    for (size_t run = 0; run < sweep->design.run_count; run++)
        wanted += is_wanted(sweep, run);
    stopped = 0;
    signal_catch(SIGINT, on_signal, 0);
    signal_catch(SIGTERM, on_signal, 0);
    signal_catch(SIGHUP, on_signal, 0);
    if (!measure_open(&measure, sweep, report, sweep))
        return STATUS_FAILED;
    progress_start(&progress, sweep->options->verbosity > LOG_QUIET && progress_possible(), wanted);
    progress.things = "runs";
    bool good = true;
    for (size_t run = 0; good && !stopped && run < sweep->design.run_count; run++) {
        if (is_wanted(sweep, run)) {
            progress_erase(&progress);
            good = execute(sweep, journal, &measure, run);
            progress_update(&progress, ++done);
        }
        clock_seconds(); // a system call, during which signals are delivered
    }
    progress_erase(&progress);
    measure_close(&measure);
    return !good ? STATUS_FAILED : done == wanted ? STATUS_DONE : STATUS_SIGNAL + (int)stopped;
}

int worker_pool_signal(void) {
    return (int)stopped;
}
