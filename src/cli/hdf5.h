// hdf5.h: HDF5 output through petri-hdf5, the only program that links libhdf5.
//
// petri sends the data through a socket. If a signal terminates petri, petri-hdf5 detects the end of the stream and
// finishes the file, so the file is always valid.
#pragma once

#include "base/str.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

// Error text for an existing trajectory file that a run cannot continue.
#define TRAJECTORY_FILE_UNKNOWN "it was not written by '--trajectory'; remove it or choose another name"

// A running petri-hdf5.
typedef struct Hdf5 {
    pid_t process;  // -1: not started
    int stream;     // socket; -1: none
    int cleanup_id; // number from signal_cleanup_begin
    bool killed;    // true if it did not respond after a signal and was killed
    int (*pending_signal)(void);
} Hdf5;

// Starts petri-hdf5. Returns false after a message. `kind` selects what the caller writes to the stream. "trajectory":
// any number of Hdf5Head, each followed by its data. "table": one HDF5_ADD with the data of hdf5_table, then
// HDF5_COMMIT. If `after` is not NULL, the trajectory survives a crash of petri and petri-hdf5 and can be resumed.
// `after` then has the form "FRAME LAST". FRAME is the frame after which the run resumes (-1: none). LAST is the last
// frame that an existing file should contain. `pending_signal` returns the number of a signal that has been caught, or
// 0. NULL: signals are not caught. After a signal, petri-hdf5 is continued if it is stopped. It is killed if it then
// does nothing for some seconds, so that petri does not wait for it forever.
bool hdf5_start(Hdf5 *writer, const char *kind, const char *path, const char *after, int (*pending_signal)(void));
// Sends bytes to the Hdf5 that `writer` points to. On failure returns false with errno set. An OutputSend.
bool hdf5_write(void *writer, const char *bytes, size_t length);
// Waits until petri-hdf5 answers an HDF5_SYNC. All data that was sent before the HDF5_SYNC is then on disk. On failure,
// returns false after a message from petri-hdf5.
bool hdf5_wait(Hdf5 *writer);
// Writes a whole table. `cells` (cli/cells.h) has the number of columns and how many of them after the first are
// parameters, the name and kind of each column, then the rows. A column is stored as int64, double or string. Cells
// without contents are NaN or an empty string. A text in a column of numbers makes the whole column strings. Returns
// false after a message.
bool hdf5_table(const char *path, Str cells, int (*pending_signal)(void));
// Returns true if the file name ends in .h5 or .hdf5. A table is then written as HDF5.
bool hdf5_has_suffix(const char *path);
// Closes the stream and waits until the file has its final name. Returns false if petri-hdf5 was not started, or
// if it failed; a message was then printed.
bool hdf5_end(Hdf5 *writer);

// Format of the stream. Both programs are built together, so it has no version and uses native byte order.

typedef enum Hdf5Command {
    HDF5_ADD = 1, // followed by `bytes` bytes of data
    HDF5_COMMIT,  // the file is complete; the end of the stream means the same if data was added
    HDF5_DISCARD, // discard the file
    HDF5_SYNC,    // write all data sent so far to disk; petri-hdf5 then answers with one byte
    HDF5_NEW_RUN, // only in a spool (hdf5/spool.h): the following data comes from another run
} Hdf5Command;

typedef struct Hdf5Head {
    uint64_t command; // Hdf5Command
    uint64_t bytes;
} Hdf5Head;

// Header of a frame. It is followed by NUL-terminated strings, and then by the systems. The strings are the particle
// ids that are not integers >= 0 and did not occur in an earlier frame of the run. After the last string, NULs pad the
// strings to a multiple of eight bytes.
typedef struct Hdf5Frame {
    int64_t number;
    double time;
    uint64_t text_bytes;
    uint64_t text_count;
    uint64_t system_count;
} Hdf5Frame;

// Header of a system. It is followed by the name of the system, padded like the strings of a frame, and by one array
// for each quantity. Positions, velocities, radii, masses and charges are double; ids and anchor flags are int64_t. An
// id of -2-K means string K. Strings are numbered from 0 over all frames of the run.
typedef struct Hdf5System {
    uint64_t particles;
    uint64_t dimensions;
    uint64_t name_bytes;
    double kinetic_energy; // NaN: the run does not record energies
    double potential_energy;
} Hdf5System;

enum { HDF5_NUMBERS = 5 }; // eight-byte values per particle besides position and velocity

// Returns the padded size of a string of this length. The padding has at least one NUL byte.
static inline size_t hdf5_padded(size_t length) {
    return (length + 8) / 8 * 8;
}
