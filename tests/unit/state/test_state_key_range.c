// test_state_key_range.c: key ranges behave exactly like separate entries but use less memory.
#include "base/budget.h"
#include "base/heap.h"
#include "groups.h"
#include "state/state.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { PAIRS = 200, SLOTS = 2 * PAIRS, NUMBERS = 2, OPERATIONS = 40, ROUNDS = 300 };
static const double PREFIX = -7, SYMBOL = -8;

static Value key_of(double id, bool velocity, double buffer[3]) {
    memcpy(buffer, (double[]){PREFIX, id, SYMBOL}, 3 * sizeof *buffer);
    return value_numbers_view(buffer, velocity ? 3 : 2);
}

static StateSlot slot_of(const State *state, double id, bool velocity) {
    double buffer[3];
    return state_find(state, key_of(id, velocity, buffer));
}

static void add_pairs(State *state, int first, int count) {
    double buffer[3];
    for (int i = 0; i < 2 * count; i++)
        assert_int_not_equal(state_slot(state, key_of(first + i / 2, i % 2, buffer)), STATE_NO_SLOT);
}

// A range of any length needs no memory until a key pointer is requested or a separate entry is written.
static void test_range_needs_no_memory(void **unused) {
    enum { MANY = 100000 };
    (void)unused;
    Budget budget = {.memory_limit = SIZE_MAX};
    State *state = state_new(&budget);
    double *rows = calloc(MANY, 2 * NUMBERS * sizeof *rows), buffer[STATE_KEY_BUFFER];
    add_pairs(state, 0, MANY);
    StateOwner owner = state_add_owner(state);
    for (StateSlot slot = 0; slot < 2 * MANY; slot++)
        state_slot_reference(state, slot, owner, rows + (size_t)NUMBERS * slot, NUMBERS);
    assert_int_equal(state_count(state), 2 * MANY);
    assert_true(state_get(state, key_of(MANY / 2, true, buffer)).as.numbers == rows + NUMBERS * (MANY + 1));
    uint32_t cursor = 0, seen = 0;
    for (Value key, value; state_next(state, &cursor, &key, &value, buffer); seen++)
        assert_true(key.len == 2 + seen % 2 && key.as.numbers[1] == seen / 2);
    assert_int_equal(seen, 2 * MANY);
    assert_true(budget.memory < MANY);
    // In the next frame, the owner has another array, and particles with other keys follow.
    double *next_rows = calloc(MANY, 2 * NUMBERS * sizeof *next_rows);
    for (StateSlot slot = 0; slot < 2 * MANY; slot++)
        state_slot_reference(state, slot, owner, next_rows + (size_t)NUMBERS * slot, NUMBERS);
    assert_true(state_slot_get(state, MANY).as.numbers == next_rows + NUMBERS * MANY);
    free(rows);
    rows = next_rows;
    add_pairs(state, 2 * MANY, MANY);
    assert_int_equal(state_slot_count(state), 4 * MANY);
    assert_true(budget.memory < MANY);
    // If there is no memory for separate entries, nothing changes.
    budget.memory_limit = budget.memory + MANY;
    assert_false(state_slot_set(state, 7, value_number(1)));
    assert_true(state_clear_exhausted(state));
    assert_true(state_slot_get(state, 7).as.numbers == rows + 7 * NUMBERS && state_count(state) == 2 * MANY);
    assert_true(state_slot_key(state, 7).len == 0 && state_clear_exhausted(state));
    budget.memory_limit = SIZE_MAX;
    assert_true(state_slot_set(state, 7, value_number(1)));
    assert_true(state_clear_modified(state, owner));
    assert_true(state_slot_get(state, 7).as.number == 1 && state_slot_key(state, 7).as.numbers[1] == 3);
    assert_true(slot_of(state, MANY - 1, true) == 2 * MANY - 1 && budget.memory > MANY);
    state_free(state);
    assert_int_equal(budget.memory, 0);
    free(rows);
}

