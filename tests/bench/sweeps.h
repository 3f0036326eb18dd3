// sweeps.h: measurement of the parallel speed-up of `petri sweep`.
#pragma once

#include "measure.h"
#include "table.h"

// Measures 1000 runs of 100 frames of a dish with 50 cells. Returns a table with one row per number of processes.
Table sweeps_measure(const Plan *plan);
