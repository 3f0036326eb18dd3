// noise.c: classic OpenSimplex noise in two to four dimensions (spec builtins.md B10).
//
// A point lies in a cell of the skewed lattice. The cell's regions (A at the base corner, B at the far corner, C and D
// between) decide which vertices can reach the point: a fixed core, and a few extra ones beyond the cell that depend on
// which coordinates are closest. The noise is the sum of their contributions in the order of the spec.
#include "builtin/noise.h"

#include "base/random.h"
#include "builtin/family.h"
#include "builtin/noise_tables.h"
#include "value/seed.h"

#include <math.h>
#include <string.h>

enum { MOST_DIMS = 4, MOST_EXTRA = 3 };

// --- one point

typedef struct NoisePoint {
    const uint8_t *permutation;
    uint64_t base[MOST_DIMS]; // two's complement: only sums and the low eight bits matter
    double frac[MOST_DIMS];   // fx … of B10.4
    double d0[MOST_DIMS];
    double sum; // of the fractions
} NoisePoint;

// B10.4. False if the point is too far out or not a number.
static inline bool point_place(NoisePoint *point, const double *c, int dims) {
    double t = c[0], whole[MOST_DIMS];
    for (int i = 1; i < dims; i++)
        t = t + c[i];
    t = t * NOISE_S[dims];
    uint64_t base_sum = 0;
    for (int i = 0; i < dims; i++) {
        double skewed = c[i] + t;
        if (!(fabs(skewed) < 4611686018427387904.0)) // 2^62
            return false;
        whole[i] = floor(skewed);
        point->frac[i] = skewed - whole[i];
        point->sum = i ? point->sum + point->frac[i] : point->frac[i];
        point->base[i] = (uint64_t)(int64_t)whole[i];
        base_sum += point->base[i];
    }
    double q = (double)(int64_t)base_sum * NOISE_Q[dims];
    for (int i = 0; i < dims; i++)
        point->d0[i] = c[i] - (whole[i] + q);
    return true;
}

static inline const double *gradient(const NoisePoint *point, const NoiseVertex *v, int dims) {
    unsigned p = 0;
    for (int i = 0; i < dims; i++) {
        uint64_t at = point->base[i] + (uint64_t)(v->early[i] + v->late[i]);
        p = point->permutation[(p + at) & 255];
    }
    return dims == 2 ? NOISE_GRAD2[p % 8] : dims == 3 ? NOISE_GRAD3[p % 24] : NOISE_GRAD4[p / 4];
}

// B10.5: d = ((d0 - a) - m*Q) - b per coordinate, A = 2 - d·d; if A > 0 the vertex adds A^4 * (g·d).
static inline double add_vertex(const NoisePoint *point, double value, const NoiseVertex *v, int dims) {
    double d[MOST_DIMS], reach = 2, units = v->units * NOISE_Q[dims];
    for (int i = 0; i < dims; i++) {
        d[i] = ((point->d0[i] - v->early[i]) - units) - v->late[i];
        reach = reach - d[i] * d[i];
    }
    if (!(reach > 0))
        return value;
    const double *g = gradient(point, v, dims);
    double slope = g[0] * d[0];
    for (int i = 1; i < dims; i++)
        slope = slope + g[i] * d[i];
    reach = reach * reach;
    return value + (reach * reach) * slope;
}

static inline double add_vertices(const NoisePoint *point, double value, const NoiseVertex *v, int count, int dims) {
    for (int i = 0; i < count; i++)
        value = add_vertex(point, value, &v[i], dims);
    return value;
}

// --- choosing extra vertices

// bit(c): the coordinate of the lowest set bit; gap(c) is that of the lowest clear one.
static int lowest_bit(unsigned mask) {
    int i = 0;
    while (!(mask >> i & 1))
        i++;
    return i;
}

static int lowest_gap(unsigned mask) {
    return lowest_bit(~mask);
}

