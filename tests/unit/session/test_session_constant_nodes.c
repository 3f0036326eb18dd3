// test_session_constant_nodes.c: tests that constant nodes, and no others, are marked and keep their address between
// frames.
#include "player.h"
#include "session/session.h"

static const Node *top_node(const Player *player) {
    Value tree = player->session->frame.tree;
    assert_true(tree.kind == VALUE_MIXED && tree.len == 1);
    return tree.as.items[0].as.node;
}

// A node with changing attributes and constant children.
static void test_constant_children_keep_address(void **state) {
    Player *player = *state;
    static const char *const scripts[] = {
        "!physics state=:a time=frame\n    for i in ..3\n        !particle id=i position=i;2*i\n    !drag strength=1\n",
        "let N=3\n!physics time=frame\n    for i in ..N\n        !particle id=i radius=(r where r=i*2)\n    !drag\n",
        "!physics time=frame\n    !group\n        !particle id=1\n    !particle id=2\n    !drag\n    !random\n",
        "func world(t)\n    !physics time=t\n        for i in ..4\n            !particle id=i\n\nworld(frame)\n",
        "for i in ..1\n    !physics time=frame\n        for k in ..4\n            !particle id=k\n",
        "if frame > -1\n    !physics time=frame\n        for k in ..4\n            !particle id=k\n",
    };
    for (size_t i = 0; i < COUNT_OF(scripts); i++) {
        player_run(player, scripts[i], 1);
        const Node *node = top_node(player);
        const Node *const *children = node->children;
        const Node *first = children[0];
        uint32_t count = node->child_count;
        assert_claim(scripts[i], node->program_lifetime_children && !node->program_lifetime &&
                                     first->program_lifetime && count > 1);
        for (int frame = 1; frame < 4; frame++) {
            player_step(player, 1);
            node = top_node(player);
            assert_claim(scripts[i], node->children == children && node->child_count == count);
            assert_claim(scripts[i], node->program_lifetime_children && node->children[0] == first);
            assert_number("its attributes change", node->attrs[node->attr_count - 1].value.as.number, frame);
        }
    }
}

static void test_changing_children_are_not_marked(void **state) {
    Player *player = *state;
    static const char script[] = "!physics time=frame\n    !group\n        !particle id=1\n    !particle id=frame\n";
    player_run(player, script, 1);
    const Node *group = top_node(player)->children[0];
    assert_false(top_node(player)->program_lifetime_children);
    assert_true(group->program_lifetime);
    assert_false(top_node(player)->children[1]->program_lifetime);
    player_step(player, 1);
    assert_ptr_equal(top_node(player)->children[0], group);
    assert_number("changed", top_node(player)->children[1]->attrs[0].value.as.number, 1);
}

// Data of another program may be allocated at the same address.
static void test_new_program_changes_generation(void **state) {
    Player *player = *state;
    uint64_t generation = player->session->loader.generation;
    player_run(player, "!a\n", 2);
    uint64_t loaded = player->session->loader.generation;
    assert_true(loaded != generation);
    PetriConfig *config = petri_config_get(player->session);
    player_run(player, "!a\n", 2);
    uint64_t again = player->session->loader.generation;
    assert_true(again != loaded);
    petri_config_apply(player->session, config);
    assert_true(player->session->loader.generation != again && player->session->loader.generation != loaded);
    petri_config_free(config);
}

TEST_GROUP(session_constant_nodes) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_constant_children_keep_address),
        PLAYER_TEST(test_changing_children_are_not_marked),
        PLAYER_TEST(test_new_program_changes_generation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
