// test_state_dictionary.c: keys, slots and order of the state dictionary (language.md L11).
#include "base/budget.h"
#include "state/state.h"
#include "values.h"

typedef struct Fixture {
    World *world;
    State *state;
} Fixture;

static int setup(void **state) {
    Fixture *fixture = calloc(1, sizeof *fixture);
    void *world;
    world_setup(&world);
    *fixture = (Fixture){world, state_new(NULL)};
    *state = fixture;
    return fixture->state == NULL;
}

static int teardown(void **state) {
    Fixture *fixture = *state;
    void *world = fixture->world;
    state_free(fixture->state);
    world_teardown(&world);
    free(fixture);
    return 0;
}

#define STATE_TEST(function) cmocka_unit_test_setup_teardown(function, setup, teardown)

static void put_text(Fixture *fixture, const char *key, const char *value) {
    assert_true(state_set(fixture->state, read_value(fixture->world, key), read_value(fixture->world, value)));
}

static const char *get_text(Fixture *fixture, const char *key) {
    return show(fixture->world, state_get(fixture->state, read_value(fixture->world, key)));
}

// Returns all entries in order, as `key=value key=value`.
static const char *listing(Fixture *fixture) {
    Text text = text_new(&fixture->world->arena);
    uint32_t cursor = 0, count = 0;
    Value key, value;
    double room[STATE_KEY_BUFFER];
    while (state_next(fixture->state, &cursor, &key, &value, room)) {
        if (count++)
            text_add_char(&text, ' ');
        format_value(&text, &fixture->world->symbols, key);
        text_add_char(&text, '=');
        format_value(&text, &fixture->world->symbols, value);
    }
    assert_int_equal(count, state_count(fixture->state));
    return text_c(&text);
}

static void test_empty_state_has_no_values(void **state) {
    Fixture *fixture = *state;
    assert_text("nothing", get_text(fixture, ":a"), "null");
    assert_text("null key", get_text(fixture, "null"), "null");
    assert_text("no entry", listing(fixture), "");
    put_text(fixture, ":a", "null");
    assert_text("removing nothing", listing(fixture), "");
    state_free(NULL);
}

// The order of digest.md 2, whatever the order in which keys are added, and with slots that have no value yet.
static void test_order_depends_only_on_keys(void **state) {
    static const char *const keys[] = {"-3", "-0",  "0",   "0;-1",  "0;'a'",   "0.5",  "1",       "1;0;7",
                                       "70", "'A'", "'a'", "'a';2", "'a';'b'", "'ab'", "'\u00e9'"};
    static const uint32_t strides[] = {1, 2, 4, 7, 8, 11, 13, 14}; // coprime to COUNT, so all keys are added
    enum { COUNT = sizeof keys / sizeof keys[0], PAIRS = 100 };
    Fixture *fixture = *state;
    char expected[300] = "";
    for (int i = 0; i < COUNT; i++)
        sprintf(expected + strlen(expected), "%s%s=%d", i ? " " : "", keys[i], i);
    for (size_t k = 0; k < COUNT_OF(strides); k++) {
        state_clear(fixture->state);
        for (int i = 0; k % 2 && i < 2 * PAIRS; i++) { // a key range without values
            const double key[] = {0.25, i / 2, -7};
            state_slot(fixture->state, value_numbers_view(key, 2 + i % 2));
        }
        for (uint32_t i = 0; i < COUNT; i++) {
            uint32_t at = (i * strides[k] + (uint32_t)k) % COUNT;
            if (k % 3 == 0) // the key was created long before it has a value
                state_slot(fixture->state, read_value(fixture->world, keys[COUNT - 1 - i]));
            char value[12];
            snprintf(value, sizeof value, "%u", at);
            put_text(fixture, keys[at], value);
            if (k % 4 == 0)
                listing(fixture); // the cached order must be updated
        }
        assert_text("order", listing(fixture), expected);
    }
    put_text(fixture, "0.5", "1;2;3");
    put_text(fixture, "-0", "null");
    const char *changed = "-3=0 0=2 0;-1=3 0;'a'=4 0.5=1;2;3 1=6 ";
    assert_int_equal(strncmp(listing(fixture), changed, strlen(changed)), 0);
    assert_text("removed", get_text(fixture, "-0"), "null");
}

static void test_keys_match_exactly(void **state) {
    Fixture *fixture = *state;
    static const char *const keys[] = {
        "0",  "-0",     "1",      "1.5", "1;2",     "2;1",  "1;2;3", "'1'",  "'a'",
        ":a", ":a;'b'", "'a';:b", "''",  "'a';'b'", "'ab'", "inf",   "-inf", "null",
    };
    char text[20];
    for (size_t i = 0; i < COUNT_OF(keys); i++) {
        snprintf(text, sizeof text, "%zu", i);
        put_text(fixture, keys[i], text);
    }
    assert_int_equal(state_count(fixture->state), COUNT_OF(keys));
    for (size_t i = 0; i < COUNT_OF(keys); i++) {
        snprintf(text, sizeof text, "%zu", i);
        assert_text(keys[i], get_text(fixture, keys[i]), text);
    }
    assert_text("no rounding", get_text(fixture, "1.4999999999999998"), "null");
}

