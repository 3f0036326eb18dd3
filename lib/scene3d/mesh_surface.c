// mesh_surface.c: operations on a model's surface (spec canvas3d.md 7); see mesh.h.
//
// mesh_snap unites corners across each edge that is flat enough, so corners share a normal if a chain of such edges
// connects them. A normal is the sum of the triangles' normals, weighted by their angles at the point.
#include "maths/maths.h"
#include "scene3d/matrix.h"
#include "scene3d/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double TURN = 6.283185307179586;

static void corner_at(const Mesh *mesh, uint32_t index, double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = mesh->vertices[mesh->indices[index]].position[k];
}

// Computes the unit normal of a triangle, or 0;0;0 if the triangle has no area.
static void triangle_normal(const Mesh *mesh, uint32_t triangle, double normal[3]) {
    double a[3], b[3], c[3];
    corner_at(mesh, 3 * triangle, a);
    corner_at(mesh, 3 * triangle + 1, b);
    corner_at(mesh, 3 * triangle + 2, c);
    for (int k = 0; k < 3; k++) {
        b[k] -= a[k];
        c[k] -= a[k];
    }
    vector_cross(b, c, normal);
    if (!vector_normalise(normal))
        memset(normal, 0, 3 * sizeof *normal);
}

static void set_normal(MeshVertex *vertex, const double normal[3]) {
    for (int k = 0; k < 3; k++)
        vertex->normal[k] = (float)normal[k];
}

void mesh_flat(Arena *arena, Mesh *mesh) {
    MeshVertex *vertices = arena_alloc_array(arena, mesh->index_count, sizeof *vertices);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        double normal[3];
        triangle_normal(mesh, i / 3, normal);
        vertices[i] = mesh->vertices[mesh->indices[i]];
        set_normal(&vertices[i], normal);
    }
    for (uint32_t i = 0; i < mesh->index_count; i++)
        mesh->indices[i] = i;
    mesh->vertices = vertices;
    mesh->vertex_count = mesh->index_count;
}

typedef struct Spot {
    float position[3];
    uint32_t vertex;
} Spot;

static int compare_spots(const void *a, const void *b) {
    const Spot *one = a, *two = b;
    for (int k = 0; k < 3; k++)
        if (one->position[k] < two->position[k] || one->position[k] > two->position[k])
            return one->position[k] < two->position[k] ? -1 : 1;
    return one->vertex < two->vertex ? -1 : one->vertex > two->vertex;
}

// Returns an array that contains, for each vertex, the index of the first vertex at the same position.
static uint32_t *join_positions(Arena *arena, const Mesh *mesh) {
    Spot *spots = arena_alloc_array(arena, mesh->vertex_count, sizeof *spots);
    uint32_t *joined = arena_alloc_array(arena, mesh->vertex_count, sizeof *joined), first = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        memcpy(spots[i].position, mesh->vertices[i].position, sizeof spots[i].position);
        spots[i].vertex = i;
    }
    qsort(spots, mesh->vertex_count, sizeof *spots, compare_spots);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float *here = spots[i].position, *there = spots[first].position;
        if (here[0] != there[0] || here[1] != there[1] || here[2] != there[2])
            first = i;
        joined[spots[i].vertex] = spots[first].vertex;
    }
    return joined;
}

// An edge of a triangle, from the corner with the index `corner` to the triangle's next corner. `low` and `high` are
// the lower and the higher of the two vertices at the ends, as numbered by join_positions.
typedef struct Edge {
    uint32_t low;
    uint32_t high;
    uint32_t corner;
} Edge;

static int compare_edges(const void *a, const void *b) {
    const Edge *one = a, *two = b;
    if (one->low != two->low)
        return one->low < two->low ? -1 : 1;
    if (one->high != two->high)
        return one->high < two->high ? -1 : 1;
    return one->corner < two->corner ? -1 : one->corner > two->corner;
}

