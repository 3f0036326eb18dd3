// hdf5.h: files in HDF5: what is to stand in them goes down a stream to petri-hdf5, which alone takes libhdf5.
//
// So no signal that ends petri can harm a file: petri-hdf5 ends with the stream, and keeps what is whole.
#ifndef PETRI_SRC_HDF5_H
#define PETRI_SRC_HDF5_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

// Of a trajectory that a run cannot go on with.
#define TRAJECTORY_FILE_UNKNOWN                                                                                        \
    "it is not what --trajectory writes; remove it, or give another name, and a new one begins"

typedef struct Hdf5 {
    pid_t process;
    int stream;
    int cleanup_id; // its number there
} Hdf5;

// Starts petri-hdf5 on a file of a kind: "trajectory" takes a stream of Hdf5Head with what it counts, "table" CSV
// behind one, and then another. `after` is NULL, or the number of the frame from which a trajectory is gone on with, -1
// for one that begins, and that of the last one that the file should have: it is then kept safe from whatever ends the
// two programs. False after a message.
bool hdf5_start(Hdf5 *writer, const char *kind, const char *path, const char *after);
// Waits until what was sent, HDF5_SYNC at last, is on the disk. False if that failed, which petri-hdf5 has told.
bool hdf5_wait(Hdf5 *writer);
// A table as a whole. False after a message.
bool hdf5_table(const char *path, const char *csv, size_t length);
// Whether a table is to be in HDF5, by its name.
bool hdf5_has_suffix(const char *path);
// Waits until the file has taken its name. False if there is none, which petri-hdf5 has told if it is its fault.
bool hdf5_end(Hdf5 *writer);

// What follows is the layout of the stream, of two programs that are built together.

typedef enum Hdf5Command {
    HDF5_ADD = 1, // `bytes` follow
    HDF5_COMMIT,  // the file is complete; it is also kept if the stream ends after something was added
    HDF5_DISCARD, // it is not to be
    HDF5_SYNC,    // what there is so far must be on the disk; answered by a byte
    HDF5_NEW_RUN, // in a spool (hdf5/spool.h): what follows comes from another run
} Hdf5Command;

typedef struct Hdf5Head {
    uint64_t command;
    uint64_t bytes;
} Hdf5Head;

// A frame. Its ids that are new and no whole numbers from 0 follow, each ended by NUL, then the systems. All texts are
// filled up with NULs to eight bytes.
typedef struct Hdf5Frame {
    int64_t number;
    double time;
    uint64_t text_bytes;
    uint64_t text_count;
    uint64_t system_count;
} Hdf5Frame;

// A system. Its name follows, then of all particles: positions, velocities, radii, masses and charges as doubles; ids
// as int64_t, -2-K for text K of all frames; whether it is an anchor as int64_t.
typedef struct Hdf5System {
    uint64_t particles;
    uint64_t dimensions;
    uint64_t name_bytes;
} Hdf5System;

enum { HDF5_NUMBERS = 5 }; // of a particle besides those of position and velocity, all of eight bytes

static inline size_t hdf5_padded(size_t length) {
    return (length + 8) / 8 * 8; // at least one NUL
}

#endif
