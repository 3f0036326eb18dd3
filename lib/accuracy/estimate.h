// estimate.h: the numerics of petri_trust, which know no sessions. The runs (trust.c) give them values at equal
// intervals.
#pragma once

#include <stdbool.h>
#include <stddef.h>

// The runs of a script that are compared.
typedef enum TrustRun {
    TRUST_STEP,    // with the script's own steps
    TRUST_HALF,    // with halves of them
    TRUST_QUARTER, // with quarters of them
    TRUST_ULP,     // starting positions moved by one unit in the last place of the size of the system
    TRUST_MOVED,   // moved by TRUST_SHIFT of the size
    TRUST_RUNS
} TrustRun;
#define TRUST_SHIFT 1e-9

// The values of one number in all runs: the value in row r of run v is `values[v * stride + r]`.
typedef struct TrustSeries {
    const double *values;
    size_t stride;
    size_t rows;
} TrustSeries;

typedef struct TrustEstimate {
    double error; // as in PetriTrust
    double order;
    double spread;
} TrustEstimate;

// Estimates the errors of the value in a row, from this row and those before it.
TrustEstimate trust_estimate(TrustSeries series, size_t row);

// How the distance between neighbouring runs grows. Times are in rows; NaN: as in PetriTrust.
typedef struct TrustGrowth {
    double lyapunov_time;
    double lyapunov_error;
    double horizon;
} TrustGrowth;

// Estimates the growth from the distances of a run with the script's own steps to the others, by row. `distances` has
// one array of `rows` numbers for each run; that of TRUST_STEP contains how far this run itself has moved.
TrustGrowth trust_growth(TrustSeries distances);
