// worker_pool.c: pre-forked workers that execute sweep runs. A worker reads run numbers from one pipe and writes
// results to another. The next run is assigned in advance, so that the worker does not wait for it.
//
// Under MPI, each rank has such a pool, and rank 0 assigns runs. Each other rank first requests jobs * RUNS_PER_WORKER
// runs, as many as its workers can hold. After that, each result also serves as the next request.
#include "base/file.h"
#include "base/os.h"
#include "cli/mpi_channel.h"
#include "cli/progress.h"
#include "cli/subprocess.h"
#include "sweep/workers.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// RUNS_PER_WORKER: maximum number of runs assigned to a worker. REDRAW: milliseconds between progress updates.
// MESSAGE_POLL_MS: milliseconds between checks for MPI messages.
enum { RUNS_PER_WORKER = 2, REDRAW = 200, MESSAGE_POLL_MS = 2 };

typedef struct PoolWorker {
    pid_t pid;
    int run_pipe;                      // run numbers are written here
    int result_pipe;                   // results are read from here, each a ResultPacket
    int64_t assigned[RUNS_PER_WORKER]; // assigned runs, the current one first
    int count;                         // number of assigned runs
} PoolWorker;

typedef struct WorkerPool {
    Sweep *sweep;
    Journal *journal;
    PoolWorker *workers;
    int64_t jobs;      // number of workers
    size_t next;       // first run that has not been assigned yet, apart from those in `returned`
    int64_t *returned; // runs to assign before `next`: left by workers that have ended, or sent by rank 0
    size_t returned_count;
    const MpiChannel *channel; // NULL: no other ranks
    bool ended;                // true if rank 0 has announced the end
    int64_t wanted;            // number of runs to execute
    int64_t done;              // number of executed runs
    Progress progress;
} WorkerPool;

static const int64_t END_OF_RUNS = -1; // sent instead of a run number

// --- in a worker process

static int worker_loop(const Sweep *sweep, int requests, int results) {
    Measure measure;
    SCOPED_TEXT diagnostics = {0}, packet = {0};
    if (!measure_open(&measure, sweep, result_add_diagnostic, &diagnostics))
        return STATUS_FAILED;
    bool good = true;
    for (int64_t run = 0; good && file_read_bytes(requests, &run, sizeof run);) {
        result_execute(&measure, run, &diagnostics, &packet);
        good = file_write(results, packet.bytes, packet.len);
    }
    measure_close(&measure);
    return STATUS_DONE;
}

// Turns a forked process into a worker. The worker ignores signals from the terminal, because the parent handles them.
// It exits when the parent exits.
static void become_worker(const WorkerPool *pool, int requests, int results, pid_t parent) {
    static const int ignored[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof ignored / sizeof ignored[0]; i++)
        signal(ignored[i], SIG_IGN);
    os_signal_after_parent(SIGKILL);
    // Closes the pipes of other workers. Otherwise those workers would not notice when the parent exits.
    for (int64_t i = 0; i < pool->jobs; i++) {
        if (pool->workers[i].pid > 0) {
            close(pool->workers[i].run_pipe);
            close(pool->workers[i].result_pipe);
        }
    }
    _exit(getppid() != parent ? STATUS_FAILED : worker_loop(pool->sweep, requests, results));
}

// --- in the parent

bool worker_pool_is_remote(const Sweep *sweep) {
    return sweep->host->channel && sweep->host->channel->rank > 0;
}

static bool start_worker(WorkerPool *pool, PoolWorker *worker) {
    int requests[2] = {-1, -1}, results[2] = {-1, -1};
    pid_t parent = getpid();
    worker->pid = pipe(requests) == 0 && pipe(results) == 0 ? fork() : -1;
    if (worker->pid == 0) {
        worker->pid = -1;
        close(requests[1]);
        close(results[0]);
        become_worker(pool, requests[0], results[1], parent);
    }
    int error = errno;
    close(requests[0]);
    close(results[1]);
    worker->run_pipe = requests[1];
    worker->result_pipe = results[0];
    worker->count = 0;
    if (worker->pid < 0) {
        close(requests[1]);
        close(results[0]);
        message("cannot start a process: %s", strerror(error));
    }
    return worker->pid > 0;
}

