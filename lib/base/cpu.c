// cpu.c: see cpu.h.
#define _GNU_SOURCE // sched_getaffinity
#include "base/cpu.h"

#include <sched.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[CPU_LEVELS] = {"scalar", "avx2", "avx512"};

Cpu cpu_detected;

// Runs before main, so that cpu_detected is constant afterwards.
__attribute__((constructor)) static void detect_cpu(void) {
#if defined(__x86_64__)
    __builtin_cpu_init();
    bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    cpu_detected.level = !__builtin_cpu_supports("avx2") ? CPU_SCALAR : wide ? CPU_AVX512 : CPU_AVX2;
    cpu_choose(getenv("PETRI_CPU"), &cpu_detected.level);
    cpu_detected.fma = cpu_detected.level > CPU_SCALAR && __builtin_cpu_supports("fma");
#endif
}

bool cpu_choose(const char *requested, CpuLevel *level) {
    *level = cpu_detected.level;
    if (!requested || !*requested)
        return true;
    for (int i = 0; i < CPU_LEVELS; i++) {
        if (strcmp(requested, names[i]))
            continue;
        if ((CpuLevel)i < *level)
            *level = (CpuLevel)i;
        return true;
    }
    return false;
}

const char *cpu_name(CpuLevel level) {
    return names[level];
}

int cpu_count(void) {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set))
        return 1;
    int count = CPU_COUNT(&set);
    return count > 0 ? count : 1;
}
