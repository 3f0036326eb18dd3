// watched.c: a variant of the scalar functions that records its decisions (watch.h). The macro WATCHED is the index of
// the variant.
#include "maths/fast.h"

#define JOIN_NAME(name, number) name##number
#define NUMBERED(name, number) JOIN_NAME(name, number)
#define MATHS_ISA NUMBERED(watched, WATCHED)
#define HOOK NUMBERED(watch_hook, WATCHED)

extern void (*HOOK)(double high, double low, double error, int instance);
void (*HOOK)(double high, double low, double error, int instance);

#define LANES_WATCH(high, low, error) HOOK(high, low, error, WATCHED)

#define DECLARE_ONE(name) double NUMBERED(maths_##name##_watched, WATCHED)(double x);
#define DECLARE_TWO(name) double NUMBERED(maths_##name##_watched, WATCHED)(double x, double y);
MATHS_FUNCTIONS(DECLARE_ONE, DECLARE_TWO)

#include "maths/maths_isa.c"
