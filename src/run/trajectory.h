// trajectory.h: the file of `petri run --trajectory`: where all particles were, frame by frame.
#ifndef PETRI_SRC_TRAJECTORY_H
#define PETRI_SRC_TRAJECTORY_H

#include "base/replace.h"
#include "cli/output.h"
#include "petri.h"
#include "run/h5md.h"
#include "run/resume.h"

#include <stdint.h>

typedef enum TrajectoryFormat { TRAJECTORY_XYZ, TRAJECTORY_CSV, TRAJECTORY_H5MD } TrajectoryFormat;

// It takes its name when it is complete (base/replace.h), or when a state is saved first, and is then lengthened where
// it lies (resume.h).
typedef struct Trajectory {
    const char *path;
    TrajectoryFormat format;
    bool open;
    bool resumable;
    bool named; // `output` writes to the file that has the name
    Replacement file;
    int cleanup_id;        // its number there
    size_t complete_bytes; // bytes up to the last frame's end
    size_t flushed_bytes;  // … and up to the last that was whole when all was written
    uint32_t dimensions;   // of a CSV's columns: the most that a system of the first frame has
    bool failed;           // told already
    H5md h5md;             // instead of `file`, `unfinished`
    Output output;
} Trajectory;

// A file whose name ends in .xyz, .csv, .h5 or .h5md. False after a message if the file cannot be made or gone on with.
bool trajectory_open(Trajectory *trajectory, const char *path, const Resume *resume);
// Adds the last frame of a session. If it cannot be written there is a message, and `failed` is set.
void trajectory_add(Trajectory *trajectory, PetriSession *session);
// To be called before a state is saved, which is not to be done after false: brings all frames to the disk, so that a
// run can go on from that state whatever happens. `trajectory` is a Trajectory.
bool trajectory_sync(void *trajectory);
// Puts the file in its place, as does a signal that ends the process at once, with the frames that are whole. False
// after a message if that or an earlier writing failed; the old file is then untouched, and if no frame is whole in a
// run that was not good.
bool trajectory_close(Trajectory *trajectory, bool good);

#endif
