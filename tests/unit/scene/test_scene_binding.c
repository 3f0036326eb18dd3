// test_scene_binding.c: tests that data which systems keep between frames never changes results.
//
// Each script runs three times: as usual; without the simplifier, so that no node is constant; and with a save and
// restore between frames, so that every frame is read from scratch. The printed states must be equal in each frame.
#include "folder.h"
#include "petri-inspect.h"
#include "player.h"

enum { FRAMES = 9 };

#define WORLD(n) "!physics state=:s dimensions=" #n " time=frame/8 resolution=0.0625\n"
#define TWO                                                                                                            \
    WORLD(2)                                                                                                           \
    "    for i in ..5\n        !particle id=i position=i;i*i/4 velocity=normal(:v;i)[..2] radius=0.5\n"

static const char *const worlds[] = {
    // Constant trees in which only forces vary by frame.
    TWO "    !collision strength=9\n    !random strength=3\n    !drag strength=0.1\n    !random strength=0.5\n",
    WORLD(1) "    for i in ..4\n        !particle id=i position=i velocity=1-i\n    !random strength=2\n",
    WORLD(3) "    for i in ..6\n        !particle id=i position=i;1;2 mass=1+i\n    !gravity strength=4 ease=0.5\n",
    TWO "    !group\n        !particle id=:in;1 position=2;2\n        !random strength=4\n    !random strength=1\n",
    // Attributes or groups of some or all particles change.
    TWO "    !particle id=9 position=frame;2 radius=frame/10 charge=sin(frame/7)\n    !electrostatic strength=5\n",
    TWO "    !anchor id=9 position=frame;2 radius=frame/10\n    !distance from=9 to=2 max=frame/9\n",
    WORLD(2) "    for i in ..6\n        !particle id=i position=i;frame radius=frame%3 force=frame;i ease=0.4\n"
             "    for i in ..5\n        !distance from=i to=i+1 fixed=1+frame/10 strength=4\n",
    WORLD(2) "    for i in ..6\n        !particle id=:p;i position=i;frame\n    !drag\n    for i in ..(frame%4)\n"
             "        !distance from=:p;i to=:p;(i+frame)%6 max=1\n",
    WORLD(2) "    for i in ..3\n        !particle id='a';i position=i;frame\n    !random strength=frame\n",
    WORLD(
        2) "    !particle id=1 position=1;frame\n    (!group if frame%2 else !particle id=3)\n        !particle id=2\n"
           "    !group\n        !particle id=4 position=2;frame\n    !collision\n",
    WORLD(2) "    !group\n        !group\n            !particle id=1 mass=frame\n" // the nesting of groups also changes
             "    if frame%3\n        !group\n        !particle id=2\n    else\n        !group\n            !group\n"
             "    !random strength=5\n",
    // Particles appear and vanish, one by one or all at once. Their order changes. A particle becomes an anchor.
    WORLD(2) "    for i in ..(3+frame%3)\n        !particle id=i position=i;1 velocity=1;i\n    !random strength=5\n",
    WORLD(2) "    for i in ..(0 if frame%4==2 else 3)\n        !particle id=i position=i;frame velocity=1;i\n",
    WORLD(2) "    for i in (1;2;3 if frame%3 else 2;1;3)\n        !particle id=i position=i;1 velocity=1;i\n    "
             "!random\n",
    WORLD(2) "    for i in ..4\n        (!anchor if (i+frame)%3 else !particle) id=i position=i;frame mass=1+i\n"
             "    !gravity strength=3\n",
    WORLD(2) "    for i in ..3\n        !particle id=i velocity=1;i\n        if frame>3\n            !particle id=i\n",
    // Positions that are not finite initially, in some frames, or from some frame on.
    WORLD(2) "    !particle id=1 position=1/0;0 velocity=1;1\n    !particle id=2 velocity=1/0;0\n    !drag\n",
    WORLD(2) "    !particle id=1 position=frame;0 velocity=1/(frame>3);1\n    !particle id=2 velocity=0;1/0\n",
    WORLD(2) "    !particle id=1 velocity=1e308;1e308 position=1e308;0\n    !particle id=2 position=3;4\n    "
             "!collision\n",
    WORLD(1) "    !particle id=1 position=1/0\n    !particle id=2 position=1/(frame-4) velocity=1e308\n",
    // Positive and negative zeros.
    WORLD(2) "    !particle id=1 position=-0;0 velocity=0;-0\n    !anchor id=2 position=(-0 if frame%2 else 0);-0\n",
    WORLD(1) "    !particle id=1 position=-0 velocity=0\n    !anchor id=2 position=(-0 if frame%2 else 0)\n",
    // Other nodes write to the system's keys, or keys of particles equal keys of the system.
    TWO "!counter state=:s;2 initial=7;8 rate=0 reset=frame==4\n",
    TWO "!counter state=:s;2;:velocity initial=7;8 rate=1;2\n",
    TWO "if frame>=3\n    !counter state=:s;2 initial=7 rate=1\n",
    WORLD(1) "    !particle id=1 position=2 velocity=1\nif frame==4\n    !counter state=:s;1 initial=frame\n",
    WORLD(2) "    !particle id=1 velocity=1;2\n    !particle id=1;:velocity position=3;4 velocity=2;1\n",
    WORLD(2) "    !particle id=1;:velocity position=3;4 velocity=2;1\n    !particle id=1 velocity=1;2\n",
    WORLD(2) "    !particle id=:last velocity=1;2\n    !particle id=:clock position=3;4\n",
    TWO TWO "    !random strength=3\n",
    TWO WORLD(2) "    for i in ..5\n        !particle id=i position=3;frame\n    !random strength=3\n",
    TWO "!physics state=:s;2 dimensions=2 time=frame/8\n    !particle id=:velocity position=1;2\n    !random\n",
    // Changes of `run`, absent systems, skipped and paused frames, and changes of the dimensions.
    "!physics state=:s dimensions=2 run=frame//3\n    !particle id=1 position=frame;0 velocity=1;1\n    !random\n",
    "!physics state=:s dimensions=2 run=frame//3\n    for i in ..3\n        !particle id=i velocity=1;1\n    !random\n",
    "if frame%4!=2\n    !physics state=:s dimensions=2\n        for i in ..3\n            !particle id=i velocity=1;1\n"
    "        !random\n        if frame<2\n            !particle id=7 velocity=2;2\n",
    "!physics state=:s dimensions=2*(frame%4!=2)\n    for i in ..3\n        !particle id=i velocity=1;1\n    !random\n",
    "!physics state=:s dimensions=2 time=frame//2\n    for i in ..3\n        !particle id=i velocity=1;1\n    "
    "!random\n",
    "!physics state=:s dimensions=2 time=4-frame\n    for i in ..3\n        !particle id=i position=frame;1\n",
    "!physics state=:s dimensions=1+frame//3\n    for i in ..3\n        !particle id=i velocity=1\n    !random\n",
    "!physics state=:s dimensions=3-frame//3\n    !particle id=1 velocity=1;2\n    !anchor id=2 position=1;2\n    "
    "!random\n",
    // Many similar systems.
    "for k in ..4\n    !physics state=:s;k dimensions=2\n        for i in ..(2+k*frame%3)\n            !particle id=i\n"
    "        !distance from=0 to=1 fixed=2\n        !random\n",
};

