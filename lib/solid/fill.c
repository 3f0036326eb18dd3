// fill.c: see fill.h.
//
// Holes are joined to the polygons around them, and then ears are cut off. If rounding has left no proper ear, a flat
// corner and then any corner is cut off. So each side of a polygon borders exactly one triangle of the result.
#include "solid/fill.h"

#include "solid/predicates.h"

#include <stdlib.h>
#include <string.h>

typedef struct Corner {
    uint32_t point;
    uint32_t next;
    uint32_t previous;
} Corner;

typedef struct Loop {
    uint32_t first;     // a corner
    uint32_t rightmost; // corner with the largest x
    bool hole;
} Loop;

typedef struct Filling {
    Arena *arena;
    FaceBuilder *builder;
    const int32_t (*points)[3];
    int x;
    int y;
    Corner *corners; // room for two more corners per hole
    uint32_t corner_count;
    Loop *loops;
    uint32_t loop_count;
} Filling;

void face_builder_add(Arena *arena, FaceBuilder *builder, uint32_t a, uint32_t b, uint32_t c) {
    builder->faces =
        arena_grow_array(arena, builder->faces, builder->count, &builder->capacity, sizeof *builder->faces);
    memcpy(builder->faces[builder->count++], (uint32_t[3]){a, b, c}, sizeof *builder->faces);
}

static const int32_t *place_of(const Filling *filling, uint32_t corner) {
    return filling->points[filling->corners[corner].point];
}

static int64_t corner_area(const Filling *filling, uint32_t a, uint32_t b, uint32_t c) {
    return area_of(place_of(filling, a), place_of(filling, b), place_of(filling, c), filling->x, filling->y);
}

static int compare_sides(const void *a, const void *b) {
    const PolygonSide *one = a, *two = b;
    if (one->from != two->from)
        return one->from < two->from ? -1 : 1;
    return one->to < two->to ? -1 : one->to > two->to;
}

static uint32_t find_side(const PolygonSide *sides, uint32_t count, uint32_t from) {
    uint32_t low = 0, high = count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (sides[middle].from < from)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void finish_loop(Filling *filling, uint32_t first, uint32_t end) {
    Loop *loop = &filling->loops[filling->loop_count];
    double area = 0;
    *loop = (Loop){.first = first, .rightmost = first};
    for (uint32_t i = first; i < end; i++) {
        filling->corners[i].next = i + 1 < end ? i + 1 : first;
        filling->corners[i].previous = i > first ? i - 1 : end - 1;
        if (place_of(filling, i)[filling->x] > place_of(filling, loop->rightmost)[filling->x])
            loop->rightmost = i;
        if (i > first)
            area += (double)corner_area(filling, first, i, i + 1 < end ? i + 1 : first);
    }
    loop->hole = area < 0;
    filling->loop_count += end - first > 2; // a loop of two sides needs no triangle
}

static void make_loops(Filling *filling, PolygonSide *sides, uint32_t count) {
    bool *used = arena_alloc_array(filling->arena, count, sizeof *used);
    uint32_t *skipped = arena_alloc_array(filling->arena, count, sizeof *skipped); // by the first side of a point
    memset(used, 0, count * sizeof *used);
    memset(skipped, 0, count * sizeof *skipped);
    qsort(sides, count, sizeof *sides, compare_sides);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t first = filling->corner_count;
        for (uint32_t at = i; !used[at];) {
            used[at] = true;
            filling->corners[filling->corner_count++] = (Corner){.point = sides[at].from};
            uint32_t group = find_side(sides, count, sides[at].to);
            at = group + skipped[group];
            while (at < count && used[at] && sides[at].from == sides[group].from)
                at++;
            skipped[group] = at - group;
            if (at >= count || sides[at].from != sides[group].from)
                break;
        }
        if (filling->corner_count > first)
            finish_loop(filling, first, filling->corner_count);
    }
}

// Returns whether p is in the triangle a, b, c, which is counter-clockwise, or on its border.
static bool in_triangle(const Filling *filling, const int32_t *a, const int32_t *b, const int32_t *c,
                        const int32_t *p) {
    int x = filling->x, y = filling->y;
    return area_of(a, b, p, x, y) >= 0 && area_of(b, c, p, x, y) >= 0 && area_of(c, a, p, x, y) >= 0;
}

