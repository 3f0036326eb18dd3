// test_scene_mirror.c: state and engine are in sync after an update, even if it was aborted at any point.
//
// Trees are built by the test and live as long as the program. An update is aborted when its arena reaches the limit.
#include "scene/scene.h"
#include "values.h"

typedef struct Stage {
    World *world;
    Schema schema;
    Scene *scene;
    State *state;
    Arena arena; // temporary data of the frame
    jmp_buf escape;
    double time;
} Stage;

static void ignore_report(void *host, DiagLevel level, const char *code, const Origin *origin, Str node, Str key,
                          Str text) {
    (void)host, (void)level, (void)code, (void)origin, (void)node, (void)key, (void)text;
}

static const Node *make_node(World *world, const char *kind, const char *name, Value value) {
    return node_set_attrs(&world->arena, node_new(&world->arena, name_of(world, kind)),
                          &(Attr){name_of(world, name), value}, 1);
}

static Value append_node(World *world, Value system, const char *kind, const char *name, Value value,
                         const char *vector) {
    const Node *node = make_node(world, kind, name, value);
    node = node_set_attrs(&world->arena, node, &(Attr){name_of(world, vector), value_number(3)}, 1);
    return value_node(&world->arena,
                      node_append(&world->arena, system.as.items->as.node, value_node(&world->arena, node)));
}

// Returns a system in two dimensions with particles 1 to `count` and three equal forces. Their vectors have one number,
// so reading them allocates from the frame's arena.
static Value system_of(World *world, int count, double force) {
    const Node *node = make_node(world, "physics", "state", read_value(world, ":s"));
    node = node_set_attrs(&world->arena, node, &(Attr){name_of(world, "dimensions"), value_number(2)}, 1);
    Value tree = value_node(&world->arena, node);
    for (int i = 1; i <= count; i++)
        tree = append_node(world, tree, "particle", "id", value_number(i), "position");
    for (int i = 0; i < 3; i++)
        tree = append_node(world, tree, "constant", "strength", value_number(force), "force");
    value_mark_program_lifetime(tree);
    return tree;
}

// Updates the scene for one frame. Returns false if the update was aborted.
static bool update_scene(Stage *stage, Value tree, size_t limit) {
    volatile bool whole = false;
    arena_init(&stage->arena, "frame", limit);
    stage->arena.escape = &stage->escape;
    stage->time += 1;
    if (setjmp(stage->escape) == 0) {
        SceneFrame frame = {
            .state = stage->state, .arena = &stage->arena, .time = stage->time, .fps = 4, .lockstep = true};
        scene_update(stage->scene, tree, &frame);
        whole = true;
    }
    arena_free(&stage->arena);
    return whole;
}

static Value get_entry(const Stage *stage, const char *key) {
    return state_get(stage->state, read_value(stage->world, key));
}

static bool has_entry(const Stage *stage, const char *key) {
    return get_entry(stage, key).len > 0;
}

// Updates a new scene twice with `first`, then with `second` and `third`. The update with `second` has a memory budget
// of `limit` bytes, so it may be aborted; if `limit` is 0, it is left out. Returns true if it was completed.
static bool run_frames(Stage *stage, World *world, Value first, Value second, Value third, size_t limit) {
    *stage = (Stage){.world = world, .state = state_new(NULL)};
    schema_init(&stage->schema, &world->symbols, (SchemaSink){NULL, ignore_report});
    stage->scene = scene_new(&world->arena, &stage->schema);
    assert_true(update_scene(stage, first, SIZE_MAX));
    assert_true(update_scene(stage, first, SIZE_MAX));
    assert_true(has_entry(stage, ":s;1") && has_entry(stage, ":s;2") && has_entry(stage, ":s;2;:velocity"));
    bool whole = limit > 0 && update_scene(stage, second, limit);
    if (limit == 0)
        stage->time += 1;
    assert_true(update_scene(stage, third, SIZE_MAX));
    return whole;
}

static void free_stage(Stage *stage) {
    scene_free(stage->scene);
    state_free(stage->state);
}

