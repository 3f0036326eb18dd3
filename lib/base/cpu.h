// cpu.h: which vector instructions this processor has, and how many processors there are.
#ifndef PETRI_BASE_CPU_H
#define PETRI_BASE_CPU_H

#include <stdbool.h>

// Each level includes the ones before it. Results are the same on all of them.
typedef enum CpuLevel { CPU_SCALAR, CPU_AVX2, CPU_AVX512, CPU_LEVELS } CpuLevel;

// What the processor and the operating system support, lowered to the environment variable PETRI_CPU as it is when the
// process begins. Nobody writes it after that.
typedef struct Cpu {
    CpuLevel level; // the highest
    bool fma;       // fused multiply-add may be used to find results: the level is above scalar, the processor has it
} Cpu;
extern Cpu cpu_detected;

// `wish` ("scalar", "avx2" or "avx512", as in PETRI_CPU), lowered to cpu_detected.level. NULL or an empty text stand
// for no wish. False if there is no such level; *level is then cpu_detected.level.
bool cpu_choose(const char *requested, CpuLevel *level);
const char *cpu_name(CpuLevel level);

// Processors that this process may run on; at least 1.
int cpu_count(void);

#endif
