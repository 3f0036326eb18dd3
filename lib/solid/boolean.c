// boolean.c: assembles the results of boolean operations; see solid.h.
//
// Each line of the result is added to the polygons of both triangles that it borders, once in each direction, so the
// result is closed. solid_combine therefore makes the points first, then the chords, which mark the triangles that are
// cut, then the edges of these triangles. Their polygons are filled last.
#include "base/heap.h"
#include "solid/entries.h"
#include "solid/fill.h"
#include "solid/operand.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// A side of a polygon of the result, which lies in the triangle `face` of an operand.
typedef struct FaceSide {
    uint32_t face;
    PolygonSide side;
} FaceSide;

typedef struct SideList {
    FaceSide *items;
    uint32_t count;
    uint32_t capacity;
} SideList;

// A point where a line of the result begins (1) or ends (-1).
typedef struct LineEnd {
    double along;
    uint32_t point;
    int32_t sign;
    uint64_t pair; // for the intersection of two triangles: both numbers
} LineEnd;

typedef struct LineEnds {
    LineEnd *items;
    uint32_t count;
    uint32_t capacity;
} LineEnds;

typedef struct Build {
    Arena *arena;
    Operand operands[2];
    int32_t factor;   // change of a point's inclusion for a change of 1 in its winding number
    Position *points; // of the result
    uint32_t point_count;
    uint32_t point_capacity;
    SideList sides[2]; // by operand: sides of polygons in its triangles
    bool *cut[2];      // by operand and triangle: true if polygons replace the triangle
    LineEnds ends;     // scratch
    LineEnds begins;   // scratch
    FaceBuilder faces;
} Build;

static uint32_t add_point(Build *build, const int32_t place[3]) {
    build->points = arena_grow_array(build->arena, build->points, build->point_count, &build->point_capacity,
                                     sizeof *build->points);
    memcpy(build->points[build->point_count], place, sizeof *build->points);
    return build->point_count++;
}

static void add_side(Build *build, int operand, uint32_t face, uint32_t from, uint32_t to) {
    SideList *list = &build->sides[operand];
    list->items = arena_grow_array(build->arena, list->items, list->count, &list->capacity, sizeof *list->items);
    list->items[list->count++] = (FaceSide){face, {from, to}};
}

static void add_end(Build *build, LineEnds *list, const LineEnd *end) {
    list->items = arena_grow_array(build->arena, list->items, list->count, &list->capacity, sizeof *list->items);
    list->items[list->count++] = *end;
}

// Copies the points of an operand that the result contains.
static void copy_points(Build *build, Operand *operand) {
    for (uint32_t i = 0; i < operand->solid->point_count; i++) {
        int32_t copies = abs(operand->inclusion[i]);
        operand->copies[i] = build->point_count;
        for (int32_t k = 0; k < copies; k++)
            add_point(build, operand->solid->points[i]);
    }
}

// Creates the points where edges of an operand cross triangles. They lie on the unchanged edge. Where it is not nearly
// parallel to the triangle, they also lie in the unchanged triangle.
static void make_crossing_points(Build *build, Operand *operand, const Operand *other) {
    const double MAX_MOVE = 64;
    for (uint32_t i = 0; i < operand->crossing_count; i++) {
        Crossing *crossing = &operand->crossings[i];
        const int32_t *a = operand->solid->points[operand->edges[crossing->edge].a],
                      *b = operand->solid->points[operand->edges[crossing->edge].b];
        const uint32_t *face = other->solid->faces[crossing->face];
        const int32_t *f[3] = {other->solid->points[face[0]], other->solid->points[face[1]],
                               other->solid->points[face[2]]};
        double one = volume_to_double(volume_of(f[0], f[1], f[2], a)),
               two = volume_to_double(volume_of(f[0], f[1], f[2], b));
        double along = crossing->along, exact = one / (one - two), length = 0;
        for (int k = 0; k < 3; k++)
            length += ((double)b[k] - a[k]) * ((double)b[k] - a[k]);
        if (exact >= 0 && exact <= 1 && fabs(exact - along) * sqrt(length) <= MAX_MOVE)
            along = exact;
        int32_t place[3];
        for (int k = 0; k < 3; k++)
            place[k] = (int32_t)floor(a[k] + along * ((double)b[k] - a[k]) + 0.5);
        crossing->point = build->point_count;
        for (int k = 0; k < abs(crossing->leaves); k++)
            add_point(build, place);
    }
}

