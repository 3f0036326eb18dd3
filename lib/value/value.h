// value.h: values of the Flitter language, which are all vectors (spec language.md L4).
//
// A Value is a 16-byte struct that is passed by value. Its data is immutable and in an arena; individual values are
// never freed. A value created in a frame is valid until the frame's arena is reset. value_copy makes a copy that lives
// longer. Functions whose first parameter is an Arena allocate their result there. Results may share memory with
// operands.
//
// Invariants: A vector of length 0 is VALUE_NUMBERS (null) or VALUE_STREAM. A vector that contains only numbers is
// always VALUE_NUMBERS, so a VALUE_MIXED has at least one element that is not a number. A single number is stored
// inline.
#pragma once

#include "base/arena.h"
#include "base/private_api.h"
#include "base/str.h"
#include "value/symbol.h"

typedef struct Node Node;
typedef struct Function Function;

// A string element in UTF-8. It may contain U+0000.
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

// VALUE_ABSENT is not a value of the language. It marks an omitted argument (builtin/builtin.h).
typedef enum ValueKind { VALUE_NUMBERS, VALUE_MIXED, VALUE_STREAM, VALUE_ABSENT } ValueKind;

typedef enum StreamKind { STREAM_UNIFORM, STREAM_BETA, STREAM_NORMAL } StreamKind;

typedef struct Value {
    uint32_t len;   // number of elements; 0 for null and for streams
    uint8_t kind;   // ValueKind
    uint8_t stream; // StreamKind of a VALUE_STREAM
    union {
        double number;         // the element of a VALUE_NUMBERS with len 1
        const double *numbers; // the elements of a VALUE_NUMBERS with len > 1
        const Item *items;     // the elements of a VALUE_MIXED
        uint64_t key;          // the key of a VALUE_STREAM, from which its items are computed
    } as;
} Value;

_Static_assert(sizeof(Value) == 16, "a Value must fit into two registers");

enum { VALUE_MAX_LEN = 1 << 27 }; // maximum number of elements (L5.3, D4)

#define VALUE_NULL ((Value){0})

static inline Value value_number(double x) {
    return (Value){.len = 1, .as.number = x};
}

static inline bool value_is_null(Value v) {
    return v.len == 0 && v.kind == VALUE_NUMBERS;
}

// Returns true if v is not empty and contains only numbers.
static inline bool value_is_numeric(Value v) {
    return v.kind == VALUE_NUMBERS && v.len > 0;
}

// Returns the elements of a numeric vector. The pointer is valid as long as *v, because a single number is stored
// inline in *v.
static inline const double *value_numbers(const Value *v) {
    return v->len == 1 ? &v->as.number : v->as.numbers;
}

// Returns a vector that points to `numbers`. A single number is copied.
static inline Value value_numbers_view(const double *numbers, uint32_t len) {
    return len == 0 ? VALUE_NULL : len == 1 ? value_number(numbers[0]) : (Value){.len = len, .as.numbers = numbers};
}

static inline Value value_stream(StreamKind kind, uint64_t key) {
    return (Value){.kind = VALUE_STREAM, .stream = (uint8_t)kind, .as.key = key};
}

// Returns a string with a copy of the bytes.
const String *value_new_string(Arena *arena, Str text);

// These functions return a vector of one element. The bytes of a string are copied.
static inline Value value_item(Arena *arena, Item item) {
    if (item.type == ITEM_NUMBER)
        return value_number(item.as.number);
    return (Value){.len = 1, .kind = VALUE_MIXED, .as.items = arena_copy(arena, &item, sizeof item)};
}
Value value_string(Arena *arena, Str text);
Value value_function(Arena *arena, const Function *function);

// Returns element i of a vector. i must be less than its length.
static inline Item value_at(const Value *v, uint32_t i) {
    if (v->kind == VALUE_MIXED)
        return v->as.items[i];
    return (Item){ITEM_NUMBER, .as.number = value_numbers(v)[i]};
}

// Returns true if v is true as a condition (L4.6).
bool value_true(Value v);
// Returns true if v is a single number.
static inline bool value_is_number(Value v) {
    return v.len == 1 && v.kind == VALUE_NUMBERS;
}
// Comparisons (compare.c) charge their work to the arena and leave no allocations in it. The arena may be NULL
// only if the values contain no nodes and the caller has charged the work.
//
// Returns true if the vectors are equal (L5.4, operator ==).
bool value_equal(Arena *arena, Value a, Value b);
bool item_equal(Arena *arena, Item a, Item b);
enum { VALUE_INCOMPARABLE = 2 };
// Returns the order of two vectors (L5.5): -1, 0, 1 or VALUE_INCOMPARABLE.
int value_compare(Arena *arena, Value a, Value b);
// Returns the result of `x in y` (L5.6).
bool value_contains(Arena *arena, Value x, Value y);

// Returns v[index] (L5.7). v must not be a stream.
Value value_index(Arena *arena, Value v, Value index);
// Returns a vector of one element: item k of a stream, or the element of v whose index is k modulo the length of v.
// Returns null if v is null. Used for unpacking.
Value value_element(Value v, uint32_t k);
// Returns a vector of the elements of v with indices `start` to start + count - 1, which must exist.
Value value_slice(Arena *arena, Value v, uint32_t start, uint32_t count);
// Returns the index of the element that index x selects in a vector of length n: x rounded down, modulo n. An x that is
// infinite or NaN counts as -2^31 (L5.7, D8).
uint32_t value_wrap_index(double x, uint32_t n);

// Returns a deep copy (copy.c). Only functions and symbols are not copied.
Value value_copy(Arena *arena, Value v);

enum { VALUE_TEXT_WORK = 16 }; // work units per element converted to text
// Returns the elements converted to text and concatenated (L6).
Str value_text(Arena *arena, const SymbolTable *symbols, Value v) PRIVATE_API(value_text);

// A builder that concatenates values, its parts, into a vector (L4.7). A stream is kept only if nothing else is added,
// not even null.
typedef struct Vector {
    Arena *arena;
    union {
        double *numbers;
        Item *items;
    } as;
    uint32_t len;
    uint32_t capacity;
    bool mixed;     // true if the elements are in as.items, false if they are in as.numbers
    bool overflow;  // more than VALUE_MAX_LEN elements were added; the result is null and the caller reports it
    uint32_t parts; // number of parts that are not null
    bool several;   // more than one part was added, null or not
    bool any;       // at least one part was added, null or not
    Value first;    // the first part that is not null; it is the result if all other parts are null
} Vector;

Vector vector_new(Arena *arena);
void vector_add(Vector *vector, Value part);
// Like vector_add, but handles the most common case inline: the part is one number or item, at least two parts that are
// not null were added before, and the vector has spare capacity.
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
