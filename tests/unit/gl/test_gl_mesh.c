// test_gl_mesh.c: tests of the triangles of models (spec canvas3d.md 6 to 8), without OpenGL.
#include "check.h"
#include "scene3d/mesh.h"

#include <math.h>
#include <string.h>

static int setup(void **state) {
    static Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    *state = &arena;
    return 0;
}

static int teardown(void **state) {
    arena_free(*state);
    return 0;
}

static const MeshVertex *corner(const Mesh *mesh, uint32_t index) {
    assert_in_range(mesh->indices[index], 0, mesh->vertex_count - 1);
    return &mesh->vertices[mesh->indices[index]];
}

// Returns six times the signed volume of the tetrahedron between the origin and a triangle. The volume is positive if
// the triangle faces away from the origin.
static double volume(const Mesh *mesh, uint32_t triangle) {
    const float *a = corner(mesh, 3 * triangle)->position, *b = corner(mesh, 3 * triangle + 1)->position,
                *c = corner(mesh, 3 * triangle + 2)->position;
    return a[0] * ((double)b[1] * c[2] - (double)b[2] * c[1]) + a[1] * ((double)b[2] * c[0] - (double)b[0] * c[2]) +
           a[2] * ((double)b[0] * c[1] - (double)b[1] * c[0]);
}

// Checks a closed body around the origin: all normals have length 1. If `sign` is 1, all triangles face outwards and
// all normals point outwards; if it is -1, inwards. Returns the signed volume.
static double check_body(const Mesh *mesh, double sign) {
    double sum = 0;
    assert_int_equal(mesh->index_count % 3, 0);
    for (uint32_t i = 0; i < mesh->index_count / 3; i++) {
        assert_true(sign * volume(mesh, i) > 0);
        sum += volume(mesh, i) / 6;
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float *n = mesh->vertices[i].normal, *p = mesh->vertices[i].position;
        assert_true(fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-5);
        assert_true(sign * (n[0] * p[0] + n[1] * p[1] + n[2] * p[2]) > 0);
    }
    return sum;
}

// Returns true if the body has a vertex with this position, normal and texture coordinates.
static bool has_vertex(const Mesh *mesh, const float wanted[8]) {
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float *v = mesh->vertices[i].position; // position, normal and uv are contiguous in memory
        bool same = true;
        for (int k = 0; k < 8; k++)
            same &= fabsf(v[k] - wanted[k]) < 1e-6f;
        if (same)
            return true;
    }
    return false;
}

static void test_box_has_volume_1_and_outward_normals(void **state) {
    Mesh mesh = mesh_box(*state, false);
    assert_int_equal(mesh.vertex_count, 24);
    assert_int_equal(mesh.index_count, 36);
    assert_true(fabs(check_body(&mesh, 1) - 1) < 1e-6);
    static const float standard[][8] = {
        {.5f, -.5f, .5f, 1, 0, 0, 0, 0},        {.5f, -.5f, -.5f, 1, 0, 0, 1 / 6.f, 0},
        {.5f, .5f, .5f, 1, 0, 0, 0, 1},         {-.5f, -.5f, -.5f, -1, 0, 0, 1 / 6.f, 0},
        {-.5f, .5f, -.5f, 0, 1, 0, 2 / 6.f, 1}, {.5f, -.5f, -.5f, 0, -1, 0, 4 / 6.f, 0},
        {.5f, .5f, .5f, 0, 0, 1, 5 / 6.f, 1},   {.5f, -.5f, -.5f, 0, 0, -1, 5 / 6.f, 0},
        {-.5f, -.5f, -.5f, 0, 0, -1, 1, 0},
    };
    for (size_t i = 0; i < sizeof standard / sizeof *standard; i++)
        assert_true(has_vertex(&mesh, standard[i]));
    mesh = mesh_box(*state, true);
    assert_true(has_vertex(&mesh, (const float[]){.5f, .5f, -.5f, 0, 0, -1, 0, 1}));
    float low[3], high[3];
    mesh_bounds(&mesh, low, high);
    for (int k = 0; k < 3; k++)
        assert_true(low[k] == -0.5f && high[k] == 0.5f);
}