// The vertex with offset `set` where the mask is set and `clear` elsewhere.
static NoiseVertex vertex_of_mask(unsigned mask, int set, int clear, int units) {
    NoiseVertex v = {.units = (uint8_t)units};
    for (int i = 0; i < MOST_DIMS; i++)
        v.early[i] = (int8_t)(mask >> i & 1 ? set : clear);
    return v;
}

// `all` everywhere, and `late` more at one coordinate, all of it late.
static NoiseVertex vertex_late(int all, int coordinate, int late, int units) {
    NoiseVertex v = vertex_of_mask(0, 0, all, units);
    v.late[coordinate] = (int8_t)late;
    return v;
}

// Two candidates with their scores and coordinate masks; `big` and `far` as in B10.8 and B10.9.
typedef struct Candidates {
    double a, b;
    unsigned mask_a, mask_b;
    bool flag_a, flag_b;
} Candidates;

// The score replaces the lesser candidate if it is greater.
static void take_greater(Candidates *c, double score, unsigned mask, bool flag) {
    if (c->a >= c->b && score > c->b) {
        c->b = score;
        c->mask_b = mask;
        c->flag_b = flag;
    } else if (c->a < c->b && score > c->a) {
        c->a = score;
        c->mask_a = mask;
        c->flag_a = flag;
    }
}

// The score replaces the greater candidate if it is less.
static void take_less(Candidates *c, double score, unsigned mask, bool flag) {
    if (c->a <= c->b && score < c->b) {
        c->b = score;
        c->mask_b = mask;
        c->flag_b = flag;
    } else if (c->a > c->b && score < c->a) {
        c->a = score;
        c->mask_a = mask;
        c->flag_a = flag;
    }
}

// --- two dimensions (B10.7)

static double noise_2(const uint8_t *permutation, const double *c) {
    NoisePoint point = {.permutation = permutation};
    if (!point_place(&point, c, 2))
        return 0;
    double fx = point.frac[0], fy = point.frac[1];
    bool near = point.sum <= 1;
    NoiseVertex extra;
    if (near) {
        double u = 1 - point.sum;
        if (u > fx || u > fy)
            extra = fx > fy ? (NoiseVertex){{1, -1}, {0}, 0} : (NoiseVertex){{-1, 1}, {0}, 0};
        else
            extra = (NoiseVertex){{1, 1}, {0}, 2};
    } else {
        double u = 2 - point.sum;
        if (u < fx || u < fy)
            extra = fx > fy ? (NoiseVertex){{2, 0}, {0}, 2} : (NoiseVertex){{0, 2}, {0}, 2};
        else
            extra = (NoiseVertex){{0, 0}, {0}, 0};
    }
    double value = add_vertices(&point, 0, near ? NOISE_CORE2_A : NOISE_CORE2_B, 3, 2);
    return add_vertex(&point, value, &extra, 2) / NOISE_N[2];
}

// --- three dimensions (B10.8)

static const NoiseVertex *extras_3a(const double *f, double sum) {
    Candidates c = {.a = f[0], .mask_a = 1, .b = f[1], .mask_b = 2};
    take_greater(&c, f[2], 4, false);
    double u = 1 - sum;
    if (u > c.a || u > c.b)
        return NOISE_EXT3_ORIGIN1[c.b > c.a ? c.mask_b : c.mask_a];
    return NOISE_EXT3_ORIGIN2[c.mask_a | c.mask_b];
}

static const NoiseVertex *extras_3b(const double *f, double sum) {
    Candidates c = {.a = f[0], .mask_a = 6, .b = f[1], .mask_b = 5};
    take_less(&c, f[2], 3, false);
    double u = 3 - sum;
    if (u < c.a || u < c.b)
        return NOISE_EXT3_CORNER2[c.b < c.a ? c.mask_b : c.mask_a];
    return NOISE_EXT3_CORNER1[c.mask_a & c.mask_b];
}

