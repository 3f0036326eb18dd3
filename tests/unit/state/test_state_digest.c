// test_state_digest.c: digests of states (spec digest.md).
#include "base/budget.h"
#include "state/digest.h"
#include "state/state.h"
#include "values.h"

#include <inttypes.h>

enum { DIGITS = 2 * STATE_DIGEST_SIZE, MAX_ENTRIES = 20, NUMBERS = 2 };
static const double PREFIX = -7, SYMBOL = -8;
static const char *examples_path;

// A digest as hexadecimal digits.
typedef struct Digits {
    char text[DIGITS + 1];
} Digits;

// Returns the digest of a state, whose numbers are hashed in `parts` parts, the last one first.
static Digits digest_in_parts(State *state, int parts) {
    uint64_t numbers;
    uint8_t digest[STATE_DIGEST_SIZE];
    Digits digits;
    assert_true(state_digest_begin(state, &numbers));
    for (int i = parts - 1; i >= 0; i--)
        state_digest_part(state, i, parts);
    state_digest_end(state, digest);
    for (int i = 0; i < STATE_DIGEST_SIZE; i++)
        snprintf(digits.text + 2 * i, 3, "%02x", digest[i]);
    return digits;
}

static Digits digest_of(State *state) {
    return digest_in_parts(state, 1);
}

// Returns the digest of a new state with the same entries, which are added in reverse order.
static Digits digest_of_copy(const State *from) {
    State *copy = state_new(NULL);
    double buffer[STATE_KEY_BUFFER];
    for (StateSlot slot = state_slot_count(from); slot-- > 0;) {
        Value value = state_slot_get(from, slot);
        if (value.len)
            assert_true(state_set(copy, state_slot_key_in(from, slot, buffer), value));
    }
    assert_int_equal(state_count(copy), state_count(from));
    Digits digits = digest_of(copy);
    state_free(copy);
    return digits;
}

static void assert_digest(State *state, const char *expected) {
    assert_string_equal(digest_of(state).text, expected);
}

// --- examples of other programs

typedef struct Example {
    char digest[DIGITS + 1];
    Value keys[MAX_ENTRIES];
    Value values[MAX_ENTRIES];
    int count;
} Example;

static void set_entry(State *state, const Example *example, int i) {
    assert_true(state_set(state, example->keys[i], example->values[i]));
}

// Adds the entries in both orders, and removes and adds some of them again.
static void check_example(const Example *example) {
    State *state = state_new(NULL);
    for (int i = 0; i < example->count; i++)
        set_entry(state, example, i);
    assert_digest(state, example->digest);
    for (int i = 0; i < example->count; i += 2) {
        assert_true(state_set(state, example->keys[i], VALUE_NULL));
        assert_string_not_equal(digest_of(state).text, example->digest);
    }
    for (int i = 0; i < example->count; i += 2)
        set_entry(state, example, i);
    assert_digest(state, example->digest);
    assert_string_equal(digest_of_copy(state).text, example->digest);
    state_clear(state);
    for (int i = example->count - 1; i >= 0; i--)
        set_entry(state, example, i);
    assert_digest(state, example->digest);
    state_free(state);
}

// Reads a line such as `$(:a;1) = 2;3`.
static void read_entry(World *world, Example *example, char *line) {
    char *value = strstr(line, " = "), *key = line + 1;
    assert_non_null(value);
    *value = 0;
    if (*key == '(') {
        key++;
        value[-1] = 0;
    }
    assert_in_range(example->count, 0, MAX_ENTRIES - 1);
    example->keys[example->count] = read_value(world, key);
    example->values[example->count++] = read_value(world, value + 3);
}

// The examples were computed independently of petri, by tests/digest/digest.py.
static void test_examples_have_the_specified_digests(void **state) {
    World *world = *state;
    FILE *file = fopen(examples_path, "r");
    char line[400];
    Example example = {0};
    int examples = 0;
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        line[strcspn(line, "\n")] = 0;
        if (line[0] == '$') {
            read_entry(world, &example, line);
        } else if (line[0] == '=') {
            if (examples++)
                check_example(&example);
            example.count = 0;
            snprintf(example.digest, sizeof example.digest, "%.32s", line + 2);
        }
    }
    check_example(&example);
    assert_in_range(examples, 10, 100);
    fclose(file);
}

// --- key ranges

static Value key_of(double id, bool velocity, double buffer[3]) {
    memcpy(buffer, (double[]){PREFIX, id, SYMBOL}, 3 * sizeof *buffer);
    return value_numbers_view(buffer, velocity ? 3 : 2);
}

static void add_pairs(State *state, int first, int count) {
    double buffer[3];
    for (int i = 0; i < 2 * count; i++)
        assert_int_not_equal(state_slot(state, key_of(first + i / 2, i % 2, buffer)), STATE_NO_SLOT);
}

