// worker.h: worker processes. Each runs one script through petri.h and measures it on request.
//
// Each variant of a workload (threads, build) has a separate worker, so variants can take turns and peak memory is that
// of one script. A worker is the bench executable with the argument `worker`. It communicates with the parent by lines
// of text.
#pragma once

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

// Measurements of one frame, as means over the frames of a round. Times are in seconds.
typedef struct Sample {
    double frame; // time of the whole petri_step call
    double evaluation;
    double physics;
    double output;    // time to write the last frame's state as text; 0: not requested
    double steps;     // number of simulation steps
    double cpu_share; // fraction of the time in which the script's thread had a processor
    double allocations;
    double load; // time of petri_load, measured once per worker
    double base; // bytes of memory in use before the session was opened
    double peak; // peak bytes of memory in use until the last frame, before text is written
} Sample;

typedef struct Worker {
    pid_t process;
    FILE *to;
    FILE *from;
} Worker;

// Starts a worker. This function and the following ones exit the program with a message if the worker fails.
Worker worker_start(const char *executable, const char *script, int threads, double fps);
// Runs frames and returns their measurements.
Sample worker_run(Worker *worker, int frames, bool with_output);
void worker_stop(Worker *worker);

// Main function of a worker: `bench worker SCRIPT THREADS FPS`. Returns the exit status.
int worker_main(int argc, char **argv);

// Returns the monotonic time in seconds.
double clock_now(void);
// Returns the processor time of this thread in seconds.
double clock_thread(void);