// A key is in a range only if its bits match exactly.
static void test_range_keys_match_exactly(void **unused) {
    (void)unused;
    State *state = state_new(NULL);
    double buffer[3];
    add_pairs(state, 0, PAIRS);
    static const double strangers[] = {-0.0, 0.5, -1, PAIRS, 1e300, -1e300};
    for (size_t i = 0; i < sizeof strangers / sizeof *strangers; i++)
        assert_int_equal(slot_of(state, strangers[i], false), STATE_NO_SLOT);
    assert_int_equal(state_find(state, value_numbers_view((double[]){PREFIX, 1, SYMBOL + 1}, 3)), STATE_NO_SLOT);
    assert_int_equal(state_find(state, value_numbers_view((double[]){PREFIX + 1, 1}, 2)), STATE_NO_SLOT);
    assert_int_equal(state_slot(state, key_of(-0.0, false, buffer)), SLOTS);
    assert_int_equal(state_slot(state, value_number(PREFIX)), SLOTS + 1);
    assert_int_equal(state_slot(state, key_of(PAIRS, false, buffer)),
                     SLOTS + 2); // because other keys were added after the range, this key does not extend the range
    assert_int_equal(slot_of(state, 0, false), 0);
    assert_int_equal(slot_of(state, PAIRS, false), SLOTS + 2);
    assert_true(state_slot_last_number(state, 5, 2) != state_slot_last_number(state, 5, 2));
    assert_true(state_slot_last_number(state, 4, 2) == 2 && state_slot_last_number(state, 4, 3) != 2);
    add_pairs(state, 1000, PAIRS);
    assert_int_equal(slot_of(state, 1001, true), SLOTS + 3 + 3);
    state_free(state);
}

// Each key has one slot, also if ids have fractions, so that their differences are inexact, or if ids are so large that
// some numbers have no successor.
static void test_fractional_and_large_ids_have_one_slot(void **unused) {
    (void)unused;
    static const double firsts[] = {0.1,     -0.1,         -7.3,          1.0 / 3,       1e-300,       -0x1p-1074,
                                    1e9 / 7, 0x1p53 - 100, 0x1p53 - 99,   0x1p53 + 2,    0x1p52 + 0.5, 0x1p54 + 4,
                                    1e17,    -0x1p53 + 2,  -0x1p53 - 100, -0x1p54 - 100, 0x1p51 + 0.25};
    for (size_t n = 0; n < 2 * sizeof firsts / sizeof *firsts; n++) {
        size_t f = n / 2;
        bool counted = n % 2; // each id is computed from the first one, or from the one before it
        State *state = state_new(NULL);
        double buffer[3], ids[SLOTS];
        StateSlot slots[SLOTS];
        double id = firsts[f];
        for (int i = 0; i < SLOTS; i++, id = i % 2 ? id : counted ? firsts[f] + i / 2 : id + 1) {
            ids[i] = id;
            slots[i] = state_slot(state, key_of(id, i % 2, buffer));
        }
        for (int i = 0; i < SLOTS; i++) {
            Value key = key_of(ids[i], i % 2, buffer);
            assert_int_equal(state_find(state, key), slots[i]);
            assert_int_equal(state_slot(state, key), slots[i]);
            Value stored = state_slot_key(state, slots[i]);
            assert_true(stored.len == key.len && memcmp(stored.as.numbers, buffer, key.len * sizeof *buffer) == 0);
        }
        for (int i = 0; i < SLOTS; i += 2) { // ids between those of a range
            StateSlot slot = state_slot(state, key_of(ids[i] + 0.375, false, buffer));
            assert_int_equal(slot_of(state, ids[i] + 0.375, false), slot);
        }
        state_free(state);
    }
}

// The last particle of a range may have only one slot so far.
static void test_range_may_end_with_incomplete_pair(void **unused) {
    (void)unused;
    State *state = state_new(NULL);
    double buffer[3];
    add_pairs(state, 0, PAIRS);
    assert_int_equal(state_slot(state, key_of(PAIRS, false, buffer)), SLOTS);
    assert_int_equal(slot_of(state, PAIRS, true), STATE_NO_SLOT);
    Value key = state_slot_key(state, SLOTS);
    assert_true(key.len == 2 && memcmp(key.as.numbers, buffer, 2 * sizeof *buffer) == 0);
    state_free(state);
}

static void reference_range(State *state, StateOwner owner, const double *rows, uint32_t count) {
    for (StateSlot slot = 0; slot < count; slot++)
        state_slot_reference(state, slot, owner, rows + (size_t)NUMBERS * slot, NUMBERS);
}

