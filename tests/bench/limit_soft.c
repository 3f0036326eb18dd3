// limit_soft.c: the limit kernel for soft discs and spheres with neighbour lists; see limit.h.
//
// n = side² discs (side³ spheres) of diameter 1 and mass 1 in a box with reflecting walls: the workloads "soft discs",
// at area fraction 0.84, and "soft spheres", at volume fraction 0.60. Arrays are sorted by cell. id[] holds the
// original numbers of the particles; forces are summed in ascending order of these numbers. test_limit.c compares the
// bits with those of lib/physics.
#include "limit.h"

#if defined(__x86_64__)

#include "base/cpu.h"

#include <immintrin.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>

#define AVX512 __attribute__((target("avx512f,avx512dq,avx512vl,avx512bw,avx2,fma,bmi2,popcnt")))
static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return t.tv_sec + t.tv_nsec * 1e-9;
}

static uint64_t random_state = 88172645463325252u;
static double uniform(void) { /* xorshift64*, in [0, 1) */
    random_state ^= random_state >> 12;
    random_state ^= random_state << 25;
    random_state ^= random_state >> 27;
    return ((random_state * 2685821657736338717u) >> 11) * 0x1p-53;
}
static double normal(void) {
    return sqrt(-2 * log(1 - uniform())) * cos(6.283185307179586 * uniform());
}

/* Returns zeroed memory aligned to a cache line. Large blocks use huge pages if the system has them. */
static void *zeroed(size_t bytes) {
    size_t align = bytes >= 4 << 20 ? 2 << 20 : 64;
    void *p = aligned_alloc(align, bytes = (bytes + 64 + align - 1) / align * align);
    if (!p) {
        perror("limit");
        exit(1);
    }
    if (align > 64)
        madvise(p, bytes, MADV_HUGEPAGE);
    return memset(p, 0, bytes);
}

#define STIFFNESS 1000.0
#define MAX_NEIGHBOURS(dim) ((dim) == 2 ? 24 : 48) /* capacity of a neighbour list */
#define INLINE AVX512 static inline __attribute__((always_inline))

typedef struct {
    int n, blocks, columns, dim;
    double low, high; /* positions of the walls; low: 0, or unreachable for no walls */
    double step, skin, cell;
    double *p[3], *u[3], *r, *f[3], *p0[3]; /* sorted by cell; elements n and up are distant dummies */
    double *spare[7];
    double *quad; /* position and radius of a particle, adjacent for fast loads */
    int *id, *spare_id, *cell_of, *start;
    int *list, *max_length; /* per block of 8 particles: [k][8] neighbours, and the longest length */
    size_t *at;             /* start of a block's list */
    long rebuilds;
} Box;

static int cells_of(const Box *b) {
    int wide = b->columns + 2;
    return b->dim == 2 ? wide * wide : wide * wide * wide;
}

static void box_arrays(Box *b) {
    size_t n = (b->n + 7) / 8 * 8 + 8;
    for (int m = 0; m < b->dim; m++)
        b->p[m] = zeroed(8 * n), b->u[m] = zeroed(8 * n), b->f[m] = zeroed(8 * n), b->p0[m] = zeroed(8 * n);
    for (int k = 0; k < 2 * b->dim; k++)
        b->spare[k] = zeroed(8 * n);
    b->r = zeroed(8 * n), b->quad = zeroed(32 * n);
    b->id = zeroed(4 * n), b->spare_id = zeroed(4 * n), b->cell_of = zeroed(4 * n);
    b->start = zeroed(4 * (size_t)(cells_of(b) + 2));
    b->blocks = (b->n + 7) / 8;
    b->list = zeroed((size_t)b->blocks * MAX_NEIGHBOURS(b->dim) * 8 * 4), b->max_length = zeroed(4 * (size_t)b->blocks);
    b->at = zeroed(8 * (size_t)b->blocks);
}

static Box box(int dim, int side, double skin) {
    Box b = {.n = dim == 2 ? side * side : side * side * side, .dim = dim, .skin = skin, .step = 0.005};
    double quarter = 3.14159265358979323846 / 4, pitch = dim == 2 ? sqrt(quarter / 0.84) : cbrt(quarter / 1.5 / 0.60);
    b.high = side * pitch;
    b.columns = (int)(b.high / (1 + skin));
    b.cell = b.high / b.columns;
    box_arrays(&b);
    random_state = 88172645463325252u;
    for (int i = 0; i < b.n; i++) {
        int at[] = {i % side, i / side % (dim == 2 ? b.n : side), i / side / side};
        for (int m = 0; m < dim; m++)
            b.p[m][i] = (at[m] + 0.5) * pitch, b.u[m][i] = normal();
        b.r[i] = 0.5, b.id[i] = i;
    }
    for (int i = b.n; i < b.blocks * 8 + 8; i++) {
        b.id[i] = i;
        for (int m = 0; m < dim; m++)
            b.p[m][i] = 1e30;
    }
    return b;
}

