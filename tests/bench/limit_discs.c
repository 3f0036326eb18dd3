// limit_discs.c: soft discs with kept neighbour lists, as fast as this processor can with the right bits.
//
// n = side² discs of diameter 1 and mass 1 at area fraction 0.84 in a box with reflecting walls: the workload "soft
// discs". Arrays are kept sorted by cell; id[] is a disc's own number, which fixes the order of summation.
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

/* Zeroed memory, at a cache line; large pieces in huge pages where the system has them. */
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
#define STEP 0.005
#define MOST 24 /* room for neighbours in a list */

typedef struct {
    int n, blocks, columns;
    double size; /* side of the box */
    double skin, cell;
    double *x, *y, *u, *v, *r, *fx, *fy, *x0, *y0; /* sorted by cell; [n..] are far dummies */
    double *spare[5];
    double *xyr; /* x, y, r, 0 side by side, for loads by number */
    int *id, *spare_id, *cell_of, *start;
    int *list, *most; /* per block of 8: [k][8] neighbours, and their largest count */
    size_t *at;       /* where a block's list begins */
    long steps, rebuilds, listed, contacts;
    double rebuild_seconds;
} Box;

static void box_arrays(Box *b) {
    size_t n = (b->n + 7) / 8 * 8 + 8, cells = (size_t)(b->columns + 2) * (b->columns + 2) + 2;
    double **all[] = {&b->x,  &b->y,  &b->u,        &b->v,        &b->r,        &b->fx,       &b->fy,
                      &b->x0, &b->y0, &b->spare[0], &b->spare[1], &b->spare[2], &b->spare[3], &b->spare[4]};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        *all[i] = zeroed(8 * n);
    b->xyr = zeroed(32 * n);
    b->id = zeroed(4 * n), b->spare_id = zeroed(4 * n), b->cell_of = zeroed(4 * n);
    b->start = zeroed(4 * cells);
    b->blocks = (b->n + 7) / 8;
    b->list = zeroed((size_t)b->blocks * MOST * 8 * 4), b->most = zeroed(4 * (size_t)b->blocks);
    b->at = zeroed(8 * (size_t)b->blocks);
}

static Box box(int side, double skin) {
    Box b = {.n = side * side, .skin = skin};
    double pitch = sqrt(3.14159265358979323846 / 4 / 0.84);
    b.size = side * pitch;
    b.columns = (int)(b.size / (1 + skin));
    b.cell = b.size / b.columns;
    box_arrays(&b);
    random_state = 88172645463325252u;
    for (int i = 0; i < b.n; i++) {
        b.x[i] = (i % side + 0.5) * pitch, b.y[i] = (i / side + 0.5) * pitch;
        b.u[i] = normal(), b.v[i] = normal(), b.r[i] = 0.5, b.id[i] = i;
    }
    for (int i = b.n; i < b.blocks * 8 + 8; i++)
        b.x[i] = b.y[i] = 1e30, b.id[i] = i;
    return b;
}

static void box_free(Box *b) {
    void *all[] = {b->x,        b->y,        b->u,        b->v,        b->r,        b->fx,       b->fy,  b->x0,
                   b->y0,       b->spare[0], b->spare[1], b->spare[2], b->spare[3], b->spare[4], b->xyr, b->id,
                   b->spare_id, b->cell_of,  b->start,    b->list,     b->most,     b->at};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        free(all[i]);
}

