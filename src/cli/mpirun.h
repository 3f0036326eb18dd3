// mpirun.h: whether this process is one of several that mpirun has started, without MPI.
#ifndef PETRI_SRC_MPIRUN_H
#define PETRI_SRC_MPIRUN_H

#include <stdbool.h>

// False if it is alone; else its number, from 0, and how many there are.
bool mpirun_rank(int *rank, int *count);

#endif
