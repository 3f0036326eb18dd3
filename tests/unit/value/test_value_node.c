// test_value_node.c: immutable nodes (language.md L7).
#include "value/node.h"
#include "values.h"

// Returns a tree as text, one line per node.
static const char *tree(World *world, const Node *node) {
    Text text = text_new(&world->arena);
    format_tree(&text, &world->symbols, node, 0, NULL, NULL);
    return text_c(&text);
}

static const Node *new_node(World *world, const char *kind) {
    return node_new(&world->arena, name_of(world, kind));
}

static bool nodes_equal(const Node *a, const Node *b) {
    return item_equal(NULL, (Item){ITEM_NODE, .as.node = a}, (Item){ITEM_NODE, .as.node = b});
}

static const Node *with_attrs(World *world, const Node *node, const char *names, const char *const *values) {
    Attr attrs[8];
    uint32_t count = 0;
    for (; names[count]; count++)
        attrs[count] =
            (Attr){symbol_intern(&world->symbols, (Str){names + count, 1}), read_value(world, values[count])};
    return node_set_attrs(&world->arena, node, attrs, count);
}

static const Node *with_attr(World *world, const Node *node, const char *name, const char *value) {
    return with_attrs(world, node, name, &value);
}

static void test_new_node_is_empty(void **state) {
    World *world = *state;
    assert_text("new node", tree(world, new_node(world, "canvas")), "!canvas\n");
    assert_int_equal(new_node(world, "a")->height, 1);
}

static void test_attributes_keep_order(void **state) {
    World *world = *state;
    const Node *a = with_attrs(world, new_node(world, "a"), "xyz", (const char *const[]){"1", "2", "3"});
    assert_text("order of setting", tree(world, a), "!a x=1 y=2 z=3\n");
    assert_text("a new value keeps the position", tree(world, with_attr(world, a, "x", "9")), "!a x=9 y=2 z=3\n");
    const Node *without = with_attr(world, a, "x", "null");
    assert_text("removed", tree(world, without), "!a y=2 z=3\n");
    assert_text("set again after removal: at the end", tree(world, with_attr(world, without, "x", "4")),
                "!a y=2 z=3 x=4\n");
    assert_text("a stream removes", tree(world, with_attr(world, a, "y", "uniform:1")), "!a x=1 z=3\n");
    assert_text("removing a missing attribute changes nothing", tree(world, with_attr(world, a, "q", "null")),
                "!a x=1 y=2 z=3\n");
    const char *const twice[] = {"5", "null", "6"};
    assert_text("the same name three times", tree(world, with_attrs(world, a, "yyy", twice)), "!a x=1 z=3 y=6\n");
    assert_text("the operand is unchanged", tree(world, a), "!a x=1 y=2 z=3\n");
    assert_text("get", show(world, node_get(a, name_of(world, "z"))), "3");
    assert_true(value_is_null(node_get(a, name_of(world, "q"))));
}

static void test_tags_are_sorted_and_unique(void **state) {
    World *world = *state;
    const Node *node = new_node(world, "a");
    static const char *const tags[] = {"m", "z", "b", "é", "b", "Z", "m"};
    for (size_t i = 0; i < COUNT_OF(tags); i++)
        node = node_add_tag(&world->arena, node, name_of(world, tags[i]));
    assert_text("sorted and unique", tree(world, node), "!a #Z #b #m #z #é\n");
}

static void test_append_adds_nodes_only(void **state) {
    World *world = *state;
    Arena *arena = &world->arena;
    const Node *a = node_append(arena, new_node(world, "a"), read_value(world, "!b;1;'x';!c"));
    assert_text("nodes only", tree(world, a), "!a\n    !b\n    !c\n");
    const Node *more = node_append(arena, a, value_node(arena, a)); // appends the original node to the changed one
    assert_text("appended after the others", tree(world, more), "!a\n    !b\n    !c\n    !a\n        !b\n        !c\n");
    assert_int_equal(more->height, 3);
    assert_text("the operand is unchanged", tree(world, a), "!a\n    !b\n    !c\n");
    assert_text("null", tree(world, node_append(arena, a, VALUE_NULL)), "!a\n    !b\n    !c\n");
    assert_text("numbers", tree(world, node_append(arena, a, read_value(world, "1;2"))), "!a\n    !b\n    !c\n");
}