static uint32_t next_corner(uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

static uint32_t root_of(uint32_t *parents, uint32_t i) {
    while (parents[i] != i)
        i = parents[i] = parents[parents[i]];
    return i;
}

static void unite_corners(uint32_t *parents, uint32_t a, uint32_t b) {
    a = root_of(parents, a);
    b = root_of(parents, b);
    parents[a > b ? a : b] = a > b ? b : a;
}

// At both ends of an edge that two triangles share, unites the corners of the two triangles. The edge starts at corner
// a of one triangle and at corner b of the other triangle.
static void unite_across(uint32_t *parents, const uint32_t *points, uint32_t a, uint32_t b) {
    uint32_t a_end = next_corner(a), b_end = next_corner(b);
    bool same = points[a] == points[b]; // both triangles have the edge in the same direction
    unite_corners(parents, a, same ? b : b_end);
    unite_corners(parents, a_end, same ? b_end : b);
}

// Unites corners that will share a normal. Returns the union-find array, which contains the parent of each corner.
// United corners have the same root.
static uint32_t *find_roots(Arena *arena, const Mesh *mesh, const uint32_t *points, const double (*normals)[3],
                            double turns) {
    uint32_t count = mesh->index_count;
    uint32_t *parents = arena_alloc_array(arena, count, sizeof *parents);
    Edge *edges = arena_alloc_array(arena, count, sizeof *edges);
    double min_cosine = maths_cos(TURN * turns);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t a = points[i], b = points[next_corner(i)];
        parents[i] = i;
        edges[i] = (Edge){a < b ? a : b, a < b ? b : a, i};
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    for (uint32_t i = 0; i < count; i++) // each triangle at an edge is compared with the previous triangle at this edge
        if (i > 0 && edges[i].low == edges[i - 1].low && edges[i].high == edges[i - 1].high &&
            vector_dot(normals[edges[i].corner / 3], normals[edges[i - 1].corner / 3]) >= min_cosine - 1e-9)
            unite_across(parents, points, edges[i - 1].corner, edges[i].corner);
    return parents;
}

static double angle_at(const Mesh *mesh, uint32_t corner) {
    uint32_t after = next_corner(corner), before = next_corner(after);
    double p[3], a[3], b[3];
    corner_at(mesh, corner, p);
    corner_at(mesh, after, a);
    corner_at(mesh, before, b);
    for (int k = 0; k < 3; k++) {
        a[k] -= p[k];
        b[k] -= p[k];
    }
    if (!vector_normalise(a) || !vector_normalise(b))
        return 0;
    double cosine = vector_dot(a, b);
    return maths_acos(cosine < -1 ? -1 : cosine > 1 ? 1 : cosine);
}

void mesh_snap(Arena *arena, Mesh *mesh, double turns) {
    uint32_t count = mesh->index_count, vertex_count = 0;
    arena_charge(arena, (uint64_t)count * 40); // measured: about 0.3 µs per corner on an idle machine
    uint32_t *joined = join_positions(arena, mesh), *points = arena_alloc_array(arena, count, sizeof *points);
    double(*normals)[3] = arena_alloc_array(arena, count / 3, sizeof *normals);
    double(*sums)[3] = arena_alloc_array(arena, count > mesh->vertex_count ? count : mesh->vertex_count, sizeof *sums);
    memset(sums, 0, (count > mesh->vertex_count ? count : mesh->vertex_count) * sizeof *sums);
    for (uint32_t i = 0; i < count; i++)
        points[i] = joined[mesh->indices[i]];
    for (uint32_t i = 0; i < count / 3; i++)
        triangle_normal(mesh, i, normals[i]);
    uint32_t *roots = turns < 0.5 ? find_roots(arena, mesh, points, (const double(*)[3])normals, turns) : points;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t root = turns < 0.5 ? root_of(roots, i) : roots[i];
        double angle = angle_at(mesh, i);
        for (int k = 0; k < 3; k++)
            sums[root][k] += angle * normals[i / 3][k];
    }
    // Creates one vertex per corner, with the normal of the corner's root.
    MeshVertex *vertices = arena_alloc_array(arena, count, sizeof *vertices);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t root = turns < 0.5 ? root_of(roots, i) : roots[i];
        double normal[3] = {sums[root][0], sums[root][1], sums[root][2]};
        if (!vector_normalise(normal))
            memcpy(normal, normals[i / 3], sizeof normal);
        vertices[vertex_count] = mesh->vertices[mesh->indices[i]];
        set_normal(&vertices[vertex_count], normal);
        mesh->indices[i] = vertex_count++;
    }
    mesh->vertices = vertices;
    mesh->vertex_count = vertex_count;
}

void mesh_invert(Mesh *mesh) {
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        for (int k = 0; k < 3; k++)
            mesh->vertices[i].normal[k] = -mesh->vertices[i].normal[k];
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        uint32_t b = mesh->indices[i + 1];
        mesh->indices[i + 1] = mesh->indices[i + 2];
        mesh->indices[i + 2] = b;
    }
}

static void remap_sphere(MeshVertex *vertex) {
    double x = vertex->position[0], y = vertex->position[1], z = vertex->position[2];
    double u = maths_atan2(y, x) / TURN;
    vertex->uv[0] = (float)(u - floor(u));
    vertex->uv[1] = (float)(maths_atan2(z, sqrt(x * x + y * y)) / (TURN / 2) + 0.5);
}

// Mends the seam where u wraps from 1 to 0. If a triangle crosses the seam, replaces those of its corners that have a
// small u by copies with u + 1.
static void mend_seam(Arena *arena, Mesh *mesh) {
    MeshVertex *vertices = arena_alloc_array(arena, (size_t)mesh->vertex_count + mesh->index_count, sizeof *vertices);
    memcpy(vertices, mesh->vertices, mesh->vertex_count * sizeof *vertices);
    mesh->vertices = vertices;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        uint32_t *corners = mesh->indices + i;
        bool far = false;
        for (int k = 0; k < 3; k++)
            far |= vertices[corners[k]].uv[0] > 0.75f && vertices[corners[k]].uv[0] <= 1;
        for (int k = 0; k < 3 && far; k++)
            if (vertices[corners[k]].uv[0] < 0.25f) {
                vertices[mesh->vertex_count] = vertices[corners[k]];
                vertices[mesh->vertex_count].uv[0] += 1;
                corners[k] = mesh->vertex_count++;
            }
    }
}

void mesh_remap(Arena *arena, Mesh *mesh, int how) {
    float low[3], high[3];
    mesh_bounds(mesh, low, high);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        MeshVertex *vertex = &mesh->vertices[i];
        if (how == REMAP_SPHERE) {
            remap_sphere(vertex);
            continue;
        }
        for (int k = 0; k < 2; k++)
            vertex->uv[k] = high[k] > low[k] ? (vertex->position[k] - low[k]) / (high[k] - low[k]) : 0;
        if (how == REMAP_BOOK)
            vertex->uv[0] = vertex->normal[2] >= 0 ? 0.5f + vertex->uv[0] / 2 : 0.5f - vertex->uv[0] / 2;
    }
    if (how == REMAP_SPHERE)
        mend_seam(arena, mesh);
}
