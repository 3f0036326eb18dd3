// worker_sequence.c: replaces worker_pool.c where there are no processes. Helpers, which are instances of this command
// in other threads, execute the runs. A single job, and the runs that helpers have not executed, need no helpers.
#include "base/clock.h"
#include "cli/progress.h"
#include "cli/wasm_host.h"
#include "sweep/workers.h"

#include <stdlib.h>
#include <string.h>

bool worker_pool_is_remote(const Sweep *sweep) {
    (void)sweep;
    return host_is_helper();
}

// --- in a helper

static int help(const Sweep *sweep) {
    Measure measure;
    SCOPED_TEXT diagnostics = {0}, packet = {0};
    if (!measure_open(&measure, sweep, result_add_diagnostic, &diagnostics))
        return STATUS_FAILED;
    for (int run = host_take_run(); run >= 0; run = host_take_run()) {
        result_execute(&measure, run, &diagnostics, &packet);
        host_send(packet.bytes, (int)packet.len);
    }
    measure_close(&measure);
    return STATUS_DONE;
}

// --- in the command

typedef struct Sequence {
    Sweep *sweep;
    Journal *journal;
    Progress progress;
    int64_t wanted; // number of runs to execute
    int64_t done;   // number of executed runs
} Sequence;

static bool store_result(Sequence *sequence, const ResultPacket *result) {
    progress_erase(&sequence->progress);
    bool good = result_store(sequence->sweep, sequence->journal, result);
    progress_update(&sequence->progress, ++sequence->done);
    return good;
}

// Lists the runs to execute for the helpers, starts them, and stores their results. Returns false after a message.
static bool receive_results(Sequence *sequence, int64_t jobs) {
    int *runs = memory_calloc((size_t)sequence->wanted * sizeof *runs), count = 0;
    for (size_t run = 0; run < sequence->sweep->design.run_count; run++)
        if (sweep_wants_run(sequence->sweep, run))
            runs[count++] = (int)run;
    bool good = host_start_helpers((int)(jobs < count ? jobs : count), runs, count) == 0;
    free(runs);
    for (int length = 0; good && worker_signal() == 0 && (length = host_receive()) >= 0;) {
        SCOPED_STRING bytes = memory_calloc((size_t)length + 1);
        host_read(bytes);
        good = store_result(sequence, (const void *)bytes);
    }
    return good;
}

// Executes the runs that are not done. Returns false after a message.
static bool execute_rest(Sequence *sequence) {
    Sweep *sweep = sequence->sweep;
    Measure measure;
    SCOPED_TEXT diagnostics = {0}, bytes = {0};
    if (sequence->done == sequence->wanted)
        return true;
    if (!measure_open(&measure, sweep, result_add_diagnostic, &diagnostics))
        return false;
    bool good = true;
    for (size_t run = 0; good && worker_signal() == 0 && run < sweep->design.run_count; run++) {
        if (sweep_wants_run(sweep, run))
            good = store_result(sequence, result_execute(&measure, (int64_t)run, &diagnostics, &bytes));
        clock_seconds(); // a system call, during which signals are delivered
    }
    measure_close(&measure);
    return good;
}

int worker_pool_run(Sweep *sweep, Journal *journal, int64_t jobs) {
    if (worker_pool_is_remote(sweep))
        return help(sweep);
    Sequence sequence = {.sweep = sweep, .journal = journal};
    sequence.wanted = (int64_t)sweep_count_runs(sweep, sweep_wants_run);
    worker_catch_signals();
    progress_start(&sequence.progress, sweep->options->verbosity > LOG_QUIET && progress_possible(), sequence.wanted);
    sequence.progress.things = "runs";
    // Helpers cannot read a script from standard input again.
    bool parallel = jobs > 1 && sequence.wanted > 1 && strcmp(sweep->options->script, "-") != 0;
    bool good = (!parallel || receive_results(&sequence, jobs)) && execute_rest(&sequence);
    progress_erase(&sequence.progress);
    return !good ? STATUS_FAILED : sequence.done == sequence.wanted ? STATUS_DONE : STATUS_SIGNAL + worker_signal();
}
