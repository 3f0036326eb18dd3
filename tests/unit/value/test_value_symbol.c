// test_value_symbol.c: interned names, symbol numbers (language.md L4.3) and seed hashes (builtins.md B9.2).
#include "value/node.h"
#include "value/stream.h"
#include "values.h"

static void test_symbol_numbers_match_spec(void **state) {
    (void)state;
    static const struct {
        const char *name;
        uint64_t hash;
        double number;
    } rows[] = {
        {"a", 0xaf63dc4c8601ec8c, -1.514662081452513e+308},  {"foo", 0xdcb27518fed9d577, -1.6737404350843107e+308},
        {"x", 0xaf63f54c86021707, -1.5146634208382725e+308}, {"hello", 0xa430d84680aabd0b, -1.4753400716276727e+308},
        {"é", 0xaf64644c8602d3a4, -1.5146693677110448e+308}, // the hash is of code points, not bytes
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        assert_claim(rows[i].name, symbol_hash(str_from(rows[i].name)) == rows[i].hash);
        assert_number(rows[i].name, symbol_number(str_from(rows[i].name)), rows[i].number);
    }
    assert_true(symbol_hash(STR("")) == UINT64_C(0xcbf29ce484222325));
}

static void test_interned_names_are_unique(void **state) {
    World *world = *state;
    char name[] = "mass";
    const Symbol *mass = symbol_intern(&world->symbols, str_from(name));
    name[0] = 'X'; // the table has its own copy of the name
    assert_ptr_equal(symbol_intern(&world->symbols, STR("mass")), mass);
    assert_ptr_not_equal(symbol_intern(&world->symbols, STR("Mass")), mass);
    assert_ptr_not_equal(symbol_intern(&world->symbols, STR("mas")), mass);
    const Symbol *symbols[5000];
    for (int i = 0; i < 5000; i++)
        symbols[i] = symbol_intern(&world->symbols, str_format(&world->arena, "name%d", i));
    for (int i = 0; i < 5000; i++) // symbols keep their address when the table grows
        assert_ptr_equal(symbol_intern(&world->symbols, str_format(&world->arena, "name%d", i)), symbols[i]);
    assert_ptr_equal(symbol_intern(&world->symbols, STR("mass")), mass);
}

// A number is recognised as a symbol only after that symbol has been registered.
static void test_only_registered_symbols_are_found(void **state) {
    World *world = *state;
    double number = symbol_number(STR("spring"));
    assert_null(symbol_of_number(&world->symbols, number));
    const Symbol *name = symbol_intern(&world->symbols, STR("spring"));
    assert_null(symbol_of_number(&world->symbols, number));
    assert_ptr_equal(symbol_register(&world->symbols, STR("spring")), name);
    assert_ptr_equal(symbol_of_number(&world->symbols, number), name);
    assert_ptr_equal(symbol_register(&world->symbols, STR("spring")), name); // registering again is not a collision
    static const double others[] = {0, -1, NAN, INFINITY, -INFINITY, -1.7e308, 1e308};
    for (size_t i = 0; i < COUNT_OF(others); i++)
        assert_null(symbol_of_number(&world->symbols, others[i]));
}

static void test_seed_hashes_match_spec(void **state) {
    World *world = *state;
    static const struct {
        const char *seed;
        uint64_t key;
    } rows[] = {
        {"null", 0xe220a8397b1dcdaf},       {"1", 0x03953eea0e693074},      {"1.9", 0x03953eea0e693074},
        {"-0.3", 0xc91d005ca9fb5ada},       {"-1", 0xc91d005ca9fb5ada},     {":x", 0x4c2c02a3df8a536a},
        {"'x'", 0x846a330c8ce81a06},        {":a;1.5", 0x411d8fab0f723c90}, {":seed", 0x903c2f031ff55b1b},
        {"uniform:77", 0xe220a8397b1dcdaf}, // a stream is hashed like null
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_claim(rows[i].seed, value_seed_hash(NULL, read_value(world, rows[i].seed)) == rows[i].key);
#define SEED(text) value_seed_hash(NULL, read_value(world, text))
    assert_true(SEED("0") != SEED("-0"));
    assert_true(SEED("'ab'") != SEED("'a';'b'"));
    assert_true(SEED("inf") != SEED("-inf"));
}

// The three node seeds of B9.5. Each is identified by the first item of its stream.
static void test_node_seeds_match_spec(void **state) {
    World *world = *state;
    Arena *arena = &world->arena;
    const Node *a = node_new(arena, name_of(world, "a"));
    const Node *b = node_new(arena, name_of(world, "b"));
    const Symbol *x = name_of(world, "x"), *y = name_of(world, "y");
    Attr both[] = {{x, read_value(world, "1;2")}, {y, text_of(world, "q")}}, swapped[] = {both[1], both[0]};
    const Node *tagged = node_add_tag(arena, node_add_tag(arena, a, name_of(world, "z")), name_of(world, "b"));
    const Node *parent =
        node_append(arena, node_set_attrs(arena, a, &(Attr){x, value_number(1)}, 1), value_node(arena, b));
    const struct {
        const Node *node;
        double item;
    } rows[] = {
        {a, 0.8562539106701949},
        {node_set_attrs(arena, tagged, both, 2), 0.6813509987656384},
        // attributes are hashed in the order of their names
        {node_set_attrs(arena, tagged, swapped, 2), 0.6813509987656384},
        {parent, 0.2517061228601389},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        uint64_t key = value_seed_hash(NULL, value_node(arena, rows[i].node));
        assert_number("item 0", value_stream_item(value_stream(STREAM_UNIFORM, key), 0), rows[i].item);
    }
}

static void test_stream_positions_match_spec(void **state) {
    (void)state;
    static const struct {
        double x;
        uint64_t position;
    } rows[] = {
        {0, 0},
        {0.9, 0},
        {-0.0, 0},
        {-0.5, UINT64_MAX},
        {-1, UINT64_MAX},
        {1e15, 1000000000000000},
        {-9223372036854775808.0, 0x8000000000000000},
        {9223372036854774784.0, 9223372036854774784u},
        {1e19, 0x8000000000000000}, // outside the range of 64 bits: the smallest integer
        {-1e19, 0x8000000000000000},
        {NAN, 0x8000000000000000},
        {INFINITY, 0x8000000000000000},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_true(value_stream_position(rows[i].x) == rows[i].position);
}

TEST_GROUP(value_symbol) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_symbol_numbers_match_spec),
        WORLD_TEST(test_interned_names_are_unique),
        WORLD_TEST(test_only_registered_symbols_are_found),
        WORLD_TEST(test_seed_hashes_match_spec),
        WORLD_TEST(test_node_seeds_match_spec),
        WORLD_TEST(test_stream_positions_match_spec),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