/* Sort all arrays by cell (stable counting sort). The grid has one rim of empty cells. */
static void box_sort(Box *b) {
    int n = b->n, wide = b->columns + 2, cells = wide * wide;
    memset(b->start, 0, 4 * (size_t)(cells + 2));
    double scale = 1 / b->cell;
    for (int i = 0; i < n; i++) {
        int cx = (int)(b->x[i] * scale), cy = (int)(b->y[i] * scale);
        cx = cx < 0 ? 0 : cx >= b->columns ? b->columns - 1 : cx;
        cy = cy < 0 ? 0 : cy >= b->columns ? b->columns - 1 : cy;
        int c = (cy + 1) * wide + cx + 1;
        b->cell_of[i] = c;
        b->start[c + 2]++;
    }
    for (int c = 2; c < cells + 2; c++)
        b->start[c] += b->start[c - 1];
    double **from[] = {&b->x, &b->y, &b->u, &b->v, &b->r};
    for (int i = 0; i < n; i++) {
        int to = b->start[b->cell_of[i] + 1]++;
        for (int k = 0; k < 5; k++)
            b->spare[k][to] = (*from[k])[i];
        b->spare_id[to] = b->id[i];
    }
    for (int k = 0; k < 5; k++) {
        double *old = *from[k];
        memcpy(b->spare[k] + n, old + n, 8 * (size_t)(b->blocks * 8 + 8 - n));
        *from[k] = b->spare[k], b->spare[k] = old;
    }
    memcpy(b->spare_id + n, b->id + n, 4 * (size_t)(b->blocks * 8 + 8 - n));
    int *old = b->id;
    b->id = b->spare_id, b->spare_id = old;
}

/* Neighbour lists within contact distance + skin, each in ascending order of id, eight discs side by side. */
static AVX512 void box_lists(Box *b) {
    double t = now();
    box_sort(b);
    int wide = b->columns + 2, n = b->n;
    double reach = 1 + b->skin, reach2 = reach * reach;
    __m512i lanes = _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0);
    int block_count[8], found[8][MOST];
    size_t used = 0;
    for (int row = 1, i = 0; row <= b->columns; row++)
        for (int column = 1; column <= b->columns; column++) {
            int c = row * wide + column;
            for (; i < b->start[c + 1]; i++) {
                int count = 0, *mine = found[i & 7], raw[64];
                __m512d xi = _mm512_set1_pd(b->x[i]), yi = _mm512_set1_pd(b->y[i]);
                for (int dr = -1; dr <= 1; dr++) {
                    int lo = b->start[c + dr * wide - 1], hi = b->start[c + dr * wide + 2];
                    for (int j = lo; j < hi; j += 8) {
                        __m512d dx = _mm512_sub_pd(_mm512_loadu_pd(b->x + j), xi);
                        __m512d dy = _mm512_sub_pd(_mm512_loadu_pd(b->y + j), yi);
                        __m512d d2 = _mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy));
                        __mmask8 near = _mm512_cmp_pd_mask(d2, _mm512_set1_pd(reach2), _CMP_LT_OQ);
                        near &= _mm512_cmplt_epi64_mask(lanes, _mm512_set1_epi64(hi - j));
                        near &= ~_mm512_cmpeq_epi64_mask(lanes, _mm512_set1_epi64(i - j));
                        __m512i number = _mm512_add_epi64(lanes, _mm512_set1_epi64(j));
                        _mm256_storeu_si256((void *)(raw + count),
                                            _mm512_cvtepi64_epi32(_mm512_maskz_compress_epi64(near, number)));
                        count += __builtin_popcount(near);
                    }
                }
                if (count > MOST) {
                    fprintf(stderr, "limit: too many neighbours\n");
                    exit(1);
                }
                for (int k = 0; k < count; k++) { /* insertion by id */
                    int j = raw[k], key = b->id[j], m = k;
                    for (; m && b->id[mine[m - 1]] > key; m--)
                        mine[m] = mine[m - 1];
                    mine[m] = j;
                }
                b->listed += count;
                block_count[i & 7] = count;
                if ((i & 7) == 7 || i == n - 1) {
                    int most = 0, block = i >> 3, *list = b->list + used;
                    for (int m = 0; m <= (i & 7); m++)
                        most = block_count[m] > most ? block_count[m] : most;
                    for (int k = 0; k < most; k++)
                        for (int m = 0; m < 8; m++)
                            list[k * 8 + m] = m <= (i & 7) && k < block_count[m] ? found[m][k] : b->blocks * 8;
                    b->most[block] = most, b->at[block] = used, used += (size_t)most * 8;
                }
            }
        }
    memcpy(b->x0, b->x, 8 * (size_t)n), memcpy(b->y0, b->y, 8 * (size_t)n);
    for (int i = 0; i < b->blocks * 8 + 8; i++)
        b->xyr[4 * i] = b->x[i], b->xyr[4 * i + 1] = b->y[i], b->xyr[4 * i + 2] = b->r[i];
    b->rebuilds++;
    b->rebuild_seconds += now() - t;
}

