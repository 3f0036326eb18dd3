// mesh.c: box, sphere, cylinder and cone; see mesh.h.
//
// Corners at the same point are separate vertices if their normals or texture coordinates differ.
#include "scene3d/mesh.h"

#include "maths/maths.h"

#include <math.h>
#include <string.h>

static const double TURN = 6.283185307179586;

static Mesh new_mesh(Arena *arena, uint32_t vertices, uint32_t triangles) {
    return (Mesh){.vertices = arena_alloc_array(arena, vertices, sizeof(MeshVertex)),
                  .indices = arena_alloc_array(arena, 3 * (size_t)triangles, sizeof(uint32_t))};
}

static uint32_t add_vertex(Mesh *mesh, const double position[3], const double normal[3], double u, double v) {
    MeshVertex *vertex = &mesh->vertices[mesh->vertex_count];
    for (int k = 0; k < 3; k++) {
        vertex->position[k] = (float)position[k];
        vertex->normal[k] = (float)normal[k];
    }
    vertex->uv[0] = (float)u;
    vertex->uv[1] = (float)v;
    return mesh->vertex_count++;
}

static void add_triangle(Mesh *mesh, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t *index = mesh->indices + mesh->index_count;
    index[0] = a, index[1] = b, index[2] = c;
    mesh->index_count += 3;
}

Mesh mesh_box(Arena *arena, bool repeat) {
    // For each face, the positions, in units of half an edge, of the corners with texture coordinates (0, 0), (1, 0)
    // and (0, 1).
    static const int corners[6][3][3] = {
        {{1, -1, 1}, {1, -1, -1}, {1, 1, 1}},  {{-1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}},
        {{-1, 1, 1}, {1, 1, 1}, {-1, 1, -1}},  {{-1, -1, -1}, {1, -1, -1}, {-1, -1, 1}},
        {{-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}}, {{1, -1, -1}, {-1, -1, -1}, {1, 1, -1}},
    };
    Mesh mesh = new_mesh(arena, 24, 12);
    for (int face = 0; face < 6; face++) {
        double normal[3] = {0};
        normal[face / 2] = face % 2 ? -1 : 1;
        for (int corner = 0; corner < 4; corner++) {
            int right = corner & 1, upper = corner >> 1;
            double place[3], u = repeat ? right : (face + right) / 6.0;
            for (int k = 0; k < 3; k++) {
                int a = corners[face][0][k], b = corners[face][1][k], c = corners[face][2][k];
                place[k] = 0.5 * (a + right * (b - a) + upper * (c - a));
            }
            add_vertex(&mesh, place, normal, u, upper);
        }
        uint32_t first = (uint32_t)face * 4;
        add_triangle(&mesh, first, first + 1, first + 3);
        add_triangle(&mesh, first, first + 3, first + 2);
    }
    return mesh;
}

static void add_octant(Mesh *mesh, uint32_t n, uint32_t side, int half) {
    uint32_t start = mesh->vertex_count;
    for (uint32_t i = 0; i <= n; i++)
        for (uint32_t j = 0; j <= i; j++) {
            double latitude = half * (1 - (double)i / n) / 4;
            double longitude = i ? (side + (double)j / i) / 4 : (side + 0.5) / 4;
            double ring = i ? maths_cos(TURN * latitude) : 0;
            double place[3] = {ring * maths_cos(TURN * longitude), ring * maths_sin(TURN * longitude),
                               i ? maths_sin(TURN * latitude) : half};
            add_vertex(mesh, place, place, longitude, 2 * latitude + 0.5);
        }
    // Row i, counted from the pole, starts after 1 + 2 + … + i vertices. Columns are in counter-clockwise order when
    // seen from the north pole.
    for (uint32_t i = 1; i <= n; i++)
        for (uint32_t j = 1; j <= i; j++) {
            uint32_t a = start + i * (i + 1) / 2 + j, b = start + (i - 1) * i / 2 + j - 1;
            half > 0 ? add_triangle(mesh, a - 1, a, b) : add_triangle(mesh, a, a - 1, b);
            if (j < i)
                half > 0 ? add_triangle(mesh, a, b + 1, b) : add_triangle(mesh, a, b, b + 1);
        }
}

Mesh mesh_sphere(Arena *arena, uint32_t segments) {
    uint32_t n = (segments < 4 ? 4 : segments + 3) / 4;
    Mesh mesh = new_mesh(arena, 8 * ((n + 1) * (n + 2) / 2), 8 * n * n);
    for (uint32_t side = 0; side < 4; side++) {
        add_octant(&mesh, n, side, 1);
        add_octant(&mesh, n, side, -1);
    }
    return mesh;
}

// Fills the area between an arc of corners and its chord with triangles. The triangles are as large as possible,
// because a pixel on an edge is shaded once for each adjacent triangle.
static void add_arc(Mesh *mesh, uint32_t from, uint32_t to, uint32_t n) {
    uint32_t middle = (from + to) / 2;
    if (to - from < 2)
        return;
    add_triangle(mesh, from, middle, to % n);
    add_arc(mesh, from, middle, n);
    add_arc(mesh, middle, to, n);
}

