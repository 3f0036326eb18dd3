// test_vm_code.c: tests code that optimisations could break: reused registers, loops and nodes whose instructions
// differ from the source, and cached lookups. `z` is a zero that is computed in each frame, so that nothing is folded.
#include "runner.h"

#define Z "let z=frame*0\n"

static void test_reused_registers_keep_live_values(void **state) {
    static const ScriptRow rows[] = {
        {Z "let a=(x where x=5+z)+(y where y=6+z)\n!a v=a\n", "!a v=11\n"},
        {Z "let a=(x+(y where y=2+z) where x=5+z)\n!a v=a\n", "!a v=7\n"},
        {Z "let a=((x where x=z) or (y where y=2+z)) b=((x where x=3+z) and (y where y=4+z))\n!a v=a;b\n",
         "!a v=2;4\n"},
        {Z "let a=((x where x=7+z) or (y where y=2+z)) b=((x where x=z) and (y where y=4+z))\n!a v=a;b\n",
         "!a v=7;0\n"},
        {Z "let a=((x where x=7+z) xor (y where y=z));((x where x=7+z) xor 1+z)\n!a v=a\n", "!a v=7;0\n"},
        {Z "let a=(1+z if z==0 else 2) b=(a+(c where c=10+z))\n!a v=b\n", "!a v=11\n"},
        {Z "let a=((b;(c where c=2+z)) where b=1+z c=3+z)\n!a v=a\n", "!a v=1;2\n"},
        {Z "let a;b;c=(1;2)+z\n!a v=a;b;c\n", "!a v=1;2;1\n"},
        {Z "let a=z+1 a=a+1 a=a+a\n!a v=a\n", "!a v=4\n"},
        {Z "let f=func(x, y=z+3) (x+y+w where w=x*10)\n!a v=f(1);f(2, 1);f(1, y=f(2))\n", "!a v=14;23;36\n"},
        {Z "let a=(10*i+j for j in ..2+z for i in ..3+z)\n!a v=a\n", "!a v=0;1;10;11;20;21\n"},
        {Z "let s=((i;t where t=i*i) for i in ..4+z)\n!a v=s\n", "!a v=0;0;1;1;2;4;3;9\n"},
        {Z "func down(n)\n    for i in ..n\n        n\n        down(n-1)\n!a v=down(3+z)\n",
         "!a v=3;2;1;2;1;3;2;1;2;1;3;2;1;2;1\n"},
        {Z "func many(a, b, c, d, e, f, g, h, i, j)\n    j;i;h;g;f;e;d;c;b;a\n"
           "!a v=many(1, 2, 3, 4, 5, 6, 7, 8, 9, 10+z);zip(1, 2, 3, 4, 5, 6, 7, 8, 9, z)\n",
         "!a v=10;9;8;7;6;5;4;3;2;1;1;2;3;4;5;6;7;8;9;0\n"},
        {Z "let f=((func(x) x+i) for i in ..3+z)\n!a v=f(10)\n", "!a v=10;11;12\n"},
    };
    check_trees(*state, rows, COUNT_OF(rows), 3);
}

static void test_loop_collects_values_that_are_not_null(void **state) {
    static const ScriptRow rows[] = {
        {Z "!a v=(i if i%2 else null for i in ..5+z)\n", "!a v=1;3\n"},
        {Z "!a v=(i if i>9 for i in ..5+z)\n", "!a\n"},
        {Z "!a v=((x;y) for x;y in ..5+z)\n", "!a v=0;1;2;3;4\n"},
        {Z "for x;y in ..3+z\n    !a v=x w=y\n", "!a v=0 w=1\n!a v=2\n"},
        {Z "for i in ..2+z\n    !a v=i\n    !b v=i\n    'x'\n    let q=i+1\n    !c v=q\n",
         "!a v=0\n!b v=0\n!c v=1\n!a v=1\n!b v=1\n!c v=2\n"},
        {Z "for i in ..3+z\n    if i==1\n        !a v=i\n        !b\n    elif i==2\n        !c v=i\n    let q=i\n",
         "!a v=1\n!b\n!c v=2\n"},
        {Z "!a v=((i;'n';!b) for i in ..2+z)\n", "!a v=0;'n';(!b);1;'n';(!b)\n"},
        // A stream is kept only if it is the only part of a vector. Nulls also count as parts (L4.7).
        {Z "!a v=(uniform(:a+z) for i in ..1+z)[0]==uniform(:a)[0]\n", "!a v=1\n"},
        {Z "!a v=(uniform(:a+z) for i in ..2+z)[0]\n", "!a\n"},
        {Z "!a v=((uniform(:a+z) if i==0) for i in ..2+z)[0]\n", "!a\n"},
        {Z "!a v=((uniform(:a+z) if i==0 else (null;null)) for i in ..2+z)[0];5\n", "!a v=5\n"},
        {Z "!a v=((uniform(:a+z);i) for i in ..2+z)\n", "!a v=0;1\n"},
        {Z "!a v=(i for i in uniform(:a+z));(i for i in null);7\n", "!a v=7\n"},
        {Z "!a v=(i for i in ('x';2;'y';4+z))\n", "!a v='x';2;'y';4\n"},
    };
    check_trees(*state, rows, COUNT_OF(rows), 3);
}

