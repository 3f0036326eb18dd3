// ranks.h: the processes that mpirun has started, as PetriOptions.ranks has them. The only part of petri that needs
// MPI.
#ifndef PETRI_SRC_RANKS_H
#define PETRI_SRC_RANKS_H

#include "cli/cli.h"

// Joins the others. Only rank 0 is seen and heard from then on.
void ranks_begin(CommandContext *context);
// Leaves them; if this process has failed they end, too, because they would wait for it.
void ranks_end(int status);

#endif