// An owner may start with a third array although most slots still refer to the first.
static void test_range_with_three_arrays_keeps_all_values(void **unused) {
    (void)unused;
    static double rows[3][SLOTS * NUMBERS];
    State *state = state_new(NULL);
    add_pairs(state, 0, PAIRS);
    StateOwner owner = state_add_owner(state);
    reference_range(state, owner, rows[0], SLOTS);
    reference_range(state, owner, rows[1], 10);
    reference_range(state, owner, rows[2], 5);
    for (StateSlot slot = 0; slot < SLOTS; slot++)
        assert_ptr_equal(state_slot_get(state, slot).as.numbers, rows[slot < 5    ? 2
                                                                      : slot < 10 ? 1
                                                                                  : 0] +
                                                                     (size_t)NUMBERS * slot);
    assert_false(state_clear_modified(state, owner));
    state_free(state);
}

// If another owner takes over a slot of a range, the other slots keep their owner, which is marked as modified.
static void test_range_keeps_its_owner(void **unused) {
    (void)unused;
    static double rows[2][SLOTS * NUMBERS];
    State *state = state_new(NULL);
    add_pairs(state, 0, PAIRS);
    StateOwner owner = state_add_owner(state), rival = state_add_owner(state);
    reference_range(state, owner, rows[0], SLOTS);
    reference_range(state, rival, rows[1], 1);
    assert_true(state_clear_modified(state, owner));
    assert_true(state_slot_references(state, 0, rival));
    assert_true(state_slot_references(state, 1, owner));
    state_free(state);
}

// A heap whose allocations fail when `left` reaches 0.
static void *allocate(void *left, size_t size) {
    return (*(int *)left)-- > 0 ? malloc(size) : NULL;
}

static void *resize(void *left, void *block, size_t size) {
    return (*(int *)left)-- > 0 ? realloc(block, size) : NULL;
}

static void release(void *left, void *block) {
    (void)left;
    free(block);
}

// If a range cannot be converted to separate entries because memory runs out, nothing changes.
static void test_failed_conversion_changes_nothing(void **unused) {
    enum { OTHERS = 20 };
    (void)unused;
    int left = INT32_MAX, failures = 0;
    assert_true(heap_set_allocator(&(HeapAllocator){allocate, resize, release, &left}));
    for (bool done = false; !done; failures++) {
        State *state = state_new(NULL);
        add_pairs(state, 0, PAIRS);
        for (int i = 0; i < OTHERS; i++)
            assert_true(state_set(state, value_number(i), value_number(10 * i)));
        left = failures;
        done = state_slot_set(state, 7, value_number(1));
        left = INT32_MAX;
        assert_int_equal(state_clear_exhausted(state), !done);
        assert_int_equal(state_count(state), done ? OTHERS + 1 : OTHERS);
        for (int i = 0; i < OTHERS; i++)
            assert_true(state_get(state, value_number(i)).as.number == 10 * i);
        for (StateSlot slot = 0; slot < SLOTS; slot++)
            assert_int_equal(slot_of(state, slot / 2, slot % 2), slot);
        state_free(state);
    }
    assert_true(failures > 3);
    assert_true(heap_set_allocator(NULL));
}

// A range may start with the id -0, which is different from 0.
static void test_range_may_start_at_negative_zero(void **unused) {
    enum { FIRST = 2 };
    (void)unused;
    State *state = state_new(NULL);
    double buffer[STATE_KEY_BUFFER];
    for (int i = 0; i < FIRST; i++) // add other entries before the range
        assert_int_equal(state_slot(state, value_number(i)), i);
    for (int i = 0; i < SLOTS; i++)
        assert_int_equal(state_slot(state, key_of(i < 2 ? -0.0 : i / 2, i % 2, buffer)), FIRST + i);
    assert_int_equal(slot_of(state, 0, false), STATE_NO_SLOT);
    assert_int_equal(slot_of(state, -0.0, false), FIRST);
    assert_int_equal(slot_of(state, -0.0, true), FIRST + 1);
    assert_int_equal(slot_of(state, 1, false), FIRST + 2);
    assert_true(signbit(state_slot_last_number(state, FIRST, 2)));
    assert_true(signbit(state_slot_key_in(state, FIRST, buffer).as.numbers[1]));
    assert_true(signbit(state_slot_key(state, FIRST + 1).as.numbers[1]));
    state_free(state);
}

// Expected contents of the dictionary.
typedef struct Model {
    State *state;
    StateOwner owner;
    double rows[2][SLOTS * NUMBERS]; // current and previous array of the owner
    int turn;
    StateSlot slots[SLOTS]; // by key; STATE_NO_SLOT: removed
    double values[SLOTS][NUMBERS];
    bool has[SLOTS];
} Model;