static int compare_holes(const void *a, const void *b) {
    const Loop *one = a, *two = b;
    return one->first < two->first ? -1 : one->first > two->first;
}

// Returns the corner of an outer polygon that a hole can be joined to. It is visible from the hole's rightmost corner.
// Returns UINT32_MAX if there is none.
static uint32_t find_bridge(const Filling *filling, const bool *outer, uint32_t from) {
    const int32_t *p = place_of(filling, from);
    int x = filling->x, y = filling->y;
    double nearest = 0;
    uint32_t found = UINT32_MAX;
    for (uint32_t i = 0; i < filling->corner_count; i++) { // the side that a ray to the right meets first
        if (!outer[i])
            continue;
        const int32_t *a = place_of(filling, i), *b = place_of(filling, filling->corners[i].next);
        if (!(a[y] <= p[y] && p[y] <= b[y]) || a[y] == b[y])
            continue;
        double at = a[x] + (double)(p[y] - a[y]) / (b[y] - a[y]) * (b[x] - (double)a[x]);
        if (at < p[x] || (found != UINT32_MAX && at >= nearest))
            continue;
        nearest = at;
        found = a[x] > b[x] ? i : filling->corners[i].next;
    }
    if (found == UINT32_MAX)
        return found;
    // Another corner may be in front of this one: takes the one at the smallest angle to the ray.
    const int32_t *end = place_of(filling, found);
    int32_t hit[3] = {0};
    hit[x] = nearest < end[x] ? (int32_t)nearest : end[x];
    hit[y] = p[y];
    uint32_t best = found;
    for (uint32_t i = 0; i < filling->corner_count; i++) {
        const int32_t *c = place_of(filling, i);
        if (!outer[i] || c[x] < p[x] || i == found)
            continue;
        bool inside = end[y] < p[y] ? in_triangle(filling, p, end, hit, c) : in_triangle(filling, p, hit, end, c);
        if (!inside || memcmp(c, end, sizeof(Position)) == 0)
            continue;
        const int32_t *d = place_of(filling, best);
        double one = ((double)c[y] - p[y]) * ((double)d[x] - p[x]), two = ((double)d[y] - p[y]) * ((double)c[x] - p[x]);
        if (end[y] < p[y] ? one > two : one < two)
            best = i;
    }
    return best;
}

// Joins a hole to a polygon by two sides, there and back.
static void add_bridge(Filling *filling, uint32_t hole, uint32_t polygon) {
    Corner *corners = filling->corners;
    uint32_t hole_copy = filling->corner_count++, polygon_copy = filling->corner_count++;
    corners[hole_copy] = (Corner){corners[hole].point, polygon_copy, corners[hole].previous};
    corners[polygon_copy] = (Corner){corners[polygon].point, corners[polygon].next, hole_copy};
    corners[corners[hole].previous].next = hole_copy;
    corners[corners[polygon].next].previous = polygon_copy;
    corners[polygon].next = hole;
    corners[hole].previous = polygon;
}

static int compare_rightmost(const Filling *filling, const Loop *one, const Loop *two) {
    int32_t a = place_of(filling, one->rightmost)[filling->x], b = place_of(filling, two->rightmost)[filling->x];
    return a != b ? (a > b ? -1 : 1) : compare_holes(one, two);
}

