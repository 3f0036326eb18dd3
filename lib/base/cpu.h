// cpu.h: detection of vector instructions.
#pragma once

#include <stdbool.h>

// Levels of vector instructions. Each level includes the previous ones. Computed results do not depend on the level.
typedef enum CpuLevel { CPU_SCALAR, CPU_AVX2, CPU_AVX512, CPU_LEVELS } CpuLevel;

// Use of fused multiply-add where other operations give the same results.
typedef enum CpuFma {
    CPU_FMA_FASTER, // where it is faster
    CPU_FMA_NEVER,  // as on a processor without it
    CPU_FMA_ALWAYS, // wherever it is possible, for tests
} CpuFma;

// The instructions that the processor and the operating system support, limited by the environment variable PETRI_CPU:
// the name of a level, followed by "-fma" or "+fma" for CPU_FMA_NEVER or CPU_FMA_ALWAYS. Either part may be missing.
// Set once before main.
typedef struct Cpu {
    CpuLevel level; // highest supported level
    bool fma;       // true if fused multiply-add may be used: the processor has it and the level is above scalar
    CpuFma use_fma; // CPU_FMA_NEVER if `fma` is false
    bool sha256; // true if instructions for SHA-256 may be used: the processor has them and `scalar` is not requested
} Cpu;
extern Cpu cpu_detected;

// Sets *level to the lower of `requested` ("scalar", "avx2" or "avx512", as in PETRI_CPU) and cpu_detected.level. If
// `requested` is NULL, empty or unknown, sets *level to cpu_detected.level. Returns false only if it is unknown.
bool cpu_choose(const char *requested, CpuLevel *level);
const char *cpu_name(CpuLevel level);
