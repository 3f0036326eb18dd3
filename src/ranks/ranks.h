// ranks.h: MPI ranks for PetriOptions.ranks. The only part of petri that needs MPI.
#ifndef PETRI_SRC_RANKS_H
#define PETRI_SRC_RANKS_H

#include "cli/cli.h"

// Initialises MPI and sets the ranks, the channel and the CPU level of the context. Afterwards only rank 0 uses its
// standard streams.
void ranks_begin(CommandContext *context);
// Finalises MPI. If `status` is a failure, exits the process instead. mpirun then terminates all ranks, which would
// otherwise wait for this one.
void ranks_end(int status);

#endif