static void join_holes(Filling *filling) {
    Loop *holes = arena_alloc_array(filling->arena, filling->loop_count, sizeof *holes);
    bool *outer = arena_alloc_array(filling->arena, 3 * (size_t)filling->corner_count + 2, sizeof *outer);
    uint32_t hole_count = 0, kept = 0;
    memset(outer, 0, 3 * (size_t)filling->corner_count + 2);
    for (uint32_t i = 0; i < filling->loop_count; i++) {
        Loop loop = filling->loops[i];
        if (loop.hole) {
            uint32_t at = hole_count++;
            for (; at > 0 && compare_rightmost(filling, &loop, &holes[at - 1]) < 0; at--)
                holes[at] = holes[at - 1];
            holes[at] = loop;
            continue;
        }
        uint32_t corner = loop.first;
        do
            outer[corner] = true;
        while ((corner = filling->corners[corner].next) != loop.first);
        filling->loops[kept++] = loop;
    }
    arena_charge(filling->arena, (uint64_t)hole_count * (1 + filling->corner_count / 2 + hole_count));
    for (uint32_t i = 0; i < hole_count; i++) {
        uint32_t bridge = find_bridge(filling, outer, holes[i].rightmost), corner = holes[i].first;
        do
            outer[corner] = true;
        while ((corner = filling->corners[corner].next) != holes[i].first);
        if (bridge == UINT32_MAX) {
            filling->loops[kept++] = holes[i];
            continue;
        }
        outer[filling->corner_count] = outer[filling->corner_count + 1] = true;
        add_bridge(filling, holes[i].rightmost, bridge);
    }
    filling->loop_count = kept;
}

// Levels of ears: a proper triangle, one without area, any.
enum { EAR_PROPER, EAR_FLAT, EAR_ANY };

static bool is_ear(const Filling *filling, uint32_t corner, int level) {
    const Corner *corners = filling->corners;
    uint32_t before = corners[corner].previous, after = corners[corner].next;
    int64_t area = corner_area(filling, before, corner, after);
    if (level == EAR_ANY)
        return true;
    if (level == EAR_FLAT ? area < 0 : area <= 0)
        return false;
    const int32_t *a = place_of(filling, before), *b = place_of(filling, corner), *c = place_of(filling, after);
    int x = filling->x, y = filling->y;
    int32_t low[2], high[2];
    for (int k = 0; k < 2; k++) {
        int axis = k ? y : x;
        low[k] = a[axis] < b[axis] ? a[axis] : b[axis];
        low[k] = c[axis] < low[k] ? c[axis] : low[k];
        high[k] = a[axis] > b[axis] ? a[axis] : b[axis];
        high[k] = c[axis] > high[k] ? c[axis] : high[k];
    }
    for (uint32_t i = corners[after].next; i != before; i = corners[i].next) {
        const int32_t *p = place_of(filling, i);
        if (p[x] < low[0] || p[x] > high[0] || p[y] < low[1] || p[y] > high[1])
            continue;
        if (p == a || p == b || p == c || !in_triangle(filling, a, b, c, p))
            continue;
        if (corner_area(filling, corners[i].previous, i, corners[i].next) <= 0)
            return false;
    }
    return true;
}

static void cut_ears(Filling *filling, uint32_t start) {
    Corner *corners = filling->corners;
    uint32_t left = 1, failures = 0;
    for (uint32_t i = corners[start].next; i != start; i = corners[i].next)
        left++;
    int level = EAR_PROPER;
    for (uint32_t at = start; left > 2;) {
        arena_charge(filling->arena, 1 + left / 4);
        uint32_t before = corners[at].previous, after = corners[at].next;
        if (is_ear(filling, at, level)) {
            face_builder_add(filling->arena, filling->builder, corners[before].point, corners[at].point,
                             corners[after].point);
            corners[before].next = after;
            corners[after].previous = before;
            left--;
            failures = 0;
            level = EAR_PROPER;
            at = corners[after].next; // skips a corner, so that the triangles do not become narrow
        } else {
            at = after;
            if (++failures > left) {
                level++;
                failures = 0;
            }
        }
    }
}

void fill_polygons(Arena *arena, FaceBuilder *builder, const int32_t (*points)[3], PolygonSide *sides, uint32_t count,
                   int x, int y) {
    Filling filling = {.arena = arena,
                       .builder = builder,
                       .points = points,
                       .x = x,
                       .y = y,
                       .corners = arena_alloc_array(arena, 3 * (size_t)count, sizeof *filling.corners),
                       .loops = arena_alloc_array(arena, count, sizeof *filling.loops)};
    make_loops(&filling, sides, count);
    if (filling.loop_count > 1)
        join_holes(&filling);
    for (uint32_t i = 0; i < filling.loop_count; i++)
        cut_ears(&filling, filling.loops[i].first);
}
