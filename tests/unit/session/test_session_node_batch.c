// test_session_node_batch.c: tests that nodes which loops create as batches (lib/value/node_batch.h) behave like single
// nodes and use less memory.
#include "petri-inspect.h"
#include "player.h"
#include "session/session.h"

enum { VARIANTS = 4, LOOPS = 7 };

// Nodes that are created in each iteration.
static const char *const nodes[] = {
    "!particle id=i position=i;2*i mass=3",
    "!particle #one #two id=i position=(i;1) radius=i*2 mass=1/(i-7)",
    "!particle id=i position=(i;1 if i<25 else i;2;3)",
    "!particle id=i radius=(null if i==30 else 1)",
    "!particle id=(i if i%9 else 'text') v=i",
    "!particle id=-i x=(..3) s='text' y=:a;'b'",
    "!particle id=i%7 x=(!inner v=i)",
    "!particle id=i x=(!inner v=1)",
    "!particle id=k x=sum(j*k for j in ..3) where k=i+1",
    "!particle id=i if i%2 else !particle x=i",
    "!particle id=i x=uniform(i)[0] y=hypot(i;'a')",
    "!particle id=i x=i x=i+1",
};
static const char *const loops[LOOPS] = {"..40", "(5;..40)",  "..20|0.5",    "(x/3 for x in ..100)",
                                         "..3",  "(..40)*-1", "(-0;(1..40))"};

// Writes a script in which loops create nodes in place (`in_place`, batched), or bind a vector of nodes first (not
// batched).
static const char *make_script(char *text, size_t size, bool in_place, bool dynamic, const char *node,
                               const char *loop) {
    const char *factor = dynamic ? "*(1+0*frame)" : ""; // this factor keeps the sign of zero
    char vector[1000] = "many", line[1000] = "many";
    if (in_place) {
        snprintf(vector, sizeof vector, "((%s) for i in %s%s)", node, loop, factor);
        snprintf(line, sizeof line, "for i in %s%s\n                %s", loop, factor, node);
    }
    snprintf(text, size,
             "let many=((%s) for i in %s%s)\n"
             "    a=(!top << %s)\n"
             "    b=(!top << many)\n"
             "!top\n    !first\n    for j in ..2\n        !group\n            %s\n            !last\n"
             "!same v=(a==b);(a<b);(a in b) w=uniform(a)[..2] x=len(a) y=str(a) z=debug(a)\n"
             "!holder n=a\n",
             node, loop, factor, vector, line);
    return text;
}

static const char *run_variant(Player *player, bool in_place, bool dynamic, int node, int loop, bool simplify) {
    char text[4000];
    PetriOptions options = player_options(player);
    options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .no_simplify = !simplify};
    player_reopen(player, &options);
    player_run(player, make_script(text, sizeof text, in_place, dynamic, nodes[node], loops[loop]), 2);
    return player_print(player, PETRI_PRINT_TREE | PETRI_PRINT_LOG);
}

// Batched and single nodes give equal trees.
static void test_batched_nodes_match_single_nodes(void **state) {
    Player *player = *state;
    for (int node = 0; node < (int)COUNT_OF(nodes); node++)
        for (int loop = 0; loop < LOOPS; loop++) {
            char *plain = strdup(run_variant(player, false, true, node, loop, false));
            assert_true(strstr(plain, "!same v=1;") != NULL);
            for (int variant = 0; variant < VARIANTS; variant++)
                assert_text(nodes[node], run_variant(player, true, variant & 1, node, loop, variant & 2), plain);
            free(plain);
        }
}

// Scripts see single nodes in the result of a function, and in a test among the children of a node.
static void test_scripts_see_single_nodes(void **state) {
    Player *player = *state;
    player_run(player,
               "func particles()\n    for i in ..40+0*frame\n        !particle id=i\n"
               "let many=particles()\n!count v=len(many)\n"
               "!top\n    if many==((!particle id=i) for i in ..40+0*frame)\n        !equal\n",
               1);
    assert_text("tree", player_print(player, PETRI_PRINT_TREE), "!count v=40\n!top\n    !equal\n");
}

// Adds to *kinds the number of particles in the tree with the root `node`, and to *sum their ids. Reads the tree with
// petri_tree_*.
static void count_nodes(const PetriNode *node, int *kinds, double *sum) {
    PetriValue v = petri_tree_get(node, "id");
    *kinds += strcmp(petri_tree_kind(node), "particle") == 0;
    *sum += v.length == 1 ? v.numbers[0] : 0;
    const PetriNode *child;
    for (uint32_t i = 0; (child = petri_tree_child(node, i)) != NULL; i++)
        count_nodes(child, kinds, sum);
}

// A host sees single nodes with separate numbers. Whether or not the host reads the tree, systems continue as usual.
static void test_host_sees_single_nodes(void **state) {
    Player *player = *state;
    player_run(player,
               "!physics state=:p dimensions=1\n    !group\n        for i in ..1000\n            !particle id=i "
               "position=i velocity=1\n    for i in ..1000+0*frame\n        !particle id=1000+i position=2*i\n",
               1);
    for (int frame = 0; frame < 3; frame++) {
        PetriValue top = petri_tree(player->session);
        int kinds = 0;
        double sum = 0;
        assert_int_equal(top.length, 1);
        count_nodes(top.items[0].as.node, &kinds, &sum);
        assert_int_equal(kinds, 2000);
        assert_number("ids", sum, 1999 * 1000);
        player_step(player, 1);
    }
    assert_true(strstr(player_state(player), "$(:p;999) = 999.05\n") != NULL);
}

// Nodes in attributes are also single nodes for a host.
static void test_host_sees_single_nodes_in_attributes(void **state) {
    Player *player = *state;
    player_run(player, "!holder n=(!top << ((!particle id=i) for i in ..40+0*frame))\n", 1);
    PetriValue top = petri_tree(player->session);
    assert_int_equal(top.length, 1);
    PetriValue held = petri_tree_get(top.items[0].as.node, "n");
    assert_int_equal(held.length, 1);
    int kinds = 0;
    double sum = 0;
    count_nodes(held.items[0].as.node, &kinds, &sum);
    assert_int_equal(kinds, 40);
    assert_number("ids", sum, 39 * 20);
}

// Limits the memory per particle: script, state and engine together.
static void test_memory_per_particle(void **state) {
    enum { COUNT = 100000, EACH = 380 };
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.threads = 1;
    player_reopen(player, &options);
    size_t before = player->session->budget.memory;
    player_run(
        player,
        "!physics state=:p dimensions=2 time=time resolution=1/60\n    for i in ..100000\n        !particle id=i "
        "radius=0.5 position=i%300;i//300 velocity=normal(:x)[i];normal(:y)[i]\n    !collision strength=100\n",
        3);
    size_t bytes = player->session->budget.memory - before;
    if (bytes > (size_t)COUNT * EACH)
        print_error("%zu bytes a particle\n", bytes / COUNT);
    assert_true(bytes > (size_t)COUNT * 100 && bytes <= (size_t)COUNT * EACH);
}

TEST_GROUP(session_node_batch) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_batched_nodes_match_single_nodes),
        PLAYER_TEST(test_scripts_see_single_nodes),
        PLAYER_TEST(test_host_sees_single_nodes),
        PLAYER_TEST(test_host_sees_single_nodes_in_attributes),
        PLAYER_TEST(test_memory_per_particle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
