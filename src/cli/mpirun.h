// mpirun.h: detection of mpirun without linking MPI.
#pragma once

#include <stdbool.h>

// Returns true if mpirun has started several processes, and sets *rank (from 0) and *count.
bool mpirun_rank(int *rank, int *count);
