// test_state_compact.c: removal of slots whose keys were removed.
#include "groups.h"
#include "state/state.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { COUNT = 300 };

static State *filled(void) {
    State *state = state_new(NULL);
    for (int i = 0; i < COUNT; i++) {
        const double pair[2] = {i, i + 0.5};
        assert_true(state_set(state, value_number(i), value_numbers_view(pair, 2)));
    }
    return state;
}

static double second_of(const State *state, double key) {
    Value v = state_get(state, value_number(key));
    return v.len == 2 ? v.as.numbers[1] : -1;
}

// Removes every third key. One of the removed slots is still referenced.
static void test_compact_keeps_used_slots_in_order(void **unused) {
    (void)unused;
    State *state = filled();
    for (int i = 0; i < COUNT; i += 3)
        state_set(state, value_number(i), VALUE_NULL);
    StateSlot held = state_find(state, value_number(30)), other = state_find(state, value_number(31));
    uint8_t used[COUNT] = {0};
    StateSlot moved[COUNT];
    used[held] = 1;
    assert_int_equal(state_slot_count(state), COUNT);
    assert_true(state_compact(state, used, moved));
    assert_int_equal(state_slot_count(state), COUNT - COUNT / 3 + 1);
    assert_int_equal(state_count(state), COUNT - COUNT / 3);
    assert_int_equal(moved[0], STATE_NO_SLOT);
    assert_int_equal(state_find(state, value_number(0)), STATE_NO_SLOT);
    assert_int_equal(state_find(state, value_number(30)), moved[held]);
    assert_int_equal(state_find(state, value_number(31)), moved[other]);
    for (int i = 0; i < COUNT; i++)
        assert_true(second_of(state, i) == (i % 3 ? i + 0.5 : -1));
    // The order is still that of the keys.
    assert_true(state_set(state, value_number(-1), value_number(7)));
    uint32_t cursor = 0;
    double last = -2;
    int seen = 0;
    double room[STATE_KEY_BUFFER];
    for (Value key, value; state_next(state, &cursor, &key, &value, room); seen++) {
        assert_true(key.as.number > last);
        last = key.as.number;
    }
    assert_int_equal(seen, COUNT - COUNT / 3 + 1);
    state_free(state);
}

static void test_compact_removes_all_unused_slots(void **unused) {
    (void)unused;
    State *state = filled();
    for (int i = 0; i < COUNT; i++)
        state_set(state, value_number(i), VALUE_NULL);
    uint8_t used[COUNT] = {0};
    StateSlot moved[COUNT];
    assert_true(state_compact(state, used, moved));
    assert_int_equal(state_slot_count(state), 0);
    assert_true(state_set(state, value_number(5), value_number(6)));
    assert_true(state_get(state, value_number(5)).as.number == 6);
    state_free(state);
}

TEST_GROUP(state_compact) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_compact_keeps_used_slots_in_order),
                                       cmocka_unit_test(test_compact_removes_all_unused_slots)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
