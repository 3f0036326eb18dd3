// state_file.h: the file of `--state`, for the commands that go on from it and keep it.
//
// A file that could not be read is left alone: it may be all that is left of something. One that could not be written
// is tried again; that is said once, and once more when it works again.
#ifndef PETRI_SRC_STATE_FILE_H
#define PETRI_SRC_STATE_FILE_H

#include "petri.h"

#include <stdbool.h>

typedef struct StateFile {
    const char *name;    // NULL: none is kept
    bool unreadable;     // it could not be read, and is not written
    bool outdated;       // the last state is not in it
    double last_attempt; // when it was tried last, in seconds of the monotonic clock
    // What must be on the disk before a state is; after false none is saved. May be NULL.
    bool (*before)(void *context);
    void *context;
} StateFile;

// False, after a message, if there is a file that cannot be read.
bool state_file_restore(StateFile *file, PetriSession *session, const char *name);
// NULL, or what is to be told beside the session's diagnostics. Not within a few seconds, unless that is asked for.
const char *state_file_save(StateFile *file, PetriSession *session, bool at_once);
// Whether what the user has asked for is not so: for the exit status.
static inline bool state_file_failed(const StateFile *file) {
    return file->unreadable || file->outdated;
}

#endif