static int compare_ends(const void *a, const void *b) {
    const LineEnd *one = a, *two = b;
    if (one->along < two->along || one->along > two->along)
        return one->along < two->along ? -1 : 1;
    return one->point < two->point ? -1 : one->point > two->point;
}

// Adds an end once for each point at its place.
static void collect_end(Build *build, const LineEnd *end) {
    for (int32_t k = 0; k < abs(end->sign); k++) {
        LineEnd copy = *end;
        copy.point += (uint32_t)k;
        add_end(build, end->sign > 0 ? &build->begins : &build->ends, &copy);
    }
}

// Sorts the collected ends along their line, so that the k-th end follows the k-th begin.
static uint32_t pair_ends(Build *build) {
    assert(build->begins.count == build->ends.count);
    if (build->begins.count > 1) {
        qsort(build->begins.items, build->begins.count, sizeof *build->begins.items, compare_ends);
        qsort(build->ends.items, build->ends.count, sizeof *build->ends.items, compare_ends);
    }
    return build->begins.count < build->ends.count ? build->begins.count : build->ends.count;
}

// Adds the parts of an operand's edges that the result contains to the polygons of both adjacent triangles.
static void split_edges(Build *build, int which) {
    Operand *operand = &build->operands[which];
    Entry *order = arena_alloc_array(build->arena, operand->crossing_count, sizeof *order);
    for (uint32_t i = 0; i < operand->crossing_count; i++)
        order[i] = (Entry){.bucket = operand->crossings[i].edge, .value = i};
    const uint32_t *starts = entries_sort(build->arena, order, operand->crossing_count, operand->edge_count);
    for (uint32_t i = 0; i < operand->edge_count; i++) {
        const SolidEdge *edge = &operand->edges[i];
        if (!build->cut[which][edge->left] && !build->cut[which][edge->right])
            continue;
        build->begins.count = build->ends.count = 0;
        collect_end(build,
                    &(LineEnd){.along = -1, .point = operand->copies[edge->a], .sign = operand->inclusion[edge->a]});
        collect_end(build,
                    &(LineEnd){.along = 2, .point = operand->copies[edge->b], .sign = -operand->inclusion[edge->b]});
        for (uint32_t k = starts[i]; k < starts[i + 1]; k++) {
            const Crossing *crossing = &operand->crossings[order[k].value];
            collect_end(build, &(LineEnd){.along = crossing->along,
                                          .point = crossing->point,
                                          .sign = -build->factor * crossing->leaves});
        }
        uint32_t count = pair_ends(build);
        for (uint32_t k = 0; k < count; k++) {
            uint32_t from = build->begins.items[k].point, to = build->ends.items[k].point;
            if (build->cut[which][edge->left])
                add_side(build, which, edge->left, from, to);
            if (build->cut[which][edge->right])
                add_side(build, which, edge->right, to, from);
        }
    }
}

// Adds the ends of the lines in which the two triangles at an edge intersect the triangle that the edge crosses.
static void add_chord_ends(Build *build, LineEnds *all, int which) {
    const Operand *operand = &build->operands[which];
    for (uint32_t i = 0; i < operand->crossing_count; i++) {
        const Crossing *crossing = &operand->crossings[i];
        const SolidEdge *edge = &operand->edges[crossing->edge];
        for (int right = 0; right < 2; right++) {
            uint32_t own = right ? edge->right : edge->left;
            int32_t change = -build->factor * crossing->leaves;
            LineEnd end = {.point = crossing->point,
                           .sign = (which == 0) == (right == 0) ? -change : change,
                           .pair = which == 0 ? (uint64_t)own << 32 | crossing->face
                                              : (uint64_t)crossing->face << 32 | own};
            add_end(build, all, &end);
            build->cut[which][own] = true;
        }
        build->cut[1 - which][crossing->face] = true;
    }
}

static void face_normal(const Operand *operand, uint32_t face, double out[3]) {
    const uint32_t *f = operand->solid->faces[face];
    const int32_t *a = operand->at[f[0]], *b = operand->at[f[1]], *c = operand->at[f[2]];
    for (int k = 0; k < 3; k++)
        out[k] = (double)area_of(a, b, c, (k + 1) % 3, (k + 2) % 3) * 0x1p-40;
}

