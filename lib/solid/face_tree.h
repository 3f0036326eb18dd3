// face_tree.h: a tree of boxes, which finds the triangles near a box.
#pragma once

#include "base/arena.h"

// Boxes contain their bounds.
typedef struct FaceBox {
    int32_t low[3];
    int32_t high[3];
} FaceBox;

enum { FACE_TREE_WAYS = 4, FACE_TREE_LEVELS = 16 };

typedef struct FaceTree {
    uint32_t *faces;                   // in the order of a space-filling curve
    FaceBox *levels[FACE_TREE_LEVELS]; // levels[0]: boxes of `faces`; each box of the next level covers up to four
    uint32_t counts[FACE_TREE_LEVELS];
    int level_count;
} FaceTree;

// A growing list of indices.
typedef struct FaceList {
    uint32_t *items;
    uint32_t count;
    uint32_t capacity;
} FaceList;

// Builds the tree of `count` boxes.
FaceTree face_tree_new(Arena *arena, const FaceBox *boxes, uint32_t count);
// Sets the list to the indices of all boxes that intersect the box.
void face_tree_find(Arena *arena, const FaceTree *tree, const FaceBox *box, FaceList *found);
