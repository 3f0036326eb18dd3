// test_hostile.c: calls every built-in with all kinds and numbers of arguments. The result must be well-formed, with at
// most one error.
#include "value/node.h"
#include "world.h"

enum { LONG = 1000000, MAX_SAMPLES = 32, MAX_ARGUMENTS = 6 };

typedef struct Samples {
    Value values[MAX_SAMPLES];
    uint32_t count;
} Samples;

static void add_sample(Samples *samples, Value v) {
    assert_true(samples->count < MAX_SAMPLES);
    samples->values[samples->count++] = v;
}

static Value numbers(Arena *arena, uint32_t len, double first, double step) {
    double *x = arena_alloc_array(arena, len, sizeof *x);
    for (uint32_t i = 0; i < len; i++)
        x[i] = first + step * i;
    return value_numbers_view(x, len);
}

static Value mixed(Arena *arena, const Item *items, uint32_t len) {
    return (Value){.len = len, .kind = VALUE_MIXED, .as.items = arena_copy(arena, items, len * sizeof *items)};
}

static Value quaternion_like(Arena *arena, uint32_t len) {
    return numbers(arena, len, 0.1, 0.3);
}

static Samples samples_new(World *world) {
    Samples samples = {.count = 0};
    Arena *arena = &world->session;
    static const double lone[] = {0, -0.0, 1, -1, 0.5, 2.5, 1e308, -1e300, 1e19, 4e9, 5e-324, INFINITY, -INFINITY, NAN};
    add_sample(&samples, VALUE_NULL);
    for (size_t i = 0; i < sizeof lone / sizeof lone[0]; i++)
        add_sample(&samples, value_number(lone[i]));
    Value string = value_string(arena, STR("a,b\n\xc3\xa9")), empty = value_string(arena, STR(""));
    const Symbol *kind = symbol_intern(&world->symbols, STR("kind"));
    Function *function = arena_alloc(arena, sizeof *function);
    *function = (Function){.name = STR("f")};
    Item node = {ITEM_NODE, .as.node = node_new(arena, kind)}, call = {ITEM_FUNCTION, .as.function = function};
    Item nan = {ITEM_NUMBER, .as.number = NAN}, text = string.as.items[0];
    add_sample(&samples, string);
    add_sample(&samples, empty);
    add_sample(&samples, value_item(arena, node));
    add_sample(&samples, value_item(arena, call));
    add_sample(&samples, mixed(arena, (Item[]){nan, text, node, call, text, nan}, 6));
    add_sample(&samples, mixed(arena, (Item[]){text, empty.as.items[0], text}, 3));
    add_sample(&samples, value_stream(STREAM_UNIFORM, 12345));
    add_sample(&samples, value_stream(STREAM_NORMAL, 0));
    add_sample(&samples, value_number(symbol_register(&world->symbols, STR("seed"))->number));
    add_sample(&samples, numbers(arena, 3, -1, 1.5));
    add_sample(&samples, quaternion_like(arena, 4));
    add_sample(&samples, numbers(arena, 3, NAN, 0));
    add_sample(&samples, numbers(arena, 9, 0, 0));
    return samples;
}

static void try_call(World *world, const Builtin *builtin, const Value *args, uint32_t count) {
    world->errors = 0;
    Value v = builtin_call(&world->context, builtin, args, count, NULL, NULL, 0);
    if (world->errors > 1)
        fail_msg("%s: %u errors, the last: %s", builtin->name, world->errors, world->text);
    assert_well_formed(v);
    if (count < builtin->required || (count > builtin->fixed && !builtin->variadic)) {
        assert_int_equal(world->errors, 1);
        assert_true(value_is_null(v));
    }
    if (world->errors)
        assert_true(value_is_null(v));
    arena_reset(&world->frame);
}

static void test_equal_arguments_give_valid_results(void **state) {
    World *world = *state;
    Samples samples = samples_new(world);
    for (uint32_t b = 0; b < builtin_table_count; b++)
        for (uint32_t s = 0; s < samples.count; s++)
            for (uint32_t count = 0; count <= MAX_ARGUMENTS + 1; count++) {
                Value args[MAX_ARGUMENTS + 1];
                for (uint32_t i = 0; i < count; i++)
                    args[i] = samples.values[s];
                try_call(world, &builtin_table[b], args, count);
            }
}

static void test_argument_pairs_give_valid_results(void **state) {
    World *world = *state;
    Samples samples = samples_new(world);
    for (uint32_t b = 0; b < builtin_table_count; b++)
        for (uint32_t s = 0; s < samples.count; s++)
            for (uint32_t t = 0; t < samples.count; t++)
                try_call(world, &builtin_table[b], (Value[]){samples.values[s], samples.values[t]}, 2);
}

