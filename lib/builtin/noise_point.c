// noise_point.c: classic OpenSimplex noise at one point (spec builtins.md B10.4 to B10.9); see family.h.
//
// A point is in a cell of the skewed lattice. Each cell is divided into regions: A at the base corner, B at the far
// corner, C and D between. Which vertices influence the point depends on its region. Each region has a fixed set of
// core vertices. The position of the point in the region determines a few extra vertices: other corners of the cell, or
// vertices outside it. The noise is the sum of the contributions of all these vertices, in the order of the spec.
#include "base/number.h"
#include "builtin/family.h"
#include "builtin/noise_tables.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MAX_POINT_DIMS = 4, MAX_EXTRA = 3 };

typedef struct NoisePoint {
    const uint8_t *permutation;
    uint64_t
        base[MAX_POINT_DIMS]; // base corner of the cell, in two's complement; only sums and the low eight bits are used
    double frac[MAX_POINT_DIMS]; // fx, fy, … of B10.4
    double d0[MAX_POINT_DIMS];   // offset of the point from the base corner, in the coordinates of c
    double sum;                  // sum of frac
} NoisePoint;

// Finds the cell that contains the point c, and the point's position in the cell (B10.4). Returns false if a coordinate
// is too large or NaN.
static inline bool point_locate(NoisePoint *point, const double *c, int dims) {
    double t = c[0], whole[MAX_POINT_DIMS];
    for (int i = 1; i < dims; i++)
        t = t + c[i];
    t = t * NOISE_S[dims];
    uint64_t base_sum = 0;
    for (int i = 0; i < dims; i++) {
        double skewed = c[i] + t;
        if (!(fabs(skewed) < 4611686018427387904.0)) // 2^62
            return false;
        whole[i] = number_floor(skewed);
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

// Adds the contribution of a vertex (B10.5): A^4 * (g·d) if A > 0, else nothing. Here d = ((d0 - a) - m*Q) - b for each
// coordinate, where a, b and m are v->early, v->late and v->units. A = 2 - d·d, and g is the gradient.
static inline double add_vertex(const NoisePoint *point, double value, const NoiseVertex *v, int dims) {
    double d[MAX_POINT_DIMS], reach = 2, units = v->units * NOISE_Q[dims];
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

// --- selection of extra vertices

// Returns the index of the lowest set bit of a mask that is not 0 (bit(c) in the spec). lowest_gap returns the index of
// the lowest clear bit (gap(c)).
static int lowest_bit(unsigned mask) {
    int i = 0;
    while (!(mask >> i & 1))
        i++;
    return i;
}

static int lowest_gap(unsigned mask) {
    return lowest_bit(~mask);
}

// Returns the vertex with offset `set` in the coordinates of the mask and `clear` in the others.
static NoiseVertex vertex_of_mask(unsigned mask, int set, int clear, int units) {
    NoiseVertex v = {.units = (uint8_t)units};
    for (int i = 0; i < MAX_POINT_DIMS; i++)
        v.early[i] = (int8_t)(mask >> i & 1 ? set : clear);
    return v;
}

// Returns the vertex with offset `all` in every coordinate. In one coordinate, it also has the offset `late`, which is
// subtracted last.
static NoiseVertex vertex_late(int all, int coordinate, int late, int units) {
    NoiseVertex v = vertex_of_mask(0, 0, all, units);
    v.late[coordinate] = (int8_t)late;
    return v;
}

// Two candidates with their scores and coordinate masks. The flags are called "big" in B10.9 and are unused in B10.8.
// The greatest scores win in regions A and C. In B and D, the smallest win, so scores are negated there.
typedef struct Candidates {
    double a, b;
    unsigned mask_a, mask_b;
    bool flag_a, flag_b;
} Candidates;

// Replaces the candidate that has the lower score if `score` is greater than that score.
static void replace_lesser(Candidates *c, double score, unsigned mask, bool flag) {
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

// The choice of extra vertices for regions A and B in three and four dimensions. `corner_is_nearer` selects a table in
// noise_tables.h, and `row` is the row of this table.
typedef struct Choice {
    bool corner_is_nearer; // true if the corner of the cell is nearer than one of the candidates
    unsigned row;
} Choice;

static inline Choice choose_at_corner(const NoisePoint *point, int dims, bool far) {
    double sign = far ? -1 : 1, u = sign * ((far ? dims : 1) - point->sum);
    unsigned flip = far ? (1u << dims) - 1 : 0;
    Candidates c = {.a = sign * point->frac[0], .mask_a = 1 ^ flip, .b = sign * point->frac[1], .mask_b = 2 ^ flip};
    for (int i = 2; i < dims; i++)
        replace_lesser(&c, sign * point->frac[i], 1u << i ^ flip, false);
    if (u > c.a || u > c.b)
        return (Choice){true, c.b > c.a ? c.mask_b : c.mask_a};
    return (Choice){false, far ? c.mask_a & c.mask_b : c.mask_a | c.mask_b};
}

// --- two dimensions (B10.7)

// Returns `yes` if the condition holds, else `no`. Does not branch, because the branch would be hard to predict.
static inline double select_value(bool condition, double yes, double no) {
    uint64_t mask = -(uint64_t)condition, bits = (number_bits(yes) & mask) | (number_bits(no) & ~mask);
    double chosen;
    memcpy(&chosen, &bits, sizeof chosen);
    return chosen;
}

// Like add_vertex, for the vertex (a, b) with `units` squish units. In two dimensions, no offset is subtracted last.
static inline double add_vertex_2(const NoisePoint *point, double value, int a, int b, int units) {
    double squish = units * NOISE_Q[2];
    double dx = (point->d0[0] - a) - squish, dy = (point->d0[1] - b) - squish;
    double reach = (2 - dx * dx) - dy * dy;
    unsigned p = point->permutation[(point->base[0] + (uint64_t)a) & 255];
    p = point->permutation[(p + point->base[1] + (uint64_t)b) & 255];
    const double *g = NOISE_GRAD2[p % 8];
    double slope = g[0] * dx + g[1] * dy, squared = reach * reach;
    return select_value(reach > 0, value + (squared * squared) * slope, value);
}

double noise_point_2(const uint8_t *permutation, const double *c) {
    NoisePoint point = {.permutation = permutation};
    if (!point_locate(&point, c, 2))
        return 0;
    double fx = point.frac[0], fy = point.frac[1];
    double value = add_vertex_2(&point, 0, 1, 0, 1);
    value = add_vertex_2(&point, value, 0, 1, 1);
    // Add the nearer corner of the cell, and either the extra vertex (beyond the cell) or the other corner.
    int far = point.sum > 1, right = fx > fy ? 1 : -1;
    double u = 1 + far - point.sum;
    int beyond = far ? (u < fx) | (u < fy) : (u > fx) | (u > fy);
    value = add_vertex_2(&point, value, far, far, 2 * far);
    int a = beyond ? far + right : 1 - far, b = beyond ? far - right : 1 - far;
    value = add_vertex_2(&point, value, a, b, beyond ? 2 * far : 2 - 2 * far);
    return value / NOISE_N[2];
}

PlaneNoise noise_plane(void) {
    PlaneNoise plane = {.skew = NOISE_S[2], .squish = NOISE_Q[2], .scale = NOISE_N[2]};
    for (int i = 0; i < 8; i++) {
        plane.gradient_x[i] = NOISE_GRAD2[i][0];
        plane.gradient_y[i] = NOISE_GRAD2[i][1];
    }
    return plane;
}

// --- three dimensions (B10.8)

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
    // On a tie, the first candidate is replaced here, but the second in replace_lesser.
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

double noise_point_3(const uint8_t *permutation, const double *c) {
    NoisePoint point = {.permutation = permutation};
    if (!point_locate(&point, c, 3))
        return 0;
    double value;
    NoiseVertex between[2];
    const NoiseVertex *extra = between;
    if (point.sum <= 1) {
        value = add_vertices(&point, 0, NOISE_CORE3_A, 4, 3);
        Choice choice = choose_at_corner(&point, 3, false);
        extra = choice.corner_is_nearer ? NOISE_EXT3_ORIGIN1[choice.row] : NOISE_EXT3_ORIGIN2[choice.row];
    } else if (point.sum >= 2) {
        value = add_vertices(&point, 0, NOISE_CORE3_B, 4, 3);
        Choice choice = choose_at_corner(&point, 3, true);
        extra = choice.corner_is_nearer ? NOISE_EXT3_CORNER2[choice.row] : NOISE_EXT3_CORNER1[choice.row];
    } else {
        value = add_vertices(&point, 0, NOISE_CORE3_C, 6, 3);
        extras_3c(point.frac, between);
    }
    return add_vertices(&point, value, extra, 2, 3) / NOISE_N[3];
}

// --- four dimensions (B10.9)

// Returns the two winning candidates of region C. There are three ways to split the coordinates into two pairs. For
// each way, the pair with the greater sum is a candidate whose flag is set ("big" in B10.9). Each single coordinate is
// a candidate whose flag is clear. Region D (`far`) mirrors C.
static inline Candidates candidates_4cd(const double *f, double sum, bool far) {
    double sign = far ? -1 : 1;
    unsigned flip = far ? 15 : 0;
    double xy = sign * (f[0] + f[1]), xz = sign * (f[0] + f[2]), xw = sign * (f[0] + f[3]);
    double yz = sign * (f[1] + f[2]), yw = sign * (f[1] + f[3]), zw = sign * (f[2] + f[3]);
    Candidates c = {.flag_a = true, .flag_b = true};
    c.a = xy > zw ? xy : zw;
    c.mask_a = (xy > zw ? 3 : 12) ^ flip;
    c.b = xz > yw ? xz : yw;
    c.mask_b = (xz > yw ? 5 : 10) ^ flip;
    replace_lesser(&c, xw > yz ? xw : yz, (xw > yz ? 9 : 6) ^ flip, true);
    for (int i = 0; i < 4; i++)
        replace_lesser(&c, sign * ((far ? 3 : 2) - sum + f[i]), 1u << i ^ flip, false);
    return c;
}

static inline void extras_4cd(const double *f, double sum, bool far, NoiseVertex extra[3]) {
    Candidates c = candidates_4cd(f, sum, far);
    unsigned either = c.mask_a | c.mask_b, both = c.mask_a & c.mask_b;
    if (c.flag_a && c.flag_b) {
        extra[0] = far ? vertex_late(0, lowest_bit(both), 1, 1) : vertex_of_mask(either, 1, 0, 3);
        extra[1] = far ? vertex_late(0, lowest_bit(both), 2, 2) : vertex_of_mask(either, 1, -1, 2);
        extra[2] = far ? vertex_late(1, lowest_gap(either), -2, 2) : vertex_late(0, lowest_bit(both), 2, 2);
        return;
    }
    unsigned first = c.flag_a ? c.mask_a : c.flag_b ? c.mask_b : far ? both : either;
    const NoiseVertex *row = far ? NOISE_EXT4_CORNER2[first] : NOISE_EXT4_ORIGIN2[first];
    unsigned other = c.flag_a ? c.mask_b : c.mask_a;
    extra[0] = row[1];
    extra[1] = row[2];
    if (!c.flag_a && !c.flag_b)
        extra[2] = far ? vertex_of_mask(15, 1, 0, 4) : vertex_of_mask(0, 0, 0, 0);
    else
        extra[2] = far ? vertex_late(1, lowest_gap(other), -2, 2) : vertex_late(0, lowest_bit(other), 2, 2);
}

double noise_point_4(const uint8_t *permutation, const double *c) {
    NoisePoint point = {.permutation = permutation};
    if (!point_locate(&point, c, 4))
        return 0;
    double value;
    NoiseVertex between[MAX_EXTRA];
    const NoiseVertex *extra = between;
    if (point.sum <= 1) {
        value = add_vertices(&point, 0, NOISE_CORE4_A, 5, 4);
        Choice choice = choose_at_corner(&point, 4, false);
        extra = choice.corner_is_nearer ? NOISE_EXT4_ORIGIN1[choice.row] : NOISE_EXT4_ORIGIN2[choice.row];
    } else if (point.sum >= 3) {
        value = add_vertices(&point, 0, NOISE_CORE4_B, 5, 4);
        Choice choice = choose_at_corner(&point, 4, true);
        extra = choice.corner_is_nearer ? NOISE_EXT4_CORNER3[choice.row] : NOISE_EXT4_CORNER2[choice.row];
    } else if (point.sum <= 2) {
        value = add_vertices(&point, 0, NOISE_CORE4_C, 10, 4);
        extras_4cd(point.frac, point.sum, false, between);
    } else {
        value = add_vertices(&point, 0, NOISE_CORE4_D, 10, 4);
        extras_4cd(point.frac, point.sum, true, between);
    }
    return add_vertices(&point, value, extra, 3, 4) / NOISE_N[4];
}
