// arrays.c: see arrays.h. Each function calls the variant for the selected vector instructions.
#include "maths/arrays.h"

#include "maths/arrays_isa.h"

// Returns the functions for a level. CPU_SCALAR selects two lanes, which every supported processor has. The one-lane
// variant only serves as a reference in tests.
static const ArraysIsa *select_isa(CpuLevel level) {
#if defined(__x86_64__)
    if (level == CPU_AVX512)
        return &maths_arrays_avx512;
    if (level == CPU_AVX2 && cpu_detected.fma)
        return &maths_arrays_avx2;
#endif
    (void)level;
    return &maths_arrays_pair;
}

void maths_exp_array(CpuLevel level, const double *x, size_t count, double *to) {
    select_isa(level)->exp(x, count, to);
}

void maths_log_array(CpuLevel level, const double *x, size_t count, double *to) {
    select_isa(level)->log(x, count, to);
}

void maths_sin_cos_array(CpuLevel level, const double *x, size_t count, double *sines, double *cosines) {
    select_isa(level)->sin_cos(x, count, sines, cosines);
}

void maths_pow_array(CpuLevel level, const double *x, const double *y, size_t count, double *to) {
    select_isa(level)->pow(x, y, 1, count, to);
}

void maths_power_array(CpuLevel level, const double *x, double power, size_t count, double *to) {
    select_isa(level)->pow(x, &power, 0, count, to);
}

void maths_turns_sin_array(CpuLevel level, const double *t, size_t count, double *to) {
    select_isa(level)->turns_sin(t, count, to);
}

void maths_plane_noise_array(CpuLevel level, const PlaneNoise *noise, const uint8_t *permutation, const double *x,
                             const double *y, size_t count, double *to) {
    select_isa(level)->plane_noise(noise, permutation, x, y, count, to);
}

void maths_uniform_array(CpuLevel level, uint64_t key, uint64_t first, size_t count, double *to) {
    select_isa(level)->uniform(key, first, count, to);
}
