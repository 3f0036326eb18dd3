// many.c: see many.h. Each function asks the instance for the vector instructions that are there.
#include "maths/many.h"

#include "maths/many_instance.h"

// Without vector instructions that were asked for there are still two lanes on every processor that we know; one lane
// is there to be compared.
static const ManyInstance *instance(CpuLevel level) {
#if defined(__x86_64__)
    if (level == CPU_AVX512)
        return &maths_many_avx512;
    if (level == CPU_AVX2 && cpu_here.fma)
        return &maths_many_avx2;
#endif
    (void)level;
    return &maths_many_pair;
}

void maths_exp_many(CpuLevel level, const double *x, size_t count, double *to) {
    instance(level)->exp(x, count, to);
}

void maths_log_many(CpuLevel level, const double *x, size_t count, double *to) {
    instance(level)->log(x, count, to);
}

void maths_sin_cos_many(CpuLevel level, const double *x, size_t count, double *sines, double *cosines) {
    instance(level)->sin_cos(x, count, sines, cosines);
}

void maths_pow_many(CpuLevel level, const double *x, const double *y, size_t count, double *to) {
    instance(level)->pow(x, y, 1, count, to);
}

void maths_power_many(CpuLevel level, const double *x, double power, size_t count, double *to) {
    instance(level)->pow(x, &power, 0, count, to);
}

void maths_turns_sin_many(CpuLevel level, const double *t, size_t count, double *to) {
    instance(level)->turns_sin(t, count, to);
}

void maths_plane_noise_many(CpuLevel level, const PlaneNoise *noise, const uint8_t *permutation, const double *x,
                            const double *y, size_t count, double *to) {
    instance(level)->plane_noise(noise, permutation, x, y, count, to);
}

void maths_uniform_many(CpuLevel level, uint64_t key, uint64_t first, size_t count, double *to) {
    instance(level)->uniform(key, first, count, to);
}
