// digest.c: the time of petri_digest relative to that of a frame. `bench_digest SCRIPT FRAMES THREADS` prints medians.
#include "petri-inspect.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { WARM_UP = 20 }; // unmeasured frames, which fill caches and neighbour lists

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, long count) {
    qsort(values, (size_t)count, sizeof *values, by_value);
    return values[count / 2];
}

// Measures frames and the digest after each. Returns false if a frame fails.
static bool measure(PetriSession *session, long count, double *frames, double *digests) {
    uint8_t digest[16];
    bool good = true;
    for (long i = -WARM_UP; good && i < count; i++) {
        double begin = now();
        good = petri_step(session) == PETRI_OK;
        double middle = now();
        good = good && petri_digest(session, digest) == PETRI_OK;
        if (i >= 0) {
            frames[i] = middle - begin;
            digests[i] = now() - middle;
        }
    }
    return good;
}

int main(int argc, char **argv) {
    PetriOptions options = petri_default_options();
    long count = argc == 4 ? strtol(argv[2], NULL, 10) : 0;
    if (count < 1) {
        fputs("usage: bench_digest SCRIPT FRAMES THREADS\n", stderr);
        return 2;
    }
    options.threads = (int)strtol(argv[3], NULL, 10);
    options.memory_limit = (size_t)8 << 30;
    options.work_limit = (uint64_t)100 << 30;
    PetriSession *session = petri_open(&options);
    double *frames = calloc((size_t)count, sizeof *frames), *digests = calloc((size_t)count, sizeof *digests);
    bool good = session && frames && digests && petri_load(session, argv[1]) == PETRI_OK &&
                measure(session, count, frames, digests);
    if (good) {
        double frame = median(frames, count), digest = median(digests, count);
        printf("frame %.1f us, digest %.2f us, %.2f %%\n", 1e6 * frame, 1e6 * digest, 100 * digest / frame);
    }
    free(frames);
    free(digests);
    petri_close(&session);
    return !good;
}