static void test_sphere_has_unit_normals_at_its_vertices(void **state) {
    static const uint32_t segments[][2] = {{4, 1}, {5, 2}, {64, 16}, {1, 1}};
    for (size_t i = 0; i < 4; i++) {
        uint32_t n = segments[i][1];
        Mesh mesh = mesh_sphere(*state, segments[i][0]);
        assert_int_equal(mesh.index_count, 3 * 8 * n * n);
        assert_int_equal(mesh.vertex_count, 8 * (n + 1) * (n + 2) / 2);
        double size = check_body(&mesh, 1);
        assert_true(size < 4.18880 && (n < 16 || size > 4.15));
        for (uint32_t k = 0; k < mesh.vertex_count; k++)
            assert_memory_equal(mesh.vertices[k].position, mesh.vertices[k].normal, 12);
        // The pole of the second side, and a point on the equator at the end of the third side.
        assert_true(has_vertex(&mesh, (const float[]){0, 0, 1, 0, 0, 1, 1.5f / 4, 1}));
        assert_true(has_vertex(&mesh, (const float[]){0, -1, 0, 0, -1, 0, 0.75f, 0.5f}));
    }
    Mesh mesh = mesh_sphere(*state, 8);
    float h = sqrtf(0.5f); // coordinate of row 1 of 2, halfway between columns 0 and 1 of side 0
    assert_true(has_vertex(&mesh, (const float[]){h, 0, h, h, 0, h, 0, 0.75f}));
    assert_true(has_vertex(&mesh, (const float[]){0, h, -h, 0, h, -h, 0.25f, 0.25f}));
}

static void test_cylinder_and_cone(void **state) {
    double pi = 3.14159265358979;
    for (uint32_t n = 3; n < 100; n += 13) {
        double area = n / 2.0 * sin(2 * pi / n);
        Mesh cylinder = mesh_cylinder(*state, n);
        assert_int_equal(cylinder.index_count, 3 * 4 * n);
        assert_true(fabs(check_body(&cylinder, 1) - area) < 1e-5);
        assert_true(has_vertex(&cylinder, (const float[]){1, 0, .5f, 1, 0, 0, 1, .75f}));
        assert_true(has_vertex(&cylinder, (const float[]){1, 0, -.5f, 0, 0, -1, 0, .25f}));
        assert_true(has_vertex(&cylinder, (const float[]){0, 0, .5f, 0, 0, 1, 0.5f / (float)n, 1}));
        Mesh cone = mesh_cone(*state, n);
        assert_int_equal(cone.index_count, 3 * 2 * n);
        assert_true(fabs(check_body(&cone, 1) - area / 3) < 1e-5);
        float h = sqrtf(0.5f);
        assert_true(has_vertex(&cone, (const float[]){1, 0, -.5f, h, 0, h, 0, .25f}));
        assert_true(has_vertex(&cone, (const float[]){0, 0, -.5f, 0, 0, -1, 0.5f / (float)n, 0}));
    }
    assert_int_equal(mesh_cylinder(*state, 0).index_count, 24);
}

static void test_flat_and_invert(void **state) {
    Mesh mesh = mesh_sphere(*state, 8);
    mesh_flat(*state, &mesh);
    assert_int_equal(mesh.vertex_count, mesh.index_count);
    check_body(&mesh, 1);
    for (uint32_t i = 0; i < mesh.index_count; i += 3) // all corners of a triangle have the same normal
        assert_memory_equal(corner(&mesh, i)->normal, corner(&mesh, i + 2)->normal, 12);
    mesh_invert(&mesh);
    check_body(&mesh, -1);
}

