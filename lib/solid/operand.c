// operand.c: see operand.h. All decisions are derived from three comparisons: of the x coordinates of two points, of
// the y coordinates of a point and an edge, and of the z coordinates of a point and a triangle or of two edges. The
// sums cancel along borders, so decisions never contradict each other.
#include "solid/operand.h"

#include <math.h>
#include <string.h>

enum { FINE = 64 }; // positions per unit of a solid's coordinates

// Computes vectors by which the points of a solid are moved so that all adjacent faces move outwards by 1 or more, if
// there is such a vector.
static double (*outward_vectors(Arena *arena, const Solid *solid))[3] {
    enum { ITERATIONS = 4 };
    double(*moves)[3] = arena_alloc_array(arena, solid->point_count, sizeof *moves);
    memset(moves, 0, solid->point_count * sizeof *moves);
    for (int iteration = 0; iteration < ITERATIONS; iteration++)
        for (uint32_t i = 0; i < solid->face_count; i++) {
            const int32_t *a = solid->points[solid->faces[i][0]], *b = solid->points[solid->faces[i][1]],
                          *c = solid->points[solid->faces[i][2]];
            double normal[3] = {(double)area_of(a, b, c, 1, 2), (double)area_of(a, b, c, 2, 0),
                                (double)area_of(a, b, c, 0, 1)};
            double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
            for (int k = 0; k < 3 && length > 0; k++) {
                double *move = moves[solid->faces[i][k]];
                double missing = 1 - (move[0] * normal[0] + move[1] * normal[1] + move[2] * normal[2]) / length;
                for (int axis = 0; axis < 3 && missing > 0; axis++)
                    move[axis] += missing * normal[axis] / length;
            }
        }
    return moves;
}

// Returns a pseudo-random number from -FINE to FINE. It keeps moved points off the planes of other points.
static int32_t jitter(uint32_t point, int axis) {
    uint64_t hash = (3 * (uint64_t)point + (uint64_t)axis + 1) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ hash >> 32) * 0xd6e8feb86659fd93u;
    return (int32_t)((hash >> 32) % (2 * FINE + 1)) - FINE;
}

static void set_positions(Arena *arena, Operand *operand, int shift) {
    enum { MAX_MOVE = 3 };
    const Solid *solid = operand->solid;
    double(*moves)[3] = operand->first ? outward_vectors(arena, solid) : NULL;
    for (uint32_t i = 0; i < solid->point_count; i++)
        for (int k = 0; k < 3; k++) {
            int32_t x = solid->points[i][k] * FINE;
            if (moves) {
                double move = fmin(fmax(moves[i][k], -MAX_MOVE), MAX_MOVE) * shift * FINE;
                x = (x + (int32_t)floor(move) + jitter(i, k)) | 1; // odd: never equal to a position of the second one
            }
            operand->at[i][k] = x;
        }
}

static FaceBox box_of(const Operand *operand, const uint32_t *points, int count) {
    FaceBox box;
    memcpy(box.low, operand->at[points[0]], sizeof box.low);
    memcpy(box.high, operand->at[points[0]], sizeof box.high);
    for (int i = 1; i < count; i++)
        for (int k = 0; k < 3; k++) {
            int32_t x = operand->at[points[i]][k];
            box.low[k] = x < box.low[k] ? x : box.low[k];
            box.high[k] = x > box.high[k] ? x : box.high[k];
        }
    return box;
}

Operand operand_new(Arena *arena, const Solid *solid, bool first, int shift) {
    Operand operand = {.solid = solid,
                       .first = first,
                       .at = arena_alloc_array(arena, solid->point_count, sizeof *operand.at),
                       .inclusion = arena_alloc_array(arena, solid->point_count, sizeof *operand.inclusion),
                       .copies = arena_alloc_array(arena, solid->point_count, sizeof *operand.copies)};
    memset(operand.inclusion, 0, solid->point_count * sizeof *operand.inclusion);
    set_positions(arena, &operand, shift);
    operand.edges = solid_edges(arena, solid, &operand.edge_count);
    FaceBox *boxes = arena_alloc_array(arena, solid->face_count, sizeof *boxes);
    for (uint32_t i = 0; i < solid->face_count; i++)
        boxes[i] = box_of(&operand, solid->faces[i], 3);
    operand.tree = face_tree_new(arena, boxes, solid->face_count);
    return operand;
}

typedef const int32_t *Triangle[3];

static void read_triangle(const Operand *operand, uint32_t face, Triangle out) {
    for (int k = 0; k < 3; k++)
        out[k] = operand->at[operand->solid->faces[face][k]];
}

// The following functions are named after their arguments: an element of the first operand, then one of the second.
// They return the orientation of the pair if the first element is below the second in z, else 0.

static int point_triangle(const Position p, const Triangle f) {
    int sum = below_edge(p, f[0], f[1]) + below_edge(p, f[1], f[2]) + below_edge(p, f[2], f[0]);
    if (sum == 0)
        return 0;
    int side = volume_sign(volume_of(f[0], f[1], f[2], p));
    return (sum < 0 ? side < 0 : side > 0) ? sum : 0;
}

