// meshes.h: the triangles that `petri check --stats` prints.
#pragma once

#include "cli/options.h"

// Prints how many triangles the models of the script's first frame have, to standard error. Prints nothing if the
// script has none, or if it cannot be executed, which the check has already reported.
void check_print_meshes(const CommandContext *host, const Options *options, const char *path);
