// seed.c: see seed.h.
#include "value/seed.h"

#include "base/cpu.h"
#include "base/number.h"
#include "maths/many.h"
#include "maths/random.h"
#include "value/run.h"
#include "value/walk.h"

#include <math.h>
#include <string.h>

typedef struct Hashing {
    Arena *arena; // NULL: free of charge
    Walk walk;
} Hashing;

static uint64_t hash_vector(Hashing *hashing, Value v, bool floored);

static uint64_t hash_node(Hashing *hashing, const Node *node) {
    uint64_t hash;
    if (walk_knows(&hashing->walk, hashing->arena, node, NULL, &hash))
        return hash;
    hash = random_hash_step(RANDOM_HASH_START, symbol_hash(node->kind->name));
    for (uint32_t i = 0; i < node->tag_count; i++)
        hash = random_hash_step(hash, symbol_hash(node->tags[i]->name));
    // Attributes count in the order of their names, whatever the order in which they were set.
    const Symbol *last = NULL;
    for (uint32_t done = 0; done < node->attr_count; done++) {
        const Attr *next = NULL;
        if (hashing->arena)
            arena_charge(hashing->arena, node->attr_count / 4);
        for (uint32_t i = 0; i < node->attr_count; i++) {
            const Attr *attr = &node->attrs[i];
            if ((!last || str_compare(attr->name->name, last->name) > 0) &&
                (!next || str_compare(attr->name->name, next->name->name) < 0))
                next = attr;
        }
        if (!next)
            break;
        hash = random_hash_step(hash, symbol_hash(next->name->name));
        hash = random_hash_step(hash, hash_vector(hashing, next->value, false));
        last = next->name;
    }
    uint32_t count;
    const Node *const *children = node_children(hashing->arena, node, &count);
    for (uint32_t i = 0; i < count; i++)
        hash = random_hash_step(hash, hash_node(hashing, children[i]));
    walk_learn(&hashing->walk, node, NULL, hash);
    return hash;
}

static uint64_t hash_item(Hashing *hashing, Item item, bool floored) {
    switch (item.type) {
    case ITEM_NUMBER:
        return floored ? random_hash_number(item.as.number) : number_bits(item.as.number);
    case ITEM_STRING:
        return symbol_hash(item.as.string->text);
    case ITEM_NODE:
        return hash_node(hashing, item.as.node);
    default:
        return symbol_hash(item.as.function->name); // unspecified; the name keeps runs reproducible
    }
}

static uint64_t hash_vector(Hashing *hashing, Value v, bool floored) {
    uint64_t hash = RANDOM_HASH_START;
    for (uint32_t i = 0; i < v.len; i++) {
        if (i % METER_PORTION == METER_PORTION - 1 && hashing->arena)
            arena_charge(hashing->arena, METER_PORTION / 4);
        hash = random_hash_step(hash, hash_item(hashing, value_at(&v, i), floored));
    }
    return hash;
}

static uint64_t hash_all(Arena *arena, Value seed, bool floored) {
    Hashing hashing = {arena, {0}};
    ArenaMark mark = arena ? arena_mark(arena) : (ArenaMark){0};
    uint64_t hash = hash_vector(&hashing, seed, floored);
    if (hashing.walk.facts)
        arena_rewind(arena, mark);
    return hash;
}

uint64_t value_exact_hash(Arena *arena, Value seed) {
    return hash_all(arena, seed, false);
}

uint64_t value_seed_hash(Arena *arena, Value seed) {
    return hash_all(arena, seed, true);
}

double value_stream_item(Value stream, uint64_t i) {
    switch ((StreamKind)stream.stream) {
    case STREAM_UNIFORM:
        return random_uniform(stream.as.key, i);
    case STREAM_BETA:
        return random_beta(stream.as.key, i);
    default:
        return random_normal(stream.as.key, i);
    }
}

static void items_in_a_row(Value stream, uint64_t first, uint32_t count, double *to) {
    if (count > 1 && stream.stream == STREAM_UNIFORM)
        maths_uniform_many(cpu_here.level, stream.as.key, first, count, to);
    else if (count > 1 && stream.stream == STREAM_NORMAL)
        random_normals(cpu_here.level, stream.as.key, first, count, to);
    else
        for (uint32_t i = 0; i < count; i++)
            to[i] = value_stream_item(stream, first + i);
}

void value_stream_items(Value stream, const double *at, uint32_t count, double *to) {
    for (uint32_t i = 0, run; i < count; i += run) {
        uint64_t first = value_stream_position(at[i]);
        run = 1;
        while (i + run < count && first + run != 0 && value_stream_position(at[i + run]) == first + run)
            run++;
        items_in_a_row(stream, first, run, to + i);
    }
}

uint64_t value_stream_position(double x) {
    double whole = number_floor(x);
    // Beyond the range of 64 bits the x86 conversion gives the least integer; so do we on every machine.
    if (!(whole >= -9223372036854775808.0 && whole < 9223372036854775808.0))
        return UINT64_C(1) << 63;
    return (uint64_t)(int64_t)whole;
}
