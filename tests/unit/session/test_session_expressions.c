// test_session_expressions.c: tests every `check` line of language.md with the complete interpreter.
#include "player.h"

typedef struct Check {
    const char *expression;
    const char *value;
} Check;

// Names whose values are unknown until run time. From frame 1 on, the state holds :k → 5, (:a;1) → 1;2, "str" → 7 and 3
// → 9.
static const char prelude[] = "let dz=frame*0 d1=1+dz d2=2+dz d3=3+dz\n"
                              "!counter state=:k initial=5 rate=0\n"
                              "!counter state=:a;1 initial=1;2 rate=0\n"
                              "!counter state=\"str\" initial=7 rate=0\n"
                              "!counter state=3 initial=9 rate=0\n";

static void check_all(Player *player, bool simplify, const Check *checks, size_t count) {
    PetriOptions options = player_options(player);
    options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .no_simplify = !simplify};
    player_reopen(player, &options);
    for (size_t i = 0; i < count; i++) {
        Notebook script = {0};
        const char *const parts[] = {prelude, "!v v=(", checks[i].expression, ")\n"};
        for (size_t k = 0; k < COUNT_OF(parts); k++)
            note(&script, parts[k], strlen(parts[k]));
        player_run(player, script.text, 2);
        free(script.text);
        const char *found = strstr(player_tree(player), "!v");
        char wanted[1000];
        bool null = strcmp(checks[i].value, "null") == 0; // an attribute with the value null is omitted
        snprintf(wanted, sizeof wanted, null ? "!v\n" : "!v v=%s\n", checks[i].value);
        assert_text(checks[i].expression, found, wanted);
    }
}