// Random arguments, for functions that accept three or more.
static void test_random_arguments_give_valid_results(void **state) {
    World *world = *state;
    Samples samples = samples_new(world);
    uint64_t random = 1;
    for (uint32_t b = 0; b < builtin_table_count; b++) {
        const Builtin *builtin = &builtin_table[b];
        for (uint32_t trial = 0; (builtin->fixed >= 3 || builtin->variadic) && trial < 3000; trial++) {
            Value args[MAX_ARGUMENTS];
            for (uint32_t i = 0; i < MAX_ARGUMENTS; i++) {
                random = random * 6364136223846793005u + 1442695040888963407u;
                args[i] = samples.values[(random >> 33) % samples.count];
            }
            try_call(world, builtin, args, builtin->variadic ? 1 + trial % MAX_ARGUMENTS : builtin->fixed);
        }
    }
}

// One argument has a million elements; the others are short.
static void test_long_arguments_give_valid_results(void **state) {
    World *world = *state;
    Arena *arena = &world->session;
    Item *items = arena_alloc_array(arena, LONG, sizeof *items);
    Value string = value_string(arena, STR("x\n"));
    for (uint32_t i = 0; i < LONG; i++)
        items[i] = i % 2 ? (Item){ITEM_NUMBER, .as.number = i} : string.as.items[0];
    Item *texts = arena_alloc_array(arena, LONG, sizeof *texts);
    for (uint32_t i = 0; i < LONG; i++)
        texts[i] = string.as.items[0];
    const Value longs[] = {
        numbers(arena, LONG, -500, 0.001),
        {.len = LONG, .kind = VALUE_MIXED, .as.items = items},
        {.len = LONG, .kind = VALUE_MIXED, .as.items = texts},
    };
    const Value plain[] = {value_number(2), value_stream(STREAM_UNIFORM, 1)};
    for (uint32_t b = 0; b < builtin_table_count; b++) {
        const Builtin *builtin = &builtin_table[b];
        uint32_t count = builtin->fixed + (builtin->variadic ? 1 : 0);
        for (uint32_t at = 0; at < count; at++)
            for (uint32_t l = 0; l < sizeof longs / sizeof longs[0]; l++)
                for (uint32_t p = 0; p < (count > 1 ? sizeof plain / sizeof plain[0] : 1); p++) {
                    Value args[MAX_ARGUMENTS];
                    for (uint32_t i = 0; i < count; i++)
                        args[i] = i == at ? longs[l] : plain[p];
                    try_call(world, builtin, args, count);
                }
    }
}

// Two long arguments: the time must grow with the sum of their lengths, not with the product.
static void test_time_is_not_product_of_lengths(void **state) {
    World *world = *state;
    Value x = numbers(&world->session, LONG, 0, 1);
    for (uint32_t b = 0; b < builtin_table_count; b++)
        if (builtin_table[b].fixed >= 2)
            try_call(world, &builtin_table[b], (Value[]){x, x}, 2);
}

static void test_sort_with_nan_keeps_elements(void **state) {
    World *world = *state;
    double *x = arena_alloc_array(&world->session, LONG / 10, sizeof *x);
    double sum = 0;
    for (uint32_t i = 0; i < LONG / 10; i++) {
        x[i] = i % 3 ? (double)((i * 7919u) % 1000) : NAN;
        sum += i % 3 ? x[i] : 0;
    }
    Value v = value_numbers_view(x, LONG / 10);
    Value sorted = builtin_call(&world->context, builtin_find(STR("sort")), &v, 1, NULL, NULL, 0);
    assert_int_equal(sorted.len, v.len);
    double check = 0;
    for (uint32_t i = 0; i < sorted.len; i++)
        check += isnan(sorted.as.numbers[i]) ? 0 : sorted.as.numbers[i];
    assert_true(check == sum);
}

static void test_any_argument_names_give_valid_results(void **state) {
    World *world = *state;
    const Symbol *names[3] = {symbol_intern(&world->symbols, STR("xs")), symbol_intern(&world->symbols, STR("value")),
                              symbol_intern(&world->symbols, STR(""))};
    const Value values[3] = {value_number(1), VALUE_NULL, value_number(2)};
    for (uint32_t b = 0; b < builtin_table_count; b++)
        for (uint32_t count = 0; count < 4; count++)
            for (uint32_t first = 0; first < 3; first++)
                for (uint32_t named = 1; named <= 3 - first; named++) {
                    world->errors = 0;
                    Value v = builtin_call(&world->context, &builtin_table[b],
                                           (Value[]){value_number(1), value_number(2), value_number(3)}, count,
                                           names + first, values + first, named);
                    assert_well_formed(v);
                    assert_true(world->errors <= 1);
                    arena_reset(&world->frame);
                }
}

TEST_GROUP(hostile) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_equal_arguments_give_valid_results, world_setup, world_teardown),
        cmocka_unit_test_setup_teardown(test_argument_pairs_give_valid_results, world_setup, world_teardown),
        cmocka_unit_test_setup_teardown(test_random_arguments_give_valid_results, world_setup, world_teardown),
        cmocka_unit_test_setup_teardown(test_long_arguments_give_valid_results, world_setup, world_teardown),
        cmocka_unit_test_setup_teardown(test_time_is_not_product_of_lengths, world_setup, world_teardown),
        cmocka_unit_test_setup_teardown(test_sort_with_nan_keeps_elements, world_setup, world_teardown),
        cmocka_unit_test_setup_teardown(test_any_argument_names_give_valid_results, world_setup, world_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