static void test_node_operations_keep_the_original_node(void **state) {
    static const ScriptRow rows[] = {
        {Z "!a x=1+z y=null z=uniform(:a+z) w=2+z\n", "!a x=1 w=2\n"},
        {Z "!a x=1+z y=2 x=3+z\n", "!a x=3 y=2\n"},
        {Z "!a x=1+z y=2 x=null+z\n", "!a y=2\n"},
        {Z "!a #q #b #q x=z\n", "!a #b #q x=0\n"},
        {Z "!a x=z\n    null\n    3\n    'x'\n    !b y=z\n        !c\n    !d\n",
         "!a x=0\n    !b y=0\n        !c\n    !d\n"},
        {Z "!a x=z\n    null\n", "!a x=0\n"},
        {Z "let n=!a\n(n << !b x=z);n;(n << !c)\n", "!a\n    !b x=0\n!a\n!a\n    !c\n"},
        {Z "let n=(!a x=1)\n(n #t y=z);(n x=null);n\n", "!a #t x=1 y=0\n!a\n!a x=1\n"},
        {Z "let n=(!a;3;!b)\n!c v=(n x=z)\n(n << !d v=z)\n", "!c v=(!a);3;(!b)\n!a\n    !d v=0\n!b\n    !d v=0\n"},
        {Z "(null+z) #t x=1\n(3+z) << !b\n!c v=((3+z) << !b)\n", "!c v=3\n"},
        {Z "!a v=((!b x=(!c y=z))==(!b x=(!c y=z)));((!b x=z)==(!b x=z+1))\n", "!a v=1;0\n"},
        {Z "func f(c, x=0)\n    !f v=x\n        c\n@f x=z+1\n    !g\n    !h\n", "!f v=1\n    !g\n    !h\n"},
    };
    check_trees(*state, rows, COUNT_OF(rows), 3);
}

static void test_elements_and_comparisons_follow_the_language(void **state) {
    static const ScriptRow rows[] = {
        {Z "let v=(10..20)+z\n!a v=v[1..3];v[z+1..z+3];v[..2];v[8..12];v[-1..1];v[0.5..2.5];v[3..3];v[2..1]\n",
         "!a v=11;12;11;12;10;11;18;19;10;11;19;10;10;11\n"},
        {Z "let v=(10..20)+z\n!a v=v[3];v[-1];v[10];v[2.7];v[0;2;4];v[1..8|3];v[5..6];v['x'];v[null];v[4..2|-1]\n",
         "!a v=13;19;10;12;10;12;14;11;14;17;15;14;13\n"},
        {Z "let v=7+z\n!a v=v[0..3];v[0];v[2]\n", "!a v=7;7;7;7;7\n"},
        {Z "let v='a';'b';'c';z\n!a v=v[1..3];v[3];v[..2];v[3..5]\n", "!a v='b';'c';0;'a';'b';0;'a'\n"},
        {Z "!a v=(uniform(:a+z)[1..3]==(uniform(:a)[1];uniform(:a)[2]));null[1..3];4\n", "!a v=1;4\n"},
        {Z "let v=(1;2)+z n=v[nan];v[inf] m=v[z/0]\n!a v=n;m\n", "!a v=1;1;1\n"},
        // In comparisons, an object equals itself; other equal numbers are compared one by one (L5.5).
        {Z "let x=nan+z y=(nan;1)+z w=y[0..2] u=y[0..2]\n!a v=(x<x);(x<=x);(x>x);(x>=x);(x==x);(x!=x)\n"
           "!b v=(x<1);(x>1);(1>x);(1<=x)\n!c v=(y<=y);(w<=u);(w>u)\n",
         "!a v=0;1;0;1;0;1\n!b v=0;1;1;0\n!c v=1;0;1\n"},
        {Z "!a v=(1+z<2);(2<=2+z);('a'<'b');(1+z<'a');(null<1+z);(1+z==1);('a'!='b');(2+z in (1;2;3));(not z)\n",
         "!a v=1;1;1;1;1;1;1;1\n"},
        {Z "!a v=(-(1;2)-z);(+'x');(7//2+z);(-7%3+z);(2**3+z);((1;2;3)+(10;20)+z);(1/(0+z))\n",
         "!a v=-1;-2;3;2;8;11;22;13;inf\n"},
    };
    check_trees(*state, rows, COUNT_OF(rows), 3);
}

// In each frame, the n-th execution of a lookup first tries the slot that the n-th execution found in the previous
// frame.
static void test_lookup_finds_entries_that_move_between_frames(void **state) {
    static const ScriptRow rows[] = {
        {"!a v=($(:k;(i+frame)%3) for i in ..3) w=$(:k;frame-1);$(frame+1);$:k;$'s';$('s';frame);$(nan+frame)\n"
         "!b v=($(:k;i) for i in ..(frame-1));($(:k;i;:nothing) for i in ..frame);$uniform(:k)\n"
         "!c v=($(:k;(i where i=frame-1)));($((:k;i)) for i in (0;2));$(null;:k;null;frame-2);$(frame*0;:k)\n",
         "!a v=10;11;12 w=12;6;5;7\n!b v=10;11\n!c v=12;10;12;11\n"},
    };
    static const char *const entries[][2] = {{":k;0", "10"}, {":k;1", "11"}, {":k;2", "12"},
                                             {"'s'", "7"},   {":k", "5"},    {"4", "6"}};
    Runner *runner = *state;
    for (size_t i = 0; i < COUNT_OF(entries); i++)
        assert_true(state_set(runner->state, read_value(&runner->world, entries[i][0]),
                              read_value(&runner->world, entries[i][1])));
    check_trees(runner, rows, COUNT_OF(rows), 4);
}

TEST_GROUP(vm_code) {
    const struct CMUnitTest tests[] = {
        RUNNER_TEST(test_reused_registers_keep_live_values),
        RUNNER_TEST(test_loop_collects_values_that_are_not_null),
        RUNNER_TEST(test_node_operations_keep_the_original_node),
        RUNNER_TEST(test_elements_and_comparisons_follow_the_language),
        RUNNER_TEST(test_lookup_finds_entries_that_move_between_frames),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
