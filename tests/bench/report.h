// report.h: the measured figures as tables.
#ifndef TESTS_BENCH_REPORT_H
#define TESTS_BENCH_REPORT_H

#include "measure.h"
#include "peers.h"
#include "table.h"

// All that a run has measured; figures[i] belongs to cases[i].
typedef struct Results {
    Figures *figures;
    KernelFigures kernels[2]; // electrostatic in 2 dimensions, gravity in 3; 0: not measured
    PeerRatios ratios;
} Results;

Table report_workloads(const Results *results);
// What issue 5 asks for: figure, reference implementation, target. `all`: with the rows that were not measured.
Table report_targets(const Results *results, bool all);
// This build beside the other one.
Table report_builds(const Results *results);

#endif