// Returns the states of all frames.
static char *run_frames(Player *player, const char *world, bool simplify, Folder *folder) {
    Notebook book = {0};
    PetriOptions options = player_options(player);
    options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .no_simplify = !simplify};
    options.fps = 8;
    player_reopen(player, &options);
    for (int frame = 0; frame < FRAMES; frame++) {
        if (frame == 0 || folder)
            assert_int_equal(player_load(player, world), PETRI_OK);
        if (frame > 0 && folder)
            assert_int_equal(petri_restore(player->session, folder_file(folder, "state")), PETRI_OK);
        player_step(player, 1);
        assert_int_equal(petri_print(player->session, PETRI_PRINT_STATE, note, &book), PETRI_OK);
        if (folder)
            assert_int_equal(petri_save(player->session, folder_file(folder, "state")), PETRI_OK);
    }
    return book.text;
}

static void test_continued_systems_match_restored(void **state) {
    Player *player = *state;
    Folder folder;
    folder_open(&folder);
    for (size_t i = 0; i < COUNT_OF(worlds); i++) {
        char *from_scratch = run_frames(player, worlds[i], true, &folder),
             *kept = run_frames(player, worlds[i], true, NULL);
        char *not_kept = run_frames(player, worlds[i], false, NULL);
        assert_text(worlds[i], kept, from_scratch);
        assert_text(worlds[i], not_kept, from_scratch);
        assert_non_null(strstr(kept, "$"));
        free(from_scratch);
        free(kept);
        free(not_kept);
    }
    folder_close(&folder);
}

TEST_GROUP(scene_binding) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_continued_systems_match_restored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