static double *random_rows(int count) {
    double *rows = calloc((size_t)count, NUMBERS * sizeof *rows);
    for (int i = 0; i < NUMBERS * count; i++)
        rows[i] = rand() / 1000.0;
    return rows;
}

// Digests of ranges are computed without copying. They equal those of separate entries while the owner replaces its
// array slot by slot, and when keys are added before, after and within the range.
static void test_ranges_have_the_digests_of_entries(void **unused) {
    enum { PAIRS = 10000, SLOTS = 2 * PAIRS };
    (void)unused;
    State *state = state_new(NULL);
    double *rows[2] = {random_rows(SLOTS), random_rows(SLOTS)}, buffer[3];
    assert_true(state_set(state, value_number(PREFIX), value_number(1)));
    add_pairs(state, 5, PAIRS);
    StateOwner owner = state_add_owner(state);
    for (int turn = 0; turn < 2; turn++)
        for (StateSlot i = 0; i < SLOTS; i++) {
            state_slot_reference(state, 1 + i, owner, rows[turn] + NUMBERS * i, NUMBERS);
            if (i % 3333 == 0 || i == SLOTS - 1)
                assert_string_equal(digest_in_parts(state, 3).text, digest_of_copy(state).text);
        }
    const double others[] = {4, 4.5, 70.5, 5004.25, PAIRS + 4.5, PAIRS + 5};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        assert_true(state_set(state, key_of(others[i], i % 2, buffer), value_number((double)i)));
        assert_string_equal(digest_of(state).text, digest_of_copy(state).text);
    }
    rows[1][77] += 1;
    assert_string_equal(digest_of(state).text, digest_of_copy(state).text);
    assert_true(state_slot_references(state, 100, owner)); // still a range
    assert_true(state_slot_set(state, 101, value_number(3)));
    assert_string_equal(digest_of(state).text, digest_of_copy(state).text);
    state_free(state);
    free(rows[0]);
    free(rows[1]);
}

// Two ranges whose keys alternate.
static void test_ranges_can_interleave(void **unused) {
    enum { PAIRS = 300, SLOTS = 2 * PAIRS };
    (void)unused;
    State *state = state_new(NULL);
    double *rows = random_rows(2 * SLOTS), buffer[3];
    StateOwner owner = state_add_owner(state);
    for (StateSlot i = 0; i < 2 * SLOTS; i++) {
        double id = i / 2 % PAIRS + (i < SLOTS ? 0.5 : 0);
        assert_int_equal(state_slot(state, key_of(id, i % 2, buffer)), i);
    }
    for (StateSlot i = 0; i < 2 * SLOTS; i++)
        state_slot_reference(state, i, owner, rows + NUMBERS * i, NUMBERS);
    assert_string_equal(digest_of(state).text, digest_of_copy(state).text);
    state_free(state);
    free(rows);
}

// Values of separate entries that an owner has stored one after the other are hashed together, across chunks and until
// another value interrupts them.
static void test_consecutive_values_of_entries_have_the_digests_of_single_ones(void **unused) {
    enum { ENTRIES = 9000 };
    (void)unused;
    State *state = state_new(NULL);
    double *rows[2] = {random_rows(ENTRIES), random_rows(ENTRIES)};
    StateOwner owners[2] = {state_add_owner(state), state_add_owner(state)};
    for (StateSlot i = 0; i < ENTRIES; i++) {
        assert_int_equal(state_slot(state, value_number(3 * i)), i);
        state_slot_reference(state, i, owners[0], rows[0] + NUMBERS * i, NUMBERS);
    }
    assert_string_equal(digest_in_parts(state, 3).text, digest_of_copy(state).text);
    for (StateSlot i = 0; i < ENTRIES; i += 501) {
        state_slot_reference(state, i, owners[i % 2], rows[1] + NUMBERS * i, NUMBERS);
        assert_true(state_slot_set(state, i + 100, value_number(i)));
        assert_true(state_slot_set(state, i + 200, VALUE_NULL));
        assert_true(state_slot_detach(state, i + 300, owners[0]));
    }
    assert_string_equal(digest_in_parts(state, 3).text, digest_of_copy(state).text);
    state_free(state);
    free(rows[0]);
    free(rows[1]);
}

static void test_parts_do_not_matter(void **unused) {
    (void)unused;
    State *state = state_new(NULL);
    Digits empty = digest_of(state);
    assert_string_equal(digest_in_parts(state, 8).text, empty.text);
    double *numbers = random_rows(15000);
    for (int i = 0; i < 1000; i++)
        assert_true(state_set(state, value_number(i * 7 % 1000), value_numbers_view(numbers + i, 1 + i % 29)));
    assert_true(state_set(state, value_number(500.5), value_numbers_view(numbers, 30000)));
    Digits whole = digest_of(state);
    assert_string_not_equal(whole.text, empty.text);
    for (int parts = 2; parts < 20; parts++)
        assert_string_equal(digest_in_parts(state, parts).text, whole.text);
    state_free(state);
    free(numbers);
}

// --- changes

