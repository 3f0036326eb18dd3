// report.h: tables of the measured figures.
#pragma once

#include "measure.h"
#include "peers.h"
#include "table.h"

// All figures of a run. figures[i] belongs to cases[i].
typedef struct Results {
    Figures *figures;
    KernelFigures kernels[2]; // [0]: electrostatic in 2 dimensions, [1]: gravity in 3; 0: not measured
    PeerRatios ratios;
} Results;

Table report_workloads(const Results *results);
// Returns the table of targets of issue 5. `all`: also includes targets that were not measured.
Table report_targets(const Results *results, bool all);
// Returns the table that compares this build with the other build.
Table report_builds(const Results *results);
