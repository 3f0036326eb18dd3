// mesh_hull.c: the convex hull of points (spec canvas3d.md 8.2). Points are added one by one. The faces that are
// visible from the new point are removed. New faces connect the edges of the resulting hole to the point.
#include "scene3d/matrix.h"
#include "scene3d/mesh.h"

#include <math.h>
#include <string.h>

enum { MIN_EXPONENT = -1000 }; // the power of two that scales smaller points would overflow

typedef struct Face {
    uint32_t corners[3]; // counter-clockwise seen from outside
    double normal[3];
    double offset;
} Face;

// A directed edge of a face that is visible from the point number `point`, in an open-addressing hash table.
typedef struct Edge {
    uint32_t from;
    uint32_t to;
    uint32_t point;
} Edge;

// The edge of the hole around the visible faces that begins at a point. It is valid for the point number `point`.
typedef struct Step {
    uint32_t to;
    uint32_t point;
} Step;

typedef struct Hull {
    Arena *arena;
    Edge *edges;
    uint32_t mask;     // number of elements of `edges`, a power of two, minus 1
    Step *boundary;    // one element for each point
    uint32_t first[4]; // the points of the tetrahedron with which the hull begins
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
    uint32_t *first = hull->first;
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

// Returns the element of the table for an edge: the edge itself, or a free element if the table does not contain it.
static Edge *edge_place(const Hull *hull, uint32_t from, uint32_t to, uint32_t point) {
    uint32_t place = (from * MESH_MAX_HULL + to) * 0x9E3779B1U >> 8; // Fibonacci hashing
    for (;; place++) {
        Edge *edge = &hull->edges[place & hull->mask];
        if (edge->point != point || (edge->from == from && edge->to == to))
            return edge;
    }
}

// Returns true if the visible face number `face` has no visible neighbour at its edge number k.
static bool is_boundary(const Hull *hull, uint32_t face, int k, uint32_t point) {
    const uint32_t *corners = hull->faces[face].corners;
    return edge_place(hull, corners[(k + 1) % 3], corners[k], point)->point != point;
}

// Returns true if the hole that the first `seen` faces leave has one boundary, which passes through each point at most
// once. Otherwise, new faces would not make a closed surface. Rounding errors cause this if points are very close to
// planes through others.
static bool has_one_boundary(Hull *hull, uint32_t seen, uint32_t point) {
    uint32_t count = 0, first = 0;
    for (uint32_t i = 0; i < seen; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t *corners = hull->faces[i].corners;
            if (!is_boundary(hull, i, k, point))
                continue;
            Step *step = &hull->boundary[corners[k]];
            if (step->point == point)
                return false;
            *step = (Step){.to = corners[(k + 1) % 3], .point = point};
            first = corners[k];
            count++;
        }
    uint32_t at = first, steps = 0;
    do {
        if (hull->boundary[at].point != point)
            return false;
        at = hull->boundary[at].to;
        steps++;
    } while (at != first && steps < count);
    return at == first && steps == count;
}

// Adds the point with this index, if it is outside the hull.
static void add_point(Hull *hull, uint32_t index) {
    uint32_t seen = 0; // number of faces that are visible from the point; they are moved to the front of the list
    uint32_t point = index + 1; // 0: elements that were never used
    arena_charge(hull->arena, 1 + hull->count / 4);
    for (uint32_t i = 0; i < hull->count; i++)
        if (plane_distance(&hull->faces[i], hull->points[index]) > hull->thick) {
            Face face = hull->faces[i];
            hull->faces[i] = hull->faces[seen];
            hull->faces[seen++] = face;
        }
    arena_charge(hull->arena, 8 * (uint64_t)seen);
    for (uint32_t i = 0; i < seen; i++)
        for (int k = 0; k < 3; k++) {
            uint32_t from = hull->faces[i].corners[k], to = hull->faces[i].corners[(k + 1) % 3];
            *edge_place(hull, from, to, point) = (Edge){from, to, point};
        }
    if (seen == 0 || !has_one_boundary(hull, seen, point))
        return;
    for (uint32_t i = 0; i < seen; i++)
        for (int k = 0; k < 3; k++)
            if (is_boundary(hull, i, k, point))
                add_face(hull, hull->faces[i].corners[k], hull->faces[i].corners[(k + 1) % 3], index);
    hull->count -= seen;
    memmove(hull->faces, hull->faces + seen, hull->count * sizeof *hull->faces);
}

// Copies the points, multiplied by a power of two so that the largest coordinate is about 1: products of coordinates
// must neither overflow nor underflow. Multiplying by a power of two changes no faces.
static const double (*scale_points(Arena *arena, const double *vertices, uint32_t count))[3] {
    double *scaled = arena_alloc_array(arena, 3 * (size_t)count, sizeof *scaled), max = 0;
    int exponent;
    for (size_t i = 0; i < 3 * (size_t)count; i++)
        max = fmax(max, fabs(vertices[i]));
    frexp(max, &exponent);
    double scale = ldexp(1, exponent < MIN_EXPONENT ? -MIN_EXPONENT : -exponent);
    for (size_t i = 0; i < 3 * (size_t)count; i++)
        scaled[i] = vertices[i] * scale;
    return (const double(*)[3])scaled;
}

const double *mesh_hull(Arena *arena, const double *vertices, uint32_t count, uint32_t *numbers) {
    Hull hull = {.arena = arena, .points = scale_points(arena, vertices, count)};
    if (count < 4 || !begin_hull(&hull, count))
        return NULL;
    // A closed surface of n points has at most 2n - 4 triangles, thus 6n - 12 edges.
    uint32_t places = 16;
    while (places < 12 * count)
        places *= 2;
    hull.mask = places - 1;
    hull.edges = arena_alloc_array(arena, places, sizeof *hull.edges);
    hull.boundary = arena_alloc_array(arena, count, sizeof *hull.boundary);
    memset(hull.edges, 0, places * sizeof *hull.edges);
    memset(hull.boundary, 0, count * sizeof *hull.boundary);
    for (uint32_t i = 0; i < count; i++)
        if (i != hull.first[0] && i != hull.first[1] && i != hull.first[2] && i != hull.first[3])
            add_point(&hull, i);
    double *faces = arena_alloc_array(arena, 3 * (size_t)hull.count, sizeof *faces);
    for (uint32_t i = 0; i < hull.count; i++)
        for (int k = 0; k < 3; k++)
            faces[3 * (size_t)i + (size_t)k] = hull.faces[i].corners[k];
    *numbers = 3 * hull.count;
    return faces;
}
