// test_session_allocations.c: tests that a frame allocates nothing if it is similar to the previous frames, because all
// memory is reused. Wraps glibc's allocator to count calls. Skipped with other C libraries and with sanitizers.
#include "player.h"
#include "session/session.h"

extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *bytes, size_t size);

static _Atomic size_t allocations;

static void note_call(void) {
    allocations++;
}

void *malloc(size_t size) {
    note_call();
    return __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
    note_call();
    return __libc_calloc(count, size);
}

void *realloc(void *bytes, size_t size) {
    note_call();
    return __libc_realloc(bytes, size);
}

typedef struct Row {
    const char *what;
    const char *script;
} Row;

static const Row rows[] = {
    {"a dish", "let N=200\n!physics state=:dish dimensions=2 time=beat resolution=tempo/60/fps\n"
               "    !anchor id=:hub position=0;0\n    for i in ..N\n"
               "        !particle id=i radius=12 charge=normal(:charge)[i] position=200*polar(i/N)\n"
               "        !distance from=i to=:hub max=240 strength=500\n"
               "    !electrostatic strength=150\n    !collision strength=5\n    !drag strength=0.002\n"
               "    !random strength=8\n"},
    {"a script with a lot to do",
     "let N=500\n    PHASE=($(:swarm;:clock) or 0)/7\n    HOMES=(uniform(:home)[..3*N]-0.5)*600\n"
     "let sizes=8+20*(1+noise(:size, i/9, PHASE*3))/2 for i in ..N\n"
     "    glows=0.5+0.5*noise(:glow, i/5, PHASE*5) for i in ..N\n"
     "!physics state=:swarm dimensions=3 time=beat resolution=tempo/60/fps\n"
     "    !anchor id=:core position=50*polar(PHASE/3);0\n    for i in ..N\n        let r=sizes[i]\n"
     "        !particle id=i position=HOMES[i*3..i*3+3] radius=r mass=r**3/1000\n"
     "        !distance from=i to=:core fixed=300-r strength=50\n    !drag strength=0.0005\n    !random strength=20\n"
     "!window size=1080;1080\n    !canvas3d\n        for i in ..N\n            let place=$(:swarm;i)\n"
     "                pace=hypot($(:swarm;i;:velocity))\n"
     "            !sphere position=place size=sizes[i] color=hsv(i/N;clamp(pace/200, 0, 1);glows[i])\n"},
    {"calls, texts and branches",
     "func fade(x, level=0.5)\n    x*level+frame if x<3 else null\n"
     "let names='a';'b';'c'\nfor i in ..20\n    !item #t text='n';i fade=fade(i);fade(i, level=2) name=names[i]\n"
     "        !inner x=$(:nothing;i) y=split('1,2,3', ',') z=(sort(names))\n!counter state=:c rate=2\n"},
};

// Reads all data of the systems, as a host might.
static void look_up_everything(PetriSession *session) {
    PetriSystem system;
    PetriValue key, value = {0};
    for (uint32_t at = 0; petri_state_next(session, &at, &key, &value);) {
        assert_ptr_equal(petri_state_get(session, key).numbers, value.numbers); // the numbers are not copied
        assert_int_equal(petri_state_set(session, key, value), PETRI_OK);
    }
    assert_int_equal(petri_set_global(session, "given", value), PETRI_OK);
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); s++) {
        uint32_t found = 0;
        petri_particle_ids(session, s);
        for (uint32_t i = 0; i < system.particle_count; i++) {
            assert_true(petri_find_particle(session, s, petri_particle_id(session, s, i), &found));
            assert_int_equal(found, i);
        }
    }
}

// In these scripts the systems do not change, so all buffers reach their final size in the first frames.
static void test_similar_frames_allocate_nothing(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.threads = 2;
    for (int simplify = 1; simplify >= 0; simplify--)
        for (size_t i = 0; i < COUNT_OF(rows); i++) {
            options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .no_simplify = !simplify};
            player_reopen(player, &options);
            player_run(player, rows[i].script, 5);
            look_up_everything(player->session);
            look_up_everything(player->session); // again, because a global name alternates between two buffers
            size_t before = allocations;
            assert_true(before > 0); // otherwise, calls are not counted
            for (int frame = 0; frame < 20; frame++) {
                petri_step(player->session);
                look_up_everything(player->session);
            }
            assert_number(rows[i].what, (double)(allocations - before), 0);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {PLAYER_TEST(test_similar_frames_allocate_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
