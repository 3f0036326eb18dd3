// worker.c: see worker.h.
#include "worker.h"

#include "allocations.h"
#include "petri-inspect.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double clock_read(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

double clock_now(void) {
    return clock_read(CLOCK_MONOTONIC);
}

double clock_thread(void) {
    return clock_read(CLOCK_THREAD_CPUTIME_ID);
}

static void exit_with_error(const char *what) {
    fprintf(stderr, "bench: %s: %s\n", what, strerror(errno));
    exit(1);
}

// ---- in the worker

static void show_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    (void)host;
    fputs(diagnostic->rendered, stderr);
}

static bool count_bytes(void *host, const char *text, size_t length) {
    (void)text;
    *(uint64_t *)host += length;
    return true;
}

// Returns a memory figure of this process, such as VmHWM, in bytes. Unlike getrusage's maximum, it does not include the
// memory of the parent process.
static double memory_figure(const char *name) {
    FILE *file = fopen("/proc/self/status", "r");
    char line[256];
    double bytes = 0;
    size_t length = strlen(name);
    while (file && fgets(line, sizeof line, file))
        if (!strncmp(line, name, length) && line[length] == ':')
            bytes = strtod(line + length + 1, NULL) * 1024;
    if (file)
        fclose(file);
    return bytes;
}

static bool run_frames(PetriSession *session, int frames, Sample *sum) {
    double start = clock_now(), mine = clock_thread();
    for (int i = 0; i < frames; i++) {
        uint64_t before = allocations_so_far();
        double begin = clock_now();
        if (petri_step(session) != PETRI_OK) {
            fputs("bench: the script exceeded a limit\n", stderr);
            return false;
        }
        sum->frame += clock_now() - begin;
        sum->allocations += (double)(allocations_so_far() - before);
        PetriFrame frame;
        petri_frame(session, &frame, sizeof frame);
        sum->evaluation += frame.evaluation_seconds;
        sum->physics += frame.physics_seconds;
        sum->steps += (double)frame.physics_steps;
    }
    sum->cpu_share = (clock_thread() - mine) / (clock_now() - start);
    sum->frame /= frames;
    sum->allocations /= frames;
    sum->evaluation /= frames;
    sum->physics /= frames;
    sum->steps /= frames;
    return true;
}

// Returns the seconds for writing the state once, as the mean over 5 ms.
static double time_output(PetriSession *session) {
    double begin = clock_now(), spent;
    int times = 0;
    uint64_t bytes = 0;
    do {
        petri_print(session, PETRI_PRINT_STATE, count_bytes, &bytes);
        times++;
    } while ((spent = clock_now() - begin) < 0.005);
    return spent / times;
}

static int serve_commands(PetriSession *session, double base, double load) {
    int frames, with_output;
    while (scanf("%d %d", &frames, &with_output) == 2) {
        Sample s = {.base = base, .load = load};
        if (!run_frames(session, frames, &s))
            return 1;
        s.peak = memory_figure("VmHWM");
        if (with_output)
            s.output = time_output(session);
        printf("%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", s.frame, s.evaluation, s.physics, s.output,
               s.steps, s.cpu_share, s.allocations, s.load, s.base, s.peak);
        fflush(stdout);
    }
    return 0;
}

int worker_main(int argc, char **argv) {
    if (argc != 3)
        return 2;
    PetriOptions options = petri_default_options();
    options.threads = atoi(argv[1]);
    options.fps = strtod(argv[2], NULL);
    options.on_diagnostic = show_diagnostic;
    double base = memory_figure("VmRSS");
    PetriSession *session = petri_open(&options);
    double begin = clock_now();
    if (!session || petri_load(session, argv[0]) != PETRI_OK)
        return 1;
    int status = serve_commands(session, base, clock_now() - begin);
    petri_close(&session);
    return status;
}

// ---- in the bench

// Opens a pipe that later workers do not inherit. Otherwise, a worker would not see the end of its input.
static void open_pipe(int ends[2]) {
    if (pipe(ends) || fcntl(ends[0], F_SETFD, FD_CLOEXEC) < 0 || fcntl(ends[1], F_SETFD, FD_CLOEXEC) < 0)
        exit_with_error("cannot communicate with a worker");
}

Worker worker_start(const char *executable, const char *script, int threads, double fps) {
    int down[2], up[2];
    char number[2][32];
    open_pipe(down);
    open_pipe(up);
    snprintf(number[0], sizeof number[0], "%d", threads);
    snprintf(number[1], sizeof number[1], "%g", fps);
    pid_t process = fork();
    if (process < 0)
        exit_with_error("cannot start a worker");
    if (process == 0) {
        dup2(down[0], STDIN_FILENO);
        dup2(up[1], STDOUT_FILENO);
        execl(executable, executable, "worker", script, number[0], number[1], (char *)NULL);
        fprintf(stderr, "bench: cannot start %s: %s\n", executable, strerror(errno));
        _exit(127);
    }
    close(down[0]);
    close(up[1]);
    Worker worker = {.process = process, .to = fdopen(down[1], "w"), .from = fdopen(up[0], "r")};
    if (!worker.to || !worker.from)
        exit_with_error("cannot communicate with a worker");
    return worker;
}

Sample worker_run(Worker *worker, int frames, bool with_output) {
    Sample s;
    fprintf(worker->to, "%d %d\n", frames, with_output);
    fflush(worker->to);
    if (fscanf(worker->from, "%lf %lf %lf %lf %lf %lf %lf %lf %lf %lf", &s.frame, &s.evaluation, &s.physics, &s.output,
               &s.steps, &s.cpu_share, &s.allocations, &s.load, &s.base, &s.peak) != 10) {
        fputs("bench: a worker ended unexpectedly\n", stderr);
        exit(1);
    }
    return s;
}

void worker_stop(Worker *worker) {
    fclose(worker->to);
    fclose(worker->from);
    waitpid(worker->process, NULL, 0);
}
