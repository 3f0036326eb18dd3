// The kernels for each instruction set. A pass adds its name to the names of all kernels.
#define PETRI_NAMED(name) PETRI_WITH_PASS(name, PETRI_PASS)
#define PETRI_WITH_PASS(name, pass) PETRI_JOINED(name, pass)
#define PETRI_JOINED(name, pass) name##_of_##pass
#undef MATHS_ISA_NEAR
#if defined(__FMA__) || defined(__aarch64__)
#define PETRI_HAS_FMA 1
#else
#define PETRI_HAS_FMA 0
#endif
