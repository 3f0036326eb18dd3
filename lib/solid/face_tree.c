// face_tree.c: see face_tree.h. The boxes are sorted along a Morton curve. Each level then groups four neighbours.
#include "solid/face_tree.h"

#include <string.h>

enum { AXIS_BITS = 14, RADIX_BITS = 14, RADIX = 1 << RADIX_BITS };

static uint64_t spread_bits(uint64_t x) {
    uint64_t code = 0;
    for (int i = 0; i < AXIS_BITS; i++)
        code |= (x >> i & 1) << 3 * i;
    return code;
}

static FaceBox join_boxes(const FaceBox *boxes, uint32_t count) {
    FaceBox all = boxes[0];
    for (uint32_t i = 1; i < count; i++)
        for (int k = 0; k < 3; k++) {
            all.low[k] = boxes[i].low[k] < all.low[k] ? boxes[i].low[k] : all.low[k];
            all.high[k] = boxes[i].high[k] > all.high[k] ? boxes[i].high[k] : all.high[k];
        }
    return all;
}

typedef struct CodedFace {
    uint64_t code;
    uint32_t face;
} CodedFace;

// Sorts by code. Equal codes keep their order.
static void sort_codes(Arena *arena, CodedFace *faces, uint32_t count) {
    CodedFace *other = arena_alloc_array(arena, count, sizeof *other);
    uint32_t *starts = arena_alloc_array(arena, RADIX, sizeof *starts);
    for (int shift = 0; shift < 3 * AXIS_BITS; shift += RADIX_BITS) {
        memset(starts, 0, RADIX * sizeof *starts);
        for (uint32_t i = 0; i < count; i++)
            starts[faces[i].code >> shift & (RADIX - 1)]++;
        for (uint32_t i = 0, sum = 0; i < RADIX; i++) {
            uint32_t here = starts[i];
            starts[i] = sum;
            sum += here;
        }
        for (uint32_t i = 0; i < count; i++)
            other[starts[faces[i].code >> shift & (RADIX - 1)]++] = faces[i];
        memcpy(faces, other, count * sizeof *faces);
    }
}

FaceTree face_tree_new(Arena *arena, const FaceBox *boxes, uint32_t count) {
    FaceTree tree = {.faces = arena_alloc_array(arena, count, sizeof *tree.faces)};
    if (count == 0)
        return tree;
    tree.levels[0] = arena_alloc_array(arena, count, sizeof *tree.levels[0]);
    FaceBox all = join_boxes(boxes, count);
    ArenaMark mark = arena_mark(arena);
    CodedFace *coded = arena_alloc_array(arena, count, sizeof *coded);
    for (uint32_t i = 0; i < count; i++) {
        coded[i] = (CodedFace){.face = i};
        for (int k = 0; k < 3; k++) {
            int64_t middle = ((int64_t)boxes[i].low[k] + boxes[i].high[k]) / 2 - all.low[k];
            int64_t size = (int64_t)all.high[k] - all.low[k] + 1;
            coded[i].code |= spread_bits((uint64_t)((middle << AXIS_BITS) / size)) << k;
        }
    }
    sort_codes(arena, coded, count);
    for (uint32_t i = 0; i < count; i++) {
        tree.faces[i] = coded[i].face;
        tree.levels[0][i] = boxes[coded[i].face];
    }
    arena_rewind(arena, mark);
    tree.counts[0] = count;
    tree.level_count = 1;
    while (tree.counts[tree.level_count - 1] > 1) {
        const FaceBox *below = tree.levels[tree.level_count - 1];
        uint32_t below_count = tree.counts[tree.level_count - 1];
        uint32_t here = (below_count + FACE_TREE_WAYS - 1) / FACE_TREE_WAYS;
        FaceBox *level = arena_alloc_array(arena, here, sizeof *level);
        for (uint32_t i = 0; i < here; i++) {
            uint32_t first = i * FACE_TREE_WAYS, left = below_count - first;
            level[i] = join_boxes(below + first, left < FACE_TREE_WAYS ? left : FACE_TREE_WAYS);
        }
        tree.levels[tree.level_count] = level;
        tree.counts[tree.level_count++] = here;
    }
    return tree;
}

static bool boxes_meet(const FaceBox *a, const FaceBox *b) {
    return a->low[0] <= b->high[0] && b->low[0] <= a->high[0] && a->low[1] <= b->high[1] && b->low[1] <= a->high[1] &&
           a->low[2] <= b->high[2] && b->low[2] <= a->high[2];
}

void face_tree_find(Arena *arena, const FaceTree *tree, const FaceBox *box, FaceList *found) {
    struct {
        uint32_t index;
        int level;
    } stack[FACE_TREE_WAYS * FACE_TREE_LEVELS];
    int depth = 0;
    found->count = 0;
    if (tree->level_count == 0)
        return;
    stack[depth].index = 0;
    stack[depth++].level = tree->level_count - 1;
    while (depth > 0) {
        uint32_t index = stack[--depth].index;
        int level = stack[depth].level;
        if (!boxes_meet(&tree->levels[level][index], box))
            continue;
        if (level == 0) {
            found->items = arena_grow_array(arena, found->items, found->count, &found->capacity, sizeof *found->items);
            found->items[found->count++] = tree->faces[index];
            continue;
        }
        for (uint32_t k = 0; k < FACE_TREE_WAYS; k++) {
            uint32_t child = index * FACE_TREE_WAYS + FACE_TREE_WAYS - 1 - k;
            if (child >= tree->counts[level - 1])
                continue;
            stack[depth].index = child;
            stack[depth++].level = level - 1;
        }
    }
}
