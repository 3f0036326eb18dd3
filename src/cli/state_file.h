// state_file.h: the file of `--state`, for commands that load and save it.
//
// A file that cannot be read is never overwritten, because it may be the only copy of a state. Failed writes are
// retried. The first failure is reported, and so is the next success.
#pragma once

#include "petri.h"

#include <stdbool.h>

typedef struct StateFile {
    const char *name;    // NULL: no state file
    bool unreadable;     // true if the file could not be read, so it is not written
    bool outdated;       // true if the last attempt to save the state failed
    double last_attempt; // time of the last attempt, in seconds of the monotonic clock
    // Writes data that must be on disk before the state is saved. Returns false after a message; the state is then not
    // saved. NULL: there is no such data.
    bool (*before)(void *context);
    void *context; // passed to `before`
} StateFile;

// Loads the state. Returns false after a message if the file exists but cannot be read.
bool state_file_restore(StateFile *file, PetriSession *session, const char *name);
// Saves the state, unless it was saved in the last few seconds and `at_once` is false. Returns a message for the user
// if saving has started to fail or works again, else NULL.
const char *state_file_save(StateFile *file, PetriSession *session, bool at_once);
// Returns true if the file does not contain the last state. In this case, the command fails.
static inline bool state_file_failed(const StateFile *file) {
    return file->unreadable || file->outdated;
}