// Returns the next run to assign, or -1.
static int64_t next_run(WorkerPool *pool) {
    if (pool->returned_count > 0)
        return pool->returned[--pool->returned_count];
    for (; !worker_pool_is_remote(pool->sweep) && pool->next < pool->sweep->design.run_count; pool->next++)
        if (sweep_wants_run(pool->sweep, pool->next))
            return (int64_t)pool->next++;
    return -1;
}

// Assigns runs round-robin, so that no worker has two runs while another has none.
static void assign_runs(WorkerPool *pool) {
    for (int max = 1; max <= RUNS_PER_WORKER; max++) {
        for (int64_t i = 0; i < pool->jobs; i++) {
            PoolWorker *worker = &pool->workers[i];
            int64_t run = worker->count < max && worker->pid > 0 ? next_run(pool) : -1;
            if (run >= 0) {
                worker->assigned[worker->count++] = run;
                if (!file_write(worker->run_pipe, (const char *)&run, sizeof run))
                    kill(worker->pid, SIGKILL); // its pipe is broken; reap_worker then puts its runs into `returned`
            }
        }
    }
}

// Stores a result, or sends it to rank 0. Returns false after a message.
static bool store_result(WorkerPool *pool, const ResultPacket *result) {
    pool->done++;
    if (worker_pool_is_remote(pool->sweep)) {
        pool->channel->send(0, result, result_size(result));
        return true;
    }
    progress_erase(&pool->progress);
    return result_store(pool->sweep, pool->journal, result);
}

static bool read_result(WorkerPool *pool, PoolWorker *worker, bool *gone) {
    ResultPacket head;
    *gone = !file_read_bytes(worker->result_pipe, &head, sizeof head);
    if (*gone)
        return true;
    ResultPacket *result = memory_calloc(result_size(&head));
    *result = head;
    *gone = !file_read_bytes(worker->result_pipe, result->bytes, result_size(&head) - sizeof head);
    bool good = true;
    if (!*gone) {
        memmove(worker->assigned, worker->assigned + 1, sizeof worker->assigned - sizeof worker->assigned[0]);
        worker->count--;
        good = store_result(pool, result);
    }
    free(result);
    return good;
}

// Receives MPI messages. Rank 0 receives requests and results; other ranks receive the runs that are assigned to them.
static bool receive_messages(WorkerPool *pool) {
    SCOPED_TEXT packet = {0};
    bool good = true;
    for (int from = 0; good && pool->channel && pool->channel->receive(&from, &packet); packet.len = 0) {
        if (worker_pool_is_remote(pool->sweep)) {
            int64_t run;
            memcpy(&run, packet.bytes, sizeof run);
            pool->ended = pool->ended || run == END_OF_RUNS;
            pool->returned[pool->returned_count] = run;
            pool->returned_count += run != END_OF_RUNS;
            continue;
        }
        // A request is shorter than a result.
        good = packet.len < sizeof(ResultPacket) || store_result(pool, (const void *)packet.bytes);
        int64_t run = next_run(pool);
        if (run >= 0)
            pool->channel->send(from, &run, sizeof run);
    }
    return good;
}

// Handles the end of a worker, and ends it if only its pipe has failed. Its current run gets a row with the cause as
// its error. After the first SIGKILL, which the kernel sends if the machine is out of memory, the run is repeated
// instead. Returns false after a message.
static bool reap_worker(WorkerPool *pool, PoolWorker *worker) {
    kill(worker->pid, SIGKILL); // has no effect on a worker that has closed its pipe, because it is exiting
    int status = subprocess_wait_for(worker->pid);
    close(worker->run_pipe);
    close(worker->result_pipe);
    worker->pid = -1;
    for (int i = worker->count - 1; i > 0; i--)
        pool->returned[pool->returned_count++] = worker->assigned[i];
    Result *result = worker->count > 0 ? &pool->sweep->results[worker->assigned[0]] : NULL;
    if (result && WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL && !result->killed) {
        result->killed = true;
        pool->returned[pool->returned_count++] = worker->assigned[0];
        return true;
    }
    SCOPED_TEXT error = {0}, row = {0}, packet = {0};
    if (WIFSIGNALED(status))
        text_add_format(&error, "crashed: signal %d (%s)", WTERMSIG(status), strsignal(WTERMSIG(status)));
    else
        text_add_format(&error, "the process ended with status %d", WEXITSTATUS(status));
    row_add_failure(pool->sweep, 0, error.bytes, &row);
    ResultPacket head = {.run = worker->assigned[0], .frames = 1};
    return !result || store_result(pool, result_pack(&head, text_str(&row), (Str){0}, &packet));
}

