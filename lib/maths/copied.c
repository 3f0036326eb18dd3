// copied.c: the functions of maths.h in libpetri-draw.so. They call those of libpetri.so, because a copy of their code
// and tables would have 300 KB.
#include "maths/maths.h"
#include "maths/table.h"

#define DEFINE_ONE(name)                                                                                               \
    double maths_##name(double x) {                                                                                    \
        return maths_table.name(x);                                                                                    \
    }
#define DEFINE_TWO(name)                                                                                               \
    double maths_##name(double x, double y) {                                                                          \
        return maths_table.name(x, y);                                                                                 \
    }
MATHS_FUNCTIONS(DEFINE_ONE, DEFINE_TWO)
DEFINE_TWO(hypot)
