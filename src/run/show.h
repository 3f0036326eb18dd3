// show.h: `petri run --show`.
#ifndef PETRI_SRC_SHOW_H
#define PETRI_SRC_SHOW_H

#include "cli/options.h"

// Whether the picture is to be shown: --show was given, a person sits at the terminal, and the command line asks for
// nothing that a picture does not give, such as --print.
bool show_wanted(const Options *options);
// Becomes `petri view` in the terminal, with the same options, for as many frames. Returns if there is nothing to see,
// or no way to show it.
void show(const Options *options, const Host *host);

#endif
