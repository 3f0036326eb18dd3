// main.c: petri-hdf5, which writes files for petri (cli/hdf5.h): `petri-hdf5 trajectory|table FILE` with a stream on
// its standard input, a socket.
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "cli/cli.h"
#include "cli/hdf5.h"
#include "hdf5/table.h"
#include "hdf5/trajectory.h"

// False if the stream ends before.
static bool receive(void *bytes, size_t length) {
    char *at = bytes;
    while (length > 0) {
        ssize_t count = read(STDIN_FILENO, at, length);
        if (count <= 0 && !(count < 0 && errno == EINTR)) {
            return false;
        }
        at += count < 0 ? 0 : count;
        length -= count < 0 ? 0 : (size_t)count;
    }
    return true;
}

static bool receive_block(char **block, Hdf5Head *head) {
    if (!receive(head, sizeof *head)) {
        return false;
    }
    *block = memory_resized(*block, head->bytes + 1);
    return receive(*block, head->bytes);
}

static bool write_trajectory(Store *store) {
    Way way;
    Hdf5Head head = {0};
    char *block = NULL;
    bool any = false;
    way_begin(&way, store);
    while (!store->failed && receive_block(&block, &head) && head.act == HDF5_ADD) {
        way_add(&way, block);
        any = true;
    }
    way_end(&way);
    free(block);
    return head.act == HDF5_KEEP || (any && head.act == HDF5_ADD);
}

static bool write_table(Store *store) {
    Hdf5Head head = {0};
    char *block = NULL;
    bool whole = receive_block(&block, &head) && head.act == HDF5_ADD;
    if (whole) {
        table_store(store, block, head.bytes);
        whole = receive_block(&block, &head) && head.act == HDF5_KEEP;
    }
    free(block);
    return whole;
}

int main(int argc, char **argv) {
    if (argc != 3 || (strcmp(argv[1], "trajectory") != 0 && strcmp(argv[1], "table") != 0)) {
        message("petri-hdf5 writes files for petri run and petri sweep; it is of no use by itself");
        return STATUS_USAGE;
    }
    Store store;
    if (!store_begin(&store, argv[2])) {
        return STATUS_FAILED;
    }
    // MSG_NOSIGNAL: petri may be gone.
    send(STDIN_FILENO, "!", 1, MSG_NOSIGNAL);
    bool keep = strcmp(argv[1], "table") == 0 ? write_table(&store) : write_trajectory(&store);
    // Without what runs at the end: it would try again to write what could not be written.
    _exit(store_end(&store, keep) ? STATUS_DONE : STATUS_FAILED);
}