static int triangle_point(const Triangle f, const Position q) {
    int sum = edge_below(f[0], f[1], q) + edge_below(f[1], f[2], q) + edge_below(f[2], f[0], q);
    if (sum == 0)
        return 0;
    int side = volume_sign(volume_of(f[0], f[1], f[2], q));
    return (sum < 0 ? side > 0 : side < 0) ? sum : 0;
}

static int edge_edge(const Position a, const Position b, const Position q_a, const Position q_b) {
    int sum = below_edge(b, q_a, q_b) - below_edge(a, q_a, q_b) - edge_below(a, b, q_b) + edge_below(a, b, q_a);
    if (sum == 0)
        return 0;
    int side = volume_sign(volume_of(a, b, q_a, q_b));
    return (sum < 0 ? side > 0 : side < 0) ? sum : 0;
}

// Returns `leaves` of the crossing of an edge with a triangle of the other operand.
static int edge_leaves(const Operand *operand, const Position a, const Position b, const Triangle f) {
    int sum = 0;
    if (operand->first) {
        for (int k = 0; k < 3; k++)
            sum -= edge_edge(a, b, f[k], f[(k + 1) % 3]);
        return sum + point_triangle(b, f) - point_triangle(a, f);
    }
    for (int k = 0; k < 3; k++)
        sum -= edge_edge(f[k], f[(k + 1) % 3], a, b);
    return sum - triangle_point(f, b) + triangle_point(f, a);
}

// Returns where an edge crosses the plane of a triangle.
static double crossing_place(const Position a, const Position b, const Triangle f) {
    double one = volume_to_double(volume_of(f[0], f[1], f[2], a)),
           two = volume_to_double(volume_of(f[0], f[1], f[2], b));
    double along = one / (one - two);
    return along > 0 ? along < 1 ? along : 1 : along <= 0 ? 0 : 0.5;
}

void operand_cross(Arena *arena, Operand *operand, const Operand *other) {
    FaceList near = {0};
    for (uint32_t i = 0; i < operand->edge_count; i++) {
        if (i % BUDGET_CHUNK == 0)
            arena_charge(arena, BUDGET_CHUNK * 2);
        uint32_t ends[2] = {operand->edges[i].a, operand->edges[i].b};
        FaceBox box = box_of(operand, ends, 2);
        face_tree_find(arena, &other->tree, &box, &near);
        arena_charge(arena, (uint64_t)near.count * 8);
        const int32_t *a = operand->at[ends[0]], *b = operand->at[ends[1]];
        for (uint32_t k = 0; k < near.count; k++) {
            Triangle f;
            read_triangle(other, near.items[k], f);
            int leaves = edge_leaves(operand, a, b, f);
            if (leaves == 0)
                continue;
            operand->crossings = arena_grow_array(arena, operand->crossings, operand->crossing_count,
                                                  &operand->crossing_capacity, sizeof *operand->crossings);
            operand->crossings[operand->crossing_count++] =
                (Crossing){.edge = i, .face = near.items[k], .leaves = leaves, .along = crossing_place(a, b, f)};
        }
    }
}

static uint32_t root_of(uint32_t *parents, uint32_t i) {
    while (parents[i] != i)
        i = parents[i] = parents[parents[i]];
    return i;
}

static int32_t winding_of(Arena *arena, const Operand *operand, uint32_t point, const Operand *other, FaceList *near) {
    int32_t winding = 0;
    const int32_t *p = operand->at[point];
    FaceBox column = {.low = {p[0], p[1], operand->first ? p[2] : INT32_MIN},
                      .high = {p[0], p[1], operand->first ? INT32_MAX : p[2]}};
    face_tree_find(arena, &other->tree, &column, near);
    arena_charge(arena, 10 + (uint64_t)near->count * 4);
    for (uint32_t k = 0; k < near->count; k++) {
        Triangle f;
        read_triangle(other, near->items[k], f);
        winding += operand->first ? -point_triangle(p, f) : triangle_point(f, p);
    }
    return winding;
}

void operand_find_windings(Arena *arena, Operand *operand, const Operand *other) {
    uint32_t count = operand->solid->point_count;
    uint32_t *parents = arena_alloc_array(arena, count, sizeof *parents);
    bool *crossed = arena_alloc_array(arena, operand->edge_count, sizeof *crossed);
    memset(crossed, 0, operand->edge_count * sizeof *crossed);
    for (uint32_t i = 0; i < operand->crossing_count; i++)
        crossed[operand->crossings[i].edge] = true;
    for (uint32_t i = 0; i < count; i++)
        parents[i] = i;
    for (uint32_t i = 0; i < operand->edge_count; i++) {
        if (crossed[i])
            continue;
        uint32_t a = root_of(parents, operand->edges[i].a), b = root_of(parents, operand->edges[i].b);
        parents[a > b ? a : b] = a > b ? b : a;
    }
    FaceList near = {0};
    for (uint32_t i = 0; i < count; i++) { // a root has the smallest index of its set
        uint32_t root = root_of(parents, i);
        operand->inclusion[i] = root < i ? operand->inclusion[root] : winding_of(arena, operand, i, other, &near);
    }
}