static void extras_3c(const double *f, NoiseVertex extra[2]) {
    static const unsigned far_masks[3] = {3, 5, 6}, near_masks[3] = {4, 2, 1};
    const double sums[3] = {f[0] + f[1], f[0] + f[2], f[1] + f[2]};
    double score[3];
    unsigned mask[3];
    bool far[3];
    for (int i = 0; i < 3; i++) {
        far[i] = sums[i] > 1;
        score[i] = far[i] ? sums[i] - 1 : 1 - sums[i];
        mask[i] = far[i] ? far_masks[i] : near_masks[i];
    }
    // On a tie the first gives way here, the second in take_greater.
    int replaced = score[0] <= score[1] && score[0] < score[2] ? 0 : score[0] > score[1] && score[1] < score[2] ? 1 : 2;
    mask[replaced] = mask[2];
    far[replaced] = far[2];
    if (far[0] && far[1]) {
        extra[0] = vertex_of_mask(0, 0, 1, 3);
        extra[1] = vertex_of_mask(1u << lowest_bit(mask[0] & mask[1]), 2, 0, 2);
    } else if (!far[0] && !far[1]) {
        extra[0] = vertex_of_mask(0, 0, 0, 0);
        extra[1] = vertex_of_mask(1u << lowest_gap(mask[0] | mask[1]), -1, 1, 1);
    } else {
        unsigned far_mask = far[0] ? mask[0] : mask[1], near_mask = far[0] ? mask[1] : mask[0];
        extra[0] = vertex_of_mask(1u << lowest_gap(far_mask), -1, 1, 1);
        extra[1] = vertex_late(0, lowest_bit(near_mask), 2, 2);
    }
}

static double noise_3(const uint8_t *permutation, const double *c) {
    NoisePoint point = {.permutation = permutation};
    if (!point_place(&point, c, 3))
        return 0;
    double value;
    NoiseVertex between[2];
    const NoiseVertex *extra = between;
    if (point.sum <= 1) {
        value = add_vertices(&point, 0, NOISE_CORE3_A, 4, 3);
        extra = extras_3a(point.frac, point.sum);
    } else if (point.sum >= 2) {
        value = add_vertices(&point, 0, NOISE_CORE3_B, 4, 3);
        extra = extras_3b(point.frac, point.sum);
    } else {
        value = add_vertices(&point, 0, NOISE_CORE3_C, 6, 3);
        extras_3c(point.frac, between);
    }
    return add_vertices(&point, value, extra, 2, 3) / NOISE_N[3];
}

// --- four dimensions (B10.9)

static const NoiseVertex *extras_4a(const double *f, double sum) {
    Candidates c = {.a = f[0], .mask_a = 1, .b = f[1], .mask_b = 2};
    take_greater(&c, f[2], 4, false);
    take_greater(&c, f[3], 8, false);
    double u = 1 - sum;
    if (u > c.a || u > c.b)
        return NOISE_EXT4_ORIGIN1[c.b > c.a ? c.mask_b : c.mask_a];
    return NOISE_EXT4_ORIGIN2[c.mask_a | c.mask_b];
}

static const NoiseVertex *extras_4b(const double *f, double sum) {
    Candidates c = {.a = f[0], .mask_a = 14, .b = f[1], .mask_b = 13};
    take_less(&c, f[2], 11, false);
    take_less(&c, f[3], 7, false);
    double u = 4 - sum;
    if (u < c.a || u < c.b)
        return NOISE_EXT4_CORNER3[c.b < c.a ? c.mask_b : c.mask_a];
    return NOISE_EXT4_CORNER2[c.mask_a & c.mask_b];
}