static void box_free(Box *b) {
    for (int m = 0; m < 3; m++)
        free(b->p[m]), free(b->u[m]), free(b->f[m]), free(b->p0[m]);
    for (int k = 0; k < 7; k++)
        free(b->spare[k]);
    void *all[] = {b->r, b->quad, b->id, b->spare_id, b->cell_of, b->start, b->list, b->max_length, b->at};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        free(all[i]);
}

/* Sorts all arrays by cell (stable counting sort). The grid has a border of empty cells. */
INLINE void box_sort(Box *b, int dim) {
    int n = b->n, wide = b->columns + 2, cells = cells_of(b);
    memset(b->start, 0, 4 * (size_t)(cells + 2));
    double scale = 1 / b->cell;
    for (int i = 0; i < n; i++) {
        int c = 0;
        for (int m = dim; m-- > 0;) {
            int at = (int)(b->p[m][i] * scale);
            c = c * wide + 1 + (at < 0 ? 0 : at >= b->columns ? b->columns - 1 : at);
        }
        b->cell_of[i] = c;
        b->start[c + 2]++;
    }
    for (int c = 2; c < cells + 2; c++)
        b->start[c] += b->start[c - 1];
    double **from[6];
    for (int m = 0; m < dim; m++)
        from[m] = &b->p[m], from[dim + m] = &b->u[m];
    for (int i = 0; i < n; i++) {
        int to = b->start[b->cell_of[i] + 1]++;
        for (int k = 0; k < 2 * dim; k++)
            b->spare[k][to] = (*from[k])[i];
        b->spare_id[to] = b->id[i];
    }
    for (int k = 0; k < 2 * dim; k++) {
        double *old = *from[k];
        memcpy(b->spare[k] + n, old + n, 8 * (size_t)(b->blocks * 8 + 8 - n));
        *from[k] = b->spare[k], b->spare[k] = old;
    }
    memcpy(b->spare_id + n, b->id + n, 4 * (size_t)(b->blocks * 8 + 8 - n));
    int *old = b->id;
    b->id = b->spare_id, b->spare_id = old;
}

/* Stores in `raw` the indices of the particles within distance 1 + skin of particle i, which is in cell c. They are in
   no particular order. Returns their number. */
INLINE int box_near(const Box *b, int dim, int c, int i, int *raw) {
    __m512i lanes = _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0);
    double reach = 1 + b->skin;
    int wide = b->columns + 2, count = 0;
    __m512d here[3];
    for (int m = 0; m < dim; m++)
        here[m] = _mm512_set1_pd(b->p[m][i]);
    for (int row = 0; row < (dim == 2 ? 3 : 9); row++) {
        int middle = c + (row % 3 - 1) * wide + (dim == 2 ? 0 : (row / 3 - 1) * wide * wide);
        for (int j = b->start[middle - 1], end = b->start[middle + 2]; j < end; j += 8) {
            __m512d d2 = _mm512_setzero_pd();
            for (int m = 0; m < dim; m++) {
                __m512d d = _mm512_sub_pd(_mm512_loadu_pd(b->p[m] + j), here[m]);
                d2 = _mm512_add_pd(d2, _mm512_mul_pd(d, d));
            }
            __mmask8 near = _mm512_cmp_pd_mask(d2, _mm512_set1_pd(reach * reach), _CMP_LT_OQ);
            near &= _mm512_cmplt_epi64_mask(lanes, _mm512_set1_epi64(end - j));
            near &= ~_mm512_cmpeq_epi64_mask(lanes, _mm512_set1_epi64(i - j));
            __m512i number = _mm512_add_epi64(lanes, _mm512_set1_epi64(j));
            _mm256_storeu_si256((void *)(raw + count),
                                _mm512_cvtepi64_epi32(_mm512_maskz_compress_epi64(near, number)));
            count += __builtin_popcount(near);
            if (count > MAX_NEIGHBOURS(dim)) {
                fprintf(stderr, "limit: too many neighbours\n");
                exit(1);
            }
        }
    }
    return count;
}

/* Sorts the particles by cell and builds their neighbour lists. A list contains the particles within contact distance +
   skin, in ascending order of id. The lists of eight particles are interleaved: entry k of list m is at k * 8 + m. */
