// test_vm_batch.c: tests that loops give the same results in batches as iteration by iteration.
#include "runner.h"

enum { ITERATIONS = 150 };

static const char loop_form[] = "%sfunc all()\n    for i in ..150\n        %s\n!all v=all()\n    all()\n";

// The body of a loop. `one_by_one`: true if the loop cannot be batched, so that its iterations are executed one by one.
typedef struct Body {
    const char *text;
    bool one_by_one;
} Body;

static const char before[] = "let z=frame vector=(4;8;15;16;23;42)*(1+frame) stream=uniform(:s;frame)\n"
                             "    mixed=(1;'two';!three) nothing=vector[frame..0]\n";

static const Body bodies[] = {
    // numbers
    {"i+1", false},
    {"(i-3)*(z+2)/(i+1)", false},
    {"-(i//4)+(0-i)%7", false},
    {"i**3+i**(z+1)+2**i+(i-9)**(i%3)", false},
    {"(i<7);(i<=z);(i>z);(i>=7);(i==7);(i!=7);not (i<3)", false},
    {"(0/0*i<1);(0/0*i>=1);(0/0*i==0/0*i)", false},
    {"((x<x);(x>x);(x<=x);(x>=x) where x=0/0*i)", false},
    {"(-y;+y;not y;(y xor i);(y xor 0) where y=0*(i-9))", false},
    // operands that are numbers in some iterations only
    {"(y+1;y-1;2*y;y/3;y//2;y%3;y**2;-y;+y;not y where y=(i if i%3 else 'x' if i%2 else i;0/0))", false},
    {"(y<z;y>z;y<=z;y>=z;y==z;y!=z;(y xor z) where y=(0/0 if i%3 else 'x' if i%2 else i-9))", false},
    // elements
    {"vector[i]+vector[i-3]+vector[i/2]+vector[0-i]", false},
    {"vector[i;i+1]", false},
    {"vector[i%4..i%4+2];vector[1..i]", false},
    {"stream[i]+uniform(:t;i)[2];stream[i-70];stream[2*i];stream[9-i]", false},
    {"normal(:t)[i];normal(:t)[i-70];beta(:t)[i];normal(:t)[i*1e17];(normal(:t)[i//7])", false},
    {"(s[i];(s==stream);s[i+1] where s=uniform(:s;i%3))", false},
    {"mixed[i];nothing[i];(i;2;3)[i]", false},
    {"'x' if mixed[i]==1 else 2", false},
    // built-ins: element-wise, of points, others
    {"sin(i/10)+cos(i)+sine(i/9)+triangle(z+i/7)+abs(3-i)+floor(i/4)+sqrt(i)", false},
    {"clamp(i;i/2, 3, 8);clamp(i, z, 9);round(i/7, 2);round(i/7, 19);impulse(i/10, i/20)", false},
    {"hypot(i;z);hypot(i, 3);hypot(i);length(i, 4);length(i;3);angle(i, z+1);map(i/9, 1, z)", false},
    {"noise(:n, i/9, z/3)+noise(:n;i, i/5, 2)+noise(:n, i)+noise(:n, i/3, i, z);noise(:n, 1e300*i, 0/0)", false},
    {"hsv(i/10;0.5;z);polar(i/8);max(i, z, 3);len(vector);sum(i;z;i)", false},
    // vectors
    {"(i;z;1)*(2;i;1)+(i;1)", false},
    {"(b;a;c;d) where a;b=(i;z) c;d=vector[i..i+2]", false},
    {"(vector[a..a+2] where a=(-2 if i%64==0 else i%4))", false},
    {"(p[1]+hypot(p);-p;+p;p in vector;i in vector) where p=(i;2*i;3)", false},
    {"$(:k;i);$(:k;i;:v)", false},
    {"hypot($(:k;i)) or 7", false},
    // branches
    {"i if i%3==0 else z if i%3==1 else 'text'", false},
    {"(i if i>20)", false},
    {"(s;t;u;(i xor z)) where s=(i;2 if i%2 else i) t=(i and 5) u=(nothing or i)", false},
    {"vector[i] if i<4 else vector[i..i+2] if i<90 else nothing", false},
    {"stream if i==140 else nothing", false},
    // nodes
    {"!p id=i at=(i;z) size=vector[i] also=nothing", false},
    {"!p id=i at=$(:k;i)", false},
    {"!p #tag a=1 b=(i if i%2 else nothing) c=!q n=i", false},
    {"!p a=i\n                    !q b=i\n                    !r c=(z if i%4 else i;z)", false},
    {"!p id=i;!q id=i+1;(!r c=z if i%4 else !s)", false},
    // bodies that cannot be batched
    {"(func(x) x+i)(1)", true},
    {"debug(i)", true},
};

