// test_vm_names.c: tests scopes, closures, calls and loops (language.md L8 to L10).
#include "runner.h"

static void test_name_is_visible_in_its_block_only(void **state) {
    static const ScriptRow rows[] = {
        {"let x=1\n!a\n    let x=x+1\n    !b x=x\n!c x=x\n", "!a\n    !b x=2\n!c x=1\n"},
        {"let x=1\nlet x=x+1\n!a x=x\n", "!a x=2\n"},
        {"let a=1 b=a+1\n    c=b+1\n!x v=a;b;c\n", "!x v=1;2;3\n"},
        {"let x=5\nif 1\n    let x=6\n!a x=x\n", "!a x=5\n"},
        {"for x in 1;2\n    let y=x\n!a x=x y=y\n", "!a\n"}, // loop names and bindings in the body are local
        {"let x=9\n!a v=(x where x=x+1 x=x*2) w=x\n", "!a v=20 w=9\n"},
        {"let x=1;2;3 a;b;c;d=x\n!r a=a d=d\n", "!r a=1 d=1\n"},
        {"let u;v=uniform(:q)\n!r s=u==uniform(:q)[0];v==uniform(:q)[1]\n", "!r s=1;1\n"},
        {"let a;b=null\n!r a=a b=b\n", "!r\n"},
        {"let a;a=1;2\n!r a=a\n", "!r a=2\n"},
        {"let q=\n    1\n    2 if 0\n    3\n!q q=q\n", "!q q=1;3\n"},
        {"let stable e;f=4;5\n!e e=e f=f\n", "!e e=4 f=5\n"},
        {"let sin=3\n!a v=sin\n", "!a v=3\n"}, // scripts may rebind built-ins and engine names
        {"let frame=7\n!a v=frame\n", "!a v=7\n"},
        {"let pi=4 true=0\n!a v=pi;true\n", "!a v=4;0\n"},
        {"!a v=inf;true;false;pi;tau;π;𝜏\n",
         "!a v=inf;1;0;3.141592653589793;6.283185307179586;3.141592653589793;6.283185307179586\n"},
    };
    check_trees(*state, rows, COUNT_OF(rows), 1);
}

static void test_function_captures_values_at_its_definition(void **state) {
    static const ScriptRow rows[] = {
        // Values are captured when the definition is evaluated.
        {"let k=3\nfunc g(v)\n    k*v\nlet k=7\n!g v=g(5;6)\n", "!g v=15;18\n"},
        {"let f=(func(x) x+k) k=1\n!g v=f(1)\n", "!g\n"}, // k is not bound yet when f is defined
        {"let fs=(func() i) for i in ..3\n!f v=fs()\n", "!f v=0;1;2\n"},
        {"func f(a, b=5, c)\n    !f a=a b=b c=c\nf(1)\nf(1, c=3, c=4, q=9)\nf(null, b=2)\nf(1, 2, 3, 4, a=7)\n",
         "!f a=1 b=5\n!f a=1 b=5 c=4\n!f b=2\n!f a=1 b=2 c=3\n"},
        // defaults are evaluated at the definition
        {"let d=1\nfunc f(a, b=d+1)\n    a+b\nlet d=100\n!f v=f(1)\n", "!f v=3\n"},
        {"func f(a, b=a)\n    b\n!f v=f(1)\n", "!f\n"}, // a default does not see parameters
        {"func f(f)\n    f\n!f v=f(3)\n", "!f v=3\n"},  // a parameter may shadow the function's name
        {"func f(a, a)\n    a\n!f v=f(1, 2)\n", "!f v=2\n"},
        {"func f(n)\n    n*f(n-1) if n>1 else 1\n!f v=f(10)\n", "!f v=3628800\n"},
        {"let f=func(x) func(y) x-y\n!f v=f(3)(4)\n", "!f v=-1\n"},
        {"func ()\n    1\n!f v=2\n", "!f v=2\n"},
        {"let g=\n    func (x)\n        x+1\n!f v=g(1)\n", "!f v=2\n"},
        {"func a(f, n)\n    (f(a, n-1);n) if n>0\nfunc b(f, n)\n    (f(b, n-1);-n) if n>0\n!f v=a(b, 2)\n",
         "!f v=-1;2\n"},
        {"func f(x)\n    let y=x*2\n    y+1\n!f v=(f;f)(3)\n", "!f v=7;7\n"},
        {"!f v=(func(x) x)==(func(x) x);(f==f where f=(func(x) x))\n", "!f v=0;1\n"},
        {"func f(x)\n    x\n!f v=f;(func(x) x);sin\n", "!f v=(f);(<anon>);(sin)\n"},
    };
    check_trees(*state, rows, COUNT_OF(rows), 1);
}

static void test_template_passes_attributes_and_children(void **state) {
    static const ScriptRow rows[] = {
        {"func f(a, b=5)\n    !f a=a b=b\n@f\n@f a=1\n@f b=2\n    !x\n@f b=null\n    null\n",
         "!f b=5\n!f a=1 b=5\n!f a=(!x) b=2\n!f\n"},
        {"@(func(x) (!a x=x)) x=3\n", "!a x=3\n"},
        {"@$:nothing x=3\n", ""},
        {"func box(inside, size=1)\n    !box size=size\n        inside\n@box size=2\n    !a\n    @box\n        !b\n",
         "!box size=2\n    !a\n    !box size=1\n        !b\n"},
    };
    check_trees(*state, rows, COUNT_OF(rows), 1);
}