static void test_edges_below_the_limit_are_smoothed(void **state) {
    // Right-angled edges are smoothed if snap_edges is above a quarter turn; corner normals then point along the
    // diagonals.
    Mesh mesh = mesh_box(*state, false);
    mesh_snap(*state, &mesh, 0.26);
    float d = 1 / sqrtf(3);
    for (uint32_t i = 0; i < mesh.vertex_count; i++)
        for (int k = 0; k < 3; k++)
            assert_true(fabsf(mesh.vertices[i].normal[k] - 2 * d * mesh.vertices[i].position[k]) < 1e-5f);
    check_body(&mesh, 1);
    mesh = mesh_box(*state, false);
    mesh_snap(*state, &mesh, 0.24);
    assert_true(has_vertex(&mesh, (const float[]){.5f, .5f, .5f, 0, 0, 1, 5 / 6.f, 1}));
    check_body(&mesh, 1);
    // With 64 segments, the edge between a cylinder's caps and its side stays sharp, but the side is smooth.
    mesh = mesh_cylinder(*state, 64);
    mesh_snap(*state, &mesh, 0.05);
    assert_true(has_vertex(&mesh, (const float[]){0, 1, .5f, 0, 1, 0, .25f, .75f}));
    assert_true(has_vertex(&mesh, (const float[]){0, 1, .5f, 0, 0, 1, .25f, .75f}));
}

static void test_remapped_coordinates_do_not_cross_the_seam(void **state) {
    Mesh mesh = mesh_box(*state, false);
    mesh_remap(*state, &mesh, REMAP_PLANE);
    assert_true(has_vertex(&mesh, (const float[]){.5f, -.5f, .5f, 1, 0, 0, 1, 0}));
    mesh = mesh_box(*state, false);
    mesh_remap(*state, &mesh, REMAP_BOOK);
    assert_true(has_vertex(&mesh, (const float[]){.5f, -.5f, .5f, 0, 0, 1, 1, 0}));
    assert_true(has_vertex(&mesh, (const float[]){.5f, -.5f, -.5f, 0, 0, -1, 0, 0}));
    mesh = mesh_sphere(*state, 16);
    mesh_remap(*state, &mesh, REMAP_SPHERE);
    for (uint32_t i = 0; i < mesh.index_count; i += 3) {
        float low = 2, high = 0;
        for (uint32_t k = 0; k < 3; k++) {
            low = fminf(low, corner(&mesh, i + k)->uv[0]);
            high = fmaxf(high, corner(&mesh, i + k)->uv[0]);
        }
        assert_true(fabsf(corner(&mesh, i)->position[2]) > 0.9f || high - low <= 0.26f); // no triangle crosses the seam
    }
}

static bool from_file(Arena *arena, const char *text, Mesh *mesh) {
    MeshError error = {0};
    return mesh_from_file(arena, str_copy(arena, str_from(text)), mesh, &error);
}

// Checks that a file is rejected with this message at this line; 0: no line.
static void check_bad(Arena *arena, const char *text, uint32_t line, const char *problem) {
    Mesh mesh;
    MeshError error = {0};
    bool good = mesh_from_file(arena, str_copy(arena, str_from(text)), &mesh, &error);
    assert_claim(text, !good && error.text);
    assert_claim(text, error.line == line);
    assert_claim(text, strstr(error.text, problem) != NULL);
}