INLINE void box_lists(Box *b, int dim) {
    box_sort(b, dim);
    int n = b->n, count[8], found[8][MAX_NEIGHBOURS(3)], raw[MAX_NEIGHBOURS(3) + 8];
    size_t used = 0;
    for (int i = 0, c = 0; i < n; i++) {
        while (i >= b->start[c + 1])
            c++;
        int *mine = found[i & 7];
        count[i & 7] = box_near(b, dim, c, i, raw);
        for (int k = 0; k < count[i & 7]; k++) { /* insertion by id */
            int j = raw[k], key = b->id[j], m = k;
            for (; m && b->id[mine[m - 1]] > key; m--)
                mine[m] = mine[m - 1];
            mine[m] = j;
        }
        if ((i & 7) == 7 || i == n - 1) {
            int max = 0, block = i >> 3, *list = b->list + used;
            for (int m = 0; m <= (i & 7); m++)
                max = count[m] > max ? count[m] : max;
            for (int k = 0; k < max; k++)
                for (int m = 0; m < 8; m++)
                    list[k * 8 + m] = m <= (i & 7) && k < count[m] ? found[m][k] : b->blocks * 8;
            b->max_length[block] = max, b->at[block] = used, used += (size_t)max * 8;
        }
    }
    for (int m = 0; m < dim; m++)
        memcpy(b->p0[m], b->p[m], 8 * (size_t)n);
    for (int i = 0; i < b->blocks * 8 + 8; i++) {
        for (int m = 0; m < dim; m++)
            b->quad[4 * i + m] = b->p[m][i];
        b->quad[4 * i + dim] = b->r[i];
    }
    b->rebuilds++;
}

/* Moves the particles and reflects them at walls. Returns the largest squared displacement since the last rebuild. */
INLINE double box_move(Box *b, int dim) {
    __m512d step = _mm512_set1_pd(b->step), zero = _mm512_setzero_pd(), far = zero, high = _mm512_set1_pd(b->high);
    __m512d wall[] = {_mm512_set1_pd(b->low), _mm512_set1_pd(2 * b->high)};
    for (int i = 0; i < b->n; i += 8) {
        __mmask8 live = b->n - i >= 8 ? 255 : (1 << (b->n - i)) - 1;
        __m512d square = zero;
        double place[3][8];
        for (int m = 0; m < dim; m++) {
            __m512d u = _mm512_add_pd(_mm512_load_pd(b->u[m] + i), _mm512_mul_pd(_mm512_load_pd(b->f[m] + i), step));
            __m512d x = _mm512_add_pd(_mm512_load_pd(b->p[m] + i), _mm512_mul_pd(u, step));
            __mmask8 under = _mm512_cmp_pd_mask(x, wall[0], _CMP_LT_OQ), over = _mm512_cmp_pd_mask(x, high, _CMP_GT_OQ);
            x = _mm512_mask_sub_pd(x, under, zero, x);
            x = _mm512_mask_sub_pd(x, over, wall[1], x);
            u = _mm512_mask_sub_pd(u, under | over, zero, u);
            _mm512_mask_store_pd(b->p[m] + i, live, x), _mm512_mask_store_pd(b->u[m] + i, live, u);
            __m512d d = _mm512_sub_pd(x, _mm512_load_pd(b->p0[m] + i));
            square = _mm512_add_pd(square, _mm512_mul_pd(d, d));
            _mm512_storeu_pd(place[m], x);
        }
        far = _mm512_mask_max_pd(far, live, far, square);
        for (int k = 0; k < 8; k++)
            if (live >> k & 1)
                for (int m = 0; m < dim; m++)
                    b->quad[4 * (i + k) + m] = place[m][k];
    }
    return _mm512_reduce_max_pd(far);
}

/* Loads coordinate m of the particles j[0] to j[7] to out[m], and their radii to out[dim]. Uses eight loads and a
   transposition. */
INLINE void box_quads(const Box *b, int dim, const int *j, __m512d *out) {
#define QUAD(m) _mm256_load_pd(b->quad + 4 * (size_t)j[m])
    __m512d a = _mm512_insertf64x4(_mm512_castpd256_pd512(QUAD(0)), QUAD(4), 1); /* x0 y0 z0 r0 x4 y4 z4 r4 */
    __m512d c = _mm512_insertf64x4(_mm512_castpd256_pd512(QUAD(1)), QUAD(5), 1);
    __m512d d = _mm512_insertf64x4(_mm512_castpd256_pd512(QUAD(2)), QUAD(6), 1);
    __m512d e = _mm512_insertf64x4(_mm512_castpd256_pd512(QUAD(3)), QUAD(7), 1);
    __m512d xa = _mm512_unpacklo_pd(a, c), xb = _mm512_unpacklo_pd(d, e); /* x0 x1 z0 z1 x4 x5 z4 z5 */
    __m512d ya = _mm512_unpackhi_pd(a, c), yb = _mm512_unpackhi_pd(d, e); /* y0 y1 r0 r1 y4 y5 r4 r5 */
    __m512i low = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0), high = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
    out[0] = _mm512_permutex2var_pd(xa, low, xb), out[1] = _mm512_permutex2var_pd(ya, low, yb);
    out[2] = _mm512_permutex2var_pd(xa, high, xb);
    if (dim == 3)
        out[3] = _mm512_permutex2var_pd(ya, high, yb);
}