static void test_blocks_run_by_their_conditions(void **state) {
    static const ScriptRow rows[] = {
        {"for a;b in 1;2;3\n    !r a=a b=b\n", "!r a=1 b=2\n!r a=3\n"},
        {"for a in ..2, b in a..2\n    !s a=a b=b\n", "!s a=0 b=0\n!s a=0 b=1\n!s a=1 b=1\n"},
        {"for a in null\n    !s\nfor a in uniform(1)\n    !s\n", ""},
        {"for i in ..4\n    if i==0\n        !z\n    elif i==1\n        !o\n    else\n        !m i=i\n",
         "!z\n!o\n!m i=2\n!m i=3\n"},
        {"if null\n    !a\nelif nan\n    !b\nelse\n    !c\n", "!b\n"},
        {"!a << for i in ..2\n    !b i=i\n", "!a\n    !b i=0\n    !b i=1\n"},
        {"!a v=(x if x>2 for x in ..5)\n", "!a v=3;4\n"},
        {"3\n    !b\n'ignored'\n!a\n", "!a\n"},
    };
    check_trees(*state, rows, COUNT_OF(rows), 1);
}

static void test_operations_on_nodes_make_new_nodes(void **state) {
    static const ScriptRow rows[] = {
        {"let n=!a\nlet m=(n x=1 y=2)\nn #q\nm x=null z=3\nm x=5\n(m x=null) x=6\n(n;n;3;'s') k=1\n"
         "n << (n;1;'x';null;!c)\n3\n'ignored'\n",
         "!a #q\n!a y=2 z=3\n!a x=5 y=2\n!a y=2 x=6\n!a k=1\n!a k=1\n!a\n    !a\n    !c\n"},
        {"!a << !b << !c x=1\n    !d\n", "!a\n    !b\n        !c x=1\n            !d\n"},
        {"(!e;!f) #t z=1\n    !g\n", "!e #t z=1\n    !g\n!f #t z=1\n    !g\n"},
        {"let n=!a\nn x=(n y=1)\nn\n", "!a x=(!a)\n!a\n"},
        {"!a x=1 x=2 y=3 x=null\n", "!a y=3\n"},
        {"!a x=uniform(1)\n", "!a\n"},
    };
    check_trees(*state, rows, COUNT_OF(rows), 1);
}

// Only branches that are taken are evaluated, once and in order, as the output of debug() shows.
static void test_order_of_evaluation(void **state) {
    Runner *runner = *state;
    static const ScriptRow rows[] = {
        {"1 or debug(1)\n0 and debug(2)\n0 or debug(3)\n1 and debug(4)\n", "> 3\n> 4\n"},
        {"1 xor debug(1)\n0 xor debug(2)\n", "> 1\n> 2\n"},
        {"debug(1) if debug(0) else debug(2)\n", "> 0\n> 2\n"},
        {"if debug(1)\n    debug(2)\nelif debug(3)\n    debug(4)\n", "> 1\n> 2\n"},
        {"!a x=debug(1) y=debug(2)\n    debug(3)\n", "> 1\n> 2\n> 3\n"},
        {"debug(2)-debug(1)\n", "> 2\n> 1\n"},
        {"debug('x') for i in ..2\n", "> 'x'\n> 'x'\n"},
        {"let unused=debug('u')\nfunc f(x=debug('d'))\n    debug('never')\n", "> 'u'\n> 'd'\n"},
        {"debug(x) where x=debug(1)+1\n", "> 1\n> 2\n"},
        {"nothing(debug(1))\n3(debug(2))\n", "> 2\n"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        runner_run(runner, rows[i].script, 1);
        const char *found = text_c(&runner->log);
        // If the called name is unbound, the arguments need not be evaluated (L8.1).
        if (i + 1 == COUNT_OF(rows) && strcmp(found, "> 1\n> 2\n") == 0)
            continue;
        assert_text(rows[i].script, found, rows[i].wanted);
    }
}

static void test_unbound_names_and_bad_calls_are_reported(void **state) {
    Runner *runner = *state;
    static const ScriptRow rows[] = {
        {"let mass=1\n!a x=mas\n", "2:6 unbound name 'mas' is null [unbound-name]\n"},
        {"!a\n    !b v=foo+bar\n", "2:10 unbound name 'foo' is null [unbound-name]\n"
                                   "2:14 unbound name 'bar' is null [unbound-name]\n"},
        {"let x=x\n", "1:7 unbound name 'x' is null [unbound-name]\n"},
        {"!a v=(sin;'s';1;!n)(0)\n", "1:6 a string cannot be called [not-callable]\n"
                                     "1:6 a number cannot be called [not-callable]\n"
                                     "1:6 a node cannot be called; write attributes without "
                                     "parentheses: !name a=1 [not-callable]\n"},
        {"!a v=1(2);null(3)\n", ""},
        {"!a v='a'+1;[]\n", NULL},
        {"!a v='a'+1;(1;2)[null];1<'a'\n3 x=1\n", ""}, // type errors are not reported
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        bool good = runner_load(runner, rows[i].script);
        assert_claim(rows[i].script, good == (rows[i].wanted != NULL));
        if (!rows[i].wanted)
            continue;
        runner_frame(runner, 0);
        assert_text(rows[i].script, text_c(&runner->reported), rows[i].wanted);
    }
}

TEST_GROUP(vm_names) {
    const struct CMUnitTest tests[] = {
        RUNNER_TEST(test_name_is_visible_in_its_block_only),
        RUNNER_TEST(test_function_captures_values_at_its_definition),
        RUNNER_TEST(test_template_passes_attributes_and_children),
        RUNNER_TEST(test_blocks_run_by_their_conditions),
        RUNNER_TEST(test_operations_on_nodes_make_new_nodes),
        RUNNER_TEST(test_order_of_evaluation),
        RUNNER_TEST(test_unbound_names_and_bad_calls_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
