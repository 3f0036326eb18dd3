// test_scene_warm.c: tests that a frame allocates nothing from the heap if it is similar to the previous frames.
#include "player.h"

static int allocations;

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_malloc(size_t size) {
    allocations++;
    return __real_malloc(size);
}

void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size) {
    allocations++;
    return __real_calloc(count, size);
}

void *__real_realloc(void *bytes, size_t size);
void *__wrap_realloc(void *bytes, size_t size);
void *__wrap_realloc(void *bytes, size_t size) {
    allocations++;
    return __real_realloc(bytes, size);
}

#define SYSTEM "!physics state=:s dimensions=2\n"
#define LINE "!physics state=:s dimensions=1\n"
#define FORCES "    !collision strength=9\n    !random strength=2\n    !drag strength=0.1\n"

static void test_similar_frames_allocate_nothing(void **state) {
    static const char *const worlds[] = {
        // constant trees, trees with changing numbers, and trees with particles in changing order
        SYSTEM "    !anchor id=:a\n    for i in ..300\n        !particle id=i position=i;i%7 radius=0.5\n"
               "        !distance from=i to=:a max=9\n" FORCES,
        SYSTEM "    !anchor id=:a position=frame;0\n    for i in ..300\n        !particle id=i position=i;i%7 "
               "radius=0.5+frame/1e3\n        !distance from=i to=:a max=9+frame\n" FORCES,
        SYSTEM "    for i in ..300\n        !particle id=(i+frame)%300 position=i;i%7 radius=0.5\n" FORCES,
        LINE "    for i in ..300\n        !particle id=i position=i\n" FORCES,
    };
    Player *player = *state;
    for (size_t i = 0; i < COUNT_OF(worlds); i++) {
        PetriOptions options = player_options(player);
        options.threads = 2;
        player_reopen(player, &options);
        player_run(player, worlds[i], 20);
        int before = allocations;
        player_step(player, 20);
        assert_true(before > 0);
        assert_number(worlds[i], allocations - before, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_similar_frames_allocate_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