// Waits for results and messages and handles them. Returns false, after a message, if the sweep cannot continue.
static bool poll_workers(WorkerPool *pool) {
    struct pollfd *waits = memory_calloc((size_t)pool->jobs * sizeof *waits);
    bool good = true;
    for (int64_t i = 0; i < pool->jobs; i++) {
        waits[i] =
            (struct pollfd){.fd = pool->workers[i].pid > 0 ? pool->workers[i].result_pipe : -1, .events = POLLIN};
    }
    int timeout = pool->channel ? MESSAGE_POLL_MS : pool->progress.enabled ? REDRAW : -1;
    int ready = poll(waits, (nfds_t)pool->jobs, timeout);
    for (int64_t i = 0; good && ready > 0 && i < pool->jobs; i++) {
        bool gone = false;
        if (waits[i].revents != 0)
            good = read_result(pool, &pool->workers[i], &gone);
        if (good && gone)
            good = reap_worker(pool, &pool->workers[i]) && start_worker(pool, &pool->workers[i]);
    }
    free(waits);
    return good && receive_messages(pool);
}

// On ranks other than 0, requests as many runs from rank 0 as the workers can hold.
static void request_runs(const WorkerPool *pool) {
    for (int64_t i = 0; worker_pool_is_remote(pool->sweep) && i < pool->jobs * RUNS_PER_WORKER; i++)
        pool->channel->send(0, "", 1);
}

// On rank 0, informs the other ranks that all runs are done.
static void announce_end(const WorkerPool *pool) {
    for (int rank = 1; pool->channel && pool->channel->rank == 0 && rank < pool->channel->count; rank++)
        pool->channel->send(rank, &END_OF_RUNS, sizeof END_OF_RUNS);
}

static void stop_workers(WorkerPool *pool) {
    for (int64_t i = 0; i < pool->jobs; i++) {
        PoolWorker *worker = &pool->workers[i];
        if (worker->pid > 0) {
            close(worker->run_pipe);
            kill(worker->pid, SIGKILL);
            waitpid(worker->pid, NULL, 0);
            close(worker->result_pipe);
        }
    }
}

static bool has_work(const WorkerPool *pool) {
    return worker_pool_is_remote(pool->sweep) ? !pool->ended : pool->done < pool->wanted;
}

int worker_pool_run(Sweep *sweep, Journal *journal, int64_t jobs) {
    WorkerPool pool = {.sweep = sweep, .journal = journal, .channel = sweep->host->channel};
    pool.wanted = (int64_t)sweep_count_runs(sweep, sweep_wants_run);
    pool.jobs = jobs < pool.wanted || worker_pool_is_remote(sweep) ? jobs : pool.wanted;
    pool.workers = memory_calloc((size_t)pool.jobs * sizeof *pool.workers);
    pool.returned = memory_calloc((size_t)pool.jobs * (2 * RUNS_PER_WORKER + 1) * sizeof *pool.returned);
    worker_catch_signals();
    bool good = true;
    for (int64_t i = 0; good && i < pool.jobs; i++)
        good = start_worker(&pool, &pool.workers[i]);
    progress_start(&pool.progress, sweep->options->verbosity > LOG_QUIET && progress_possible(), pool.wanted);
    pool.progress.things = "runs";
    request_runs(&pool);
    while (good && has_work(&pool) && worker_signal() == 0) {
        assign_runs(&pool);
        good = poll_workers(&pool);
        progress_update(&pool.progress, pool.done);
    }
    bool done = !has_work(&pool);
    if (good && done)
        announce_end(&pool);
    progress_erase(&pool.progress);
    stop_workers(&pool);
    free(pool.workers);
    free(pool.returned);
    return !good ? STATUS_FAILED : done ? STATUS_DONE : STATUS_SIGNAL + worker_signal();
}
