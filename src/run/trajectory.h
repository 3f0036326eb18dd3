// trajectory.h: the file of `petri run --trajectory`: where all particles were, frame by frame.
#ifndef PETRI_SRC_TRAJECTORY_H
#define PETRI_SRC_TRAJECTORY_H

#include <stdint.h>

#include "base/replace.h"
#include "cli/output.h"
#include "petri.h"
#include "run/h5md.h"

typedef enum TrajectoryFormat { TRAJECTORY_XYZ, TRAJECTORY_CSV, TRAJECTORY_H5MD } TrajectoryFormat;

// It takes its name when it is complete (base/replace.h).
typedef struct Trajectory {
    const char *path;
    TrajectoryFormat format;
    bool open;
    Replacement file;
    int unfinished;      // its number there
    size_t whole;        // bytes up to the last frame's end
    uint32_t dimensions; // of a CSV's columns: the most that a system of the first frame has
    bool failed;         // told already
    H5md h5md;           // instead of `file`, `unfinished`
    Output output;
} Trajectory;

// A file whose name ends in .xyz, .csv, .h5 or .h5md. False after a message if the file cannot be made.
bool trajectory_open(Trajectory *trajectory, const char *path);
// Adds the last frame of a session. If it cannot be written there is a message, and `failed` is set.
void trajectory_add(Trajectory *trajectory, PetriSession *session);
// Puts the file in its place, as does a signal that ends the process at once, with the frames that are whole. False
// after a message if that or an earlier writing failed; the old file is then untouched, and if no frame is whole in a
// run that was not good.
bool trajectory_close(Trajectory *trajectory, bool good);

#endif
