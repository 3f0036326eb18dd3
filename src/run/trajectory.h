// trajectory.h: the file of `petri run --trajectory`: all particles, frame by frame.
#pragma once

#include "base/replace.h"
#include "cli/output.h"
#include "petri.h"
#include "run/h5md.h"
#include "run/resume.h"
#include "run/xyz.h"

#include <stdint.h>

typedef enum TrajectoryFormat { TRAJECTORY_XYZ, TRAJECTORY_CSV, TRAJECTORY_H5MD } TrajectoryFormat;

// The file gets its final name when it is complete (base/replace.h). With `--state`, it gets its final name when the
// first state is saved, and is then extended in place (resume.h).
typedef struct Trajectory {
    const char *path;
    TrajectoryFormat format;
    bool open;
    bool energies;  // true if the file has the energies of each system
    bool resumable; // true if a later run can continue the file
    bool named;     // true if the file has its final name and is extended in place
    Replacement file;
    int cleanup_id;        // from signal_cleanup_begin
    size_t complete_bytes; // length of the file up to the end of the last complete frame
    size_t flushed_bytes;  // value of complete_bytes at the last flush
    uint32_t dimensions;   // CSV: largest number of dimensions of a system in the first frame; 0: no header yet
    XyzNames names;        // XYZ: numbers of particles and systems
    bool failed;           // true after an error, which has been reported
    H5md h5md;             // used instead of `file` for H5MD
    Output output;
} Trajectory;

// Opens a file whose name ends in .xyz, .csv, .h5 or .h5md. Returns false, after a message, if it cannot be created or
// continued. `energies`: also write the energies of each system; a CSV file that is continued keeps its columns.
bool trajectory_open(Trajectory *trajectory, const char *path, bool energies, const Resume *resume);
// Adds the last frame of a session. On failure, prints a message and sets `failed`.
void trajectory_add(Trajectory *trajectory, PetriSession *session);
// Writes all frames to disk. Must be called before a state is saved, so that a run can continue from that state. If it
// returns false, the state must not be saved. `trajectory` points to a Trajectory.
bool trajectory_sync(void *trajectory);
// Closes the file, which then contains all complete frames. Returns false after a message if this or an earlier write
// failed. An old file of the same name is kept if a write failed. It is also kept if the run failed (`good` is false)
// before its first complete frame.
bool trajectory_close(Trajectory *trajectory, bool good);
