// state_file.h: the file of `--state`, for commands that load and save it.
//
// A file that cannot be read is never overwritten, because it may be the only copy of a state. If writing fails, it is
// retried; the failure is reported once, and so is the next success.
#ifndef PETRI_SRC_STATE_FILE_H
#define PETRI_SRC_STATE_FILE_H

#include "petri.h"

#include <stdbool.h>

typedef struct StateFile {
    const char *name;    // NULL: no state file
    bool unreadable;     // the file could not be read, so it is not written
    bool outdated;       // the last state could not be written
    double last_attempt; // time of the last attempt, in seconds of the monotonic clock
    // Writes data to disk that must be there before the state. If it returns false after a message, the state is not
    // saved. NULL: nothing to write.
    bool (*before)(void *context);
    void *context; // passed to `before`
} StateFile;

// Loads the state. Returns false after a message if the file exists but cannot be read.
bool state_file_restore(StateFile *file, PetriSession *session, const char *name);
// Saves the state, unless it was saved in the last few seconds and `at_once` is false. Returns a message for the user
// if saving has begun to fail or works again, else NULL.
const char *state_file_save(StateFile *file, PetriSession *session, bool at_once);
// Returns true if the file does not contain the last state, which makes the command fail.
static inline bool state_file_failed(const StateFile *file) {
    return file->unreadable || file->outdated;
}

#endif
