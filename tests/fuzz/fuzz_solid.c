// fuzz_solid.c: fuzzes operations on solids. The first byte of the input selects what is done with the rest: points
// with coordinates of one byte or two, which form tetrahedra or a soup of triangles. Tetrahedra overlap each other, so
// their solid also overlaps itself.
#include "fuzz.h"
#include "solid/solid.h"

#include <string.h>

enum { OPERATION = 3, TRIANGLES = 4, WIDE = 8, TRIM = 16, TWICE = 32 };

typedef struct Input {
    Arena *arena;
    const uint8_t *bytes;
    size_t size;
} Input;

static void check_solid(Arena *arena, const Solid *solid) {
    for (uint32_t i = 0; i < solid->face_count; i++)
        for (int k = 0; k < 3; k++)
            if (solid->faces[i][k] >= solid->point_count)
                fuzz_fail("a solid has an index without a point");
    for (uint32_t i = 0; i < solid->point_count; i++)
        for (int k = 0; k < 3; k++)
            if (solid->points[i][k] > SOLID_MAX / 4 || solid->points[i][k] < -SOLID_MAX / 4)
                fuzz_fail("a point of a solid is out of range");
    if (!solid_is_closed(arena, solid))
        fuzz_fail("a solid is not closed");
}

// Reads points and makes triangles of each three, or tetrahedra of each four. Returns false if that is not closed.
static bool read_solid(const Input *input, const uint8_t *bytes, size_t size, const SolidGrid *grid, Solid *solid) {
    static const uint32_t tetrahedron[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    bool triangles = input->bytes[0] & TRIANGLES, wide = input->bytes[0] & WIDE;
    uint32_t corners = triangles ? 3 : 4, sides = triangles ? 3 : 12, count = (uint32_t)(size / (wide ? 6 : 3));
    double(*points)[3] = arena_alloc_array(input->arena, count, sizeof *points);
    uint32_t *indices = arena_alloc_array(input->arena, 3 * (size_t)count, sizeof *indices), used = 0;
    for (uint32_t i = 0; i < 3 * count; i++)
        points[i / 3][i % 3] = wide ? bytes[2 * i] * 256 + bytes[2 * i + 1] - 32768 : 256 * ((int8_t)bytes[i]);
    for (uint32_t i = 0; i + corners <= count; i += corners)
        for (uint32_t k = 0; k < sides; k++)
            indices[used++] = i + (triangles ? k : tetrahedron[k]);
    return solid_from_mesh(input->arena, grid, (const double(*)[3])points, count, indices, used, solid) ||
           solid_repair(input->arena, solid);
}

// For arena_protect.
static void combine_solids(void *context) {
    const Input *input = context;
    Arena *arena = input->arena;
    SolidGrid grid = solid_grid((double[3]){-32768, -32768, -32768}, (double[3]){32768, 32768, 32768});
    size_t half = input->size / 2;
    Solid a, b;
    uint8_t how = input->bytes[0];
    if (!read_solid(input, input->bytes + 1, half, &grid, &a) ||
        !read_solid(input, input->bytes + 1 + half, input->size - 1 - half, &grid, &b))
        return;
    solid_turn_outwards(&a);
    check_solid(arena, &a);
    Solid result = solid_combine(arena, (SolidOperation)((how & OPERATION) % 3), &a, &b);
    check_solid(arena, &result);
    if (how & TWICE) {
        result = solid_combine(arena, SOLID_DIFFERENCE, &b, &result);
        check_solid(arena, &result);
    }
    if (how & TRIM) {
        const uint8_t *end = input->bytes + input->size - 1;
        result = solid_trim(arena, &grid, &result, (double[3]){end[0], 0, 0}, (double[3]){(int8_t)end[-1], how, 1});
        check_solid(arena, &result);
    }
}

FUZZ_HARNESS(solid) {
    static Arena arena;
    Budget budget = {.memory_limit = (size_t)256 << 20};
    if (size < 3)
        return 0;
    budget_begin(&budget, 20000000, NULL); // 0.2 s; sanitizers make this much longer
    arena_init(&arena, "fuzz", (size_t)256 << 20);
    arena.budget = &budget;
    Arena *const arenas[] = {&arena};
    Input input = {&arena, data, size};
    arena_protect(arenas, 1, combine_solids, &input);
    arena_free(&arena);
    return 0;
}
