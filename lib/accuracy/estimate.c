// estimate.c: errors of a run from the differences between runs; see estimate.h. src/manual/trust.md explains the
// method and has its tests.
#include "accuracy/estimate.h"

#include "maths/maths.h"

#include <float.h>
#include <math.h>

static double at(TrustSeries series, TrustRun run, size_t row) {
    return series.values[(size_t)run * series.stride + row];
}

// What the differences in a window of rows say about the order.
typedef struct Window {
    double ratio; // of the second difference (quarters - halves) to the first (halves - steps); NaN: not regular
    double scale; // root mean square of the first difference
} Window;

// In a regular window, one ratio fits all rows, and it is that of a plausible order.
static Window measure_window(TrustSeries series, size_t row) {
    enum { MIN_ROWS = 8, PARTS = 8 };
    static const double misfit = 0.1, min_ratio = 0.08, max_ratio = 0.75;
    size_t length = row / PARTS < MIN_ROWS ? MIN_ROWS : row / PARTS, first = row < length ? 0 : row - length;
    double a = 0, b = 0, ab = 0, count = 0;
    for (size_t r = first; r <= row; r++) {
        double d = at(series, TRUST_HALF, r) - at(series, TRUST_STEP, r);
        double e = at(series, TRUST_QUARTER, r) - at(series, TRUST_HALF, r);
        bool known = isfinite(d) && isfinite(e);
        a += known ? d * d : 0;
        b += known ? e * e : 0;
        ab += known ? d * e : 0;
        count += known;
    }
    double ratio = ab / a;
    bool regular = a > 0 && b > 0 && ratio > min_ratio && ratio < max_ratio && 1 - ab * ratio / b < misfit * misfit;
    return (Window){regular ? ratio : NAN, count > 0 ? sqrt(a / count) : 0};
}

// Returns the largest difference in all rows up to `row` between the runs, except the one that starts far away.
static double largest_difference(TrustSeries series, size_t row) {
    double largest = 0;
    for (size_t r = 0; r <= row; r++) {
        double low = INFINITY, high = -INFINITY;
        for (int run = 0; run < TRUST_MOVED; run++) {
            low = fmin(low, at(series, (TrustRun)run, r));
            high = fmax(high, at(series, (TrustRun)run, r));
        }
        largest = fmax(largest, high - low);
    }
    return largest;
}

TrustEstimate trust_estimate(TrustSeries series, size_t row) {
    static const double irregular = 2.5, margin = 0.05;
    double step = at(series, TRUST_STEP, row), half = at(series, TRUST_HALF, row);
    double quarter = at(series, TRUST_QUARTER, row);
    double moved = fabs(at(series, TRUST_MOVED, row) - step) * (DBL_EPSILON / TRUST_SHIFT);
    TrustEstimate found = {.order = NAN, .spread = fmax(fabs(at(series, TRUST_ULP, row) - step), moved)};
    if (!isfinite(half) || !isfinite(quarter)) {
        found.error = INFINITY;
        return found;
    }
    Window window = measure_window(series, row);
    if (isnan(window.ratio)) {
        found.error = irregular * largest_difference(series, row);
        return found;
    }
    // Two limits of infinitely short steps: Richardson's with the observed order, and that of a first-order method
    // whose error is a series in the step. Both should agree. A high order may be an accident, so the rest of the
    // error is also bounded as for order 1.
    found.order = -maths_log2(window.ratio);
    double observed = quarter + (quarter - half) * window.ratio / (1 - window.ratio);
    double series_limit = (8 * quarter - 6 * half + step) / 3;
    double first_order = fabs(step - quarter) + fabs(quarter - half);
    found.error =
        fmax(fmax(fabs(step - observed), fabs(step - series_limit)) + fabs(observed - series_limit), first_order) +
        margin * window.scale;
    return found;
}

// A part of the rows in which a distance grows before it is as large as the motion itself.
typedef struct Range {
    size_t first;
    size_t end;
} Range;

static Range find_growth(TrustSeries distances, TrustRun run, double motion) {
    static const double noise = 100 * DBL_EPSILON, small = 0.01;
    Range range = {0};
    while (range.first < distances.rows && !(at(distances, run, range.first) > noise * motion))
        range.first++;
    range.end = range.first;
    while (range.end < distances.rows && at(distances, run, range.end) < small * motion)
        range.end++;
    return range;
}

// Returns the growth of a distance per row from `first` to `end` as a logarithm.
static double mean_growth(TrustSeries distances, TrustRun run, size_t first, size_t end) {
    return maths_log(at(distances, run, end) / at(distances, run, first)) / (double)(end - first);
}

// Adds the exponents of the blocks of a range to a sum and a sum of squares. Does nothing unless the distance grows
// exponentially: also by a large factor in the second half of the range, as no power of time does.
static void add_exponents(TrustSeries distances, TrustRun run, double motion, double sums[3]) {
    enum { MIN_ROWS = 8, BLOCKS = 8 };
    static const double factor = 16;
    Range range = find_growth(distances, run, motion);
    size_t rows = range.end - range.first, middle = range.first + rows / 2, last = range.end - 1;
    if (rows < MIN_ROWS || at(distances, run, last) < factor * at(distances, run, middle) ||
        at(distances, run, middle) < factor * at(distances, run, range.first))
        return;
    for (size_t block = 0; block < BLOCKS; block++) {
        size_t first = range.first + block * (rows - 1) / BLOCKS, end = range.first + (block + 1) * (rows - 1) / BLOCKS;
        double exponent = mean_growth(distances, run, first, end > first ? end : first + 1);
        sums[0] += 1;
        sums[1] += exponent;
        sums[2] += exponent * exponent;
    }
}

// Returns the first row in which a distance is above a limit, or NaN.
static double first_above(TrustSeries distances, TrustRun run, double limit) {
    for (size_t r = 0; r < distances.rows; r++)
        if (at(distances, run, r) > limit)
            return (double)r;
    return NAN;
}

TrustGrowth trust_growth(TrustSeries distances) {
    static const double far = 0.1;
    TrustGrowth growth = {NAN, NAN, NAN};
    double motion = 0, sums[3] = {0};
    for (size_t r = 0; r < distances.rows; r++)
        motion = fmax(motion, at(distances, TRUST_STEP, r));
    add_exponents(distances, TRUST_ULP, motion, sums);
    add_exponents(distances, TRUST_MOVED, motion, sums);
    double exponent = sums[1] / sums[0], apart = first_above(distances, TRUST_MOVED, far * motion);
    if (exponent > 0) {
        double variance = fmax(0, sums[2] / sums[0] - exponent * exponent) / (sums[0] - 1);
        growth.lyapunov_time = 1 / exponent;
        growth.lyapunov_error = sqrt(variance) / (exponent * exponent);
    }
    if (exponent > 0 || !isnan(apart))
        growth.horizon = fmin(apart, first_above(distances, TRUST_HALF, far * motion));
    return growth;
}
