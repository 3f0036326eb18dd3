// worker.h: worker processes, which run one script through petri.h and measure it on request.
//
// Each variant of a workload (threads, build) has its own worker, so that variants can take turns and the peak memory
// is that of one script. A worker is the bench executable started with the command `worker`. Bench and worker
// communicate by lines of text.
#ifndef TESTS_BENCH_WORKER_H
#define TESTS_BENCH_WORKER_H

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

// Measurements of one frame, averaged over the frames of a round. Times are in seconds.
typedef struct Sample {
    double frame; // all of petri_step
    double evaluation;
    double physics;
    double output;    // writing the last frame's state as text; 0: not requested
    double steps;     // simulation steps
    double cpu_share; // fraction of a processor that the script's thread used
    double allocations;
    double load; // petri_load, once per worker
    double base; // bytes of memory in use before the session was opened
    double peak; // peak bytes of memory in use up to the last frame, before text was written
} Sample;

typedef struct Worker {
    pid_t process;
    FILE *to;
    FILE *from;
} Worker;

// Starts a worker. This and the next functions end the program with a message if the worker fails.
Worker worker_start(const char *executable, const char *script, int threads, double fps);
// Runs frames and returns their measurements.
Sample worker_run(Worker *worker, int frames, bool with_output);
void worker_stop(Worker *worker);

// Main function of a worker: `bench worker SCRIPT THREADS FPS`. Returns the exit status.
int worker_main(int argc, char **argv);

// Returns seconds since a fixed time.
double clock_now(void);
// Returns the processor time of this thread in seconds.
double clock_thread(void);

#endif
