// main.c: the program petri-hdf5, which writes HDF5 files for petri (cli/hdf5.h).
//
// Usage: `petri-hdf5 trajectory|table FILE [NUMBERS]`, with a socket as standard input. NUMBERS is the argument
// `after` of hdf5_start.
#include "base/file.h"
#include "cli/cli.h"
#include "cli/hdf5.h"
#include "hdf5/spool.h"
#include "hdf5/table.h"
#include "hdf5/trajectory.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

static bool receive_block(char **block, Hdf5Head *head) {
    if (!file_read_bytes(STDIN_FILENO, head, sizeof *head))
        return false;
    *block = memory_realloc(*block, head->bytes + 1);
    return file_read_bytes(STDIN_FILENO, *block, head->bytes);
}

// Sends a byte to petri. MSG_NOSIGNAL prevents SIGPIPE if petri has already exited.
static void acknowledge(void) {
    send(STDIN_FILENO, "!", 1, MSG_NOSIGNAL);
}

// The position at which a run with --state resumes a trajectory; see hdf5_start.
typedef struct Resumed {
    Spool *spool;
    int64_t after;    // number of the frame to resume after; -1: none
    int64_t expected; // number of the last frame that the file should contain
} Resumed;

static bool resume_trajectory(TrajectoryFile *file, Store *store, const Resumed *from) {
    Hdf5Head head;
    char *block = NULL;
    if (!store->existing) {
        trajectory_file_begin(file, store);
    } else if (!trajectory_file_resume(file, store, from->after)) {
        message("cannot continue %s: %s", store->path, TRAJECTORY_FILE_UNKNOWN);
        return false;
    }
    while (!store->failed && spool_next(from->spool, from->after, &head, &block))
        if (head.command == HDF5_ADD)
            trajectory_file_add(file, block);
        else
            trajectory_file_begin_run(file);
    free(block);
    trajectory_file_begin_run(file);
    if ((store->existing || from->spool->has_frames) && file->last < from->expected) {
        message("frames %" PRId64 " to %" PRId64 " are missing in %s, which continues with frame %" PRId64,
                file->last + 1, from->after, store->path, from->after + 1);
    }
    return spool_add(from->spool, &(Hdf5Head){HDF5_NEW_RUN, 0}, "");
}

// Receives and handles one block. Returns false at the end of the trajectory or after an error.
static bool handle_block(TrajectoryFile *file, Spool *spool, Hdf5Head *head, char **block) {
    if (!receive_block(block, head) || (head->command != HDF5_ADD && head->command != HDF5_SYNC))
        return false;
    bool good = true;
    if (head->command == HDF5_SYNC)
        good = !spool || spool_save(spool, file->store->replacement.folder);
    else if (spool)
        good = spool_add(spool, head, *block);
    if (head->command == HDF5_ADD)
        trajectory_file_add(file, *block);
    else if (good && !file->store->failed)
        acknowledge();
    if (!good)
        file->store->reported = file->store->failed = true;
    return !file->store->failed;
}

static bool write_trajectory(Store *store, Spool *spool, const Resumed *from) {
    TrajectoryFile file;
    Hdf5Head head = {0};
    char *block = NULL;
    bool begun = true;
    if (!spool) {
        trajectory_file_begin(&file, store);
    } else if (!resume_trajectory(&file, store, from)) {
        store->reported = store->failed = true;
        begun = false;
    }
    if (begun)
        acknowledge();
    while (begun && handle_block(&file, spool, &head, &block)) {
    }
    trajectory_file_end(&file);
    free(block);
    return head.command == HDF5_COMMIT || (head.command != HDF5_DISCARD && file.last >= 0);
}

static bool write_table(Store *store) {
    Hdf5Head head = {0};
    char *block = NULL;
    bool whole = receive_block(&block, &head) && head.command == HDF5_ADD;
    if (whole) {
        table_store(store, block, head.bytes);
        whole = receive_block(&block, &head) && head.command == HDF5_COMMIT;
    }
    free(block);
    return whole;
}

static bool run_trajectory(const char *path, const char *numbers) {
    Store store;
    Spool spool;
    Resumed from = {.after = -1, .expected = -1};
    bool resumable = numbers;
    if (resumable && (sscanf(numbers, "%" SCNd64 " %" SCNd64, &from.after, &from.expected) != 2 ||
                      !spool_open(&spool, path, from.after < 0)))
        return false;
    from.spool = &spool;
    if (!store_begin(&store, path, resumable && !spool.complete)) {
        if (resumable)
            spool_close(&spool, false);
        return false;
    }
    bool keep = write_trajectory(&store, resumable ? &spool : NULL, &from), good = store_end(&store, keep);
    if (resumable)
        spool_close(&spool, good && keep);
    return good;
}

static bool run_table(const char *path) {
    Store store;
    if (!store_begin(&store, path, false))
        return false;
    acknowledge();
    bool keep = write_table(&store);
    return store_end(&store, keep);
}

int main(int argc, char **argv) {
    bool is_table = argc == 3 && strcmp(argv[1], "table") == 0;
    if (!is_table && !((argc == 3 || argc == 4) && strcmp(argv[1], "trajectory") == 0)) {
        message("petri-hdf5 is started by petri run and petri sweep; it cannot be used alone");
        return STATUS_USAGE;
    }
    bool good = is_table ? run_table(argv[2]) : run_trajectory(argv[2], argv[3]);
    // _exit, because libhdf5's exit handlers would retry failed writes.
    _exit(good ? STATUS_DONE : STATUS_FAILED);
}