static void test_obj_file_gives_triangles_or_the_bad_line(void **state) {
    Mesh mesh;
    assert_true(from_file(*state,
                          "# a square\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\r\nv 1.0e0 +1 0\nv 0 1 0 1\n"
                          "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\ng one\nf 1/1/1 2/2/1 3/3/1 4/4/1\n",
                          &mesh));
    assert_int_equal(mesh.index_count, 6);
    assert_int_equal(mesh.vertex_count, 4);
    assert_true(has_vertex(&mesh, (const float[]){1, 1, 0, 0, 0, 1, 1, 1}));
    // Negative indices count from the end. Normals and texture coordinates may be omitted.
    assert_true(from_file(*state, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n", &mesh));
    assert_true(has_vertex(&mesh, (const float[]){1, 0, 0, 0, 0, 1, 0, 0}));
    assert_true(from_file(*state, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nf 1//1 2//1 3//-1", &mesh));
    assert_true(has_vertex(&mesh, (const float[]){1, 0, 0, 1, 0, 0, 0, 0}));
    // A line that ends with `\` continues, unless it is a comment.
    assert_true(from_file(
        *state, "# C:\\\nv 0 \\\n 0 0\nv 1 0 0\nv 0\\\r\n1\\\r\n0\nv 0 0 \\\n\\\n1\nf 1 2 \\\r\n3\nf 1 2 4\\", &mesh));
    assert_int_equal(mesh.index_count, 6);
    assert_true(has_vertex(&mesh, (const float[]){0, 1, 0, 0, 0, 1, 0, 0}));
    assert_int_equal(mesh.vertex_count, 6);
    static const struct {
        const char *text;
        uint32_t line;
        const char *problem;
    } bad[] = {
        {"v 0 0 0\nv 1 \\\n0\\\n 0\nv 0 1 \\\nx\nf 1 2 3\n", 5, "'v' needs three numbers"},
        {"", 0, "it contains no triangles"},
        {"v 0 0 0\n", 0, "it contains no triangles"},
        {"# a\n\nv 0 0\n", 3, "'v' needs three numbers"},
        {"v 0 0 x\n", 1, "'v' needs three numbers"},
        {"v nan 0 0\nf 1 1 1\n", 1, "'v' needs three numbers"},
        {"v 1e300 0 0\nf 1 1 1\n", 1, "'v' needs three numbers"},
        {"v 0 0 0\nvt\nf 1 1 1\n", 2, "'vt' needs one or two numbers"},
        {"v 0 0 0\r\nvn 1\r\nf 1 1 1\n", 2, "'vn' needs three numbers"},
        {"f 1 2 3\n", 1, "a vertex that does not exist"},
        {"v 0 0 0\nf 1 1\n", 2, "at least three corners"},
        {"v 0 0 0\nf 1 1 2\n", 2, "a vertex that does not exist"},
        {"v 0 0 0\nf 1 1 0\n", 2, "a vertex that does not exist"},
        {"v 0 0 0\nf 1 1 -2\n", 2, "a vertex that does not exist"},
        {"v 0 0 0\nf 1/1 1/1 1/1\n", 2, "(vt) that do not exist"},
        {"v 0 0 0\nf 1//1 1//1 1//1\n", 2, "(vn) that does not exist"},
        {"v 0 0 0\nf 1 1 99999999999999999999\n", 2, "a vertex that does not exist"},
        {"v 0 0 0\nf 1 1 1/1/1/1\n", 2, "coordinates (vt) that do not exist"},
        {"v 0 0 0\nf a b c\n", 2, "a corner of a face is written"},
        {"\x89PNG\r\n\x1a\n", 0, "it contains no triangles"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        check_bad(*state, bad[i].text, bad[i].line, bad[i].problem);
}

static void test_off_file_gives_triangles_or_the_bad_line(void **state) {
    Mesh mesh;
    assert_true(
        from_file(*state, "OFF\n# a square\n4 1 0\n\n0 0 0\n1 0 0\r\n1 1 0 # corner\n0 1 0\n4 0 1 2 3\n", &mesh));
    assert_int_equal(mesh.index_count, 6);
    assert_true(has_vertex(&mesh, (const float[]){1, 1, 0, 0, 0, 1, 0, 0}));
    assert_true(from_file(*state, "COFF 3 1 3\n0 0 0 1 0 0 1\n2 0 0 0 1 0 1\n0 2 0 0 0 1 1\n3 0 1 2 255 0 0", &mesh));
    assert_int_equal(mesh.index_count, 3);
    static const struct {
        const char *text;
        uint32_t line;
        const char *problem;
    } bad[] = {
        {"OFF", 1, "the numbers of vertices and faces are missing"},
        {"OFF\n3\n", 2, "the numbers of vertices and faces are missing"},
        {"OFF\n1 0 0\n0 0\n", 3, "a vertex needs three numbers"},
        {"OFF\n1 1 0\n0 0 0\n", 3, "the file ends before the last face"},
        {"OFF\n1 1 0\n0 0 0\n3 0 0\n", 4, "a face needs the number of its corners"},
        {"OFF\n1 1 0\n0 0 0\n3 0 0 1\n", 4, "a vertex that does not exist"},
        {"OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", 4, "a vertex that does not exist"},
        {"OFF\n1 1 0\n0 0 0\n1e29 0 0 0\n", 4, "a face needs the number of its corners"},
        {"OFF\n1e29 1e29 0\n0 0 0\n", 3, "the file ends before the last face"},
        {"OFF\n1 1 0\n0 0 0\n2 0 0\n", 0, "it contains no triangles"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        check_bad(*state, bad[i].text, bad[i].line, bad[i].problem);
}

#define PLY_HEAD "ply\nformat ascii 1.0\ncomment a square\n"
#define PLY_VERTEX "element vertex 3\nproperty float x\nproperty float y\nproperty double z\n"
#define PLY_FACE "element face 1\nproperty list uchar int vertex_indices\nend_header\n"

static void test_ply_file_gives_triangles_or_the_bad_line(void **state) {
    Mesh mesh;
    assert_true(from_file(*state,
                          PLY_HEAD "element vertex 4\nproperty uchar red\nproperty float x\nproperty float y\n"
                                   "property float z\nproperty float nz\nproperty float s\nproperty float t\n"
                                   "element other 2\nproperty list uchar float numbers\nelement nothing 4000000000\n"
                                   "element face 1\nproperty uchar flags\nproperty list uchar int vertex_index\n"
                                   "end_header\n9 0 0 0 1 0 0\n9 1 0 0 1 1 0\n9 1 1 0 1 1 1\n9 0 1 0 1 0 1\n"
                                   "2 7 7\n0\n5 4 0 1 2 3\n",
                          &mesh));
    assert_int_equal(mesh.index_count, 6);
    assert_int_equal(mesh.vertex_count, 4);
    assert_true(has_vertex(&mesh, (const float[]){1, 1, 0, 0, 0, 1, 1, 1}));
    assert_true(from_file(*state, PLY_HEAD PLY_VERTEX PLY_FACE "0 0 0\n1 0 0\n0 1\n0\n3 0 1 2", &mesh));
    assert_true(has_vertex(&mesh, (const float[]){1, 0, 0, 0, 0, 1, 0, 0}));
    static const struct {
        const char *text;
        uint32_t line;
        const char *problem;
    } bad[] = {
        {"ply\n", 1, "'end_header' is missing"},
        {"ply\nend_header\n", 2, "'format' is missing"},
        {"ply\nformat latin 1.0\n", 2, "not valid"},
        {PLY_HEAD "property float x\n", 4, "not valid"},
        {PLY_HEAD "element vertex\n", 4, "not valid"},
        {PLY_HEAD "element vertex 3\nproperty word x\n", 5, "not valid"},
        {PLY_HEAD "element vertex 3\nproperty list uchar\n", 5, "not valid"},
        {PLY_HEAD PLY_VERTEX PLY_FACE "0 0 0 1 0 0 0 1 0 3 0 1 3", 11, "a vertex that does not exist"},
        {PLY_HEAD PLY_VERTEX PLY_FACE "0 0 0 1 0 0 0 1 0 3 0 1 -1", 11, "a vertex that does not exist"},
        {PLY_HEAD PLY_VERTEX PLY_FACE "0 0 0\n1 0 z\n", 12, "a number is not valid"},
        {PLY_HEAD PLY_VERTEX PLY_FACE "0 0 0\n1 0 0\n", 12, "the file ends before the last face"},
        {PLY_HEAD PLY_VERTEX PLY_FACE "0 0 0 1 0 0 0 1 0 2 0 1", 0, "it contains no triangles"},
        {PLY_HEAD "end_header\n", 0, "it contains no triangles"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        check_bad(*state, bad[i].text, bad[i].line, bad[i].problem);
}

// Binary files of both byte orders, with a list, a short and a double.
static void test_binary_ply(void **state) {
    static const char head[] = "ply\nformat binary_%s_endian 1.0\nelement vertex 3\nproperty short x\n"
                               "property char y\nproperty double z\nelement face 1\n"
                               "property list ushort uint vertex_indices\nend_header\n";
    static const unsigned char body[2][47] = {
        {0xff, 0xff, 0,    0, 0, 0, 0, 0, 0, 0, 0,    // -1;0;0
         1,    0,    0,    0, 0, 0, 0, 0, 0, 0, 0,    // 1;0;0
         0,    0,    0xff, 0, 0, 0, 0, 0, 0, 0, 0x40, // 0;-1;2
         3,    0,    0,    0, 0, 0, 2, 0, 0, 0, 1,    0, 0, 0},
        {0xff, 0xff, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
         0xff, 0x40, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 1},
    };
    for (int big = 0; big < 2; big++) {
        char file[400];
        size_t start = (size_t)snprintf(file, sizeof file, head, big ? "big" : "little");
        memcpy(file + start, body[big], sizeof body[big]);
        Mesh mesh;
        MeshError problem;
        assert_true(mesh_from_file(*state, (Str){file, start + sizeof body[big]}, &mesh, &problem));
        assert_int_equal(mesh.index_count, 3);
        float low[3], high[3];
        mesh_bounds(&mesh, low, high);
        assert_true(low[0] == -1 && high[0] == 1 && low[1] == -1 && high[1] == 0 && low[2] == 0 && high[2] == 2);
        for (size_t size = 0; size < start + sizeof body[big]; size++) // no truncated file is accepted
            assert_false(mesh_from_file(*state, (Str){file, size}, &mesh, &problem));
        memset(file + start + 3, 0x7f, 8);
        assert_int_equal(mesh_from_file(*state, (Str){file, start + sizeof body[big]}, &mesh, &problem), false);
        assert_string_equal(problem.text, "a coordinate is out of range");
    }
}

static void test_gltf_is_named(void **state) {
    check_bad(*state, "glTF\2", 0, "glTF is not supported; convert it to OBJ");
    check_bad(*state, "{\"asset\": {}}", 0, "glTF is not supported; convert it to OBJ");
}

static void test_stl_file_gives_triangles_or_the_bad_line(void **state) {
    Mesh mesh;
    assert_true(from_file(*state,
                          "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                          "endloop\nendfacet\nendsolid x\n",
                          &mesh));
    assert_int_equal(mesh.index_count, 3);
    assert_true(has_vertex(&mesh, (const float[]){1, 0, 0, 0, 0, 1, 0, 0}));
    check_bad(*state, "solid x\nendsolid x\n", 0, "it contains no triangles");
    check_bad(*state, "solid x\nvertex 0 0 0\nendloop\n", 3, "a loop needs three vertices");
    check_bad(*state, "solid x\nvertex 0 0 0\n", 2, "ends within a loop");
    check_bad(*state, "solid\n\nvertex 0 0 inf\nendloop\n", 3, "'vertex' needs three numbers");
    char binary[84 + 50] = "binary";
    binary[80] = 1;
    float corners[9] = {0, 0, 0, 0, 2, 0, 0, 0, 2};
    memcpy(binary + 84 + 12, corners, sizeof corners);
    MeshError problem;
    assert_true(mesh_from_file(*state, (Str){binary, sizeof binary}, &mesh, &problem));
    assert_true(has_vertex(&mesh, (const float[]){0, 2, 0, 1, 0, 0, 0, 0}));
    for (size_t cut = 1; cut < sizeof binary; cut++) // no truncated file is accepted
        assert_false(mesh_from_file(*state, (Str){binary, sizeof binary - cut}, &mesh, &problem));
    binary[80] = (char)0xff, binary[83] = (char)0xff;
    assert_false(mesh_from_file(*state, (Str){binary, sizeof binary}, &mesh, &problem));
}

static void test_lists_with_a_bad_index_or_length_are_rejected(void **state) {
    static const double vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, uv[] = {0, 0, 1, 0, 0, 1};
    static const double faces[] = {0, 1, 2}, wrong[][3] = {{0, 1, 3}, {0, 1, -1}, {0, 1, 1e300}};
    Mesh mesh;
    const char *problem;
    assert_true(mesh_from_lists(*state, vertices, 9, faces, 3, uv, 6, &mesh, &problem));
    assert_true(has_vertex(&mesh, (const float[]){1, 0, 0, 0, 0, 1, 1, 0}));
    assert_true(mesh_from_lists(*state, vertices, 9, faces, 3, NULL, 0, &mesh, &problem));
    for (size_t i = 0; i < 3; i++)
        assert_false(mesh_from_lists(*state, vertices, 9, wrong[i], 3, NULL, 0, &mesh, &problem));
    assert_false(mesh_from_lists(*state, vertices, 8, faces, 3, NULL, 0, &mesh, &problem));
    assert_false(mesh_from_lists(*state, vertices, 9, faces, 2, NULL, 0, &mesh, &problem));
    assert_false(mesh_from_lists(*state, vertices, 9, faces, 3, uv, 5, &mesh, &problem));
}

// Checks that a hull is closed and convex, that it contains all points, and that its corners face outwards.
static void check_hull(Arena *arena, const char *row, const double *points, uint32_t count, double volume,
                       uint32_t triangles) {
    uint32_t numbers = 0;
    Mesh mesh;
    const char *problem;
    const double *faces = mesh_hull(arena, points, count, &numbers);
    assert_claim(row, faces && mesh_from_lists(arena, points, 3 * count, faces, numbers, NULL, 0, &mesh, &problem));
    double sum = 0;
    for (uint32_t i = 0; i < numbers; i += 3) {
        const double *a = points + 3 * (size_t)faces[i], *b = points + 3 * (size_t)faces[i + 1],
                     *c = points + 3 * (size_t)faces[i + 2];
        double u[3], v[3], n[3];
        for (int k = 0; k < 3; k++)
            u[k] = b[k] - a[k], v[k] = c[k] - a[k];
        for (int k = 0; k < 3; k++)
            n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
        for (uint32_t p = 0; p < count; p++)
            assert_claim(row, n[0] * (points[3 * p] - a[0]) + n[1] * (points[3 * p + 1] - a[1]) +
                                      n[2] * (points[3 * p + 2] - a[2]) <
                                  1e-6);
        sum += (n[0] * a[0] + n[1] * a[1] + n[2] * a[2]) / 6;
    }
    assert_claim(row, volume < 0 || fabs(sum - volume) < 1e-9);
    assert_claim(row, triangles == 0 || numbers == 3 * triangles);
}

static void test_hull_of_flat_points_is_rejected(void **state) {
    enum { MANY = 300 };
    static const double pyramid[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0.1, 0.1, 0.2, 0.2, 0, 0, 0, 0};
    double cube[27 * 3], ball[MANY * 3], wall[MANY * 3];
    for (int i = 0; i < 27; i++)
        cube[3 * i] = i % 3, cube[3 * i + 1] = i / 3 % 3, cube[3 * i + 2] = i / 9;
    for (int i = 0; i < MANY; i++) {
        double z = 1 - (2 * i + 1.0) / MANY, angle = 2.399963 * i, r = sqrt(1 - z * z);
        ball[3 * i] = r * cos(angle), ball[3 * i + 1] = r * sin(angle), ball[3 * i + 2] = z;
        wall[3 * i] = i % 17, wall[3 * i + 1] = i / 17, wall[3 * i + 2] = i % 17 - 2.0 * (i / 17);
    }
    check_hull(*state, "a pyramid", pyramid, 7, 1 / 6.0, 4);
    check_hull(*state, "a cube", cube, 27, 8, 0);
    check_hull(*state, "a ball", ball, MANY, -1, 2 * MANY - 4); // number of triangles from Euler's formula
    uint32_t numbers;
    assert_null(mesh_hull(*state, wall, MANY, &numbers));
    assert_null(mesh_hull(*state, pyramid, 3, &numbers));
    static const double same[12] = {0};
    assert_null(mesh_hull(*state, same, 4, &numbers));
}

// Checks that each edge of the faces has exactly one neighbour, and Euler's formula for a sphere.
static void check_closed(const double *faces, uint32_t numbers, uint32_t count) {
    uint32_t corners = 0;
    for (uint32_t i = 0; i < numbers; i++) {
        uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        int opposite = 0;
        for (uint32_t j = 0; j < numbers; j++)
            opposite += faces[j] == faces[next] && faces[j % 3 == 2 ? j - 2 : j + 1] == faces[i];
        assert_int_equal(opposite, 1);
    }
    for (uint32_t p = 0; p < count; p++) {
        bool used = false;
        for (uint32_t i = 0; i < numbers; i++)
            used = used || faces[i] == p;
        corners += used;
    }
    assert_int_equal(numbers / 3, 2 * corners - 4);
}

// Rounding errors and products that overflow once made hulls of a few dozen points with tens of thousands of faces.
static void test_hull_extremes(void **state) {
    enum { MANY = 400 };
    double points[MANY * 3], scaled[MANY * 3];
    for (uint64_t seed = 1; seed <= 20; seed++) {
        uint64_t number = seed;
        for (int i = 0; i < MANY * 3; i++) {
            number = number * 6364136223846793005U + 1442695040888963407U;
            points[i] = (number >> 63 ? 1 : -1) * pow(10, -(double)(number >> 40) / 0x1p23 * 14);
        }
        uint32_t numbers = 0, other_numbers = 0;
        const double *faces = mesh_hull(*state, points, MANY, &numbers);
        assert_non_null(faces);
        check_closed(faces, numbers, MANY);
        static const double scales[] = {0x1p600, 0x1p-600};
        for (int k = 0; k < 2; k++) {
            for (int i = 0; i < MANY * 3; i++)
                scaled[i] = points[i] * scales[k];
            const double *others = mesh_hull(*state, scaled, MANY, &other_numbers);
            assert_int_equal(other_numbers, numbers);
            assert_memory_equal(others, faces, numbers * sizeof *faces);
        }
    }
}

TEST_GROUP(gl_mesh) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_box_has_volume_1_and_outward_normals, setup, teardown),
        cmocka_unit_test_setup_teardown(test_sphere_has_unit_normals_at_its_vertices, setup, teardown),
        cmocka_unit_test_setup_teardown(test_cylinder_and_cone, setup, teardown),
        cmocka_unit_test_setup_teardown(test_flat_and_invert, setup, teardown),
        cmocka_unit_test_setup_teardown(test_edges_below_the_limit_are_smoothed, setup, teardown),
        cmocka_unit_test_setup_teardown(test_remapped_coordinates_do_not_cross_the_seam, setup, teardown),
        cmocka_unit_test_setup_teardown(test_obj_file_gives_triangles_or_the_bad_line, setup, teardown),
        cmocka_unit_test_setup_teardown(test_off_file_gives_triangles_or_the_bad_line, setup, teardown),
        cmocka_unit_test_setup_teardown(test_ply_file_gives_triangles_or_the_bad_line, setup, teardown),
        cmocka_unit_test_setup_teardown(test_binary_ply, setup, teardown),
        cmocka_unit_test_setup_teardown(test_gltf_is_named, setup, teardown),
        cmocka_unit_test_setup_teardown(test_stl_file_gives_triangles_or_the_bad_line, setup, teardown),
        cmocka_unit_test_setup_teardown(test_lists_with_a_bad_index_or_length_are_rejected, setup, teardown),
        cmocka_unit_test_setup_teardown(test_hull_of_flat_points_is_rejected, setup, teardown),
        cmocka_unit_test_setup_teardown(test_hull_extremes, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
