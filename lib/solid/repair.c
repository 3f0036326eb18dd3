// repair.c: repair of meshes that are not closed; see solid.h.
//
// Order: duplicates are removed, so that they do not count as neighbours. Neighbours are turned the same way, so that
// the open sides of a hole form a loop. After holes are filled, the parts are turned outwards, because only a closed
// part has a volume.
#include "solid/predicates.h"
#include "solid/topology.h"

#include <string.h>

static void flip_face(uint32_t face[3]) {
    uint32_t second = face[1];
    face[1] = face[2];
    face[2] = second;
}

// Returns six times the volume between a triangle and the origin.
static double volume_below(const Solid *solid, uint32_t face) {
    static const Position origin = {0, 0, 0};
    const uint32_t *f = solid->faces[face];
    return -volume_to_double(volume_of(solid->points[f[0]], solid->points[f[1]], solid->points[f[2]], origin));
}

void solid_turn_outwards(Solid *solid) {
    double sum = 0;
    for (uint32_t i = 0; i < solid->face_count; i++)
        sum += volume_below(solid, i);
    for (uint32_t i = 0; i < solid->face_count && sum < 0; i++)
        flip_face(solid->faces[i]);
}

// A set of connected triangles, as a tree. `flipped` is relative to the parent.
typedef struct FaceSet {
    uint32_t parent;
    bool flipped;
} FaceSet;

static uint32_t find_root(FaceSet *sets, uint32_t face, bool *flipped) {
    uint32_t root = face;
    bool total = false;
    for (; sets[root].parent != root; root = sets[root].parent)
        total ^= sets[root].flipped;
    *flipped = total;
    while (sets[face].parent != face) { // shortens the path
        FaceSet old = sets[face];
        sets[face] = (FaceSet){root, total};
        total ^= old.flipped;
        face = old.parent;
    }
    return root;
}

// Turns neighbours the same way round, and then each connected set outwards.
static void orient_faces(Arena *arena, Solid *solid) {
    FaceSet *sets = arena_alloc_array(arena, solid->face_count, sizeof *sets);
    double *volumes = arena_alloc_array(arena, solid->face_count, sizeof *volumes);
    const Entry *sides = sorted_sides(arena, solid);
    uint32_t count = 3 * solid->face_count;
    bool one, two;
    for (uint32_t i = 0; i < solid->face_count; i++) {
        sets[i] = (FaceSet){.parent = i};
        volumes[i] = 0;
    }
    for (uint32_t i = 0, end; i < count; i = end) {
        for (end = i; end < count && sides[end].bucket == sides[i].bucket && sides[end].key >> 1 == sides[i].key >> 1;)
            end++;
        if (end - i != 2)
            continue;
        uint32_t a = find_root(sets, sides[i].value, &one), b = find_root(sets, sides[i + 1].value, &two);
        if (a != b)
            sets[b] = (FaceSet){a, one ^ two ^ (sides[i].key == sides[i + 1].key)};
    }
    for (uint32_t i = 0; i < solid->face_count; i++) {
        uint32_t root = find_root(sets, i, &one);
        if (one)
            flip_face(solid->faces[i]);
        volumes[root] += volume_below(solid, i);
    }
    for (uint32_t i = 0; i < solid->face_count; i++)
        if (volumes[find_root(sets, i, &one)] < 0)
            flip_face(solid->faces[i]);
}

static void remove_duplicates(Arena *arena, Solid *solid) {
    const Entry *entries = sorted_faces(arena, solid);
    bool *dead = arena_alloc_array(arena, solid->face_count, sizeof *dead);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < solid->face_count; i++)
        dead[entries[i].value >> 1] =
            i > 0 && entries[i].bucket == entries[i - 1].bucket && entries[i].key == entries[i - 1].key;
    for (uint32_t i = 0; i < solid->face_count; i++)
        if (!dead[i])
            memmove(solid->faces[kept++], solid->faces[i], sizeof *solid->faces);
    solid->face_count = kept;
}

// Returns the loops of open sides as a list: next[point] is the point after `point`, or UINT32_MAX. Returns NULL if a
// point begins or ends several open sides.
static uint32_t *open_sides(Arena *arena, const Solid *solid, uint32_t *count) {
    uint32_t *next = arena_alloc_array(arena, solid->point_count, sizeof *next);
    uint32_t *before = arena_alloc_array(arena, solid->point_count, sizeof *before);
    memset(next, 0xff, solid->point_count * sizeof *next);
    memset(before, 0xff, solid->point_count * sizeof *before);
    const Entry *sides = sorted_sides(arena, solid);
    *count = 0;
    for (uint32_t i = 0, end; i < 3 * solid->face_count; i = end) {
        int64_t sum = 0;
        for (end = i; end < 3 * solid->face_count && sides[end].bucket == sides[i].bucket &&
                      sides[end].key >> 1 == sides[i].key >> 1;
             end++)
            sum += sides[end].key & 1 ? -1 : 1;
        // The missing triangle runs along the side in the opposite direction.
        uint32_t low = sides[i].bucket, high = (uint32_t)(sides[i].key >> 1);
        uint32_t from = sum > 0 ? high : low, to = sum > 0 ? low : high;
        if (sum == 0)
            continue;
        if (sum > 1 || sum < -1 || next[from] != UINT32_MAX || before[to] != UINT32_MAX)
            return NULL;
        next[from] = to;
        before[to] = from;
        ++*count;
    }
    return next;
}

static bool fill_holes(Arena *arena, Solid *solid) {
    uint32_t missing, face_count = solid->face_count;
    uint32_t *next = open_sides(arena, solid, &missing);
    if (!next)
        return false;
    uint32_t(*faces)[3] = arena_alloc_array(arena, (size_t)solid->face_count + missing, sizeof *faces);
    memcpy(faces, solid->faces, solid->face_count * sizeof *faces);
    for (uint32_t first = 0; first < solid->point_count; first++) {
        if (next[first] == UINT32_MAX)
            continue;
        uint32_t at = next[first];
        next[first] = UINT32_MAX;
        while (at != first && next[at] != UINT32_MAX) {
            uint32_t after = next[at];
            next[at] = UINT32_MAX;
            if (after != first)
                memcpy(faces[face_count++], (uint32_t[3]){first, at, after}, sizeof *faces);
            at = after;
        }
    }
    solid->faces = faces;
    solid->face_count = face_count;
    return solid_is_closed(arena, solid);
}

bool solid_repair(Arena *arena, Solid *solid) {
    arena_charge(arena, (uint64_t)solid->face_count * 60);
    remove_duplicates(arena, solid);
    orient_faces(arena, solid);
    if (!fill_holes(arena, solid))
        return false;
    orient_faces(arena, solid);
    return true;
}