static void test_equality_is_structural(void **state) {
    World *world = *state;
    Arena *arena = &world->arena;
    const Node *a = new_node(world, "a"), *ab = node_append(arena, a, read_value(world, "!b;!c"));
    const Node *xy = with_attrs(world, a, "xy", (const char *const[]){"1;2", "'s'"});
    const Node *yx = with_attrs(world, a, "yx", (const char *const[]){"'s'", "1;2"});
    const Symbol *t = name_of(world, "t"), *u = name_of(world, "u");
    const Node *tu = node_add_tag(arena, node_add_tag(arena, a, t), u);
    const Node *ut = node_add_tag(arena, node_add_tag(arena, a, u), t);
    const struct {
        const char *what;
        const Node *a, *b;
        bool wanted;
    } rows[] = {
        {"kind", a, new_node(world, "a"), true},
        {"other kind", a, new_node(world, "b"), false},
        {"attributes in any order", xy, yx, true},
        {"other value", xy, with_attr(world, yx, "x", "1;3"), false},
        {"fewer attributes", xy, with_attr(world, xy, "x", "null"), false},
        {"a removed attribute does not count", a, with_attr(world, with_attr(world, xy, "x", "null"), "y", "null"),
         true},
        {"-0", with_attr(world, a, "x", "0"), with_attr(world, a, "x", "-0"), true},
        {"nan", with_attr(world, a, "x", "nan"), with_attr(world, a, "x", "nan"), false},
        {"tags in any order", tu, ut, true},
        {"fewer tags", tu, node_add_tag(arena, a, t), false},
        {"children", ab, node_append(arena, node_append(arena, a, read_value(world, "!b")), read_value(world, "!c")),
         true},
        {"children's order", ab, node_append(arena, a, read_value(world, "!c;!b")), false},
        {"fewer children", ab, node_append(arena, a, read_value(world, "!b")), false},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        assert_claim(rows[i].what, nodes_equal(rows[i].a, rows[i].b) == rows[i].wanted);
        assert_claim(rows[i].what, nodes_equal(rows[i].b, rows[i].a) == rows[i].wanted);
    }
    const Node *nan = with_attr(world, a, "x", "nan");
    assert_false(nodes_equal(nan, nan)); // NaN differs from itself, because elements are compared, not node
                                         // addresses
}

// Chains of the maximum height can be processed; higher ones are rejected.
static void test_higher_trees_are_rejected(void **state) {
    World *world = *state;
    Arena *arena = &world->arena;
    const Node *node = new_node(world, "a");
    for (int height = 1; height < NODE_MAX_HEIGHT; height++) {
        node = node_append(arena, new_node(world, "a"), value_node(arena, node));
        assert_non_null(node);
    }
    assert_int_equal(node->height, NODE_MAX_HEIGHT);
    assert_null(node_append(arena, node, value_node(arena, node)));
    assert_non_null(node_append(arena, node, read_value(world, "!b")));
    assert_true(nodes_equal(node, node_copy(arena, node)));
    value_seed_hash(NULL, value_node(arena, node));
    bool too_high = false;
    Vector vector = vector_new(arena);
    vector_add(&vector, value_node(arena, new_node(world, "p")));
    vector_add(&vector, value_number(1));
    NodeList list = node_list(arena, value_node(arena, node));
    Value both = value_append(arena, vector_finish(&vector), &list, &too_high);
    assert_true(too_high);
    assert_text("unchanged", show(world, both), "(!p);1");
    assert_int_equal(both.as.items[0].as.node->child_count, 0);
}

// Nodes in attributes count towards the height, because == and the seed hash also recurse into them.
static void test_attributes_count_as_height(void **state) {
    World *world = *state;
    Arena *arena = &world->arena;
    const Node *node = new_node(world, "a");
    for (int i = 0; i < 100; i++)
        node = node_set_attrs(arena, new_node(world, "a"), &(Attr){name_of(world, "x"), value_node(arena, node)}, 1);
    assert_int_equal(node->height, 101);
    while (node->height < NODE_MAX_HEIGHT)
        node = node_append(arena, new_node(world, "a"), value_node(arena, node));
    Attr higher = {name_of(world, "x"), value_node(arena, node)};
    assert_null(node_set_attrs(arena, new_node(world, "p"), &higher, 1));
    bool too_high = false;
    Value left = value_set_attrs(arena, node_of(world, "p"), &higher, 1, &too_high);
    assert_true(too_high);
    assert_text("unchanged", tree(world, left.as.items[0].as.node), "!p\n");
}

