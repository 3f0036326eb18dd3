// worker_pool.h: worker processes that execute runs. A crash ends only one run and becomes a row of the table.
#pragma once

#include "sweep/journal.h"
#include "sweep/sweep.h"

// Returns true if this process executes runs for another one, which stores the results.
bool worker_pool_is_remote(const Sweep *sweep);
// Executes all runs of this shard that are not done, `jobs` at a time in each MPI rank. Only rank 0 has a journal and
// stores results. Returns STATUS_DONE or the exit status: STATUS_FAILED after a message, or 128 plus a signal number.
int worker_pool_run(Sweep *sweep, Journal *journal, int64_t jobs);
// Returns the number of the last signal since worker_pool_run was called, or 0.
int worker_pool_signal(void);
