// archive.h: archives that commands write (--archive).
#pragma once

#include "cli/options.h"
#include "petri-archive.h"

// An archive that is being written.
typedef struct Archiving {
    PetriArchive *archive; // NULL: none
    const char *name;
    bool failed; // true after the message that recording has stopped
} Archiving;

// Begins to record a session if --archive was given. Must be called before the script is loaded. Returns false after a
// message.
bool archiving_begin(Archiving *archiving, const Options *options, const char *command, PetriSession *session);
// Prints a message if recording has stopped since the last call; the run continues.
void archiving_check(Archiving *archiving);
// Completes the archive. Must be called before the session is closed. Returns false if the archive is incomplete.
bool archiving_end(Archiving *archiving);
