// limit_tile.h: forces between all pairs, each computed once, in tiles of WIDTH x WIDTH. Included once for each WIDTH.
//
// The terms of a tile are added to the particles of its rows in ascending order of partners. Then they are transposed
// and added to the particles of its columns, also in ascending order. The code has no checks and only one force, so it
// does less work than petri.
#if WIDTH == 8
#define TARGET __attribute__((target("avx512f,avx512dq,avx512vl,avx512bw,avx2")))
#define V __m512d
#define F(name) _mm512_##name##_pd
#define NAME(name) name##8
#else
#define TARGET __attribute__((target("avx2")))
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

// Computes the force terms f[] of WIDTH pairs. d[]: differences of their positions; R: sums of their radii; c: the
// strength times both charges.
INLINE void NAME(terms)(V *d, V R, V c, int dim, V *f) {
    V square = F(mul)(d[0], d[0]);
    for (int m = 1; m < dim; m++)
        square = F(add)(square, F(mul)(d[m], d[m]));
    V length = F(sqrt)(square), inverse = F(div)(F(set1)(1), length), D = F(max)(R, length);
    V k = F(div)(c, F(mul)(D, D));
    for (int m = 0; m < dim; m++)
        f[m] = F(mul)(F(mul)(d[m], inverse), k);
}

INLINE void NAME(tile)(const Cloud *c, int dim, int t, int s, const V *here, V *sum) {
    V g[3][WIDTH], R = F(loadu)(c->r + t), q = F(loadu)(c->q + t);
#pragma GCC unroll 8
    for (int k = 0; k < WIDTH; k++) {
        V d[3], f[3];
        for (int m = 0; m < dim; m++)
            d[m] = F(sub)(F(set1)(c->p[m][s + k]), here[m]);
        NAME(terms)(d, F(add)(R, F(set1)(c->r[s + k])), F(mul)(q, F(set1)(c->q[s + k])), dim, f);
        for (int m = 0; m < dim; m++) {
            sum[m] = F(sub)(sum[m], f[m]);
            g[m][k] = f[m];
        }
    }
    for (int m = 0; m < dim; m++) {
        NAME(transpose)(g[m]);
        V total = F(loadu)(c->f[m] + s);
        for (int k = 0; k < WIDTH; k++)
            total = F(add)(total, g[m][k]);
        F(storeu)(c->f[m] + s, total);
    }
}

// Computes the forces of all tiles except those on the diagonal. The omitted tiles are a fraction WIDTH / n of all
// tiles.
INLINE void NAME(all)(const Cloud *c, int dim) {
    for (int t = 0; t < c->n; t += WIDTH) {
        V here[3], sum[3];
        for (int m = 0; m < dim; m++) {
            here[m] = F(loadu)(c->p[m] + t);
            sum[m] = F(loadu)(c->f[m] + t);
        }
        for (int s = t + WIDTH; s < c->n; s += WIDTH)
            NAME(tile)(c, dim, t, s, here, sum);
        for (int m = 0; m < dim; m++)
            F(storeu)(c->f[m] + t, sum[m]);
    }
}

TARGET static void NAME(all_2_)(const Cloud *c) {
    NAME(all)(c, 2);
}

TARGET static void NAME(all_3_)(const Cloud *c) {
    NAME(all)(c, 3);
}

#undef TARGET
#undef V
#undef F
#undef NAME
#undef INLINE
