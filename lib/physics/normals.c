// normals.c: runs of normally distributed numbers.
//
// Items 2 i and 2 i + 1 of a stream share two uniform numbers and a logarithm (base/random.h). They are computed
// together here, and the reduction to a quarter turn is a rounding instead of a call of remquo; both are exact.
#include "base/random.h"
#include "physics/sweep.h"

// turns_sin for 0 ≤ t < 2^50: remquo(4 t, 1) is 4 t less the nearest integer (the even one of two), exactly.
static double quarter_sin(double t) {
    double quarters = t * 4, whole = rint(quarters), angle = (quarters - whole) * 1.5707963267948966;
    switch ((int)whole & 3) {
    case 0:
        return sin(angle);
    case 1:
        return cos(angle);
    case 2:
        return -sin(angle);
    default:
        return -cos(angle);
    }
}

void phys_normals(uint64_t key, uint64_t first, size_t count, double *to) {
    for (size_t k = 0; k < count;) {
        uint64_t item = first + k, even = item & ~UINT64_C(1);
        double u1 = random_uniform(key, even), u2 = random_uniform(key, even + 1);
        if (u1 == 0) {
            u1 = u2;
            u2 = 0;
        }
        double radius = sqrt(-2 * log(u1));
        if (item == even)
            to[k++] = radius * quarter_sin(u2 + 0.25);
        if (k < count)
            to[k++] = radius * quarter_sin(u2);
    }
}