static Value random_value(World *world) {
    int kind = rand() % 8;
    if (kind == 0)
        return VALUE_NULL;
    Vector vector = vector_new(&world->arena);
    for (int i = kind; i >= 0; i--)
        vector_add(&vector, rand() % 8 ? value_number(rand()) : text_of(world, &"a long string"[rand() % 14]));
    return vector_finish(&vector);
}

static Value random_key(World *world) {
    Vector vector = vector_new(&world->arena);
    for (int i = rand() % 3; i >= 0; i--)
        vector_add(&vector, rand() % 4 ? value_number(rand() % 6 - 2) : text_of(world, &"key"[rand() % 4]));
    return vector_finish(&vector);
}

// After any changes, the digest equals that of a new state with the same entries, so nothing cached is out of date.
static void test_changed_states_have_the_digests_of_new_ones(void **state) {
    World *world = *state;
    enum { ROUNDS = 400, CHANGES = 10, MAX_SLOTS = 2000 };
    static uint8_t used[MAX_SLOTS];
    static StateSlot moved[MAX_SLOTS];
    Budget budget = {.memory_limit = SIZE_MAX};
    State *changed = state_new(&budget);
    double *rows = random_rows(MAX_SLOTS);
    StateOwner owner = state_add_owner(changed);
    for (int round = 0; round < ROUNDS; round++) {
        for (int i = rand() % CHANGES; i >= 0; i--) {
            assert_true(state_set(changed, random_key(world), random_value(world)));
            StateSlot slot = state_slot(changed, random_key(world));
            if (rand() % 2)
                state_slot_reference(changed, slot, owner, rows + slot, 2 + rand() % 2);
            else
                assert_true(state_slot_detach(changed, slot, owner));
        }
        if (rand() % 20 == 0)
            assert_true(state_compact(changed, used, moved));
        if (rand() % 80 == 0)
            state_clear(changed);
        assert_in_range(state_slot_count(changed), 0, MAX_SLOTS);
        assert_string_equal(digest_of(changed).text, digest_of_copy(changed).text);
    }
    state_free(changed);
    assert_int_equal(budget.memory, 0);
    free(rows);
}

static void test_only_numbers_are_hashed_if_no_length_changes(void **state) {
    World *world = *state;
    State *changed = state_new(NULL);
    StateOwner owner = state_add_owner(changed);
    const double rows[] = {1, 2, 3};
    assert_true(state_digest_is_stale(changed));
    assert_true(state_set(changed, value_number(1), read_value(world, "1;2")));
    StateSlot slot = state_slot(changed, value_number(2));
    state_slot_reference(changed, slot, owner, rows, 2);
    Digits before = digest_of(changed);
    assert_false(state_digest_is_stale(changed));
    assert_true(state_set(changed, value_number(1), read_value(world, "1;3")));
    state_slot_reference(changed, slot, owner, rows + 1, 2);
    assert_false(state_digest_is_stale(changed));
    assert_string_not_equal(digest_of(changed).text, before.text);
    assert_string_equal(digest_of(changed).text, digest_of_copy(changed).text);
    state_slot_reference(changed, slot, owner, rows, 3);
    assert_true(state_digest_is_stale(changed));
    state_free(changed);
}

// If memory runs out, the digest fails, and is correct as soon as there is memory again.
static void test_digest_fails_if_out_of_memory(void **unused) {
    (void)unused;
    Budget budget = {.memory_limit = SIZE_MAX};
    State *state = state_new(&budget);
    for (int i = 0; i < 3000; i++)
        assert_true(state_set(state, value_number(i * 7 % 3000), value_number(i)));
    add_pairs(state, 0, 100);
    uint64_t numbers;
    size_t without = budget.memory, failures = 0;
    for (budget.memory_limit = without; !state_digest_begin(state, &numbers); budget.memory_limit += 500) {
        assert_true(state_clear_exhausted(state));
        failures++;
    }
    assert_in_range(failures, 10, 1000);
    assert_true(budget.memory < without + 40000);
    assert_string_equal(digest_of(state).text, digest_of_copy(state).text);
    state_free(state);
    assert_int_equal(budget.memory, 0);
}

TEST_GROUP(state_digest) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_examples_have_the_specified_digests),
        cmocka_unit_test(test_ranges_have_the_digests_of_entries),
        cmocka_unit_test(test_ranges_can_interleave),
        cmocka_unit_test(test_consecutive_values_of_entries_have_the_digests_of_single_ones),
        cmocka_unit_test(test_parts_do_not_matter),
        WORLD_TEST(test_changed_states_have_the_digests_of_new_ones),
        WORLD_TEST(test_only_numbers_are_hashed_if_no_length_changes),
        cmocka_unit_test(test_digest_fails_if_out_of_memory),
    };
    if (argc < 2)
        return GROUP_SKIPPED; // no file of examples
    examples_path = argv[1];
    return cmocka_run_group_tests(tests, NULL, NULL);
}
