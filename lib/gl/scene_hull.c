// scene_hull.c: the convex hull of points (spec canvas3d.md 8.2). Points are added one by one. The faces that are
// visible from the new point are removed. New faces connect the edges of the resulting hole to the point.
#include "gl/scene_matrix.h"
#include "gl/scene_mesh.h"

#include <math.h>
#include <string.h>

typedef struct Face {
    uint32_t corners[3]; // counter-clockwise seen from outside
    double normal[3];
    double offset;
} Face;

typedef struct Hull {
    Arena *arena;
    const double (*points)[3];
    Face *faces;
    uint32_t count;
    uint32_t capacity;
    double thick; // a point whose distance from a plane is at most this is treated as a point of the plane
} Hull;

static double plane_distance(const Face *face, const double point[3]) {
    return vector_dot(face->normal, point) - face->offset;
}

static void add_face(Hull *hull, uint32_t a, uint32_t b, uint32_t c) {
    const double *p = hull->points[a], *q = hull->points[b], *r = hull->points[c];
    double one[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]}, two[3] = {r[0] - p[0], r[1] - p[1], r[2] - p[2]};
    hull->faces = arena_grow_array(hull->arena, hull->faces, hull->count, &hull->capacity, sizeof *hull->faces);
    Face *face = &hull->faces[hull->count++];
    *face = (Face){.corners = {a, b, c}};
    vector_cross(one, two, face->normal);
    vector_normalise(face->normal);
    face->offset = vector_dot(face->normal, p);
}

// Returns the distance of p from the point, line or plane through the first `count` points (1 to 3).
static double distance_from(const Hull *hull, const uint32_t *first, int count, const double p[3]) {
    const double *a = hull->points[first[0]];
    double d[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]}, axis[3], across[3];
    if (count == 1)
        return sqrt(vector_dot(d, d));
    for (int k = 0; k < 3; k++)
        axis[k] = hull->points[first[1]][k] - a[k];
    vector_normalise(axis);
    if (count == 2) {
        vector_cross(axis, d, across);
        return sqrt(vector_dot(across, across));
    }
    return fabs(plane_distance(&hull->faces[0], p));
}

// Creates the faces of a tetrahedron of four points that are far apart. Returns false if all points lie in a plane.
static bool begin_hull(Hull *hull, uint32_t count) {
    uint32_t first[4] = {0};
    for (int found = 1; found < 4; found++) {
        double max = 0;
        for (uint32_t i = 0; i < count; i++) {
            double away = distance_from(hull, first, found, hull->points[i]);
            if (away > max)
                max = away, first[found] = i;
        }
        if (found == 1)
            hull->thick = 1e-9 * max;
        if (!(max > hull->thick))
            return false;
        if (found == 2)
            add_face(hull, first[0], first[1], first[2]);
    }
    uint32_t a = first[0], b = first[1], c = first[2], d = first[3];
    if (plane_distance(&hull->faces[0], hull->points[d]) > 0)
        b = first[2], c = first[1];
    hull->count = 0;
    add_face(hull, a, b, c);
    add_face(hull, a, d, b);
    add_face(hull, b, d, c);
    add_face(hull, c, d, a);
    return true;
}

// Returns true if one of the first `count` faces has the edge from a to b.
static bool has_edge(const Hull *hull, uint32_t count, uint32_t a, uint32_t b) {
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            if (hull->faces[i].corners[k] == a && hull->faces[i].corners[(k + 1) % 3] == b)
                return true;
    return false;
}

static void add_point(Hull *hull, uint32_t point) {
    uint32_t seen = 0; // number of faces that are visible from the point; they are moved to the front of the list
    arena_charge(hull->arena, 1 + hull->count / 4);
    for (uint32_t i = 0; i < hull->count; i++)
        if (plane_distance(&hull->faces[i], hull->points[point]) > hull->thick) {
            Face face = hull->faces[i];
            hull->faces[i] = hull->faces[seen];
            hull->faces[seen++] = face;
        }
    arena_charge(hull->arena, (uint64_t)seen * seen); // has_edge compares each edge with the edges of all visible faces
    for (uint32_t i = 0; i < seen; i++)
        for (int k = 0; k < 3; k++) {
            uint32_t a = hull->faces[i].corners[k], b = hull->faces[i].corners[(k + 1) % 3];
            if (!has_edge(hull, seen, b, a))
                add_face(hull, a, b, point);
        }
    hull->count -= seen;
    memmove(hull->faces, hull->faces + seen, hull->count * sizeof *hull->faces);
}

const double *mesh_hull(Arena *arena, const double *vertices, uint32_t count, uint32_t *numbers) {
    Hull hull = {.arena = arena};
    double(*points)[3] = arena_alloc_array(arena, count, sizeof *points);
    memcpy(points, vertices, count * sizeof *points);
    hull.points = (const double(*)[3])points;
    if (count < 4 || !begin_hull(&hull, count))
        return NULL;
    for (uint32_t i = 0; i < count; i++)
        add_point(&hull, i);
    double *faces = arena_alloc_array(arena, 3 * (size_t)hull.count, sizeof *faces);
    for (uint32_t i = 0; i < hull.count; i++)
        for (int k = 0; k < 3; k++)
            faces[3 * (size_t)i + (size_t)k] = hull.faces[i].corners[k];
    *numbers = 3 * hull.count;
    return faces;
}
