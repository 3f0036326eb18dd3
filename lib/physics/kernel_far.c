// kernel_far.c: forces of blocks of sources and cells on the targets of a walk (far_field.h, spec far-field.md).
//
// The lanes are consecutive sources. Source number j of a list is added to partial sum j % FAR_SUMS, for every number
// of lanes. The partial sums of a target start with +0.0 and never become -0.0, so adding +0.0 does not change them.
#include "physics/far_field.h"
#include "physics/pair_geometry.h"

// Returns 1 / sqrt(a), computed with single precision and one Newton step. `a` must be a normal number in single
// precision.
KERNEL Real inverse_root(Real a) {
#if LANES == 8
    __m256 root = _mm256_sqrt_ps(_mm512_cvtpd_ps(a));
    Real y = _mm512_cvtps_pd(_mm256_div_ps(_mm256_set1_ps(1), root));
#elif LANES == 4
    __m128 root = _mm_sqrt_ps(_mm256_cvtpd_ps(a));
    Real y = _mm256_cvtps_pd(_mm_div_ps(_mm_set1_ps(1), root));
#elif LANES == 2 && defined(__SSE2__)
    __m128 root = _mm_sqrt_ps(_mm_movelh_ps(_mm_cvtpd_ps((__m128d)a), _mm_set1_ps(1)));
    Real y = (Real)_mm_cvtps_pd(_mm_div_ps(_mm_set1_ps(1), root));
#elif LANES == 2 && defined(__aarch64__)
    float32x2_t root = vsqrt_f32(vcvt_f32_f64((float64x2_t)a));
    Real y = (Real)vcvt_f64_f32(vdiv_f32(vdup_n_f32(1), root));
#else
    // The outer casts to float matter where quotients of floats are computed as doubles, as on s390x.
    Real y = {(double)(float)(1 / sqrtf((float)a[0])), (double)(float)(1 / sqrtf((float)a[1]))};
#endif
    return y * (real_set(1.5) - real_set(0.5) * a * (y * y));
}

KERNEL void load_sums(size_t n, double (*sums)[FAR_SUMS], size_t part, Real *sum) {
    for (size_t k = 0; k < n; k++)
        sum[k] = real_load(sums[k] + part);
}

KERNEL void store_sums(size_t n, double (*sums)[FAR_SUMS], size_t part, const Real *sum) {
    for (size_t k = 0; k < n; k++)
        real_store(sums[k] + part, sum[k]);
}

KERNEL PairEnd source_end(PairShape shape, const double *source, Real radius) {
    PairEnd end = {.radius = radius, .mass = real_zero(), .charge = real_zero()};
    if (needs_mass(shape))
        end.mass = real_load(source);
    else
        end.charge = real_load(source);
    return end;
}

KERNEL void add_pairs(const FarPairs *pairs, const PairTerm *term, PairShape shape, FarTarget *to, size_t part) {
    size_t n = shape.dimensions;
    double sources[LANES];
    real_store(sources, real_set(to->source));
    PairEnd target = source_end(shape, sources, real_set(to->radius));
    Real sum[FAR_DIMENSIONS];
    for (size_t k = 0; k < n; k++)
        target.position[k] = real_set(to->position[k]);
    load_sums(n, to->pair_sums, part, sum);
    for (size_t j = part; j < pairs->count; j += FAR_SUMS) {
        PairEnd partner = source_end(shape, pairs->source + j, real_load(pairs->radius + j));
        PairGeometry geometry;
        for (size_t k = 0; k < n; k++)
            partner.position[k] = real_load(pairs->position[k] + j);
        pair_geometry(shape, &target, &partner, mask_first(LANES), &geometry);
        Real coefficient = lead_coefficient(
            shape, &(Pairs){.term = term, .geometry = &geometry, .target = &target, .partner = &partner});
        Mask applies = real_less_where(geometry.valid, geometry.length, real_set(term->bound));
        for (size_t k = 0; k < n; k++)
            sum[k] += real_or_zero(applies, geometry.unit[k] * coefficient);
    }
    store_sums(n, to->pair_sums, part, sum);
}

// The product of a quadrupole with a vector.
KERNEL void multiply_quadrupole(const FarCells *cells, size_t n, size_t j, const Real *d, Real *product) {
    Real q[FAR_QUADRUPOLE];
    for (size_t m = 0; m < FAR_QUADRUPOLE; m++)
        if (n == 3 || m == 0 || m == 1 || m == 3)
            q[m] = real_load(cells->quadrupole[m] + j);
    product[0] = q[0] * d[0] + q[1] * d[1];
    product[1] = q[1] * d[0] + q[3] * d[1];
    if (n == 3) {
        product[0] += q[2] * d[2];
        product[1] += q[4] * d[2];
        product[2] = q[2] * d[0] + q[4] * d[1] + q[5] * d[2];
    }
}

