// state_text.h: the text of a state file (save.c).
#pragma once

#include "session/checkpoint.h"

// Returns the text of a state file, in the session's text arena. Called within a protected call.
Str session_write_state(PetriSession *session);
// Reads the text of a state file into `incoming`, except for its clock: sets *frame. Sets *omitted to the number of
// entries that were ignored because they are not finite. Returns NULL, or the reason for a failure. Called by a
// FillIncoming function.
const char *session_read_state(PetriSession *session, Incoming *incoming, Str text, int64_t *frame, uint32_t *omitted);
