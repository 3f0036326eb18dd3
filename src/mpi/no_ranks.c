// no_ranks.c: ranks.h for programs that do not link MPI.
#include "mpi/ranks.h"

void ranks_begin(CommandContext *context) {
    (void)context;
}

void ranks_end(int status) {
    (void)status;
}
