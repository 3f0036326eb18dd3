// walk.c: see walk.h.
#include "value/walk.h"

#include "maths/random.h"

#include <string.h>

enum { FACTS = 4096, VISITS_BEFORE = 512 };

static WalkFact *place_of(const Walk *walk, const Node *a, const Node *b) {
    uint64_t hash = random_hash_step((uint64_t)(uintptr_t)a, (uint64_t)(uintptr_t)b);
    return &walk->facts[(hash >> 32) % FACTS];
}

bool walk_knows(Walk *walk, Arena *arena, const Node *a, const Node *b, uint64_t *fact) {
    if (!arena)
        return false;
    arena_charge(arena, 2 + (uint64_t)a->attr_count);
    if (!walk->facts && ++walk->visits > VISITS_BEFORE)
        walk->facts = memset(arena_alloc(arena, FACTS * sizeof(WalkFact)), 0, FACTS * sizeof(WalkFact));
    if (!walk->facts)
        return false;
    const WalkFact *known = place_of(walk, a, b);
    *fact = known->fact;
    return known->a == a && known->b == b;
}

void walk_learn(Walk *walk, const Node *a, const Node *b, uint64_t fact) {
    if (walk->facts)
        *place_of(walk, a, b) = (WalkFact){a, b, fact};
}