static void test_vector_operations_change_nodes_only(void **state) {
    World *world = *state;
    Arena *arena = &world->arena;
    Value v = read_value(world, "!a;3;!b;'s'");
    v = value_add_tag(arena, v, name_of(world, "t"));
    bool too_high = false;
    v = value_set_attrs(arena, v, &(Attr){name_of(world, "x"), value_number(1)}, 1, &too_high);
    NodeList c = node_list(arena, read_value(world, "!c"));
    v = value_append(arena, v, &c, &too_high);
    assert_false(too_high);
    assert_text("other elements are kept", show(world, v), "(!a);3;(!b);'s'");
    assert_text("first", tree(world, v.as.items[0].as.node), "!a #t x=1\n    !c\n");
    assert_text("second", tree(world, v.as.items[2].as.node), "!b #t x=1\n    !c\n");
    static const char *const others[] = {"1;2", "null", "'s'"};
    for (size_t i = 0; i < COUNT_OF(others); i++) {
        Value w = read_value(world, others[i]);
        assert_text(others[i], show(world, value_add_tag(arena, w, name_of(world, "t"))), others[i]);
        assert_text(others[i], show(world, value_append(arena, w, &c, &too_high)), others[i]);
    }
    assert_int_equal(value_add_tag(arena, value_stream(STREAM_BETA, 1), name_of(world, "t")).kind, VALUE_STREAM);
}

// Nodes that live as long as the program are marked and keep their address, so systems need not read them again.
static void test_program_lifetime_is_marked(void **state) {
    World *world = *state;
    Arena *arena = &world->arena;
    Value children = read_value(world, "!b;7;!c");
    Value attr = read_value(world, "!d");
    value_mark_program_lifetime(children);
    const Node *b = children.as.items[0].as.node;
    assert_true(b->program_lifetime && b->program_lifetime_children);
    NodeList list = node_list(arena, children);
    list.program_lifetime = true;
    const Node *first = node_append_list(arena, new_node(world, "a"), &list);
    const Node *second = node_append_list(arena, new_node(world, "a"), &list);
    assert_ptr_equal(first->children, second->children);
    assert_true(first->program_lifetime_children && !first->program_lifetime);
    assert_int_equal(first->child_count, 2);
    const Node *more = node_append_list(arena, first, &list);
    assert_text("both lists are appended", tree(world, more), "!a\n    !b\n    !c\n    !b\n    !c\n");
    assert_false(more->program_lifetime_children);
    assert_false(node_append(arena, new_node(world, "a"), children)->program_lifetime_children);
    const Node *changed = with_attr(world, b, "x", "1");
    assert_false(changed->program_lifetime);
    assert_true(changed->program_lifetime_children);
    assert_false(node_add_tag(arena, b, name_of(world, "t"))->program_lifetime);
    assert_false(node_copy(arena, first)->program_lifetime_children);
    // The attributes and children of a marked node are also marked.
    Value outer = value_node(arena, node_set_attrs(arena, more, &(Attr){name_of(world, "x"), attr}, 1));
    value_mark_program_lifetime(outer);
    assert_true(outer.as.items[0].as.node->program_lifetime);
    assert_true(attr.as.items[0].as.node->program_lifetime);
}

static void test_copy_is_deep(void **state) {
    World *world = *state;
    Arena other;
    arena_init(&other, "other", SIZE_MAX);
    const Node *node = node_add_tag(&other, node_new(&other, name_of(world, "a")), name_of(world, "t"));
    node = node_set_attrs(&other, node, &(Attr){name_of(world, "x"), value_string(&other, STR("s"))}, 1);
    node = node_append(&other, node, value_node(&other, node));
    const Node *copy = node_copy(&world->arena, node);
    assert_true(nodes_equal(copy, node));
    arena_free(&other);
    assert_text("copy", tree(world, copy), "!a #t x='s'\n    !a #t x='s'\n");
    assert_int_equal(copy->height, 2);
}

TEST_GROUP(value_node) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_new_node_is_empty),
        WORLD_TEST(test_attributes_keep_order),
        WORLD_TEST(test_tags_are_sorted_and_unique),
        WORLD_TEST(test_append_adds_nodes_only),
        WORLD_TEST(test_equality_is_structural),
        WORLD_TEST(test_higher_trees_are_rejected),
        WORLD_TEST(test_vector_operations_change_nodes_only),
        WORLD_TEST(test_program_lifetime_is_marked),
        WORLD_TEST(test_copy_is_deep),
        WORLD_TEST(test_attributes_count_as_height),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
