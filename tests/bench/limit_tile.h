// limit_tile.h: forces between all pairs, each computed once, in tiles of WIDTH x WIDTH. Included once for each WIDTH.
//
// The terms of a tile are added to the particles of its rows in ascending order of partners. Then they are transposed
// and added to the particles of its columns, also in ascending order. The code has no checks and only one force, so it
// does less work than petri.
//
// Roots and their inverses are computed by the divider, or by fused multiply-add for two columns in step, like
// lib/physics/fused_roots.h but without its checks.
#if WIDTH == 8
#define TARGET __attribute__((target("avx512f,avx512dq,avx512vl,avx512bw,avx2,fma")))
#define APPROXIMATE_INVERSE_ROOT(x) _mm512_rsqrt14_pd(x)
#define ROOT_STEPS 2
#define V __m512d
#define F(name) _mm512_##name##_pd
#define NAME(name) name##8
#else
#define TARGET __attribute__((target("avx2,fma")))
#define APPROXIMATE_INVERSE_ROOT(x) _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(x)))
#define ROOT_STEPS 3
#define V __m256d
#define F(name) _mm256_##name##_pd
#define NAME(name) name##4
#endif
#define INLINE TARGET static inline __attribute__((always_inline))

INLINE void NAME(transpose)(V *r) {
#if WIDTH == 8
    V t[8], u[4];
    for (int i = 0; i < 8; i += 2) {
        t[i] = F(unpacklo)(r[i], r[i + 1]);
        t[i + 1] = F(unpackhi)(r[i], r[i + 1]);
    }
    for (int i = 0; i < 2; i++) {
        u[0] = _mm512_shuffle_f64x2(t[i], t[i + 2], 0x88);
        u[1] = _mm512_shuffle_f64x2(t[i], t[i + 2], 0xdd);
        u[2] = _mm512_shuffle_f64x2(t[i + 4], t[i + 6], 0x88);
        u[3] = _mm512_shuffle_f64x2(t[i + 4], t[i + 6], 0xdd);
        r[i] = _mm512_shuffle_f64x2(u[0], u[2], 0x88);
        r[i + 4] = _mm512_shuffle_f64x2(u[0], u[2], 0xdd);
        r[i + 2] = _mm512_shuffle_f64x2(u[1], u[3], 0x88);
        r[i + 6] = _mm512_shuffle_f64x2(u[1], u[3], 0xdd);
    }
#else
    V a = F(unpacklo)(r[0], r[1]), b = F(unpackhi)(r[0], r[1]), c = F(unpacklo)(r[2], r[3]),
      d = F(unpackhi)(r[2], r[3]);
    r[0] = _mm256_permute2f128_pd(a, c, 0x20);
    r[1] = _mm256_permute2f128_pd(b, d, 0x20);
    r[2] = _mm256_permute2f128_pd(a, c, 0x31);
    r[3] = _mm256_permute2f128_pd(b, d, 0x31);
#endif
}

#define BOTH for (int c = 0; c < 2; c++)

// Computes length[c] = sqrt(square[c]) and inverse[c] = 1 / length[c] for two columns.
INLINE void NAME(roots)(bool fused, const V *square, V *length, V *inverse) {
    V half = F(set1)(0.5), one = F(set1)(1), g[2], h[2], e[2];
    if (!fused) {
        BOTH length[c] = F(sqrt)(square[c]), inverse[c] = F(div)(one, length[c]);
        return;
    }
    BOTH h[c] = APPROXIMATE_INVERSE_ROOT(square[c]);
    BOTH g[c] = F(mul)(square[c], h[c]), h[c] = F(mul)(h[c], half);
    for (int step = 0; step < ROOT_STEPS; step++) {
        BOTH e[c] = F(fnmadd)(g[c], h[c], half);
        BOTH g[c] = F(fmadd)(g[c], e[c], g[c]), h[c] = F(fmadd)(h[c], e[c], h[c]);
    }
    BOTH e[c] = F(fnmadd)(g[c], g[c], square[c]);
    BOTH length[c] = F(fmadd)(e[c], h[c], g[c]), inverse[c] = F(add)(h[c], h[c]);
    for (int step = 0; step < 2; step++) {
        BOTH e[c] = F(fnmadd)(length[c], inverse[c], one);
        BOTH inverse[c] = F(fmadd)(e[c], inverse[c], inverse[c]);
    }
}

INLINE void NAME(tile)(const Cloud *cloud, bool fused, int dim, int t, int s, const V *here, V *sum) {
    V terms[3][WIDTH], R = F(loadu)(cloud->r + t), q = F(loadu)(cloud->q + t);
#pragma GCC unroll 4
    for (int k = 0; k < WIDTH; k += 2) {
        V d[2][3], square[2], length[2], inverse[2];
        for (int m = 0; m < dim; m++) {
            BOTH d[c][m] = F(sub)(F(set1)(cloud->p[m][s + k + c]), here[m]);
            BOTH square[c] = m ? F(add)(square[c], F(mul)(d[c][m], d[c][m])) : F(mul)(d[c][0], d[c][0]);
        }
        NAME(roots)(fused, square, length, inverse);
        BOTH {
            V D = F(max)(F(add)(R, F(set1)(cloud->r[s + k + c])), length[c]);
            V f = F(div)(F(mul)(q, F(set1)(cloud->q[s + k + c])), F(mul)(D, D));
            for (int m = 0; m < dim; m++) {
                terms[m][k + c] = F(mul)(F(mul)(d[c][m], inverse[c]), f);
                sum[m] = F(sub)(sum[m], terms[m][k + c]);
            }
        }
    }
    for (int m = 0; m < dim; m++) {
        NAME(transpose)(terms[m]);
        V total = F(loadu)(cloud->f[m] + s);
        for (int k = 0; k < WIDTH; k++)
            total = F(add)(total, terms[m][k]);
        F(storeu)(cloud->f[m] + s, total);
    }
}
#undef BOTH

// Computes the forces of all tiles except those on the diagonal. The omitted tiles are a fraction WIDTH / n of all
// tiles.
INLINE void NAME(all)(const Cloud *c, bool fused, int dim) {
    for (int t = 0; t < c->n; t += WIDTH) {
        V here[3], sum[3];
        for (int m = 0; m < dim; m++) {
            here[m] = F(loadu)(c->p[m] + t);
            sum[m] = F(loadu)(c->f[m] + t);
        }
        for (int s = t + WIDTH; s < c->n; s += WIDTH)
            NAME(tile)(c, fused, dim, t, s, here, sum);
        for (int m = 0; m < dim; m++)
            F(storeu)(c->f[m] + t, sum[m]);
    }
}

TARGET static void NAME(divider_2_)(const Cloud *c) {
    NAME(all)(c, false, 2);
}

TARGET static void NAME(divider_3_)(const Cloud *c) {
    NAME(all)(c, false, 3);
}

TARGET static void NAME(fused_2_)(const Cloud *c) {
    NAME(all)(c, true, 2);
}

TARGET static void NAME(fused_3_)(const Cloud *c) {
    NAME(all)(c, true, 3);
}

#undef TARGET
#undef V
#undef F
#undef NAME
#undef INLINE
#undef APPROXIMATE_INVERSE_ROOT
#undef ROOT_STEPS
