// walk.h: walking trees whose nodes are shared, so that a walk has more steps than there are nodes.
//
// A walk charges for each node that it comes to and, once they are many, remembers what it found out about the last
// ones. All zeros begins a walk; what it remembers lies in the arena, above whatever is there.
#ifndef PETRI_VALUE_WALK_H
#define PETRI_VALUE_WALK_H

#include "value/node.h"

typedef struct WalkFact {
    const Node *a;
    const Node *b;
    uint64_t fact;
} WalkFact;

typedef struct Walk {
    WalkFact *facts; // by hash, the latest wins; NULL: it has not come far yet
    uint32_t visits;
} Walk;

// Comes to a node, or to two at once (`b` may be NULL); true if their fact is known. Without an arena nothing is
// charged and nothing remembered.
bool walk_knows(Walk *walk, Arena *arena, const Node *a, const Node *b, uint64_t *fact);
void walk_learn(Walk *walk, const Node *a, const Node *b, uint64_t fact);

#endif
