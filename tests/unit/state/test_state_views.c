// test_state_views.c: entries that show numbers where somebody else keeps them (state.h).
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "state/state.h"

typedef struct Fixture {
    State *state;
    StateSlot slot;
    StateLender lender;
    double numbers[2];
} Fixture;

static Fixture shown(void) {
    Fixture f = {.state = state_new(NULL), .numbers = {1, 2}};
    f.slot = state_slot(f.state, value_number(7));
    f.lender = state_add_lender(f.state);
    return f;
}

static double second(const Fixture *f) {
    Value v = state_get(f->state, value_number(7));
    return v.len == 2 ? v.as.numbers[1] : -1;
}

static void test_shows(void **unused) {
    (void)unused;
    Fixture f = shown();
    assert_int_not_equal(f.lender, 0);
    assert_int_equal(state_count(f.state), 0);
    state_slot_borrow(f.state, f.slot, f.lender, f.numbers, 2);
    assert_int_equal(state_count(f.state), 1);
    assert_true(second(&f) == 2);
    f.numbers[1] = 3;
    assert_true(second(&f) == 3);
    double elsewhere[2] = {8, 9};
    state_slot_borrow(f.state, f.slot, f.lender, elsewhere, 2);
    assert_true(second(&f) == 9);
    assert_true(state_slot_borrows(f.state, f.slot, f.lender));
    assert_false(state_take_disturbed(f.state, f.lender)); // its own doing
    state_free(f.state);
}

static void test_owns_a_copy(void **unused) {
    (void)unused;
    Fixture f = shown();
    state_slot_borrow(f.state, f.slot, f.lender, f.numbers, 2);
    assert_true(state_slot_own_copy(f.state, f.slot, f.lender));
    assert_false(state_slot_borrows(f.state, f.slot, f.lender));
    f.numbers[1] = 3;
    assert_true(second(&f) == 2);
    assert_false(state_take_disturbed(f.state, f.lender));
    assert_true(state_slot_own_copy(f.state, f.slot, f.lender)); // nothing to do
    state_free(f.state);
}

static void test_disturbed(void **unused) {
    (void)unused;
    const double other[2] = {1, 5}, same[2] = {1, 2};
    for (int way = 0; way < 5; way++) {
        Fixture f = shown();
        StateLender rival = state_add_lender(f.state);
        state_slot_borrow(f.state, f.slot, f.lender, f.numbers, 2);
        double wanted = 5;
        if (way == 0)
            state_set(f.state, value_number(7), value_numbers_view(other, 2));
        else if (way == 1)
            state_slot_borrow(f.state, f.slot, rival, other, 2);
        else if (way == 2)
            state_set(f.state, value_number(7), VALUE_NULL);
        else if (way == 3)
            state_slot_set(f.state, f.slot, value_number(4));
        else
            state_set(f.state, value_number(7), value_numbers_view(same, 2)); // leaves what is there
        if (way == 2 || way == 3)
            wanted = -1;
        else if (way == 4)
            wanted = 2;
        assert_true(second(&f) == wanted);
        assert_true(f.numbers[0] == 1 && f.numbers[1] == 2); // nobody writes through a view
        assert_int_equal(state_take_disturbed(f.state, f.lender), way < 4);
        assert_false(state_take_disturbed(f.state, f.lender)); // told once
        assert_int_equal(state_count(f.state), way != 2);
        state_free(f.state);
    }
}

static void test_compact_and_clear(void **unused) {
    (void)unused;
    Fixture f = shown();
    StateSlot gone = state_slot(f.state, value_number(1)), moved[3];
    const double key[3] = {7, 8, 9};
    StateSlot last = state_slot(f.state, value_numbers_view(key, 3));
    state_slot_borrow(f.state, f.slot, f.lender, f.numbers, 2);
    state_slot_borrow(f.state, last, f.lender, f.numbers, 2);
    const uint8_t used[3] = {0};
    assert_true(state_compact(f.state, used, moved));
    assert_int_equal(moved[gone], STATE_NO_SLOT);
    assert_true(state_slot_borrows(f.state, moved[last], f.lender));
    assert_int_equal(state_find(f.state, value_numbers_view(key, 3)), moved[last]);
    assert_true(second(&f) == 2);
    state_clear(f.state);
    assert_int_equal(state_count(f.state), 0);
    assert_true(state_take_disturbed(f.state, f.lender));
    assert_int_equal(state_find(f.state, value_number(7)), STATE_NO_SLOT);
    state_free(f.state);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shows),
        cmocka_unit_test(test_owns_a_copy),
        cmocka_unit_test(test_disturbed),
        cmocka_unit_test(test_compact_and_clear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