/* Computes forces from the lists, for eight particles at a time. */
INLINE void box_forces(Box *b, int dim) {
    for (int block = 0; block < b->blocks; block++) {
        int i = block * 8, *list = b->list + b->at[block];
        __m512d here[3], sum[3], ri = _mm512_load_pd(b->r + i);
        for (int m = 0; m < dim; m++)
            here[m] = _mm512_load_pd(b->p[m] + i), sum[m] = _mm512_setzero_pd();
        for (int k = 0; k < b->max_length[block]; k++) {
            __m512d other[4], d[3], d2 = _mm512_setzero_pd();
            box_quads(b, dim, list + k * 8, other);
            for (int m = 0; m < dim; m++) {
                d[m] = _mm512_sub_pd(other[m], here[m]);
                d2 = m ? _mm512_add_pd(d2, _mm512_mul_pd(d[m], d[m])) : _mm512_mul_pd(d[m], d[m]);
            }
            __m512d R = _mm512_add_pd(ri, other[dim]);
            /* The first test needs no square root and is slightly too wide. The second test, below, is exact. */
            __mmask8 touch =
                _mm512_cmp_pd_mask(d2, _mm512_mul_pd(_mm512_mul_pd(R, R), _mm512_set1_pd(1 + 0x1p-48)), _CMP_LT_OQ);
            if (!touch)
                continue;
            __m512d l = _mm512_maskz_sqrt_pd(touch, d2);
            touch = _mm512_mask_cmp_pd_mask(touch, l, R, _CMP_LT_OQ);
            __m512d inv = _mm512_maskz_div_pd(touch, _mm512_set1_pd(1), l);
            __m512d f = _mm512_mul_pd(_mm512_sub_pd(R, l), _mm512_set1_pd(STIFFNESS));
            for (int m = 0; m < dim; m++)
                sum[m] = _mm512_mask_sub_pd(sum[m], touch, sum[m], _mm512_mul_pd(_mm512_mul_pd(d[m], inv), f));
        }
        for (int m = 0; m < dim; m++)
            _mm512_store_pd(b->f[m] + i, sum[m]);
    }
}

INLINE void box_steps(Box *b, int dim, int steps) {
    for (int k = 0; k < steps; k++) {
        if (!b->rebuilds)
            box_lists(b, dim);
        box_forces(b, dim);
        double far = box_move(b, dim), half = 0.5 * b->skin;
        if (far >= half * half)
            box_lists(b, dim);
    }
}

AVX512 static void steps_2(Box *b, int steps) {
    box_steps(b, 2, steps);
}

AVX512 static void steps_3(Box *b, int steps) {
    box_steps(b, 3, steps);
}

static void steps(Box *b, int count) {
    if (b->dim == 2)
        steps_2(b, count);
    else
        steps_3(b, count);
}

double limit_soft(int dimensions, int side) {
    if (cpu_detected.level < CPU_AVX512)
        return 0;
    Box b = box(dimensions, side, dimensions == 2 ? 0.6 : 0.45);
    int count = b.n > 250000 ? 15 : b.n > 40000 ? 60 : 400;
    steps(&b, count);
    double best = INFINITY;
    for (int round = 0; round < 5; round++) {
        double t = now();
        steps(&b, count);
        best = fmin(best, (now() - t) / count / b.n * 1e9);
    }
    box_free(&b);
    return best;
}

int limit_soft_run(int dimensions, int side, double step, int count, double *position, double *velocity) {
    if (cpu_detected.level < CPU_AVX512)
        return 0;
    Box b = box(dimensions, side, 0.4);
    b.step = step, b.low = -1e300, b.high = 1e300;
    for (int i = 0; i < b.n; i++)
        for (int m = 0; m < dimensions; m++)
            b.p[m][i] = position[i * dimensions + m], b.u[m][i] = velocity[i * dimensions + m];
    steps(&b, count);
    for (int i = 0; i < b.n; i++)
        for (int m = 0; m < dimensions; m++) {
            position[b.id[i] * dimensions + m] = b.p[m][i];
            velocity[b.id[i] * dimensions + m] = b.u[m][i];
        }
    int rebuilds = (int)b.rebuilds;
    box_free(&b);
    return rebuilds;
}

#else

double limit_soft(int dimensions, int side) {
    (void)dimensions;
    (void)side;
    return 0;
}

int limit_soft_run(int dimensions, int side, double step, int count, double *position, double *velocity) {
    (void)dimensions;
    (void)side;
    (void)step;
    (void)count;
    (void)position;
    (void)velocity;
    return 0;
}

#endif
