// worker.h: a process that runs one script through petri.h and measures it when told to.
//
// Each variant of a workload (threads, build) has a worker of its own, so that they can take turns round by round, and
// so that peak memory is that of one script. The worker is the bench executable itself, started with the command
// `worker`; the two talk in lines of text.
#ifndef TESTS_BENCH_WORKER_H
#define TESTS_BENCH_WORKER_H

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

// What one frame took, averaged over the frames of a round. Times in seconds.
typedef struct Sample {
    double frame; // all of petri_step
    double evaluation;
    double physics;
    double output;    // writing the last frame's state as text; 0 if not asked for
    double steps;     // of simulation
    double cpu_share; // of a processor that the thread which runs the script had
    double allocations;
    double load; // petri_load, once per worker
    double base; // bytes of memory in use before the session was opened
    double peak; // largest number of bytes in use up to the last frame, text not counted
} Sample;

typedef struct Worker {
    pid_t process;
    FILE *to;
    FILE *from;
} Worker;

// Starts a worker. All of these functions end the program with a message if the worker cannot do its part.
Worker worker_start(const char *executable, const char *script, int threads, double fps);
// Has it run so many frames.
Sample worker_run(Worker *worker, int frames, bool with_output);
void worker_stop(Worker *worker);

// The worker's side: `bench worker SCRIPT THREADS FPS`. Returns the exit status.
int worker_main(int argc, char **argv);

// Seconds from some fixed time.
double clock_now(void);
// Seconds that this thread had a processor.
double clock_thread(void);

#endif
