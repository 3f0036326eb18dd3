// details.h: the differences between a run and its archive.
#pragma once

#include "cli/memory.h"
#include "petri-archive.h"

// Computes the frames up to the keyframe in frame `end`, and appends the first entry of its state that differs from the
// recorded state. Appends nothing if there is no such keyframe, or if nothing differs. The session then has the
// recorded state.
void details_add(PetriArchive *archive, PetriSession *session, int64_t end, Text *details);
