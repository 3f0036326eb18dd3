// topology.c: see topology.h.
//
// Sides and triangles are sorted by their points, so that equal and opposite ones follow each other. So results depend
// only on the order of points and triangles in the input.
#include "solid/topology.h"

#include <string.h>

Entry *sorted_sides(Arena *arena, const Solid *solid) {
    Entry *sides = arena_alloc_array(arena, 3 * (size_t)solid->face_count, sizeof *sides);
    for (uint32_t i = 0; i < solid->face_count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t a = solid->faces[i][k], b = solid->faces[i][(k + 1) % 3];
            sides[3 * (size_t)i + k] =
                (Entry){.bucket = a < b ? a : b, .key = (uint64_t)(a < b ? b : a) << 1 | (a > b), .value = i};
        }
    entries_sort(arena, sides, 3 * solid->face_count, solid->point_count);
    return sides;
}

SolidEdge *solid_edges(Arena *arena, const Solid *solid, uint32_t *count) {
    uint32_t side_count = 3 * solid->face_count;
    SolidEdge *edges = arena_alloc_array(arena, side_count / 2 + 1, sizeof *edges);
    ArenaMark mark = arena_mark(arena);
    const Entry *sides = sorted_sides(arena, solid);
    *count = 0;
    for (uint32_t i = 0, end; i < side_count; i = end) {
        uint32_t middle = i;
        for (; middle < side_count && sides[middle].bucket == sides[i].bucket && sides[middle].key == sides[i].key;)
            middle++;
        bool forward = (sides[i].key & 1) == 0;
        for (end = middle;
             end < side_count && sides[end].bucket == sides[i].bucket && sides[end].key == sides[i].key + 1;)
            end++;
        if (!forward || middle - i != end - middle)
            return NULL;
        for (uint32_t k = 0; k < middle - i; k++)
            edges[(*count)++] = (SolidEdge){.a = sides[i].bucket,
                                            .b = (uint32_t)(sides[i].key >> 1),
                                            .left = sides[i + k].value,
                                            .right = sides[middle + k].value};
    }
    arena_rewind(arena, mark);
    return edges;
}

bool solid_is_closed(Arena *arena, const Solid *solid) {
    uint32_t count;
    return solid_edges(arena, solid, &count) != NULL;
}

static uint64_t hash_point(const int32_t *point) {
    uint64_t hash = (uint32_t)point[0];
    for (int k = 1; k < 3; k++)
        hash = (hash ^ hash >> 29) * 0x9e3779b97f4a7c15u + (uint32_t)point[k];
    hash = (hash ^ hash >> 32) * 0xd6e8feb86659fd93u;
    return hash ^ hash >> 32;
}

// Returns, for each point, the index of the first point with the same coordinates.
static uint32_t *find_first(Arena *arena, const Solid *solid) {
    uint32_t size = 16, *first = arena_alloc_array(arena, solid->point_count, sizeof *first);
    while (size / 2 < solid->point_count)
        size *= 2;
    uint32_t *table = arena_alloc_array(arena, size, sizeof *table); // index of a point, plus 1; 0: free
    memset(table, 0, size * sizeof *table);
    for (uint32_t i = 0; i < solid->point_count; i++) {
        uint32_t at = (uint32_t)hash_point(solid->points[i]) & (size - 1);
        while (table[at] && memcmp(solid->points[table[at] - 1], solid->points[i], sizeof *solid->points) != 0)
            at = (at + 1) & (size - 1);
        if (!table[at])
            table[at] = i + 1;
        first[i] = table[at] - 1;
    }
    return first;
}

Entry *sorted_faces(Arena *arena, const Solid *solid) {
    Entry *entries = arena_alloc_array(arena, solid->face_count, sizeof *entries);
    for (uint32_t i = 0; i < solid->face_count; i++) {
        const uint32_t *face = solid->faces[i];
        uint32_t low = face[1] < face[0] ? 1 : 0;
        low = face[2] < face[low] ? 2 : low;
        uint32_t second = face[(low + 1) % 3], third = face[(low + 2) % 3];
        bool odd = second > third;
        entries[i] = (Entry){.bucket = face[low],
                             .key = (uint64_t)(odd ? third : second) << 32 | (odd ? second : third),
                             .value = i << 1 | odd};
    }
    entries_sort(arena, entries, solid->face_count, solid->point_count);
    return entries;
}

// Removes pairs of triangles with the same corners in opposite directions. Moves the remaining ones together.
static void remove_opposites(Arena *arena, Solid *solid) {
    ArenaMark mark = arena_mark(arena);
    const Entry *entries = sorted_faces(arena, solid);
    bool *dead = arena_alloc_array(arena, solid->face_count, sizeof *dead);
    memset(dead, 0, solid->face_count * sizeof *dead);
    for (uint32_t i = 0, end; i < solid->face_count; i = end) {
        uint32_t even = i;
        for (end = i;
             end < solid->face_count && entries[end].bucket == entries[i].bucket && entries[end].key == entries[i].key;)
            end++;
        for (uint32_t k = i; k < end; k++) { // `even` walks over the even triangles, one for each odd one
            if (!(entries[k].value & 1))
                continue;
            while (even < end && (entries[even].value & 1))
                even++;
            if (even == end)
                break;
            dead[entries[k].value >> 1] = dead[entries[even++].value >> 1] = true;
        }
    }
    uint32_t kept = 0;
    for (uint32_t i = 0; i < solid->face_count; i++)
        if (!dead[i])
            memmove(solid->faces[kept++], solid->faces[i], sizeof *solid->faces);
    solid->face_count = kept;
    arena_rewind(arena, mark);
}

Solid solid_weld(Arena *arena, const Solid *solid) {
    Solid welded = {.points = arena_alloc_array(arena, solid->point_count, sizeof *welded.points),
                    .faces = arena_alloc_array(arena, solid->face_count, sizeof *welded.faces),
                    .point_count = solid->point_count};
    ArenaMark mark = arena_mark(arena);
    const uint32_t *first = find_first(arena, solid);
    for (uint32_t i = 0; i < solid->face_count; i++) {
        const uint32_t *face = solid->faces[i];
        uint32_t a = first[face[0]], b = first[face[1]], c = first[face[2]];
        if (a != b && b != c && c != a)
            memcpy(welded.faces[welded.face_count++], (uint32_t[3]){a, b, c}, sizeof *welded.faces);
    }
    remove_opposites(arena, &welded);
    uint32_t *numbers = arena_alloc_array(arena, solid->point_count, sizeof *numbers);
    memset(numbers, 0xff, solid->point_count * sizeof *numbers);
    welded.point_count = 0;
    for (uint32_t i = 0; i < welded.face_count; i++)
        for (int k = 0; k < 3; k++) {
            uint32_t old = welded.faces[i][k];
            if (numbers[old] == UINT32_MAX) {
                numbers[old] = welded.point_count;
                memcpy(welded.points[welded.point_count++], solid->points[old], sizeof *welded.points);
            }
            welded.faces[i][k] = numbers[old];
        }
    arena_rewind(arena, mark);
    return welded;
}
