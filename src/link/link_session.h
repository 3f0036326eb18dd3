// link_session.h: running a script as a link has it: it has no files, and what it asks for is noted.
#ifndef PETRI_SRC_LINK_SESSION_H
#define PETRI_SRC_LINK_SESSION_H

#include "link/pack.h"
#include "petri-draw.h"
#include "run/frames.h"

typedef struct LinkSession {
    Linked linked;
    Frames frames;
    TextList requested_files; // the files that the script has asked for
    PetriPainter *painter;    // that has the pictures of the frames before the last, if that depends on them; or NULL
} LinkSession;

// Opens a session, loads the text and makes frames up to the link's with its changes of parameters. Returns
// OPTIONS_READ, or the status to exit with after a message; link_session_close is due in any case.
int link_session_run(LinkSession *link_session, const CommandContext *context, Options *options);
// The hash of the state, to be freed.
char *link_session_hash(const LinkSession *link_session);
// Tells what files were asked for: `before`, their names, `behind`. False if there were none.
bool link_session_print_files(const LinkSession *link_session, const char *prefix, const char *suffix);
void link_session_close(LinkSession *link_session);

#endif