static void test_examples_of_specification(void **state) {
    static const Check checks[] = {
        {"10m", "0.01"},
        {"5u", "4.9999999999999996e-06"},
        {"90°", "0.25"},
        {"10deg", "0.02777777777777778"},
        {"2.5e3k", "2500000"},
        {"1_0.5_5e1_0", "105500000000"},
        {"1e400", "inf"},
        {"1...5", "null"},
        {"1..5.5", "1;2;3;4;5"},
        {".5..2", "0.5;1.5"},
        {"1:30", "90"},
        {"12:3", "723"},
        {"1:2:3.4", "3723.4"},
        {"100:00:00", "360000"},
        {"59:59.5", "3599.5"},
        {"\"a\\x41\\n\\u00e9\\101\\q\"", "'aA\\néA\\\\q'"},
        {"'''a'b''c'''", "\"a'b''c\""},
        {"\"\\0\\12\\400\"", "'\\x00\\nĀ'"},
        {"'\\e\\ '", "'\\\\e\\\\ '"},
        {"2**3**2", "64"},
        {"-2**2", "-4"},
        {"2*-3", "-6"},
        {"7-3-2;2/2/2;2+3*4%5;7//2*2", "2;0.5;4;6"},
        {"not 1==2;not 0 or 1;not (1 and 0)", "1;1;1"},
        {"1 or 1 xor 1", "0"},
        {"1+1..2*3|1+0", "2;3;4;5"},
        {"1..3 in 0..5", "1"},
        {"1;2 == 1;2", "1;0;2"},
        {"$:k[0]", "5"},
        {"-$:k", "-5"},
        {"(1 if 0 else 2 if 0 else 3)", "3"},
        {"x for x in ..5 if x>2", "null"},
        {"x if x>2 for x in ..5", "3;4"},
        {"1;2 for x in 1;2", "1;2;2"},
        {"(x;y) for x in ..2 for y in ..2", "0;0;1;0;0;1;1;1"},
        {"x where x=1 where x=2", "1"},
        {"x+y where x;y=(5;6)", "11"},
        {"y where y=x for x in ..3", "0;1;2"},
        {"(func(x) x*2)(4)", "8"},
        {"len (1;2)", "2"},
        {"(1;2;3)+(10;20)", "11;22;13"},
        {"(1;2;3)+null", "null"},
        {"(1;\"a\")+1", "null"},
        {"7//2;-7//2;7//-2;7.5//0.5", "3;-4;-4;15"},
        {"7%2;-7%2;7%-2;-7%-2;5.5%2", "1;1;-1;-1;1.5"},
        {"1/0;-1/0;0/0", "inf;-inf;nan"},
        {"1//0;0//0;1%0", "inf;nan;nan"},
        {"inf%2;5%inf;-5%inf;5//inf;-5//inf", "nan;nan;nan;0;-0"},
        {"7 // 0.1;7%0.1;1e17%3", "70;0;0"},
        {"2**0.5;(-8)**(1/3);0**0;nan**0", "1.4142135623730951;nan;1;1"},
        {"..5", "0;1;2;3;4"},
        {"3..25|7", "3;10;17;24"},
        {"2..1|-0.3", "2;1.7;1.4;1.1"},
        {"0..1|0.1", "0;0.1;0.2;0.30000000000000004;0.4;0.5;0.6000000000000001;0.7000000000000001;0.8;0.9"},
        {"..2.5;0.5..3", "0;1;2;0.5;1.5;2.5"},
        {"5..0", "null"},
        {"5..0|-2", "5;3;1"},
        {"..1|0", "null"},
        {"..null", "null"},
        {"null..3;..3|null", "0;1;2;0;1;2"},
        {"(1;2)..3", "null"},
        {"..inf", "null"},
        {"..nan", "null"},
        {"..1e-300", "0"},
        {"-2..2", "-2;-1;0;1"},
        {"(1;2)<(1;3);(1;2)<(1;2;0);(1;2)<1;3>(2;9)", "1;1;0;1"},
        {"\"B\"<\"a\";\"ab\"<\"b\";\"é\"<\"z\";null<0;0<null", "1;1;0;1;0"},
        {"1<\"a\"", "null"},
        {"((1;\"a\")<(2;\"a\"));((1;\"a\")<(1;\"b\"))", "1;1"},
        {"(1;\"a\")<(1;2)", "null"},
        {"nan<1;nan>1;nan<=1;nan>=1;1<nan;1>nan", "0;1;0;1;0;1"},
        {"0/0==0/0;0==-0;null==null;null==0;\"a\"==:a", "0;1;1;0;0"},
        {"(1;\"a\")==(1;\"a\");(1;\"a\")!=(1;\"b\");(1;2)==1", "1;1;0"},
        {"sin==sin;sin==cos;(func(x) x)==(func(x) x)", "1;0;0"},
        {"uniform(:x)==uniform(:x);uniform(:x)==beta(:x);uniform(:x)!=uniform(:y);uniform(:x)==null", "1;0;0;0"},
        {"2 in (1;2;3);(2;3) in (1;2;3);(1;3) in (1;2;3);null in 3;3 in null", "1;1;0;1;0"},
        {"1 in (1;\"b\");\"b\" in (1;\"b\");(1;\"b\") in (1;\"b\";2);\"a\" in (1;2);nan in nan", "1;1;1;0;0"},
        {"(1;2;3)[0];(1;2;3)[-1];(1;2;3)[3;4;-4];(1;2;3)[1.9];(1;2;3)[-0.5]", "1;3;1;2;3;2;3"},
        {"(1;2;3)[null]", "null"},
        {"(1;2;3)[0;\"a\"]", "null"},
        {"null[0]", "null"},
        {"(\"a\";1;2)[1;2]+1", "2;3"},
        {"5[..4]", "5;5;5;5"},
        {"\"abc\"[0]", "'abc'"},
        {"null or 3;0 or 3;(0;0) or 5;1 or 2;\"a\" or 3", "3;3;5;1;'a'"},
        {"1 and 2;0 and 2", "2;0"},
        {"null and 2", "null"},
        {"(1 xor 2);(0 xor 2);(2 xor 0);(0 xor 0);(null xor \"a\")", "0;2;2;0;'a'"},
        {"null xor null", "null"},
        {"not null;not 0;not \"\";not (0;\"\");not (0;1);not nan;not !a;not sin;not uniform()", "1;1;1;1;0;0;0;0;0"},
        {"1 if 0", "null"},
        {"concat(1/3;:a;1e20;-0;1e-7)", "'0.333333333a1e+20-01e-07'"},
        {"concat(\"a\";null;1.0;2.50;true;1e9;1e8;123456789;1234567890;0.1+0.2)",
         "'a12.511e+091000000001234567891.23456789e+090.3'"},
        {"concat(12345678.95;\"/\";1e-4;\"/\";1e-5;\"/\";nan;\"/\";0/0;\"/\";-inf)",
         "'12345678.9/0.0001/1e-05/nan/nan/-inf'"},
        {"concat(!foo;func(x) x)", "'foo<anon>'"},
        {"concat(:a+0)", "'a'"},
        {"$:k;$(:a;1);$\"str\";$(1+2);$:k+1", "5;1;2;7;9;6"},
        {"$\"k\"", "null"},
        {"$null", "null"},
        {"$3.5", "null"},
    };
    check_all(*state, true, checks, COUNT_OF(checks));
    check_all(*state, false, checks, COUNT_OF(checks));
}

