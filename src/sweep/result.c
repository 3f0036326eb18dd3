// result.c: the results of a sweep in memory, which every other file of this folder may use (sweep.h).
#include "sweep/sweep.h"

#include <stdio.h>
#include <string.h>

bool sweep_owns_run(const Sweep *sweep, size_t run) {
    return run % sweep->shards == sweep->shard;
}

void sweep_store_result(Sweep *sweep, size_t run, int64_t frames, const char *rows, size_t length) {
    Result *result = &sweep->results[run];
    if (!result->rows) {
        result->rows = memory_strndup(rows, length);
        result->frames = frames;
    }
}

// A run has failed if its last row has an error.
bool sweep_is_failed(const Result *result) {
    size_t length = strlen(result->rows);
    return length > 1 && result->rows[length - 2] != '\t';
}

void sweep_report(Sweep *sweep, PetriLevel level, const char *rendered) {
    enum { MAX_REPORTED = 100 };
    bool wanted = level == PETRI_ERROR || sweep->options->verbosity > LOG_QUIET;
    if (wanted && sweep->reported.count < MAX_REPORTED && !texts_contain(&sweep->reported, rendered)) {
        texts_add(&sweep->reported, rendered);
        fputs(rendered, stderr);
    }
}