// Adds the lines in which two triangles intersect. A pair usually has two ends, and thus one line.
static void add_pair(Build *build, const LineEnds *all, const Entry *order, uint32_t count) {
    uint32_t faces[2] = {order->bucket, (uint32_t)order->key};
    double one[3], two[3], along[3];
    face_normal(&build->operands[0], faces[0], one);
    face_normal(&build->operands[1], faces[1], two);
    for (int k = 0; k < 3; k++)
        along[k] = one[(k + 1) % 3] * two[(k + 2) % 3] - one[(k + 2) % 3] * two[(k + 1) % 3];
    build->begins.count = build->ends.count = 0;
    for (uint32_t i = 0; i < count; i++) {
        LineEnd end = all->items[order[i].value];
        end.along = 0;
        for (int k = 0; k < 3; k++)
            end.along += along[k] * build->points[end.point][k];
        collect_end(build, &end);
    }
    uint32_t lines = pair_ends(build);
    for (uint32_t k = 0; k < lines; k++) {
        add_side(build, 0, faces[0], build->begins.items[k].point, build->ends.items[k].point);
        add_side(build, 1, faces[1], build->ends.items[k].point, build->begins.items[k].point);
    }
}

static void add_chords(Build *build) {
    LineEnds all = {0};
    add_chord_ends(build, &all, 0);
    add_chord_ends(build, &all, 1);
    Entry *order = arena_alloc_array(build->arena, all.count, sizeof *order);
    for (uint32_t i = 0; i < all.count; i++)
        order[i] =
            (Entry){.bucket = (uint32_t)(all.items[i].pair >> 32), .key = (uint32_t)all.items[i].pair, .value = i};
    entries_sort(build->arena, order, all.count, build->operands[0].solid->face_count);
    for (uint32_t i = 0, end; i < all.count; i = end) {
        for (end = i; end < all.count && order[end].bucket == order[i].bucket && order[end].key == order[i].key;)
            end++;
        add_pair(build, &all, order + i, end - i);
    }
}

static void add_whole_face(Build *build, const Operand *operand, uint32_t face) {
    const uint32_t *f = operand->solid->faces[face];
    int32_t inclusion = operand->inclusion[f[0]];
    for (uint32_t k = 0; k < (uint32_t)abs(inclusion); k++) {
        uint32_t a = operand->copies[f[0]] + k, b = operand->copies[f[1]] + k, c = operand->copies[f[2]] + k;
        inclusion > 0 ? face_builder_add(build->arena, &build->faces, a, b, c)
                      : face_builder_add(build->arena, &build->faces, a, c, b);
    }
}

static void add_faces(Build *build, int which, bool inside_out) {
    const Operand *operand = &build->operands[which];
    const SideList *list = &build->sides[which];
    Entry *order = arena_alloc_array(build->arena, list->count, sizeof *order);
    for (uint32_t i = 0; i < list->count; i++)
        order[i] = (Entry){.bucket = list->items[i].face, .value = i};
    const uint32_t *starts = entries_sort(build->arena, order, list->count, operand->solid->face_count);
    PolygonSide *sides = arena_alloc_array(build->arena, list->count, sizeof *sides);
    for (uint32_t i = 0; i < operand->solid->face_count; i++) {
        if (!build->cut[which][i]) {
            add_whole_face(build, operand, i);
            continue;
        }
        uint32_t count = 0;
        for (uint32_t k = starts[i]; k < starts[i + 1]; k++)
            sides[count++] = list->items[order[k].value].side;
        if (count == 0)
            continue;
        double normal[3];
        face_normal(operand, i, normal);
        int axis = fabs(normal[1]) > fabs(normal[0]) ? 1 : 0;
        axis = fabs(normal[2]) > fabs(normal[axis]) ? 2 : axis;
        int x = (axis + 1) % 3, y = (axis + 2) % 3;
        bool flipped = (normal[axis] < 0) != inside_out;
        fill_polygons(build->arena, &build->faces, (const int32_t(*)[3])build->points, sides, count, flipped ? y : x,
                      flipped ? x : y);
    }
}

static bool *new_flags(Arena *arena, uint32_t count) {
    bool *flags = arena_alloc_array(arena, count, sizeof *flags);
    memset(flags, 0, count * sizeof *flags);
    return flags;
}

