// operand.h: the operands of an operation, and where their edges and triangles intersect.
#pragma once

#include "solid/face_tree.h"
#include "solid/predicates.h"
#include "solid/topology.h"

// An edge that crosses a triangle of the other operand.
typedef struct Crossing {
    uint32_t edge;
    uint32_t face;  // of the other operand
    int32_t leaves; // 1 if the edge leaves the other solid, -1 if it enters it; 0: does not cross
    uint32_t point; // point of the result
    double along;   // position on the edge, from 0 to 1
} Crossing;

typedef struct Operand {
    const Solid *solid;
    bool first;         // true: the operand that is enlarged or shrunk
    Position *at;       // positions used for decisions; finer than the coordinates of the solid
    int32_t *inclusion; // by point: how many times the result contains the point; negative: inside out
    uint32_t *copies;   // by point: the first point of the result that is a copy
    SolidEdge *edges;
    uint32_t edge_count;
    FaceTree tree;
    Crossing *crossings;
    uint32_t crossing_count;
    uint32_t crossing_capacity;
} Operand;

// Reads an operand. `shift` is in units of the solid: the distance by which its faces are moved outwards.
Operand operand_new(Arena *arena, const Solid *solid, bool first, int shift);
// Finds all crossings of the operand's edges with triangles of the other operand.
void operand_cross(Arena *arena, Operand *operand, const Operand *other);
// Stores in `inclusion` how many times the other solid contains each point. This is 0 or 1, unless solids overlap
// themselves.
void operand_find_windings(Arena *arena, Operand *operand, const Operand *other);
