// maths.c: the public functions: each calls the instance for this processor. All instances give the same bits.
#include "maths/maths.h"

#include "maths/fast.h"

#if defined(__x86_64__) && !defined(__FMA__)
#define PICK(name) (__builtin_cpu_supports("fma") ? maths_##name##_fma : maths_##name##_plain)
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