// Turns winding numbers into the number of times that the result contains a point.
static void set_inclusion(Operand *operand, int32_t constant, int32_t factor) {
    for (uint32_t i = 0; i < operand->solid->point_count; i++)
        operand->inclusion[i] = constant + factor * operand->inclusion[i];
}

static bool boxes_are_apart(const Solid *a, const Solid *b) {
    int32_t low[2][3], high[2][3];
    for (int s = 0; s < 2; s++) {
        const Solid *solid = s ? b : a;
        for (int k = 0; k < 3; k++) {
            low[s][k] = INT32_MAX, high[s][k] = INT32_MIN;
            for (uint32_t i = 0; i < solid->point_count; i++) {
                low[s][k] = solid->points[i][k] < low[s][k] ? solid->points[i][k] : low[s][k];
                high[s][k] = solid->points[i][k] > high[s][k] ? solid->points[i][k] : high[s][k];
            }
        }
    }
    for (int k = 0; k < 3; k++)
        if (low[0][k] > (int64_t)high[1][k] + 4 * SOLID_SHIFT || low[1][k] > (int64_t)high[0][k] + 4 * SOLID_SHIFT)
            return true;
    return false;
}

static Solid concatenate(Arena *arena, const Solid *a, const Solid *b) {
    Solid both = {
        .points = arena_alloc_array(arena, (size_t)a->point_count + b->point_count, sizeof *both.points),
        .faces = arena_alloc_array(arena, (size_t)a->face_count + b->face_count, sizeof *both.faces),
        .point_count = a->point_count + b->point_count,
        .face_count = a->face_count + b->face_count,
    };
    memcpy(both.points, a->points, a->point_count * sizeof *a->points);
    memcpy(both.points + a->point_count, b->points, b->point_count * sizeof *b->points);
    memcpy(both.faces, a->faces, a->face_count * sizeof *a->faces);
    for (uint32_t i = 0; i < b->face_count; i++)
        for (int k = 0; k < 3; k++)
            both.faces[a->face_count + i][k] = a->point_count + b->faces[i][k];
    return both;
}

// Drops all allocations made since the mark, except the result. A tree of many operations would otherwise need the
// working memory of all of them.
static Solid keep_result(Arena *arena, ArenaMark mark, const Solid *result) {
    size_t points = result->point_count * sizeof *result->points, faces = result->face_count * sizeof *result->faces;
    char *copy = heap_alloc(points + faces + 1);
    if (!copy)
        return *result;
    memcpy(copy, result->points, points);
    memcpy(copy + points, result->faces, faces);
    arena_rewind(arena, mark);
    Solid kept = {arena_try_alloc(arena, points), arena_try_alloc(arena, faces), result->point_count,
                  result->face_count};
    bool good = kept.points && kept.faces;
    if (good) {
        memcpy(kept.points, copy, points);
        memcpy(kept.faces, copy + points, faces);
    }
    heap_free(copy);
    if (!good)
        arena_escape(arena, ARENA_MEMORY_LIMIT);
    return kept;
}

Solid solid_combine(Arena *arena, SolidOperation operation, const Solid *a, const Solid *b) {
    arena_charge(arena, ((uint64_t)a->face_count + b->face_count) * 80);
    if (a->face_count == 0 || b->face_count == 0 || boxes_are_apart(a, b)) {
        if (operation == SOLID_INTERSECTION)
            return (Solid){0};
        return operation == SOLID_DIFFERENCE || b->face_count == 0 ? *a
               : a->face_count == 0                                ? *b
                                                                   : concatenate(arena, a, b);
    }
    const ArenaMark mark = arena_mark(arena);
    Build build = {.arena = arena, .factor = operation == SOLID_INTERSECTION ? 1 : -1};
    Operand *one = &build.operands[0], *two = &build.operands[1];
    *one = operand_new(arena, a, true, operation == SOLID_UNION ? SOLID_SHIFT : -SOLID_SHIFT);
    *two = operand_new(arena, b, false, 0);
    operand_cross(arena, one, two);
    operand_cross(arena, two, one);
    operand_find_windings(arena, one, two);
    operand_find_windings(arena, two, one);
    set_inclusion(one, operation == SOLID_INTERSECTION ? 0 : 1, build.factor);
    set_inclusion(two, operation == SOLID_UNION ? 1 : 0, build.factor);
    copy_points(&build, one);
    copy_points(&build, two);
    make_crossing_points(&build, one, two);
    make_crossing_points(&build, two, one);
    build.cut[0] = new_flags(arena, a->face_count);
    build.cut[1] = new_flags(arena, b->face_count);
    add_chords(&build);
    split_edges(&build, 0);
    split_edges(&build, 1);
    add_faces(&build, 0, false);
    add_faces(&build, 1, operation == SOLID_DIFFERENCE);
    Solid result = {build.points, build.faces.faces, build.point_count, build.faces.count};
    result = solid_weld(arena, &result);
    return keep_result(arena, mark, &result);
}

