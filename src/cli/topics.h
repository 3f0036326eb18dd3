// topics.h: what there is to say of a word of the language, for `petri help` and `.help` at the prompt.
#ifndef PETRI_SRC_TOPICS_H
#define PETRI_SRC_TOPICS_H

#include "cli/cli.h"
#include "cli/output.h"

// Tells of the built-in function, the node (`!name` means no other), the word or the attribute of this name. False if
// there is none.
bool topics_tell(Output *output, const char *topic);
// Offers all of these names.
void topics_offer(Nearest *nearest);

#endif
