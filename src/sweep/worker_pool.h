// worker_pool.h: the processes that make runs, so that one that crashes is a row of the table and no more.
#ifndef PETRI_SRC_WORKER_POOL_H
#define PETRI_SRC_WORKER_POOL_H

#include "sweep/journal.h"
#include "sweep/sweep.h"

// Makes all runs of ours that are not done yet, `jobs` at a time in each process that mpirun has started; those but
// rank 0 have no journal, and keep nothing. STATUS_DONE, or the status to exit with: after a message, or 128 plus the
// number of a signal.
int worker_pool_run(Integrator *sweep, Journal *journal, int64_t jobs);

#endif