// The first scores of region C: of each of three pairs of opposite edges the greater. All start big.
static Candidates candidates_4c(const double *f, double sum) {
    double xy = f[0] + f[1], xz = f[0] + f[2], xw = f[0] + f[3], yz = f[1] + f[2], yw = f[1] + f[3], zw = f[2] + f[3];
    Candidates c = {.flag_a = true, .flag_b = true};
    c.a = xy > zw ? xy : zw;
    c.mask_a = xy > zw ? 3 : 12;
    c.b = xz > yw ? xz : yw;
    c.mask_b = xz > yw ? 5 : 10;
    take_greater(&c, xw > yz ? xw : yz, xw > yz ? 9 : 6, true);
    for (int i = 0; i < 4; i++)
        take_greater(&c, 2 - sum + f[i], 1u << i, false);
    return c;
}

static void extras_4c(const double *f, double sum, NoiseVertex extra[3]) {
    Candidates c = candidates_4c(f, sum);
    if (c.flag_a && c.flag_b) {
        unsigned either = c.mask_a | c.mask_b, both = c.mask_a & c.mask_b;
        extra[0] = vertex_of_mask(either, 1, 0, 3);
        extra[1] = vertex_of_mask(either, 1, -1, 2);
        extra[2] = vertex_late(0, lowest_bit(both), 2, 2);
        return;
    }
    unsigned first = c.flag_a ? c.mask_a : c.flag_b ? c.mask_b : c.mask_a | c.mask_b;
    extra[0] = NOISE_EXT4_ORIGIN2[first][1];
    extra[1] = NOISE_EXT4_ORIGIN2[first][2];
    if (c.flag_a || c.flag_b)
        extra[2] = vertex_late(0, lowest_bit(c.flag_a ? c.mask_b : c.mask_a), 2, 2);
    else
        extra[2] = vertex_of_mask(0, 0, 0, 0);
}

// Region D mirrors C: of each pair of opposite edges the lesser.
static Candidates candidates_4d(const double *f, double sum) {
    double xy = f[0] + f[1], xz = f[0] + f[2], xw = f[0] + f[3], yz = f[1] + f[2], yw = f[1] + f[3], zw = f[2] + f[3];
    Candidates c = {.flag_a = true, .flag_b = true};
    c.a = xy < zw ? xy : zw;
    c.mask_a = xy < zw ? 12 : 3;
    c.b = xz < yw ? xz : yw;
    c.mask_b = xz < yw ? 10 : 5;
    take_less(&c, xw < yz ? xw : yz, xw < yz ? 6 : 9, true);
    for (int i = 0; i < 4; i++)
        take_less(&c, 3 - sum + f[i], 15u & ~(1u << i), false);
    return c;
}

static void extras_4d(const double *f, double sum, NoiseVertex extra[3]) {
    Candidates c = candidates_4d(f, sum);
    if (c.flag_a && c.flag_b) {
        unsigned both = c.mask_a & c.mask_b, either = c.mask_a | c.mask_b;
        extra[0] = vertex_late(0, lowest_bit(both), 1, 1);
        extra[1] = vertex_late(0, lowest_bit(both), 2, 2);
        extra[2] = vertex_late(1, lowest_gap(either), -2, 2);
        return;
    }
    unsigned first = c.flag_a ? c.mask_a : c.flag_b ? c.mask_b : c.mask_a & c.mask_b;
    extra[0] = NOISE_EXT4_CORNER2[first][1];
    extra[1] = NOISE_EXT4_CORNER2[first][2];
    if (c.flag_a || c.flag_b)
        extra[2] = vertex_late(1, lowest_gap(c.flag_a ? c.mask_b : c.mask_a), -2, 2);
    else
        extra[2] = vertex_of_mask(15, 1, 0, 4);
}

