// link_session.h: runs the script of a link, and records the files that it reads.
#pragma once

#include "cli/shader_test.h"
#include "link/pack.h"
#include "petri-draw.h"
#include "run/frames.h"

// A file that a script has read.
typedef struct LinkedFile {
    char *name; // relative to the script's folder
    Text bytes;
} LinkedFile;

typedef struct LinkSession {
    Linked linked;
    char *folder;      // folder of the script, whose files the script may read; NULL: it may read no files
    LinkedFile *files; // files that the script has read
    Frames frames;
    size_t file_count;
    TextList requested_files; // files that the script tried to read but may not
    PetriPainter *painter;    // has the earlier pictures on which later ones depend; NULL: not needed yet
} LinkSession;

extern ShaderTester link_shader_tester; // for painters of links

// Adds the parameters that the link sets before the first frame, as NAME=VALUE.
void link_define_parameters(const Linked *linked, TextList *definitions);
// Sets the parameters that the link changes after this frame. Returns false after a message if the script does not
// accept one.
bool link_change_parameters(const Linked *linked, PetriSession *session, int64_t frame);

// Opens a session without access to files, except those below `folder`, loads the script and computes the frames up to
// the frame of the link, with the changes of parameters in the link. Returns OPTIONS_READ, or an exit status after a
// message. The caller calls link_session_close even after a failure.
int link_session_run(LinkSession *link_session, const CommandContext *context, Options *options);
// Returns the digest of the state (PETRI_PRINT_DIGEST) or its hash (PETRI_PRINT_HASH) in hexadecimal. The caller frees
// it.
char *link_session_digest(const LinkSession *link_session, unsigned section);
// Prints a message with the names of the requested files between prefix and suffix. Returns false, without
// a message, if there are none.
bool link_session_print_files(const LinkSession *link_session, const char *prefix, const char *suffix);
void link_session_close(LinkSession *link_session);