static void test_invalid_keys_are_ignored(void **state) {
    Fixture *fixture = *state;
    static const char *const keys[] = {"nan", "1;nan", "!a", "1;!a", "uniform:1"};
    for (size_t i = 0; i < COUNT_OF(keys); i++) {
        Value key = read_value(fixture->world, keys[i]);
        assert_claim(keys[i], !state_key_valid(key));
        assert_claim(keys[i], state_set(fixture->state, key, value_number(1))); // the call is ignored
        assert_claim(keys[i], state_slot(fixture->state, key) == STATE_NO_SLOT);
        assert_claim(keys[i], state_find(fixture->state, key) == STATE_NO_SLOT);
        assert_text(keys[i], get_text(fixture, keys[i]), "null");
    }
    assert_int_equal(state_count(fixture->state), 0);
    static const Function function = {.name = {"f", 1}};
    assert_false(state_key_valid(value_function(&fixture->world->arena, &function)));
    assert_true(state_key_valid(VALUE_NULL));
}

// If a new value equals the stored one, the stored one is kept.
static void test_equal_values_are_not_replaced(void **state) {
    Fixture *fixture = *state;
    static const struct {
        const char *first, *then, *wanted;
    } rows[] = {
        {"0", "-0", "0"},
        {"-0", "0", "-0"},
        {"0;1", "-0;1", "0;1"},
        {"0;1", "-0;2", "-0;2"},
        {"nan", "1", "1"},
        {"1", "nan", "nan"},
        {"1;2", "3", "3"},
        {"3", "1;2", "1;2"},
        {"1;2", "1;2;3", "1;2;3"},
        {"1", "'a'", "'a'"},
        {"'a'", "1", "1"},
        {"'a';1", "'b';2", "'b';2"},
        {"1;2", "null", "null"},
        {"'a';0", "'a';-0", "'a';0"},
        {"'a'", "uniform:1", "null"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        put_text(fixture, ":k", rows[i].first);
        put_text(fixture, ":k", rows[i].then);
        assert_text(rows[i].then, get_text(fixture, ":k"), rows[i].wanted);
        put_text(fixture, ":k", "null");
    }
}

// Numbers are overwritten in place if the count stays the same.
static void test_numbers_are_overwritten_in_place(void **state) {
    Fixture *fixture = *state;
    StateSlot slot = state_slot(fixture->state, read_value(fixture->world, ":p"));
    double numbers[] = {1, 2, 3};
    assert_true(state_slot_set(fixture->state, slot, value_numbers_view(numbers, 3)));
    const double *place = state_slot_get(fixture->state, slot).as.numbers;
    assert_ptr_not_equal(place, numbers); // the numbers were copied
    for (int i = 0; i < 10; i++) {
        numbers[1] = i;
        assert_true(state_slot_set(fixture->state, slot, value_numbers_view(numbers, 3)));
        assert_ptr_equal(state_slot_get(fixture->state, slot).as.numbers, place);
        assert_number("element", place[1], i);
    }
}

static void test_slots_stay_valid(void **state) {
    Fixture *fixture = *state;
    enum { COUNT = 5000 };
    StateSlot slots[COUNT];
    for (int i = 0; i < COUNT; i++) {
        double key[] = {symbol_of(fixture->world, "cells"), i};
        slots[i] = state_slot(fixture->state, value_numbers_view(key, 2));
        assert_int_not_equal(slots[i], STATE_NO_SLOT);
        assert_int_equal(state_count(fixture->state), i / 2); // a slot without a value is not an entry
        if (i % 2)
            assert_true(state_slot_set(fixture->state, slots[i], value_number(i)));
    }
    for (int i = 0; i < COUNT; i++) { // all keys are found after the table has grown
        double key[] = {symbol_of(fixture->world, "cells"), i};
        Value k = value_numbers_view(key, 2);
        assert_int_equal(state_slot(fixture->state, k), slots[i]);
        assert_int_equal(state_find(fixture->state, k), slots[i]);
        assert_int_equal(state_slot_get(fixture->state, slots[i]).len, i % 2);
        assert_true(value_equal(NULL, state_get(fixture->state, k), i % 2 ? value_number(i) : VALUE_NULL));
    }
    assert_true(state_slot_set(fixture->state, slots[1], VALUE_NULL));
    assert_int_equal(state_count(fixture->state), COUNT / 2 - 1);
    assert_true(state_slot_set(fixture->state, slots[1], value_number(-1))); // the slot is still valid
    assert_true(value_equal(NULL, state_slot_get(fixture->state, slots[1]), value_number(-1)));
    assert_true(state_slot_set(fixture->state, COUNT, value_number(1))); // slots that do not exist are ignored
    assert_int_equal(state_slot_count(fixture->state), COUNT);
    assert_int_equal(state_count(fixture->state), COUNT / 2);
    assert_false(state_slot_set(fixture->state, STATE_NO_SLOT, value_number(1)));
    assert_true(value_is_null(state_slot_get(fixture->state, STATE_NO_SLOT)));
}

// The state has its own copies of keys and values.
static void test_keys_and_values_are_copied(void **state) {
    Fixture *fixture = *state;
    Arena other;
    arena_init(&other, "other", SIZE_MAX);
    Vector key = vector_new(&other);
    vector_add(&key, value_string(&other, STR("key")));
    vector_add(&key, value_string(&other, STR("")));
    vector_add_number(&key, 3);
    Value value = value_string(&other, STR("a longer text than fits anywhere inline"));
    assert_true(state_set(fixture->state, vector_finish(&key), value));
    arena_free(&other);
    assert_text("value", get_text(fixture, "'key';'';3"), "'a longer text than fits anywhere inline'");
    assert_text("key", listing(fixture), "'key';'';3='a longer text than fits anywhere inline'");
}

static void test_clear_removes_all_entries(void **state) {
    Fixture *fixture = *state;
    put_text(fixture, ":a", "1;2");
    put_text(fixture, "'b'", "'c'");
    state_clear(fixture->state);
    assert_int_equal(state_count(fixture->state), 0);
    assert_text("gone", get_text(fixture, ":a"), "null");
    assert_int_equal(state_find(fixture->state, read_value(fixture->world, ":a")), STATE_NO_SLOT);
    put_text(fixture, "'b'", "7");
    assert_text("new", listing(fixture), "'b'=7");
}

// All memory is charged to the budget, and released. A value that exceeds the budget is not stored.
static void test_memory_is_charged_to_budget(void **state) {
    (void)state;
    static const double numbers[1000] = {1};
    Budget budget = {.memory_limit = SIZE_MAX};
    State *limited = state_new(&budget);
    StateSlot slot = state_slot(limited, value_number(1));
    assert_false(state_clear_exhausted(limited));
    budget.memory_limit = budget.memory + sizeof numbers - 1;
    assert_false(state_slot_set(limited, slot, value_numbers_view(numbers, COUNT_OF(numbers))));
    assert_true(state_clear_exhausted(limited));
    assert_false(state_clear_exhausted(limited));
    assert_int_equal(state_count(limited), 0);
    budget.memory_limit++;
    assert_true(state_slot_set(limited, slot, value_numbers_view(numbers, COUNT_OF(numbers))));
    state_clear(limited);
    assert_true(budget.memory < sizeof numbers);
    state_free(limited);
    assert_int_equal(budget.memory, 0);
}

// Random writes and removals, compared with an array.
static void test_state_matches_model(void **state) {
    Fixture *fixture = *state;
    enum { KEYS = 200 };
    double model[KEYS] = {0};
    uint32_t count = 0;
    uint64_t seed = 3;
    for (int round = 0; round < 20000; round++) {
        uint32_t k = (uint32_t)(next_bits(&seed) % KEYS);
        double x = (double)(next_bits(&seed) % 4); // 0: remove the key
        count += (x != 0) - (model[k] != 0);
        model[k] = x;
        assert_true(state_set(fixture->state, value_number(k), x != 0 ? value_number(x) : VALUE_NULL));
        assert_int_equal(state_count(fixture->state), count);
    }
    for (uint32_t k = 0; k < KEYS; k++)
        assert_true(value_equal(NULL, state_get(fixture->state, value_number(k)),
                                model[k] != 0 ? value_number(model[k]) : VALUE_NULL));
}

TEST_GROUP(state_dictionary) {
    const struct CMUnitTest tests[] = {
        STATE_TEST(test_empty_state_has_no_values),
        STATE_TEST(test_order_depends_only_on_keys),
        STATE_TEST(test_keys_match_exactly),
        STATE_TEST(test_invalid_keys_are_ignored),
        STATE_TEST(test_equal_values_are_not_replaced),
        STATE_TEST(test_numbers_are_overwritten_in_place),
        STATE_TEST(test_slots_stay_valid),
        STATE_TEST(test_keys_and_values_are_copied),
        STATE_TEST(test_clear_removes_all_entries),
        STATE_TEST(test_memory_is_charged_to_budget),
        STATE_TEST(test_state_matches_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
