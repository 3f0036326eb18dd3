// linking.h: running a script as a link has it: it has no files, and what it asks for is noted.
#ifndef PETRI_SRC_LINKING_H
#define PETRI_SRC_LINKING_H

#include "link/pack.h"
#include "petri-draw.h"
#include "run/frames.h"

typedef struct Linking {
    Linked linked;
    Frames frames;
    TextList wanted;       // the files that the script has asked for
    PetriPainter *painter; // that has the pictures of the frames before the last, if that depends on them; or NULL
} Linking;

// Opens a session, loads the text and makes frames up to the link's with its changes of parameters. Returns
// OPTIONS_READ, or the status to exit with after a message; linking_close is due in any case.
int linking_run(Linking *linking, const Host *host, Options *options);
// The hash of the state, to be freed.
char *linking_hash(const Linking *linking);
// Tells what files were asked for: `before`, their names, `behind`. False if there were none.
bool linking_tell(const Linking *linking, const char *before, const char *behind);
void linking_close(Linking *linking);

#endif
