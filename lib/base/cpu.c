// cpu.c: see cpu.h.
//
// A request can only lower the level, so that petri never executes instructions that the processor lacks.
#include "base/cpu.h"

#include <stdlib.h>
#include <string.h>
#ifdef __x86_64__
#include <cpuid.h>
#endif
#ifdef __APPLE__
#include <sys/sysctl.h>
#elif defined(__aarch64__) && defined(__linux__)
#include <sys/auxv.h>
#endif

static const char *const names[CPU_LEVELS] = {"scalar", "avx2", "avx512"};

Cpu cpu_detected;

#if defined(__x86_64__) && defined(__APPLE__)
// Asks the system, because it enables AVX-512 only when a program uses it.
static bool is_supported(const char *name) {
    int value = 0;
    size_t size = sizeof value;
    return sysctlbyname(name, &value, &size, NULL, 0) == 0 && value != 0;
}
#define SUPPORTS(name, apple_name) is_supported("hw.optional." apple_name)
#elif defined(__x86_64__)
#define SUPPORTS(name, apple_name) __builtin_cpu_supports(name)
#endif

#if defined(__x86_64__)
// Applies PETRI_CPU (cpu.h).
static void limit_cpu(const char *wish) {
    char name[16] = "";
    size_t len = wish ? strcspn(wish, "+-") : 0;
    if (len < sizeof name)
        memcpy(name, wish ? wish : "", len);
    cpu_choose(name, &cpu_detected.level);
    const char *use = wish ? wish + len : "";
    if (cpu_detected.level == CPU_SCALAR || !strcmp(use, "-fma"))
        cpu_detected.fma = false;
    cpu_detected.use_fma = !cpu_detected.fma ? CPU_FMA_NEVER : !strcmp(use, "+fma") ? CPU_FMA_ALWAYS : CPU_FMA_FASTER;
}
#endif

static bool has_sha256(void) {
#if defined(__x86_64__)
    unsigned eax, ebx = 0, ecx, edx;
    return __get_cpuid_count(7, 0, &eax, &ebx, &ecx, &edx) && ebx & bit_SHA;
#elif defined(__aarch64__) && defined(__APPLE__)
    return true;
#elif defined(__aarch64__) && defined(__linux__)
    const unsigned long HAS_SHA2 = 1 << 6; // HWCAP_SHA2
    return getauxval(AT_HWCAP) & HAS_SHA2;
#else
    return false;
#endif
}

// Runs before main, so that cpu_detected is constant afterwards.
__attribute__((constructor)) static void detect_cpu(void) {
    const char *requested = getenv("PETRI_CPU");
#if defined(__x86_64__)
#ifndef __APPLE__
    __builtin_cpu_init();
#endif
    bool wide = SUPPORTS("avx512f", "avx512f") && SUPPORTS("avx512dq", "avx512dq") &&
                SUPPORTS("avx512vl", "avx512vl") && SUPPORTS("avx512bw", "avx512bw");
    cpu_detected.level = !SUPPORTS("avx2", "avx2_0") ? CPU_SCALAR : wide ? CPU_AVX512 : CPU_AVX2;
    cpu_detected.fma = SUPPORTS("fma", "fma");
    limit_cpu(requested);
#else
    cpu_detected.use_fma = CPU_FMA_NEVER;
#endif
    cpu_detected.sha256 = has_sha256() && !(requested && strcmp(requested, names[CPU_SCALAR]) == 0);
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