// Combines neighbours, then neighbours of the results, and so on.
static Solid combine_pairs(Arena *arena, SolidOperation operation, const Solid *solids, uint32_t count) {
    if (count == 0)
        return (Solid){0};
    Solid *work = arena_alloc_array(arena, count, sizeof *work);
    memcpy(work, solids, count * sizeof *work);
    for (; count > 1; count = (count + 1) / 2)
        for (uint32_t i = 0; i < count; i += 2)
            work[i / 2] = i + 1 < count ? solid_combine(arena, operation, &work[i], &work[i + 1]) : work[i];
    return work[0];
}

Solid solid_combine_all(Arena *arena, SolidOperation operation, const Solid *solids, uint32_t count) {
    if (operation != SOLID_DIFFERENCE || count < 2)
        return combine_pairs(arena, operation, solids, count);
    Solid removed = combine_pairs(arena, SOLID_UNION, solids + 1, count - 1);
    return solid_combine(arena, SOLID_DIFFERENCE, &solids[0], &removed);
}

// Creates the part of the space above a plane as a box that is larger than every solid.
static Solid half_space(Arena *arena, const double origin[3], const double normal[3], double size) {
    static const uint32_t faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                          {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    Solid box = {.points = arena_alloc_array(arena, 8, sizeof *box.points),
                 .faces = arena_alloc_array(arena, 12, sizeof *box.faces),
                 .point_count = 8,
                 .face_count = 12};
    memcpy(box.faces, faces, sizeof faces);
    int axis = fabs(normal[1]) < fabs(normal[0]) ? 1 : 0;
    axis = fabs(normal[2]) < fabs(normal[axis]) ? 2 : axis;
    double across[3] = {0}, other[3], length = 0;
    int second = (axis + 1) % 3, third = (axis + 2) % 3;
    across[second] = normal[third], across[third] = -normal[second]; // across = normal x axis, up to its sign
    for (int k = 0; k < 3; k++)
        length += across[k] * across[k];
    for (int k = 0; k < 3; k++)
        across[k] /= sqrt(length);
    for (int k = 0; k < 3; k++)
        other[k] = normal[(k + 1) % 3] * across[(k + 2) % 3] - normal[(k + 2) % 3] * across[(k + 1) % 3];
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++) {
            double x = origin[k] + size * ((i & 1 ? across[k] : -across[k]) + (i & 2 ? other[k] : -other[k]) +
                                           (i & 4 ? normal[k] : 0));
            box.points[i][k] = (int32_t)floor(x + 0.5);
        }
    return box;
}

Solid solid_trim(Arena *arena, const SolidGrid *grid, const Solid *solid, const double origin[3],
                 const double normal[3]) {
    double unit[3], length = 0, distance = 0, foot[3];
    const double size = 1.75 * SOLID_MAX / 4; // more than the distance of a corner of the grid from its middle
    for (int k = 0; k < 3; k++)
        length = fmax(length, fabs(normal[k]));
    for (int k = 0; k < 3; k++)
        unit[k] = normal[k] / length;
    length = sqrt(unit[0] * unit[0] + unit[1] * unit[1] + unit[2] * unit[2]);
    if (!(length > 0) || !isfinite(length))
        return *solid;
    for (int k = 0; k < 3; k++) {
        unit[k] /= length;
        distance += unit[k] * ((origin[k] - grid->middle[k]) / grid->step);
    }
    if (!(distance < size))
        return *solid;
    if (distance < -size)
        return (Solid){0};
    for (int k = 0; k < 3; k++)
        foot[k] = unit[k] * distance;
    Solid half = half_space(arena, foot, unit, size);
    return solid_combine(arena, SOLID_DIFFERENCE, solid, &half);
}
