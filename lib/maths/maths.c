// maths.c: see maths.h. Each function calls the variant for this processor. The results of all variants are
// bit-identical.
#include "maths/maths.h"

#include "base/cpu.h"
#include "maths/double_bits.h"
#include "maths/fast.h"
#include "maths/table.h"

#if defined(__x86_64__) && !defined(__FMA__)
#define PICK(name) (cpu_detected.fma ? maths_##name##_fma : maths_##name##_plain)
#else
#define PICK(name) maths_##name##_plain
#endif

#define DEFINE_ONE(name)                                                                                               \
    double maths_##name(double x) {                                                                                    \
        return PICK(name)(x);                                                                                          \
    }
#define DEFINE_TWO(name)                                                                                               \
    double maths_##name(double x, double y) {                                                                          \
        return PICK(name)(x, y);                                                                                       \
    }
MATHS_FUNCTIONS(DEFINE_ONE, DEFINE_TWO)

double maths_hypot(double x, double y) {
    double a = double_absolute(x), b = double_absolute(y), scale = 1;
    if (a == DOUBLE_INFINITY || b == DOUBLE_INFINITY)
        return DOUBLE_INFINITY;
    if (a > 0x1p500 || b > 0x1p500)
        scale = 0x1p-600;
    else if (a < 0x1p-400 && b < 0x1p-400)
        scale = 0x1p600;
    a *= scale;
    b *= scale;
    return __builtin_sqrt(a * a + b * b) / scale;
}

#define ENTRY(name) .name = maths_##name,
const MathsTable maths_table = {MATHS_FUNCTIONS(ENTRY, ENTRY) ENTRY(hypot)};