Mesh mesh_disc(Arena *arena, uint32_t segments) {
    uint32_t n = (segments < 4 ? 4 : segments + 3) / 4 * 4;
    Mesh mesh = new_mesh(arena, n, n - 2);
    for (uint32_t i = 0; i < n; i++)
        add_vertex(&mesh, (double[3]){maths_cos(TURN * i / n), maths_sin(TURN * i / n), 0}, (double[3]){0, 0, 1}, 0, 0);
    add_triangle(&mesh, 0, n / 3, 2 * n / 3);
    add_arc(&mesh, 0, n / 3, n);
    add_arc(&mesh, n / 3, 2 * n / 3, n);
    add_arc(&mesh, 2 * n / 3, n, n);
    return mesh;
}

// Adds a vertex of the rim. `slope` is the slope of the vertex's normal: 0 for a cylinder, 1 for a cone.
static uint32_t add_rim(Mesh *mesh, double turns, double z, double slope, double v) {
    double cosine = maths_cos(TURN * turns), sine = maths_sin(TURN * turns), part = slope != 0 ? 0.7071067811865476 : 1;
    return add_vertex(mesh, (double[3]){cosine, sine, z}, (double[3]){part * cosine, part * sine, part * slope}, turns,
                      v);
}

static void add_cap(Mesh *mesh, uint32_t n, double z) {
    double normal[3] = {0, 0, z < 0 ? -1 : 1};
    for (uint32_t i = 0; i < n; i++) {
        uint32_t corners[2];
        for (uint32_t k = 0; k < 2; k++) {
            double turns = (double)(i + k) / n;
            corners[k] = add_vertex(mesh, (double[3]){maths_cos(TURN * turns), maths_sin(TURN * turns), z}, normal,
                                    turns, z < 0 ? 0.25 : 0.75);
        }
        uint32_t middle = add_vertex(mesh, (double[3]){0, 0, z}, normal, (i + 0.5) / n, z < 0 ? 0 : 1);
        z < 0 ? add_triangle(mesh, middle, corners[1], corners[0]) : add_triangle(mesh, middle, corners[0], corners[1]);
    }
}

Mesh mesh_cylinder(Arena *arena, uint32_t segments) {
    uint32_t n = segments < 2 ? 2 : segments;
    Mesh mesh = new_mesh(arena, 2 * (n + 1) + 6 * n, 4 * n);
    for (uint32_t i = 0; i <= n; i++) {
        add_rim(&mesh, (double)i / n, -0.5, 0, 0.25);
        add_rim(&mesh, (double)i / n, 0.5, 0, 0.75);
    }
    for (uint32_t i = 0; i < n; i++) {
        uint32_t bottom = 2 * i, top = bottom + 1;
        add_triangle(&mesh, bottom + 2, top, bottom);
        add_triangle(&mesh, top, bottom + 2, top + 2);
    }
    add_cap(&mesh, n, -0.5);
    add_cap(&mesh, n, 0.5);
    return mesh;
}

Mesh mesh_cone(Arena *arena, uint32_t segments) {
    uint32_t n = segments < 2 ? 2 : segments;
    Mesh mesh = new_mesh(arena, (n + 1) + n + 3 * n, 2 * n);
    for (uint32_t i = 0; i <= n; i++)
        add_rim(&mesh, (double)i / n, -0.5, 1, 0.25);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t tip = add_rim(&mesh, (i + 0.5) / n, 0.5, 1, 1);
        mesh.vertices[tip].position[0] = mesh.vertices[tip].position[1] = 0;
        add_triangle(&mesh, tip, i, i + 1);
    }
    add_cap(&mesh, n, -0.5);
    return mesh;
}

void mesh_bounds(const Mesh *mesh, float low[3], float high[3]) {
    for (int k = 0; k < 3; k++)
        low[k] = high[k] = mesh->vertices[0].position[k];
    for (uint32_t i = 1; i < mesh->vertex_count; i++)
        for (int k = 0; k < 3; k++) {
            float x = mesh->vertices[i].position[k];
            low[k] = x < low[k] ? x : low[k];
            high[k] = x > high[k] ? x : high[k];
        }
}

void mesh_measure(const Mesh *mesh, const float low[3], const float high[3], float layers[3], float lengths[3]) {
    double sides[2][3] = {{0}}; // area of the triangles, projected along each axis and seen from either side
    double extents[3] = {0};
    for (uint32_t i = 0; i + 2 < mesh->index_count; i += 3) {
        const float *a = mesh->vertices[mesh->indices[i]].position, *b = mesh->vertices[mesh->indices[i + 1]].position,
                    *c = mesh->vertices[mesh->indices[i + 2]].position;
        for (int k = 0; k < 3; k++) {
            int m = (k + 1) % 3, n = (k + 2) % 3;
            double area = ((double)(b[m] - a[m]) * (c[n] - a[n]) - (double)(b[n] - a[n]) * (c[m] - a[m])) / 2;
            sides[area < 0][k] += fabs(area);
            extents[k] += (double)(fmaxf(a[k], fmaxf(b[k], c[k])) - fminf(a[k], fminf(b[k], c[k])));
        }
    }
    for (int k = 0; k < 3; k++) {
        double face = (double)(high[(k + 1) % 3] - low[(k + 1) % 3]) * (high[(k + 2) % 3] - low[(k + 2) % 3]);
        layers[k] = face > 0 ? (float)(fmax(sides[0][k], sides[1][k]) / face) : 0;
        lengths[k] = high[k] > low[k] ? (float)(extents[k] / (double)(high[k] - low[k])) : 0;
    }
}
