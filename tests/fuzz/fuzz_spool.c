// fuzz_spool.c: fuzzes FILE.h5.part, from which an H5MD trajectory is completed after a crash. If the first byte of the
// input is '#', the rest is the file. Otherwise, the input is a list of frames, separated by a byte 30. They are
// written with valid hashes.
#include "base/hash_index.h"
#include "cli/cli.h"
#include "fuzz.h"
#include "hdf5/spool.h"
#include "hdf5/trajectory.h"

#include <stdlib.h>
#include <string.h>

static void add_block(FuzzText *file, const char *bytes, size_t length) {
    Hdf5Head head = {HDF5_ADD, length};
    uint64_t hash = hash_bytes(head.command, bytes, length);
    fuzz_append(file, (const char *)&head, sizeof head);
    fuzz_append(file, (const char *)&hash, sizeof hash);
    fuzz_append(file, bytes, length);
}

static void read_frames(Spool *spool, Store *store) {
    TrajectoryFile file;
    Hdf5Head head;
    char *block = NULL;
    trajectory_file_begin(&file, store);
    while (!store->failed && spool_next(spool, 1000, &head, &block))
        if (head.command == HDF5_ADD)
            trajectory_file_add(&file, block);
        else
            trajectory_file_begin_run(&file);
    free(block);
    trajectory_file_end(&file);
}

FUZZ_HARNESS(spool) {
    FuzzText file = {0};
    Spool spool;
    Store store;
    fuzz_append(&file, "petri spool 1 creates\n", 22);
    fuzz_put_parts("t.h5.part", &file, data, size, add_block);
    const char *path = fuzz_file("t.h5");
    bool opened = spool_open(&spool, path, false);
    if (opened && store_begin(&store, path, false)) {
        read_frames(&spool, &store);
        store_end(&store, false);
    }
    spool_close(&spool, true);
    return 0;
}
