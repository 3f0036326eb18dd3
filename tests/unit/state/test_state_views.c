// test_state_views.c: entries whose values point to an owner's numbers (state.h).
#include "groups.h"
#include "state/state.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

typedef struct Fixture {
    State *state;
    StateSlot slot;
    StateOwner owner;
    double numbers[2];
} Fixture;

static Fixture new_fixture(void) {
    Fixture f = {.state = state_new(NULL), .numbers = {1, 2}};
    f.slot = state_slot(f.state, value_number(7));
    f.owner = state_add_owner(f.state);
    return f;
}

static double second(const Fixture *f) {
    Value v = state_get(f->state, value_number(7));
    return v.len == 2 ? v.as.numbers[1] : -1;
}

static void test_reference_shows_owners_numbers(void **unused) {
    (void)unused;
    Fixture f = new_fixture();
    assert_int_not_equal(f.owner, 0);
    assert_int_equal(state_count(f.state), 0);
    state_slot_reference(f.state, f.slot, f.owner, f.numbers, 2);
    assert_int_equal(state_count(f.state), 1);
    assert_true(second(&f) == 2);
    f.numbers[1] = 3;
    assert_true(second(&f) == 3);
    double elsewhere[2] = {8, 9};
    state_slot_reference(f.state, f.slot, f.owner, elsewhere, 2);
    assert_true(second(&f) == 9);
    assert_true(state_slot_references(f.state, f.slot, f.owner));
    assert_false(state_clear_modified(f.state, f.owner)); // a reference that the owner sets is not a modification
    state_free(f.state);
}

static void test_detach_copies_numbers(void **unused) {
    (void)unused;
    Fixture f = new_fixture();
    state_slot_reference(f.state, f.slot, f.owner, f.numbers, 2);
    assert_true(state_slot_detach(f.state, f.slot, f.owner));
    assert_false(state_slot_references(f.state, f.slot, f.owner));
    f.numbers[1] = 3;
    assert_true(second(&f) == 2);
    assert_false(state_clear_modified(f.state, f.owner));
    assert_true(state_slot_detach(f.state, f.slot, f.owner)); // returns true if the slot is already detached
    state_free(f.state);
}

static void test_other_writes_mark_owner_modified(void **unused) {
    (void)unused;
    const double other[2] = {1, 5}, same[2] = {1, 2};
    for (int way = 0; way < 5; way++) {
        Fixture f = new_fixture();
        StateOwner rival = state_add_owner(f.state);
        state_slot_reference(f.state, f.slot, f.owner, f.numbers, 2);
        double wanted = 5;
        if (way == 0)
            state_set(f.state, value_number(7), value_numbers_view(other, 2));
        else if (way == 1)
            state_slot_reference(f.state, f.slot, rival, other, 2);
        else if (way == 2)
            state_set(f.state, value_number(7), VALUE_NULL);
        else if (way == 3)
            state_slot_set(f.state, f.slot, value_number(4));
        else
            state_set(f.state, value_number(7),
                      value_numbers_view(same, 2)); // changes nothing, because the values are equal
        if (way == 2 || way == 3)
            wanted = -1;
        else if (way == 4)
            wanted = 2;
        assert_true(second(&f) == wanted);
        assert_true(f.numbers[0] == 1 && f.numbers[1] == 2); // the owner's numbers are never overwritten
        assert_int_equal(state_clear_modified(f.state, f.owner), way < 4);
        assert_false(state_clear_modified(f.state, f.owner)); // a modification is reported once
        assert_int_equal(state_count(f.state), way != 2);
        state_free(f.state);
    }
}

static void test_compact_keeps_and_clear_ends_references(void **unused) {
    (void)unused;
    Fixture f = new_fixture();
    StateSlot gone = state_slot(f.state, value_number(1)), moved[3];
    const double key[3] = {7, 8, 9};
    StateSlot last = state_slot(f.state, value_numbers_view(key, 3));
    state_slot_reference(f.state, f.slot, f.owner, f.numbers, 2);
    state_slot_reference(f.state, last, f.owner, f.numbers, 2);
    const uint8_t used[3] = {0};
    assert_true(state_compact(f.state, used, moved));
    assert_int_equal(moved[gone], STATE_NO_SLOT);
    assert_true(state_slot_references(f.state, moved[last], f.owner));
    assert_int_equal(state_find(f.state, value_numbers_view(key, 3)), moved[last]);
    assert_true(second(&f) == 2);
    state_clear(f.state);
    assert_int_equal(state_count(f.state), 0);
    assert_true(state_clear_modified(f.state, f.owner));
    assert_int_equal(state_find(f.state, value_number(7)), STATE_NO_SLOT);
    state_free(f.state);
}

TEST_GROUP(state_views) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reference_shows_owners_numbers),
        cmocka_unit_test(test_detach_copies_numbers),
        cmocka_unit_test(test_other_writes_mark_owner_modified),
        cmocka_unit_test(test_compact_keeps_and_clear_ends_references),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
