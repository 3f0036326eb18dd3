// fuzz_mesh.c: fuzzes models. The first byte of the input selects what is done with the rest, which is an OBJ, STL,
// PLY or OFF file, or a list of numbers from which a convex hull is made.
#include "mesh.h"

#include <math.h>
#include <string.h>

enum { FLAT = 1, SNAP = 2, INVERT = 4, REMAP = 8, SHARP = 16, LISTS = 32, SMALL = 64 };

typedef struct Input {
    Arena *arena;
    const uint8_t *bytes;
    size_t size;
} Input;

// Reads doubles, or small integers if the input selects these. Hulls are made of finite numbers only.
static double *read_numbers(const Input *input, uint32_t *count) {
    bool small = input->bytes[0] & SMALL;
    *count = (uint32_t)((input->size - 1) / (small ? 1 : sizeof(double)));
    double *numbers = arena_alloc_array(input->arena, *count, sizeof *numbers);
    for (uint32_t i = 0; i < *count; i++) {
        if (small)
            numbers[i] = (int8_t)input->bytes[1 + i];
        else
            memcpy(&numbers[i], input->bytes + 1 + i * sizeof(double), sizeof(double));
        numbers[i] = isfinite(numbers[i]) ? numbers[i] : 0;
    }
    return numbers;
}

static bool make_hull(const Input *input, Mesh *mesh) {
    uint32_t count, face_numbers;
    const char *problem;
    const double *numbers = read_numbers(input, &count);
    uint32_t points = count / 3 < MESH_MAX_HULL ? count / 3 : MESH_MAX_HULL;
    const double *faces = mesh_hull(input->arena, numbers, points, &face_numbers);
    // Without a hull, the end of the list serves as faces and texture coordinates.
    if (!faces) {
        return mesh_from_lists(input->arena, numbers, count / 2, numbers + count / 2, count - count / 2, numbers,
                               count / 3, mesh, &problem);
    }
    return mesh_from_lists(input->arena, numbers, 3 * points, faces, face_numbers, NULL, 0, mesh, &problem);
}

// For arena_protect.
static void make_mesh(void *context) {
    const Input *input = context;
    Arena *arena = input->arena;
    Mesh mesh = {0};
    MeshError error = {0};
    uint8_t how = input->bytes[0];
    bool good = how & LISTS
                    ? make_hull(input, &mesh)
                    : mesh_from_file(arena, (Str){(const char *)input->bytes + 1, input->size - 1}, &mesh, &error);
    if (!good && !(how & LISTS) && !error.text)
        fuzz_fail("a file was rejected without a reason");
    if (!good || mesh.index_count == 0)
        return;
    mesh_check(&mesh);
    if (how & FLAT)
        mesh_flat(arena, &mesh);
    if (how & SNAP)
        mesh_snap(arena, &mesh, how & SHARP ? 0.05 : 0.5);
    if (how & INVERT)
        mesh_invert(&mesh);
    if (how & REMAP)
        mesh_remap(arena, &mesh, how % 3);
    mesh_check(&mesh);
    float low[3], high[3];
    mesh_bounds(&mesh, low, high);
}

FUZZ_HARNESS(mesh) {
    static Arena arena;
    if (size == 0)
        return 0;
    arena_init(&arena, "fuzz", (size_t)256 << 20);
    Arena *const arenas[] = {&arena};
    Input input = {&arena, data, size};
    arena_protect(arenas, 1, make_mesh, &input);
    arena_free(&arena);
    return 0;
}
