// ranks.h: MPI ranks for PetriOptions.ranks. The only part of petri that needs MPI.
#pragma once

#include "cli/cli.h"

// Initialises MPI and sets the ranks, the channel and the CPU level of the context. From then on, only rank 0 reads and
// prints: the standard streams of the other ranks are /dev/null.
void ranks_begin(CommandContext *context);
// Finalises MPI. If `status` is a failure, exits the process instead. mpirun then terminates the other ranks, which
// would wait for this one forever.
void ranks_end(int status);