static double noise_4(const uint8_t *permutation, const double *c) {
    NoisePoint point = {.permutation = permutation};
    if (!point_place(&point, c, 4))
        return 0;
    double value;
    NoiseVertex between[MOST_EXTRA];
    const NoiseVertex *extra = between;
    if (point.sum <= 1) {
        value = add_vertices(&point, 0, NOISE_CORE4_A, 5, 4);
        extra = extras_4a(point.frac, point.sum);
    } else if (point.sum >= 3) {
        value = add_vertices(&point, 0, NOISE_CORE4_B, 5, 4);
        extra = extras_4b(point.frac, point.sum);
    } else if (point.sum <= 2) {
        value = add_vertices(&point, 0, NOISE_CORE4_C, 10, 4);
        extras_4c(point.frac, point.sum, between);
    } else {
        value = add_vertices(&point, 0, NOISE_CORE4_D, 10, 4);
        extras_4d(point.frac, point.sum, between);
    }
    return add_vertices(&point, value, extra, 3, 4) / NOISE_N[4];
}

// --- permutations (B10.3)

enum { CACHE_SLOTS = 64 }; // 17 KiB; an evicted permutation only costs its making

typedef struct Permutation {
    uint64_t key;
    bool known;
    uint8_t values[256];
} Permutation;

struct NoiseCache {
    Arena arena; // holds the cache itself
    Permutation slots[CACHE_SLOTS];
};

NoiseCache *noise_cache_new(void) {
    Arena arena;
    arena_init(&arena, "noise", SIZE_MAX);
    NoiseCache *cache = arena_alloc(&arena, sizeof *cache);
    memset(cache, 0, sizeof *cache);
    cache->arena = arena;
    return cache;
}

void noise_cache_free(NoiseCache *cache) {
    if (!cache)
        return;
    Arena arena = cache->arena; // the cache dies with its arena
    arena_free(&arena);
}

// 0 … 255 shuffled by the uniform stream of this key.
static void permutation_make(uint64_t key, uint8_t values[256]) {
    for (unsigned i = 0; i < 256; i++)
        values[i] = (uint8_t)i;
    for (unsigned i = 0; i < 255; i++) {
        unsigned j = i + (unsigned)(random_uniform(key, i) * (256 - i));
        j = j < 255 ? j : 255;
        uint8_t moved = values[i];
        values[i] = values[j];
        values[j] = moved;
    }
}

// The permutation of a key: from the cache, or made in `local`.
static const uint8_t *permutation_get(NoiseCache *cache, uint64_t key, uint8_t local[256]) {
    if (!cache) {
        permutation_make(key, local);
        return local;
    }
    Permutation *slot = &cache->slots[random_hash_step(key, 0) % CACHE_SLOTS];
    if (!slot->known || slot->key != key) {
        permutation_make(key, slot->values);
        slot->key = key;
        slot->known = true;
    }
    return slot->values;
}

// --- the functions

// The coordinates of a call and how many results their combinations give.
typedef struct Grid {
    const double *axes[MOST_DIMS];
    uint32_t lens[MOST_DIMS];
    int dims;
    uint32_t len;
} Grid;

typedef enum GridOutcome { GRID_OK, GRID_BAD, GRID_TOO_LONG } GridOutcome;

// One to four numeric vectors; one stands for itself and a second coordinate of 0 (B10.2).
static GridOutcome grid_read(Grid *grid, const Value *args, uint32_t count) {
    static const double zero[1] = {0};
    if (count < 1 || count > MOST_DIMS)
        return GRID_BAD;
    uint64_t len = 1;
    for (uint32_t i = 0; i < count; i++) {
        if (!value_is_numeric(args[i]))
            return GRID_BAD;
        grid->axes[i] = value_numbers(&args[i]);
        grid->lens[i] = args[i].len;
        len = len > VALUE_MAX_LEN ? len : len * args[i].len; // stops before it could overflow
    }
    if (count == 1) {
        grid->axes[1] = zero;
        grid->lens[1] = 1;
    }
    grid->dims = count == 1 ? 2 : (int)count;
    grid->len = (uint32_t)len;
    return len > VALUE_MAX_LEN ? GRID_TOO_LONG : GRID_OK;
}