KERNEL Real dot(size_t n, const Real *a, const Real *b) {
    Real sum = a[0] * b[0] + a[1] * b[1];
    return n == 3 ? sum + a[2] * b[2] : sum;
}

//   M d/r³ + (5/2) (d·Q d) d/r⁷ − Q d/r⁵, and for charges + P/r³ − 3 (P·d) d/r⁵
KERNEL void add_cells(const FarCells *cells, size_t n, bool charges, FarTarget *to, size_t part) {
    Real at[FAR_DIMENSIONS], sum[FAR_DIMENSIONS];
    for (size_t k = 0; k < n; k++)
        at[k] = real_set(to->scaled[k]);
    load_sums(n, to->cell_sums, part, sum);
    for (size_t j = part; j < cells->count; j += FAR_SUMS) {
        Real d[FAR_DIMENSIONS], product[FAR_DIMENSIONS], dipole[FAR_DIMENSIONS];
        for (size_t k = 0; k < n; k++)
            d[k] = real_load(cells->centre[k] + j) - at[k];
        Real inverse = inverse_root(dot(n, d, d)), i2 = inverse * inverse, i3 = inverse * i2, i5 = i3 * i2;
        multiply_quadrupole(cells, n, j, d, product);
        Real radial = real_load(cells->monopole + j) * i3 + real_set(2.5) * dot(n, d, product) * (i5 * i2);
        if (charges) {
            for (size_t k = 0; k < n; k++)
                dipole[k] = real_load(cells->dipole[k] + j);
            radial -= real_set(3) * dot(n, dipole, d) * i5;
        }
        for (size_t k = 0; k < n; k++) {
            Real term = d[k] * radial - product[k] * i5;
            sum[k] += charges ? term + dipole[k] * i3 : term;
        }
    }
    store_sums(n, to->cell_sums, part, sum);
}

#define PAIRS(n, KIND)                                                                                                 \
    static void pairs_##n##KIND(const FarPairs *pairs, const PairTerm *term, FarTarget *targets, size_t count) {       \
        for (size_t t = 0; t < count; t++)                                                                             \
            for (size_t part = 0; part < FAR_SUMS; part += LANES)                                                      \
                add_pairs(pairs, term, (PairShape){n, PHYS_##KIND, REST_NONE, false}, &targets[t], part);              \
    }
#define CELLS(n, name, charges)                                                                                        \
    static void cells_##n##name(const FarCells *cells, FarTarget *targets, size_t count) {                             \
        for (size_t t = 0; t < count; t++)                                                                             \
            for (size_t part = 0; part < FAR_SUMS; part += LANES)                                                      \
                add_cells(cells, n, charges, &targets[t], part);                                                       \
    }
CELLS(2, mass, false)
CELLS(2, charge, true)
CELLS(3, mass, false)
CELLS(3, charge, true)

// Rows whose reach is INVERSE_SQUARE have kernels for pairs. Trees exist only for two sources.
#define TREES_CONTACT(MAKE, KIND, SOURCE)
#define TREES_FAR(MAKE, KIND, SOURCE)
#define TREES_INVERSE_SQUARE(MAKE, KIND, SOURCE) TREES_OF_##SOURCE(MAKE(KIND))
#define TREES_OF_MASS(...) __VA_ARGS__
#define TREES_OF_CHARGE(...) __VA_ARGS__
#define PAIR_KERNELS(KIND) PAIRS(2, KIND) PAIRS(3, KIND)
#define PAIR_ENTRIES(KIND) [PHYS_##KIND] = {[2] = pairs_2##KIND, [3] = pairs_3##KIND},
#define ROW_KERNELS(KIND, name, SIGN, SOURCE, REACH) TREES_##REACH(PAIR_KERNELS, KIND, SOURCE)
#define ROW_ENTRIES(KIND, name, SIGN, SOURCE, REACH) TREES_##REACH(PAIR_ENTRIES, KIND, SOURCE)

PHYS_FORCES(ROW_KERNELS, PHYS_NO_ROW, PHYS_NO_ROW, PHYS_NO_ROW)

const FarKernels PER_ISA(far_kernels) = {
    .pairs = {PHYS_FORCES(ROW_ENTRIES, PHYS_NO_ROW, PHYS_NO_ROW, PHYS_NO_ROW)},
    .cells = {[2] = {cells_2mass, cells_2charge}, [3] = {cells_3mass, cells_3charge}},
};
