// archive.h: archives that commands write (--archive), or replay instead of a script.
#pragma once

#include "cli/options.h"
#include "petri-archive.h"

// An archive that is being written.
typedef struct Archiving {
    PetriArchive *archive; // NULL: none
    char *name;
    bool failed; // true after the message that recording has stopped
} Archiving;

// Begins to record a session if --archive was given. Must be called before the script is loaded. Returns false after a
// message.
bool archiving_begin(Archiving *archiving, const Options *options, const char *command, PetriSession *session);
// Begins to record a session in a file. Returns false after a message.
bool archiving_start(Archiving *archiving, const char *file, const Options *options, const char *command,
                     PetriSession *session);
// Prints a message if recording has stopped since the last call; the run continues.
void archiving_check(Archiving *archiving);
// Completes the archive. Must be called before the session is closed. Returns false if the archive is incomplete.
bool archiving_end(Archiving *archiving);

// If the script is an archive, opens it and sets the options for its replay. Returns OPTIONS_READ, or an exit status
// after a message.
int replay_open(Options *options, const Command *command);
// Loads the archive and computes the frames before the first frame that was requested.
PetriStatus replay_load(const Options *options, PetriSession *session);
// Checks the script of the archive, as petri_check does.
PetriStatus replay_check(const Options *options, PetriSession *session);
// Opens an archive. Its files and texts may take half of the memory limit, because the session that replays it also has
// a limit. Returns NULL if out of memory; archive_report_problem prints other problems.
PetriArchive *replay_archive(const Options *options, const char *file);
// Prints the problem of an archive, if there is one. Returns true if there is one.
bool archive_report_problem(const PetriArchive *archive, const char *file);