// result[j] = the noise, or result[j] + noise*weight, at every combination, the last coordinate varying fastest.
static void grid_noise(const Grid *grid, const uint8_t *permutation, double *result, bool add, double weight) {
    double (*const noise)(const uint8_t *, const double *) = grid->dims == 2   ? noise_2
                                                             : grid->dims == 3 ? noise_3
                                                                               : noise_4;
    uint32_t at[MOST_DIMS] = {0};
    double c[MOST_DIMS];
    for (int i = 0; i < grid->dims; i++)
        c[i] = grid->axes[i][0];
    for (uint32_t j = 0; j < grid->len; j++) {
        double part = noise(permutation, c);
        result[j] = add ? result[j] + part * weight : part;
        int i = grid->dims - 1;
        while (i >= 0 && ++at[i] == grid->lens[i]) {
            at[i] = 0;
            c[i] = grid->axes[i][0];
            i--;
        }
        if (i >= 0)
            c[i] = grid->axes[i][at[i]];
    }
}

// Every coordinate times 2, in place once `grid` has coordinates of its own.
static void grid_double(Arena *arena, Grid *grid, bool own) {
    for (int i = 0; i < grid->dims; i++) {
        double *axis = own ? (double *)grid->axes[i] : arena_alloc_array(arena, grid->lens[i], sizeof *axis);
        for (uint32_t k = 0; k < grid->lens[i]; k++)
            axis[k] = grid->axes[i][k] * 2;
        grid->axes[i] = axis;
    }
}

Value builtin_noise(BuiltinContext *context, const Value *args, uint32_t count) {
    Grid grid;
    GridOutcome outcome = grid_read(&grid, args + 1, count - 1);
    if (outcome != GRID_OK)
        return outcome == GRID_TOO_LONG ? builtin_too_long(context, "noise") : VALUE_NULL;
    uint8_t local[256];
    const uint8_t *permutation = permutation_get(context->noise, value_seed_hash(args[0]), local);
    double single, *result = grid.len == 1 ? &single : arena_alloc_array(context->arena, grid.len, sizeof *result);
    grid_noise(&grid, permutation, result, false, 1);
    return value_numbers_view(result, grid.len);
}

// Far more than the number of doublings that a double survives near 1: a mistake, and it would take for ever.
enum { MOST_OCTAVES = 1024 };

// B10.11: r = noise, then r = r + noise(c*2^o)*k^o, divided by the total weight.
static void sum_octaves(BuiltinContext *context, Grid *grid, uint64_t seed, uint32_t octaves, double k,
                        double *result) {
    uint8_t local[256];
    double weight = 1, total = 0;
    ArenaMark scratch = arena_mark(context->arena);
    // A weight that has faded to 0 adds nothing more.
    for (uint32_t o = 0; o < octaves && weight != 0; o++) {
        if (o > 0)
            grid_double(context->arena, grid, o > 1);
        grid_noise(grid, permutation_get(context->noise, seed ^ o, local), result, o > 0, weight);
        total = total + weight;
        weight = weight * k;
    }
    for (uint32_t j = 0; j < grid->len; j++)
        result[j] = result[j] / total;
    arena_rewind(context->arena, scratch);
}

Value builtin_octnoise(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!is_scalar(args[1]) || !is_scalar(args[2]))
        return VALUE_NULL;
    double octaves = trunc(args[1].as.number);
    Grid grid;
    GridOutcome outcome = grid_read(&grid, args + 3, count - 3);
    if (!(octaves > 0) || outcome == GRID_BAD)
        return VALUE_NULL;
    if (outcome == GRID_TOO_LONG)
        return builtin_too_long(context, "octnoise");
    if (octaves > MOST_OCTAVES) {
        builtin_fault(context, "octnoise", "more than 1024 octaves");
        return VALUE_NULL;
    }
    double single, *result = grid.len == 1 ? &single : arena_alloc_array(context->arena, grid.len, sizeof *result);
    sum_octaves(context, &grid, value_seed_hash(args[0]), (uint32_t)octaves, args[2].as.number, result);
    return value_numbers_view(result, grid.len);
}
