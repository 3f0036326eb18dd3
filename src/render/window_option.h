// window_option.h: the option --window of `petri render` and `petri view`.
#pragma once

#include "petri-draw.h"

// Returns the number of a window of the last frame, for PetriPictureOptions.window. `wanted` is the value of --window,
// an id or a number. Returns `otherwise` if it is NULL. Returns INT_MAX, which is the number of no window, if there is
// no such window. A script can create other windows in each frame.
int window_option(PetriSession *session, const char *wanted, int otherwise);