// The tests try the budgets 1, 1 + BY, 1 + 2 BY and so on below MAX_BUDGET, in bytes. They must abort the update at
// PLACES or more different points.
enum { MAX_BUDGET = 1000, BY = 8, PLACES = 4 };

// If a tree is incomplete, particles of the last complete tree are removed from the state by the next complete tree.
static void test_vanished_particle_has_no_entry_after_an_abort(void **state) {
    World *world = *state;
    Value two = system_of(world, 2, 1), one = system_of(world, 1, 1), three = system_of(world, 3, 1);
    int broken = 0;
    for (size_t limit = 1; limit < MAX_BUDGET; limit += BY) {
        Stage stage;
        broken += !run_frames(&stage, world, two, three, one, limit);
        assert_true(has_entry(&stage, ":s;1"));
        assert_false(has_entry(&stage, ":s;2") || has_entry(&stage, ":s;2;:velocity") || has_entry(&stage, ":s;3"));
        free_stage(&stage);
    }
    assert_true(broken >= PLACES && broken < MAX_BUDGET / BY);
}

// Forces of a tree that was not read completely do not act.
static void test_forces_of_an_aborted_tree_do_not_act(void **state) {
    World *world = *state;
    Value pushed = system_of(world, 2, 1), pulled = system_of(world, 2, -5);
    Stage expected;
    run_frames(&expected, world, pushed, pulled, pushed, 0);
    int broken = 0;
    for (size_t limit = 1; limit < MAX_BUDGET; limit += BY) {
        Stage stage;
        if (!run_frames(&stage, world, pushed, pulled, pushed, limit)) {
            broken++;
            assert_true(value_equal(NULL, get_entry(&stage, ":s;1"), get_entry(&expected, ":s;1")));
            assert_true(value_equal(NULL, get_entry(&stage, ":s;2;:velocity"), get_entry(&expected, ":s;2;:velocity")));
        }
        free_stage(&stage);
    }
    free_stage(&expected);
    assert_true(broken >= PLACES && broken < MAX_BUDGET / BY);
}

static size_t arena_bytes(const Arena *arena) {
    size_t bytes = 0;
    for (const ArenaBlock *block = arena->first; block; block = block->next)
        bytes += sizeof *block + block->capacity;
    return bytes;
}

// Ids that a host requests are charged to the budget of the script.
static void test_ids_are_charged(void **state) {
    World *world = *state;
    Value two = system_of(world, 2, 1), three = system_of(world, 3, 1);
    Stage stage;
    SceneView view;
    const double *ids;
    Budget budget = {.memory_limit = SIZE_MAX};
    budget_begin(&budget, UINT64_MAX, NULL);
    world->arena.budget = &budget;
    size_t of_world = arena_bytes(&world->arena);
    run_frames(&stage, world, two, two, two, 0);
    world->arena.budget = NULL;
    assert_true(scene_view(stage.scene, stage.state, 0, &view));
    size_t before = budget.memory;
    assert_true(scene_view_ids(stage.state, &view, &ids));
    assert_true(ids[0] == 1 && ids[1] == 2);
    assert_int_equal(budget.memory, before + 2 * sizeof *ids);
    assert_true(update_scene(&stage, three, SIZE_MAX));
    assert_true(scene_view(stage.scene, stage.state, 0, &view));
    budget.memory_limit = budget.memory;
    assert_false(scene_view_ids(stage.state, &view, &ids));
    assert_null(ids);
    budget.memory_limit = SIZE_MAX;
    assert_true(scene_view_ids(stage.state, &view, &ids));
    assert_true(ids[2] == 3);
    scene_reset(stage.scene);
    assert_int_equal(budget.memory, arena_bytes(&world->arena) - of_world);
    free_stage(&stage);
}

TEST_GROUP(scene_mirror) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_vanished_particle_has_no_entry_after_an_abort),
        WORLD_TEST(test_forces_of_an_aborted_tree_do_not_act),
        WORLD_TEST(test_ids_are_charged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
