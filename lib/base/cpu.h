// cpu.h: which vector instructions this processor has, and how many processors there are.
#ifndef PETRI_BASE_CPU_H
#define PETRI_BASE_CPU_H

#include <stdbool.h>

// Each level includes the ones before it. Results are the same on all of them.
typedef enum CpuLevel { CPU_SCALAR, CPU_AVX2, CPU_AVX512, CPU_LEVELS } CpuLevel;

// The highest level that the processor and the operating system support.
CpuLevel cpu_detect(void);
// `wish` ("scalar", "avx2" or "avx512"), lowered to what cpu_detect() finds.
// NULL or an empty text stand for no wish. False if there is no such level; *level is then the detected one.
bool cpu_choose(const char *wish, CpuLevel *level);
const char *cpu_name(CpuLevel level);

// Processors that this process may run on; at least 1.
int cpu_count(void);

#endif
