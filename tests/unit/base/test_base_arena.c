// test_base_arena.c: tests of arenas: alignment, marks, growth and limits.
#include "base/arena.h"
#include "check.h"

static void test_allocations_are_aligned(void **state) {
    (void)state;
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    for (size_t size = 0; size < 100; size++)
        assert_int_equal((uintptr_t)arena_alloc(&arena, size) % 16, 0);
    for (size_t size = 1; size < 10 << 20; size *= 3)
        assert_int_equal((uintptr_t)arena_alloc(&arena, size) % 16, 0);
    arena_free(&arena);
}

// Writing all bytes of an allocation does not change other allocations.
static void test_allocations_do_not_overlap(void **state) {
    (void)state;
    enum { COUNT = 400 };
    unsigned char *parts[COUNT];
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    for (int i = 0; i < COUNT; i++) {
        parts[i] = arena_alloc(&arena, (size_t)(i * 7));
        memset(parts[i], i & 255, (size_t)(i * 7));
    }
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < i * 7; k++)
            assert_int_equal(parts[i][k], i & 255);
    arena_free(&arena);
}

static void test_copy_is_independent(void **state) {
    (void)state;
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    char *copy = arena_copy(&arena, "petri", 6);
    assert_string_equal(copy, "petri");
    assert_non_null(arena_copy(&arena, NULL, 0));
    arena_free(&arena);
}

static void test_rewind_drops_later_allocations(void **state) {
    (void)state;
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    ArenaMark empty = arena_mark(&arena);
    char *kept = arena_copy(&arena, "kept", 5);
    ArenaMark mark = arena_mark(&arena);
    size_t used = arena.used;
    char *first = arena_alloc(&arena, 100);
    for (int i = 0; i < 50; i++) // enough allocations to fill several blocks
        memset(arena_alloc(&arena, 5000), 1, 5000);
    arena_rewind(&arena, mark);
    assert_int_equal(arena.used, used);
    assert_string_equal(kept, "kept");
#ifndef PETRI_STRESS
    assert_ptr_equal(arena_alloc(&arena, 100), first); // after a rewind, the same address is allocated again
#else
    (void)first;
#endif
    arena_rewind(&arena, mark);
    arena_rewind(&arena, mark); // rewinding to the same mark twice is harmless
    assert_string_equal(kept, "kept");
    arena_rewind(&arena, empty);
    assert_int_equal(arena.used, 0);
    memset(arena_alloc(&arena, 300), 2, 300);
    arena_free(&arena);
}

// Rewinds to a nested mark in a later block, then to the outer mark.
static void test_marks_nest(void **state) {
    (void)state;
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    memset(arena_alloc(&arena, 10000), 1, 10000);
    ArenaMark outer = arena_mark(&arena);
    memset(arena_alloc(&arena, 30000), 2, 30000);
    ArenaMark inner = arena_mark(&arena);
    memset(arena_alloc(&arena, 90000), 3, 90000);
    arena_rewind(&arena, inner);
    assert_int_equal(arena.used, 40000);
    memset(arena_alloc(&arena, 64), 4, 64);
    arena_rewind(&arena, outer);
    assert_int_equal(arena.used, 10000);
    memset(arena_alloc(&arena, 90000), 5, 90000);
    arena_free(&arena);
}

static void test_reset_keeps_blocks(void **state) {
    (void)state;
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    for (int round = 0; round < 3; round++) {
        for (int i = 0; i < 20; i++)
            memset(arena_alloc(&arena, 4000), round, 4000);
        assert_int_equal(arena.used, 80000);
        arena_reset(&arena);
        assert_int_equal(arena.used, 0);
    }
    assert_int_equal(arena.high_water, 80000);
    ArenaBlock *first = arena.first;
    arena_alloc(&arena, 16);
    assert_ptr_equal(arena.first, first);
    assert_int_equal(arena.high_water, 80000);
    arena_free(&arena);
    assert_null(arena.first);
}

static void test_high_water_is_largest_use(void **state) {
    (void)state;
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    arena_alloc(&arena, 160);
    ArenaMark mark = arena_mark(&arena);
    arena_alloc(&arena, 320);
    arena_rewind(&arena, mark);
    arena_alloc(&arena, 16);
    assert_int_equal(arena.used, 176);
    assert_int_equal(arena.high_water, 480);
    arena_free(&arena);
}

