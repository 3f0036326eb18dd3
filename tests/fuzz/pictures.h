// pictures.h: drawing of scripts, shared by the harnesses of pictures.
#pragma once

#include "fuzz.h"
#include "petri-draw.h"

// Loads a script and computes a frame with low limits. Returns NULL if one of them fails; else the caller closes the
// session with fuzz_close.
PetriSession *pictures_open(const char *script, size_t length);
// Draws two frames of a script: the first as its nodes specify, the second as an automatic picture if `automatic` is
// true. Also reads the picture's records and its display list.
void pictures_draw(PetriPainter *painter, const char *script, size_t length, bool automatic);
