// topics.h: what there is to say of a word of the language, for `petri help` and `.help` at the prompt.
#ifndef PETRI_SRC_TOPICS_H
#define PETRI_SRC_TOPICS_H

#include "cli/output.h"

// Tells of the built-in function, the node (`!name` means no other), the word or the attribute of this name. False if
// there is none.
bool topics_tell(Output *output, const char *topic);
// The name that is nearest, or NULL; `best` as with is_nearer.
const char *topics_nearest(const char *topic, size_t *best);

#endif