static void test_grow_keeps_contents(void **state) {
    (void)state;
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    char *bytes = arena_grow(&arena, NULL, 0, 8);
    memcpy(bytes, "1234567", 8);
    char *same = arena_grow(&arena, bytes, 8, 40);
#ifndef PETRI_STRESS
    assert_ptr_equal(same, bytes); // the last allocation can be extended in place
#endif
    memset(same + 8, 'x', 32);
    char *other = arena_alloc(&arena, 16);
    memset(other, 'o', 16);
    char *moved = arena_grow(&arena, same, 40, 80);
    assert_ptr_not_equal(moved, same);
    assert_memory_equal(moved, "1234567", 8);
    for (int i = 8; i < 40; i++)
        assert_int_equal(moved[i], 'x');
    assert_int_equal(other[15], 'o');
    size_t size = 80;
    for (; size < 1 << 20; size *= 2) { // grows across many block boundaries
        memset(moved + size / 2, 'y', size / 2);
        moved = arena_grow(&arena, moved, size, size * 2);
    }
    assert_memory_equal(moved, "1234567", 8);
    assert_int_equal(moved[size / 2 - 1], 'y');
    arena_free(&arena);
}

typedef struct Attempt {
    Arena arena;
    size_t size;
    size_t count;
    void *bytes;
} Attempt;

// Returns true if the action escaped.
static bool escapes(Attempt *attempt, void (*action)(Attempt *)) {
    jmp_buf escape;
    attempt->arena.escape = &escape;
    if (setjmp(escape) != 0)
        return true;
    action(attempt);
    return false;
}

static void alloc_size(Attempt *attempt) {
    attempt->bytes = arena_alloc(&attempt->arena, attempt->size);
}

static void alloc_array(Attempt *attempt) {
    attempt->bytes = arena_alloc_array(&attempt->arena, attempt->count, attempt->size);
}

static void grow_to_size(Attempt *attempt) {
    attempt->bytes = arena_grow(&attempt->arena, attempt->bytes, 16, attempt->size);
}

static void test_exceeded_limit_escapes(void **state) {
    (void)state;
    Attempt attempt = {.size = 1000};
    arena_init(&attempt.arena, "test", 10000);
    for (int i = 0; i < 9; i++)
        assert_false(escapes(&attempt, alloc_size));
    assert_int_equal(attempt.arena.used, 9 * 1008);
    assert_true(escapes(&attempt, alloc_size));
    assert_int_equal(attempt.arena.used, 9 * 1008); // a failed allocation uses no memory
    attempt.size = 16;
    assert_false(escapes(&attempt, alloc_size));
    attempt.size = 20000;
    assert_true(escapes(&attempt, grow_to_size));
    arena_reset(&attempt.arena);
    attempt.size = 10000;
    assert_false(escapes(&attempt, alloc_size)); // arena_reset starts counting from zero
    arena_free(&attempt.arena);
}

// Makes AddressSanitizer return NULL for an impossibly large malloc instead of aborting the program.
const char *__asan_default_options(void);
const char *__asan_default_options(void) {
    return "allocator_may_return_null=1";
}

static void test_overflowing_sizes_escape(void **state) {
    (void)state;
    Attempt attempt = {.size = 16, .count = SIZE_MAX / 8};
    arena_init(&attempt.arena, "test", SIZE_MAX);
    assert_true(escapes(&attempt, alloc_array));
    attempt.size = SIZE_MAX / 2;
    assert_true(escapes(&attempt, alloc_size)); // more memory than any machine has
    attempt.size = SIZE_MAX - 3;                // rounding the size up to the alignment must not overflow
    assert_true(escapes(&attempt, alloc_size));
    attempt.size = SIZE_MAX - 40; // adding the size of the block header must not overflow
    assert_true(escapes(&attempt, alloc_size));
    attempt.size = 0;
    attempt.count = SIZE_MAX;
    assert_false(escapes(&attempt, alloc_array));
    assert_non_null(attempt.bytes);
    arena_free(&attempt.arena);
}

TEST_GROUP(base_arena) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_allocations_are_aligned),
        cmocka_unit_test(test_allocations_do_not_overlap),
        cmocka_unit_test(test_copy_is_independent),
        cmocka_unit_test(test_rewind_drops_later_allocations),
        cmocka_unit_test(test_marks_nest),
        cmocka_unit_test(test_reset_keeps_blocks),
        cmocka_unit_test(test_high_water_is_largest_use),
        cmocka_unit_test(test_grow_keeps_contents),
        cmocka_unit_test(test_exceeded_limit_escapes),
        cmocka_unit_test(test_overflowing_sizes_escape),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
