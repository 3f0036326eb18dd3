// hints.h: telling what to type next.
#ifndef PETRI_SRC_HINTS_H
#define PETRI_SRC_HINTS_H

#include "cli/cli.h"

// Tells on standard error how to see what a script shows, and how to keep a picture of it: command lines that work from
// the current folder.
void hint_pictures(const Host *host, const char *script);

#endif
