// sweeps.h: how much of its processors `petri sweep` uses.
#ifndef TESTS_BENCH_SWEEPS_H
#define TESTS_BENCH_SWEEPS_H

#include "measure.h"
#include "table.h"

// One row for each number of processes: a dish of 50 cells, 1000 runs of 100 frames each.
Table sweeps_measure(const Plan *plan);

#endif