/* Move by the forces, reflect at the walls; returns the largest squared move since the lists were built. */
static AVX512 double box_move(Box *b) {
    __m512d step = _mm512_set1_pd(STEP), zero = _mm512_setzero_pd(), size = _mm512_set1_pd(b->size), far = zero;
    for (int i = 0; i < b->n; i += 8) {
        __mmask8 live = b->n - i >= 8 ? 255 : (1 << (b->n - i)) - 1;
        __m512d x = _mm512_load_pd(b->x + i), y = _mm512_load_pd(b->y + i);
        __m512d u = _mm512_add_pd(_mm512_load_pd(b->u + i), _mm512_mul_pd(_mm512_load_pd(b->fx + i), step));
        __m512d v = _mm512_add_pd(_mm512_load_pd(b->v + i), _mm512_mul_pd(_mm512_load_pd(b->fy + i), step));
        x = _mm512_add_pd(x, _mm512_mul_pd(u, step)), y = _mm512_add_pd(y, _mm512_mul_pd(v, step));
        __mmask8 low = _mm512_cmp_pd_mask(x, zero, _CMP_LT_OQ), high = _mm512_cmp_pd_mask(x, size, _CMP_GT_OQ);
        x = _mm512_mask_sub_pd(x, low, zero, x), x = _mm512_mask_sub_pd(x, high, _mm512_add_pd(size, size), x);
        u = _mm512_mask_sub_pd(u, low | high, zero, u);
        low = _mm512_cmp_pd_mask(y, zero, _CMP_LT_OQ), high = _mm512_cmp_pd_mask(y, size, _CMP_GT_OQ);
        y = _mm512_mask_sub_pd(y, low, zero, y), y = _mm512_mask_sub_pd(y, high, _mm512_add_pd(size, size), y);
        v = _mm512_mask_sub_pd(v, low | high, zero, v);
        _mm512_mask_store_pd(b->x + i, live, x), _mm512_mask_store_pd(b->y + i, live, y);
        _mm512_mask_store_pd(b->u + i, live, u), _mm512_mask_store_pd(b->v + i, live, v);
        __m512d dx = _mm512_sub_pd(x, _mm512_load_pd(b->x0 + i)), dy = _mm512_sub_pd(y, _mm512_load_pd(b->y0 + i));
        far = _mm512_mask_max_pd(far, live, far, _mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy)));
        double xs[8], ys[8];
        _mm512_storeu_pd(xs, x), _mm512_storeu_pd(ys, y);
        for (int k = 0; k < 8; k++)
            if (live >> k & 1)
                b->xyr[4 * (i + k)] = xs[k], b->xyr[4 * (i + k) + 1] = ys[k];
    }
    b->steps++;
    return _mm512_reduce_max_pd(far);
}

