// value.h: the vectors that every Flitter value is (spec language.md L4).
//
// A Value is 16 bytes passed by value. Values are immutable and borrowed from an arena; nobody frees one. A value from
// a frame is valid until that frame's arena is reset; longer life is reached only by value_copy. Functions that take an
// Arena first put their result there; results may share memory with their operands.
//
// Invariants: a vector of length 0 is VALUE_NUMBERS (null) or VALUE_STREAM; a vector of numbers only is always
// VALUE_NUMBERS, so VALUE_MIXED means at least one element is not a number; one number is stored inline.
#ifndef PETRI_VALUE_VALUE_H
#define PETRI_VALUE_VALUE_H

#include "base/arena.h"
#include "base/str.h"
#include "value/symbol.h"

typedef struct Node Node;
typedef struct Function Function;

// Text of a string element; UTF-8, may hold U+0000.
typedef struct String {
    Str text;
} String;

typedef enum ItemType { ITEM_NUMBER, ITEM_STRING, ITEM_NODE, ITEM_FUNCTION } ItemType;

// One element of a mixed vector.
typedef struct Item {
    ItemType type;
    union {
        double number;
        const String *string;
        const Node *node;
        const Function *function;
    } as;
} Item;

typedef enum ValueKind { VALUE_NUMBERS, VALUE_MIXED, VALUE_STREAM, VALUE_ABSENT } ValueKind;
// VALUE_ABSENT is not a value of the language: it marks an argument that was not given (builtin/builtin.h).

typedef enum StreamKind { STREAM_UNIFORM, STREAM_BETA, STREAM_NORMAL } StreamKind;

typedef struct Value {
    uint32_t len;
    uint8_t kind;   // ValueKind
    uint8_t stream; // StreamKind of a VALUE_STREAM
    union {
        double number;         // VALUE_NUMBERS, len 1
        const double *numbers; // VALUE_NUMBERS, len > 1
        const Item *items;     // VALUE_MIXED
        uint64_t key;          // VALUE_STREAM
    } as;
} Value;

_Static_assert(sizeof(Value) == 16, "a Value travels in two registers");

enum { VALUE_MAX_LEN = 1 << 27 }; // elements (L5.3, D4)

#define VALUE_NULL ((Value){0})

static inline Value value_number(double x) {
    return (Value){.len = 1, .as.number = x};
}

static inline bool value_is_null(Value v) {
    return v.len == 0 && v.kind == VALUE_NUMBERS;
}

// Non-empty and numbers only.
static inline bool value_is_numeric(Value v) {
    return v.kind == VALUE_NUMBERS && v.len > 0;
}

// The elements of a numeric vector. Takes the address, since one number is stored inline: valid while *v is.
static inline const double *value_numbers(const Value *v) {
    return v->len == 1 ? &v->as.number : v->as.numbers;
}

// Borrows `numbers` unless there is one element.
static inline Value value_numbers_view(const double *numbers, uint32_t len) {
    return len == 0 ? VALUE_NULL : len == 1 ? value_number(numbers[0]) : (Value){.len = len, .as.numbers = numbers};
}

static inline Value value_stream(StreamKind kind, uint64_t key) {
    return (Value){.kind = VALUE_STREAM, .stream = (uint8_t)kind, .as.key = key};
}

// One-element vectors. The string's bytes are copied.
Value value_string(Arena *arena, Str text);
Value value_function(Arena *arena, const Function *function);
Value value_item(Arena *arena, Item item);

// Element i (below len) of any vector.
static inline Item value_at(const Value *v, uint32_t i) {
    if (v->kind == VALUE_MIXED)
        return v->as.items[i];
    return (Item){ITEM_NUMBER, .as.number = value_numbers(v)[i]};
}

// Truth (L4.6).
bool value_true(Value v);
// Comparisons (compare.c) charge for what they look at to the arena and leave nothing in it; NULL is for values without
// nodes that somebody else has charged for.
//
// Equality of whole vectors (L5.4), the operator ==.
bool value_equal(Arena *arena, Value a, Value b);
bool item_equal(Arena *arena, Item a, Item b);
// Order of whole vectors (L5.5): -1, 0, 1, or VALUE_INCOMPARABLE.
enum { VALUE_INCOMPARABLE = 2 };
int value_compare(Arena *arena, Value a, Value b);
// `x in y` (L5.6).
bool value_contains(Arena *arena, Value x, Value y);

// v[index] (L5.7). v must not be a stream.
Value value_index(Arena *arena, Value v, Value index);
// Element k modulo the length, as a vector; null for null. Used by unpacking; v must not be a stream.
Value value_element(Arena *arena, Value v, uint32_t k);
// Elements start … start+count-1, which must exist.
Value value_slice(Arena *arena, Value v, uint32_t start, uint32_t count);
// The index of an element for a floored index x into a vector of length n (L5.7, D8).
uint32_t value_wrap_index(double x, uint32_t n);

// A deep copy: nothing in the result points outside the arena, but for functions and symbols.
Value value_copy(Arena *arena, Value v);

enum { VALUE_TEXT_WORK = 16 }; // of an element that is written as text
// The text of a vector: the concatenation of its elements' texts (L6).
Str value_text(Arena *arena, const SymbolTable *symbols, Value v);

// A vector under construction. Collects values in order; `vector_finish` gives their composition (L4.7). A stream
// survives only if it is the single part, nulls counted.
typedef struct Vector {
    Arena *arena;
    union {
        double *numbers;
        Item *items;
    } as;
    uint32_t len;
    uint32_t capacity;
    bool mixed;
    bool overflow;  // more than VALUE_MAX_LEN elements were added: the result is null and the caller reports it
    uint32_t parts; // that are not null
    bool several;   // more than one part was added, null or not
    bool any;
    Value first; // the first part, returned as it is if it stays the only one
} Vector;

Vector vector_new(Arena *arena);
void vector_add(Vector *vector, Value part);
// The same for the most common part: one more number or item of a vector that has room for it.
static inline void vector_add_part(Vector *vector, const Value *part) {
    if (vector->parts > 1 && part->len == 1 && vector->len < vector->capacity) {
        if (part->kind == VALUE_NUMBERS && !vector->mixed) {
            vector->as.numbers[vector->len++] = part->as.number;
            return;
        }
        if (part->kind == VALUE_MIXED && vector->mixed) {
            vector->as.items[vector->len++] = part->as.items[0];
            return;
        }
    }
    vector_add(vector, *part);
}
void vector_add_number(Vector *vector, double x);
void vector_add_item(Vector *vector, Item item);
Value vector_finish(Vector *vector);

#endif
