// test_syntax_keywords.c: no word is reserved; tests the keyword table in language.md L2.12.
//
// A row contains a program with a placeholder `~`, and the words that are keywords in this position. K1 to K11 are rows
// of the table in language.md. The test replaces the placeholder by each of the fifteen words. A word is a name if the
// syntax tree is the same as with an ordinary name.
#include "parsing.h"

static const char *const words[] = {"let",  "stable", "func",  "import", "from", "for", "in", "if",
                                    "elif", "else",   "where", "and",    "or",   "xor", "not"};

// Returns `text` with every occurrence of `place` replaced by the word.
static const char *fill(World *world, const char *text, const char *place, const char *word) {
    Text out = text_new(&world->arena);
    while (*text) {
        if (strncmp(text, place, strlen(place)) == 0) {
            text_add_c(&out, word);
            text += strlen(place);
        } else {
            text_add_char(&out, *text++);
        }
    }
    return text_c(&out);
}

static bool is_listed(const char *list, const char *word) {
    size_t len = strlen(word);
    for (const char *at = list; (at = strstr(at, word)); at += len)
        if ((at == list || at[-1] == ' ') && (at[len] == 0 || at[len] == ' '))
            return true;
    return false;
}

static void check_point(World *world, const char *program, const char *keywords) {
    const char *plain = shape(world, fill(world, program, "~", "zzz"));
    assert_claim(program, strcmp(plain, "rejected") != 0);
    for (size_t i = 0; i < COUNT_OF(words); i++) {
        const char *filled = fill(world, program, "~", words[i]);
        const char *found = shape(world, filled);
        bool is_name = strcmp(found, fill(world, plain, "zzz", words[i])) == 0;
        assert_claim(filled, is_name != is_listed(keywords, words[i]));
    }
}

typedef struct Point {
    const char *program;
    const char *keywords;
} Point;

static void check_points(World *world, const Point *points, size_t count) {
    for (size_t i = 0; i < count; i++)
        check_point(world, points[i].program, points[i].keywords);
}

#define K1 "let func import for if not"
#define K2 K1 " else elif"
#define K3 "func for if not"
#define K4 "func not"
#define K5 "not"
#define NONE ""
#define K7 "else for if in where and or xor"
#define K9 "stable"

static void test_keywords_at_statement_start(void **state) {
    static const Point points[] = {
        {"~\n", K1},
        {"x\n~\n", K1},
        {"!a\n    ~\n", K1},
        {"!a\n    x\n~\n", K1},
        {"%pragma fps 1\n~\n", K1},
        {"func f(a)\n    b\n~\n", K1},
        {"for x in y\n    z\n~\n", K1},
        {"if x\n    y\nelse\n    z\n~\n", K1},
        {"if x\n    y\n~\n", K2},
        {"if x\n    y\nelif z\n    w\n~\n", K2},
        {"!a\n    if x\n        y\n    ~\n", K2},
        {"if x\n    !a\n        y\n~\n", K2}, // the final DEDENT ends the body of the if
        {"!a << ~\n", K3},
        {"!a <<\n~\n", K3},
        {"!a << !b << ~\n", K3},
    };
    check_points(*state, points, COUNT_OF(points));
}

static void test_keywords_in_compositions(void **state) {
    static const Point points[] = {
        {"(~)\n", K4},
        {"f(~)\n", K4},
        {"f(1, ~)\n", K4},
        {"f(a=~)\n", K4},
        {"v[~]\n", K4},
        {"!a x=~\n", K4},
        {"let x=~\n", K4},
        {"1;~\n", K4},
        {"(!a << ~)\n", K4},
        {"for x in ~\n    y\n", K4},
        {"for x in y, z in ~\n    w\n", K4},
        {"import a from ~\n", K4},
        {"if ~\n    y\n", K4},
        {"if x\n    y\nelif ~\n    z\n", K4},
        {"%include ~\n", K4},
        {"let f=func(a) ~\n", K4},
        {"func f(a=~)\n    b\n", K4},
    };
    check_points(*state, points, COUNT_OF(points));
}

static void test_keywords_at_operands(void **state) {
    static const Point points[] = {
        {"x for y in ~\n", K5}, {"x if y else ~\n", K5}, {"x where y=~\n", K5}, {"x if ~\n", K5},   {"x or ~\n", K5},
        {"x xor ~\n", K5},      {"x and ~\n", K5},       {"not ~\n", K5},       {"x == ~\n", NONE}, {"x != ~\n", NONE},
        {"x < ~\n", NONE},      {"x > ~\n", NONE},       {"x <= ~\n", NONE},    {"x >= ~\n", NONE}, {"x in ~\n", NONE},
        {"x..~\n", NONE},       {"..~\n", NONE},         {"..1|~\n", NONE},     {"x + ~\n", NONE},  {"x - ~\n", NONE},
        {"x * ~\n", NONE},      {"x / ~\n", NONE},       {"x // ~\n", NONE},    {"x % ~\n", NONE},  {"x ** ~\n", NONE},
        {"$~\n", NONE},         {"@~\n", NONE},          {"-~\n", NONE},        {"+~\n", NONE},     {"x - -~\n", NONE},
    };
    check_points(*state, points, COUNT_OF(points));
}

