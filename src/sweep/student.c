// student.c: half widths of confidence intervals of means.
#include "sweep/sweep.h"

#include <math.h>

// Returns the probability that Student's variable is within -t..t: the finite sums of Abramowitz and Stegun, 26.7.3 and
// 26.7.4.
static double probability_within(double t, int freedom) {
    double angle = atan(t / sqrt(freedom)), cosine = cos(angle), sum = 0;
    bool odd = freedom % 2 == 1;
    double term = odd ? cosine : 1;
    for (int i = odd ? 1 : 0; i < freedom - 1; i += 2) {
        sum += term;
        term *= cosine * cosine * (i + 1) / (i + 2);
    }
    return odd ? (angle + sin(angle) * sum) * 2 / acos(-1) : sin(angle) * sum;
}

static double quantile(double level, double freedom) {
    int whole = freedom < 1000 ? (int)freedom : 1000; // those for more are smaller by at most 0.15 %
    double low = 0, high = 1;
    while (probability_within(high, whole) < level)
        high *= 2;
    for (int i = 0; i < 50; i++) {
        double middle = (low + high) / 2;
        *(probability_within(middle, whole) < level ? &low : &high) = middle;
    }
    return high;
}

double student_half_width(double level, double count, double squares) {
    return count > 1 ? quantile(level, count - 1) * sqrt(squares / (count - 1) / count) : INFINITY;
}
