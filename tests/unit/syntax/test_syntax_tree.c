// test_syntax_tree.c: precedence, structure and source spans of the syntax tree (language.md L3).
#include "parsing.h"

static void test_precedence_shapes_tree(void **state) {
    World *world = *state;
    static const char *const rows[][2] = {
        {"2**3**2", "(** (** 2 3) 2)"},
        {"-2**2", "(neg (** 2 2))"},
        {"2*-3", "(* 2 (neg 3))"},
        {"2**-1", "rejected"},
        {"7-3-2;2/2/2", "(compose (- (- 7 3) 2) (/ (/ 2 2) 2))"},
        {"2+3*4%5", "(+ 2 (% (* 3 4) 5))"},
        {"7//2*2", "(* (// 7 2) 2)"},
        {"not 1==2", "(not (== 1 2))"},
        {"not 0 or 1", "(or (not 0) 1)"},
        {"1 or 1 xor 1", "(xor (or 1 1) 1)"},
        {"a or b and c", "(or a (and b c))"},
        {"1+1..2*3|1+0", "(range (+ 1 1) (* 2 3) (+ 1 0))"},
        {"1..3 in 0..5", "(in (range 1 3 _) (range 0 5 _))"},
        {"..5", "(range _ 5 _)"},
        {"..5|2", "(range _ 5 2)"},
        {"..3..4", "rejected"},
        {"a<b<c", "rejected"},
        {"a==b==c", "rejected"},
        {"1;2 == 1;2", "(compose 1 (== 2 1) 2)"},
        {"$:k[0]", "(index (lookup :k) 0)"},
        {"-$:k", "(neg (lookup :k))"},
        {"$$a", "(lookup (lookup a))"},
        {"x if 0 else y if 0 else z", "(cond x 0 (cond y 0 z))"},
        {"x if y", "(cond x y _)"},
        {"x if y if z", "rejected"},
        {"a << b << c", "(append a (append b c))"},
        {"1;2 for x in ..2", "(compose 1 (for (names x) (range _ 2 _) 2))"},
        {"(x;y) for x in a for y in b", "(for (names y) b (for (names x) a (compose x y)))"},
        {"x for x in a if b", "(for (names x) (cond a b _) x)"},
        {"x where x=1 where x=2", "(where (where x (binding (names x) 1)) (binding (names x) 2))"},
        {"x where x;y=1 z=2", "(where x (binding (names x y) 1) (binding (names z) 2))"},
        {"!a x=y where y=10 z=3",
         "(decorate (node a) (attr x (where y (binding (names y) 10) (binding (names z) 3))))"},
        {"func(x) x;1", "(compose (func (params (param x)) x) 1)"},
        {"let f=func(x) func(y) x-y",
         "(let (binding (names f) (func (params (param x)) (func (params (param y)) (- x y)))))"},
        {"let f=func(c) !light color=c",
         "(let (binding (names f) (func (params (param c)) (node light))) (binding (names color) c))"},
        {"1 or func(x) x", "rejected"},
        {"!a;!b x=1", "(decorate (compose (node a) (node b)) (attr x 1))"},
        {"!a x=1;!b y=2", "(decorate (node a) (attr x (compose 1 (node b))) (attr y 2))"},
        {"!a x=1 #t y=2 #u", "(decorate (node a) (attr x 1) (tag t) (attr y 2) (tag u))"},
        {"f (x)", "(call f x)"},
        {"v [0]", "(index v 0)"},
        {"!a (3)", "(call (node a) 3)"},
        {"f(1;2, 3)", "(call f (compose 1 2) 3)"},
        {"f(1, x=2, y=3)", "(call f 1 (named x 2) (named y 3))"},
        {"f(x=1, 2)", "rejected"},
        {"f(!a x=1)", "(call f (decorate (node a) (attr x 1)))"},
        {"f(!a << !b)", "(call f (append (node a) (node b)))"},
        {"f()(1)[2]", "(index (call (call f) 1) 2)"},
        {"f(1,)", "rejected"},
        {"1;", "rejected"},
        {"()", "rejected"},
        {"@f x=1 y=2", "(template f (attr x 1) (attr y 2))"},
        {"@f\n    !x", "(template f (suite (node x)))"},
        {"@(f) #t", "rejected"},
        {"@f(1)", "rejected"},
        {"(@f)", "rejected"},
        {"for a;b in u, c in v\n    a", "(for (names a b) u (for (names c) v (suite a)))"},
        {"if a\n    1\nelif b\n    2\nelse\n    3", "(if a (suite 1) b (suite 2) (suite 3))"},
        {"let a;b=1 c=2", "(let (binding (names a b) 1) (binding (names c) 2))"},
        {"let stable a=1", "(let-stable (binding (names a) 1))"},
        {"func f(a, b=1;2 #t)\n    a",
         "(func f (params (param a) (param b (decorate (compose 1 2) (tag t)))) (suite a))"},
        {"func ()\n    1", "(func (params) (suite 1))"},
        {"import a;b from 'x.fl'", "(import (names a b) 'x.fl')"},
        {"let x=!a y=1;2\n!b", "(let (binding (names x) (node a)) (binding (names y) (compose 1 2))) (node b)"},
        {"x for x in y #t", "(decorate (for (names x) y x) (tag t))"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_text(rows[i][0], shape(world, rows[i][0]), rows[i][1]);
}

static const Ast *find_kind(const Ast *ast, AstKind kind) {
    if (!ast || ast->kind == kind)
        return ast;
    const Ast *found = NULL;
    for (uint32_t i = 0; i < ast->count && !found; i++)
        found = find_kind(ast->children[i], kind);
    return found;
}

// Checks the source text of nodes.
static void test_nodes_span_their_text(void **state) {
    World *world = *state;
    static const struct {
        const char *program;
        AstKind kind;
        const char *span;
    } rows[] = {
        {"let x=1 + 2*3", AST_ADD, "1 + 2*3"},
        {"let x=1 + 2*3", AST_MUL, "2*3"},
        {"!a é=f(1, 'é') #t", AST_CALL, "f(1, 'é')"},
        {"!a é=f(1, 'é') #t", AST_TAG, "#t"},
        {"!a é=f(1, 'é') #t", AST_ATTR, "é=f(1, 'é')"},
        {"!a é=f(1, 'é') #t", AST_DECORATE, "!a é=f(1, 'é') #t"},
        {"x\n    y[z;1]\n", AST_INDEX, "y[z;1]"},
        {"-abc", AST_NEG, "-abc"},
        {"x if y else z", AST_COND, "x if y else z"},
        {"$(:a;1)", AST_COMPOSE, ":a;1"},
        {"import a;b from 'x'", AST_NAMES, "a;b"},
        {"let a;b=1", AST_BINDING, "a;b=1"},
        {"x for y in z", AST_FOR, "x for y in z"},
        {"f(x=1)", AST_NAMED, "x=1"},
        {"..5|2", AST_RANGE, "..5|2"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        Parsed parsed = parse_str(world, str_from(rows[i].program));
        const Ast *ast = find_kind(parsed.ast, rows[i].kind);
        assert_claim(rows[i].program, ast != NULL);
        Str span = {parsed.source->text.bytes + ast->span.start, ast->span.end - ast->span.start};
        assert_text(rows[i].program, str_to_c(&world->arena, span), rows[i].span);
        diag_sink_free(&parsed.diags);
    }
}

// The span of each node includes its children, and the children of operators are in source order.
static void check_nesting(const Ast *ast) {
    assert_true(ast->span.start <= ast->span.end);
    for (uint32_t i = 0; i < ast->count; i++)
        if (ast->children[i]) {
            assert_true(ast->height > ast->children[i]->height);
            check_nesting(ast->children[i]);
        }
}

static void test_tree_is_printed(void **state) {
    World *world = *state;
    Parsed parsed = parse_str(world, STR("let x=1;:a\n!b é=x if $'k'\n    ..3\n"));
    Text text = text_new(&world->arena);
    ast_print(&text, &world->symbols, parsed.source, parsed.ast);
    assert_text("print", text_c(&text),
                "suite  @1:1\n"
                "  let  @1:1\n"
                "    binding  @1:5\n"
                "      names  @1:5\n"
                "        name x  @1:5\n"
                "      compose  @1:7\n"
                "        literal 1  @1:7\n"
                "        literal :a  @1:9\n"
                "  append  @2:1\n"
                "    decorate  @2:1\n"
                "      node b  @2:1\n"
                "      attr é  @2:4\n"
                "        cond  @2:6\n"
                "          name x  @2:6\n"
                "          lookup  @2:11\n"
                "            literal 'k'  @2:12\n"
                "          (none)\n"
                "    suite  @3:5\n"
                "      range  @3:5\n"
                "        (none)\n"
                "        literal 3  @3:7\n"
                "        (none)\n");
    check_nesting(parsed.ast);
    diag_sink_free(&parsed.diags);
}

static void test_lists_grow(void **state) {
    World *world = *state;
    AstList *list = ast_list_new(&world->arena);
    for (int i = 0; i < 100; i++)
        assert_ptr_equal(ast_list_add(list, ast_literal(&world->arena, (Span){0}, value_number(i))), list);
    ast_list_add_all(list, list->count ? &(AstList){.items = list->items, .count = 3} : list);
    Ast *suite = ast_from_list(&world->arena, AST_SUITE, (Span){0, 1}, NULL, list);
    assert_int_equal(suite->count, 103);
    assert_int_equal(suite->height, 2);
    assert_number("last", suite->children[102]->value.as.number, 2);
}

TEST_GROUP(syntax_tree) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_precedence_shapes_tree),
        WORLD_TEST(test_nodes_span_their_text),
        WORLD_TEST(test_tree_is_printed),
        WORLD_TEST(test_lists_grow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