/* Forces from the lists: eight discs in the lanes, their k-th neighbours by eight loads and a transposition. */
static AVX512 void box_forces(Box *b) {
    long contacts = 0;
    for (int block = 0; block < b->blocks; block++) {
        int i = block * 8, *list = b->list + b->at[block];
        __m512d xi = _mm512_load_pd(b->x + i), yi = _mm512_load_pd(b->y + i), ri = _mm512_load_pd(b->r + i);
        __m512d fx = _mm512_setzero_pd(), fy = fx;
        for (int k = 0; k < b->most[block]; k++) {
            const int *j = list + k * 8;
#define QUAD(m) _mm256_load_pd(b->xyr + 4 * (size_t)j[m])
            __m512d a = _mm512_insertf64x4(_mm512_castpd256_pd512(QUAD(0)), QUAD(4), 1); /* x0 y0 r0 . x4 y4 r4 . */
            __m512d c = _mm512_insertf64x4(_mm512_castpd256_pd512(QUAD(1)), QUAD(5), 1);
            __m512d d = _mm512_insertf64x4(_mm512_castpd256_pd512(QUAD(2)), QUAD(6), 1);
            __m512d e = _mm512_insertf64x4(_mm512_castpd256_pd512(QUAD(3)), QUAD(7), 1);
            __m512d xa = _mm512_unpacklo_pd(a, c), xb = _mm512_unpacklo_pd(d, e); /* x0 x1 r0 r1 x4 x5 r4 r5 */
            __m512d ya = _mm512_unpackhi_pd(a, c), yb = _mm512_unpackhi_pd(d, e); /* y0 y1 .. y4 y5 .. */
            __m512i pick = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0),
                    pick_r = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
            __m512d xj = _mm512_permutex2var_pd(xa, pick, xb), yj = _mm512_permutex2var_pd(ya, pick, yb);
            __m512d rj = _mm512_permutex2var_pd(xa, pick_r, xb);
            __m512d dx = _mm512_sub_pd(xj, xi), dy = _mm512_sub_pd(yj, yi), R = _mm512_add_pd(ri, rj);
            __m512d d2 = _mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy));
            /* A filter without the square root first, a hair too wide, then the exact condition. */
            __mmask8 touch =
                _mm512_cmp_pd_mask(d2, _mm512_mul_pd(_mm512_mul_pd(R, R), _mm512_set1_pd(1 + 0x1p-48)), _CMP_LT_OQ);
            if (!touch)
                continue;
            __m512d l = _mm512_maskz_sqrt_pd(touch, d2);
            touch = _mm512_mask_cmp_pd_mask(touch, l, R, _CMP_LT_OQ);
            __m512d inv = _mm512_maskz_div_pd(touch, _mm512_set1_pd(1), l);
            __m512d f = _mm512_mul_pd(_mm512_sub_pd(R, l), _mm512_set1_pd(STIFFNESS));
            fx = _mm512_mask_sub_pd(fx, touch, fx, _mm512_mul_pd(_mm512_mul_pd(dx, inv), f));
            fy = _mm512_mask_sub_pd(fy, touch, fy, _mm512_mul_pd(_mm512_mul_pd(dy, inv), f));
            contacts += __builtin_popcount(touch);
        }
        _mm512_store_pd(b->fx + i, fx), _mm512_store_pd(b->fy + i, fy);
    }
    b->contacts += contacts;
}

static void box_step_lists(Box *b) {
    if (!b->rebuilds)
        box_lists(b);
    box_forces(b);
    double far = box_move(b), half = 0.5 * b->skin;
    if (far >= half * half)
        box_lists(b);
}

double limit_discs(int side) {
    if (cpu_here.level < CPU_AVX512)
        return 0;
    Box b = box(side, 0.6);
    int steps = side > 500 ? 15 : side > 200 ? 60 : 400;
    for (int k = 0; k < steps; k++)
        box_step_lists(&b);
    double best = INFINITY;
    for (int round = 0; round < 5; round++) {
        double t = now();
        for (int k = 0; k < steps; k++)
            box_step_lists(&b);
        best = fmin(best, (now() - t) / steps / b.n * 1e9);
    }
    box_free(&b);
    return best;
}

#else

double limit_discs(int side) {
    (void)side;
    return 0;
}

#endif