// Returns the tree of the second frame of a loop with this body.
static const char *run_loop(Runner *runner, const char *body, bool no_batches, uint64_t *iterations) {
    char script[2000];
    snprintf(script, sizeof script, loop_form, before, body);
    runner->vm.no_batches = runner->static_vm.no_batches = no_batches;
    runner->vm.batched_iterations = 0;
    runner_run(runner, script, 2);
    *iterations = runner->vm.batched_iterations;
    return runner_tree(runner);
}

static void set_state(Runner *runner) {
    const double name = symbol_of(&runner->world, "k"), velocity = symbol_of(&runner->world, "v");
    for (int i = 0; i < ITERATIONS; i++) {
        const double keys[3] = {name, i, velocity}, place[3] = {i, 2 * i, 3};
        state_set(runner->state, value_numbers_view(keys, 3), value_number(7 * i));
        if (i < 70 || i > 80)
            state_set(runner->state, value_numbers_view(keys, 2), value_numbers_view(place, i > 120 ? 2 : 3));
    }
}

static void test_batches_match_single_iterations(void **state) {
    Runner *runner = *state;
    set_state(runner);
    for (size_t i = 0; i < 2 * sizeof bodies / sizeof bodies[0]; i++) {
        uint64_t batched, single;
        const Body *body = &bodies[i / 2];
        runner->simplify = i % 2;
        const char *found = run_loop(runner, body->text, false, &batched);
        assert_text(body->text, found, run_loop(runner, body->text, true, &single));
        assert_int_equal(single, 0);
        if (!runner->simplify && (batched == 0) != body->one_by_one)
            fail_msg("%s: %d iterations in batches", body->text, (int)batched);
    }
}

// Consecutive items of a stream equal items that are read one by one, even at the highest index.
static void test_stream_items_match(void **state) {
    Runner *runner = *state;
    runner->simplify = false;
    runner_run(runner,
               "let s=normal(:s;frame) u=uniform(:s;frame) r=s[-70..70] v=u[-70..70] one=func(i) i-70\n"
               "!all differ=((1 for i in ..140 if s[one(i)]!=r[i] or u[one(i)]!=v[i])) count=len(r);len(v)\n",
               1);
    assert_text("items", runner_tree(runner), "!all count=140;140\n");
    assert_int_equal(runner->vm.batched_iterations, 0);
}

// Errors are reported in the same order as in iteration-by-iteration execution.
static void test_errors_keep_their_order(void **state) {
    Runner *runner = *state;
    runner_run(runner,
               "let z=frame\n"
               "!all\n"
               "    for i in ..150\n"
               "        !p a=octnoise(:s, 2000 if i==140 else 1, 0.5, i+z)\n"
               "        !q b=octnoise(:s, 3000 if i==130 else 1, 0.5, i+z) c=i\n"
               "    for i in ..300\n"
               "        !r c=(0..(1e9 if i%30==29 else 1))[0]\n",
               1);
    assert_text("faults", text_c(&runner->reported),
                "5:14 octnoise: too many octaves: the limit is 1024 [bad-call]\n"
                "4:14 octnoise: too many octaves: the limit is 1024 [bad-call]\n"
                "7:15 range too long: the limit is 134217728 elements [too-long]\n");
    assert_true(runner->vm.batched_iterations > 0 && runner->vm.batched_iterations < 450);
}

// A batch is charged about as much work as iteration-by-iteration execution.
static void test_work_matches(void **state) {
    Runner *runner = *state;
    Budget budget = {.memory_limit = SIZE_MAX};
    uint64_t work[2];
    for (int i = 0; i < 2; i++) {
        uint64_t iterations;
        runner->frame.budget = NULL;
        budget_begin(&budget, UINT64_MAX / 2, NULL);
        runner->frame.budget = &budget;
        run_loop(runner, "!p a=sin(i+z) b=hsv(i;z;1) c=i**3", i, &iterations);
        runner->frame.budget = NULL;
        work[i] = budget.work;
    }
    assert_in_range(work[0], work[1] * 3 / 4, work[1] * 5 / 4);
}

TEST_GROUP(vm_batch) {
    const struct CMUnitTest tests[] = {RUNNER_TEST(test_batches_match_single_iterations),
                                       RUNNER_TEST(test_stream_items_match), RUNNER_TEST(test_errors_keep_their_order),
                                       RUNNER_TEST(test_work_matches)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