static void check_model(const Model *model) {
    uint32_t live = 0;
    for (uint32_t i = 0; i < SLOTS; i++) {
        double buffer[3];
        Value key = key_of(i / 2, i % 2, buffer);
        StateSlot slot = model->slots[i];
        assert_int_equal(state_find(model->state, key), slot);
        if (slot == STATE_NO_SLOT)
            continue;
        Value v = state_slot_get(model->state, slot);
        assert_true(state_slot_has_key(model->state, slot, key));
        assert_int_equal(v.len, model->has[i] ? NUMBERS : 0);
        assert_true(v.len == 0 || memcmp(v.as.numbers, model->values[i], sizeof model->values[i]) == 0);
        live += v.len > 0;
    }
    assert_int_equal(state_count(model->state), live);
}

static void reference_numbers(Model *model, uint32_t from, uint32_t to) {
    double *rows = model->rows[model->turn = 1 - model->turn];
    for (uint32_t i = from; i < to; i++) {
        if (model->slots[i] == STATE_NO_SLOT)
            continue;
        for (int k = 0; k < NUMBERS; k++)
            model->values[i][k] = rows[NUMBERS * i + (uint32_t)k] = rand();
        model->has[i] = true;
        state_slot_reference(model->state, model->slots[i], model->owner, rows + (size_t)NUMBERS * i, NUMBERS);
    }
    // The previous array becomes invalid, as at the end of a frame. Slots that still point to it are detached.
    for (uint32_t i = 0; i < SLOTS; i++)
        if (i < from || i >= to)
            assert_true(state_slot_detach(model->state, model->slots[i], model->owner));
    memset(model->rows[1 - model->turn], 0, sizeof model->rows[0]);
}

static void compact_state(Model *model) {
    uint8_t used[SLOTS];
    StateSlot moved[SLOTS];
    for (uint32_t i = 0; i < SLOTS; i++)
        used[i] = rand() % 2;
    assert_true(state_compact(model->state, used, moved));
    for (uint32_t i = 0; i < SLOTS; i++)
        if (model->slots[i] != STATE_NO_SLOT) {
            assert_true(!model->has[i] || moved[model->slots[i]] != STATE_NO_SLOT);
            model->slots[i] = moved[model->slots[i]];
        }
}

static void set_value(Model *model, uint32_t i, bool value) {
    double numbers[NUMBERS] = {rand(), 1};
    if (model->slots[i] == STATE_NO_SLOT)
        return;
    assert_true(
        state_slot_set(model->state, model->slots[i], value ? value_numbers_view(numbers, NUMBERS) : VALUE_NULL));
    memcpy(model->values[i], numbers, sizeof numbers);
    model->has[i] = value;
}

// After random operations, a range has the same keys and values as separate entries.
static void test_range_matches_entries(void **unused) {
    (void)unused;
    srand(1);
    for (int round = 0; round < ROUNDS; round++) {
        Model *model = calloc(1, sizeof *model);
        model->state = state_new(NULL);
        model->owner = state_add_owner(model->state);
        add_pairs(model->state, 0, PAIRS);
        for (uint32_t i = 0; i < SLOTS; i++)
            model->slots[i] = i;
        for (int i = 0; i < OPERATIONS; i++) {
            uint32_t some = (uint32_t)rand() % SLOTS, kind = (uint32_t)rand() % 64;
            if (kind < 30)
                reference_numbers(model, 0, SLOTS);
            else if (kind < 34)
                reference_numbers(model, kind % 2 ? some : 0, kind % 2 ? SLOTS : some);
            else if (kind < 36)
                set_value(model, some, kind % 2);
            else if (kind == 36)
                compact_state(model);
            else if (kind == 37)
                assert_true(state_slot_key(model->state, some % state_slot_count(model->state)).len > 1);
            check_model(model);
        }
        state_free(model->state);
        free(model);
    }
}

TEST_GROUP(state_key_range) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_range_needs_no_memory),
        cmocka_unit_test(test_range_keys_match_exactly),
        cmocka_unit_test(test_fractional_and_large_ids_have_one_slot),
        cmocka_unit_test(test_range_may_end_with_incomplete_pair),
        cmocka_unit_test(test_range_with_three_arrays_keeps_all_values),
        cmocka_unit_test(test_range_keeps_its_owner),
        cmocka_unit_test(test_failed_conversion_changes_nothing),
        cmocka_unit_test(test_range_may_start_at_negative_zero),
        cmocka_unit_test(test_range_matches_entries),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