static void test_keywords_after_operands(void **state) {
    static const Point points[] = {
        {"x ~=1\n", K7},
        {"1 ~=1\n", K7},
        {"1:30 ~=1\n", K7},
        {"'s' ~=1\n", K7},
        {":s ~=1\n", K7},
        {"!a ~=1\n", K7},
        {"(x) ~=1\n", K7},
        {"v[1] ~=1\n", K7},
        {"f(x) ~=1\n", K7},
        {"!a x=1 ~=2\n", K7},
        {"(x ~=1)\n", K7},
        {"f(x+y ~=1)\n", K7},
        {"f((x) ~=1)\n", K7},
        {"let x=1 ~=2\n", K7},
        {"!a #t ~=1\n", NONE}, // this row and the next two: K8
        {"!a x=1 #t ~=1\n", NONE},
        {"f(!a #t ~=1)\n", NONE},
        // Directly after a name that starts an argument, `else` is a name.
        {"f(x ~=1)\n", "for if in where and or xor"},
        {"f(1, x ~=1)\n", "for if in where and or xor"},
    };
    check_points(*state, points, COUNT_OF(points));
}

static void test_keywords_as_names(void **state) {
    static const Point points[] = {
        {"let ~=1\n", K9},
        {"let stable ~=1\n", NONE}, // this row and those below: K10
        {"let stable x=1\n    ~=2\n", NONE},
        {"let x=1\n    ~=2\n", NONE},
        {"let a;~=1\n", NONE},
        {"for ~ in x\n    y\n", NONE},
        {"x for ~ in y\n", NONE},
        {"for a;~ in x\n    y\n", NONE},
        {"for a in x, ~ in y\n    z\n", NONE},
        {"import ~ from x\n", NONE},
        {"import a;~ from x\n", NONE},
        {"x where ~=1\n", NONE},
        {"f(a=1, ~=2)\n", NONE},
        {"%pragma ~ 1\n", NONE},
        {"func ~(a)\n    b\n", NONE},
        {"func f(~)\n    b\n", NONE},
        {"func f(a, ~)\n    b\n", NONE},
        {"func f(a, ~=1)\n    b\n", NONE},
        {"let g=func(~) x\n", NONE},
        {"@f ~=1\n", K7}, // `@f` is an operand, so K7 applies
    };
    check_points(*state, points, COUNT_OF(points));
}

// K11: where only `in` or `from` can follow, the keyword needs no word boundary after it.
static void test_in_and_from_need_no_boundary(void **state) {
    World *world = *state;
    for (size_t i = 0; i < COUNT_OF(words); i++) {
        bool is_in = strcmp(words[i], "in") == 0, is_from = strcmp(words[i], "from") == 0;
        assert_claim(words[i], accepts(world, fill(world, "for x ~ z\n    y\n", "~", words[i])) == is_in);
        assert_claim(words[i], accepts(world, fill(world, "for a;x ~ z\n    y\n", "~", words[i])) == is_in);
        assert_claim(words[i], accepts(world, fill(world, "y for x ~ z\n", "~", words[i])) == is_in);
        assert_claim(words[i], accepts(world, fill(world, "import a ~ z\n", "~", words[i])) == is_from);
    }
    static const char *const same[][2] = {
        {"for x in1;2\n    y\n", "for x in 1;2\n    y\n"},
        {"for x index\n    y\n", "for x in dex\n    y\n"},
        {"y for x in'z'\n", "y for x in 'z'\n"},
        {"y for in in in\n", "y for in in in\n"},
        {"import a from'f.fl'\n", "import a from 'f.fl'\n"},
        {"import a fromage\n", "import a from age\n"},
        {"import from from from\n", "import from from from\n"},
        {"10min 3\n", "10m in 3\n"},
        {"b=1c=2\n", "rejected"}, // a statement cannot begin with an attribute
        {"!a b=1c=2\n", "!a b=1 c=2\n"},
    };
    for (size_t i = 0; i < COUNT_OF(same); i++) {
        const char *wanted = strcmp(same[i][1], "rejected") ? shape(world, same[i][1]) : same[i][1];
        assert_text(same[i][0], shape(world, same[i][0]), wanted);
    }
}

static void test_pragma_and_include_positions(void **state) {
    World *world = *state;
    static const char *const rows[][2] = {
        {"%pragma fps 20\nx%pragma\n", "(pragma fps 20) (% x pragma)"},
        {"%pragmafps 20\n", "(pragma fps 20)"},
        {"x%include\n", "(% x include)"},
        {"%include'a.fl'\n", "(include 'a.fl')"},
        {"!a << %include 'a.fl'\n", "(append (node a) (include 'a.fl'))"},
        {"(!a << %include 'a.fl')\n", "rejected"},
        {"x\n%pragma fps 20\n", "rejected"},
        {"%pragma fps x\n", "rejected"},
        {"%pragma fps -1\n", "rejected"},
        {"%other\n", "rejected"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_text(rows[i][0], shape(world, rows[i][0]), rows[i][1]);
}

TEST_GROUP(syntax_keywords) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_keywords_at_statement_start),
        WORLD_TEST(test_keywords_in_compositions),
        WORLD_TEST(test_keywords_at_operands),
        WORLD_TEST(test_keywords_after_operands),
        WORLD_TEST(test_keywords_as_names),
        WORLD_TEST(test_in_and_from_need_no_boundary),
        WORLD_TEST(test_pragma_and_include_positions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