// Rules of language.md that have no examples there.
static void test_expression_edge_cases(void **state) {
    static const Check checks[] = {
        {"x<=x where x=(0/0;1)", "1"},              // both operands are the same object (L5.5 rule 1)
        {"(y<=x where x=v y=v) where v=0/0", "0"},  // but single numbers have no identity
        {"uniform(nan)[0]==uniform(-nan)[0]", "1"}, // the sign of a computed nan depends on the processor (B9.2)
        {"uniform(nan)[0]==uniform(0/0)[0]", "1"},
        {"uniform(!a x=nan)[0]==uniform(!a x=-nan)[0]", "1"},
        {"uniform(:a)", "null"},
        {"1 if uniform(:a)", "1"},
        {"(uniform(:a);null)[0]", "null"},              // a stream that is composed with another value is dropped
        {"(uniform(:a) if 1)[0]==uniform(:a)[0]", "1"}, // streams are preserved by if, and, or
        {"(0 or uniform(:a))[0]==uniform(:a)[0]", "1"},
        {"(1 and uniform(:a))[0]==uniform(:a)[0]", "1"},
        {"null==uniform(:a)", "0"},
        {"null!=uniform(:a)", "0"},
        {"uniform(:a)<1", "1"},
        {"-uniform(:a)", "null"},
        {"(null)(1);3(1);uniform(:a)(1)", "null"}, // null, without a diagnostic
        {"$(:a;1;2);$:nothing;$(!a);$sin", "null"},
        {"$(0-0)", "null"},
        {"(!a x=1 y=2)==(!a y=2 x=1);(!a x=1 x=null)==!a;!a==(!a #t)", "1;1;0"},
        {"(!a)==1;1 in (!a;1);(!a) in (1;!a)", "0;1;1"},
        {":a*2;:a+1==:a", "-inf;1"},
        {"'a'<(1;'b');(1;'a')<'b'", "null"},
        {"0;-0;0*-1", "0;-0;-0"},
        {"..1e12", "null"},
        {"(sin;cos)(0)", "0;1"},
        {"(sin;'s';cos)(0.25)", "1;-0"},
        {"(x;y) where x;y=uniform(1)", "0.3236437711805903;0.5057062674373606"},
        {"len(..3 for i in ..2)", "6"},
        {"(a;b;c) for a;b;c in ..4", "0;1;2;3"},
        {"x where x;x=(1;2)", "2"}, // the last binding of a repeated name is used
    };
    check_all(*state, true, checks, COUNT_OF(checks));
    check_all(*state, false, checks, COUNT_OF(checks));
}

TEST_GROUP(session_expressions) {
    const struct CMUnitTest tests[] = {PLAYER_TEST(test_examples_of_specification),
                                       PLAYER_TEST(test_expression_edge_cases)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
