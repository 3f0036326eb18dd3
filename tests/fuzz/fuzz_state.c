// fuzz_state.c: fuzzes state files. A line with the checksum is added to the input unless it begins with '#'. If a
// state is accepted, saving and restoring it must not change it, and the next frames must be the same.
#include "fuzz.h"
#include "petri-inspect.h"

#include <stdlib.h>

static const char SCRIPT[] = "!physics state=:c dimensions=2 time=beat\n"
                             "    !anchor id=:m\n"
                             "    for i in ..4\n"
                             "        !particle id=i position=i;0 radius=1\n"
                             "    !collision\n"
                             "    !random strength=1\n"
                             "!physics state=:d;1 dimensions=3\n"
                             "    !particle id='x'\n"
                             "!s a=$:a b=$(:a;1) c=$'x' counter=$:n\n"
                             "!counter state=:n rate=1\n";

static void check_round_trip(PetriSession *first) {
    FuzzText one = {0}, two = {0};
    bool good = true;
    PetriOptions options = fuzz_options();
    PetriSession *second = petri_open(&options);
    fuzz_load(second, SCRIPT);
    if (petri_save(first, fuzz_file("saved")) != PETRI_OK || petri_restore(second, fuzz_file("saved")) != PETRI_OK)
        fuzz_fail("cannot restore a saved state");
    for (int i = 0; i < 2 && good; i++) {
        good = petri_step(first) == PETRI_OK && petri_step(second) == PETRI_OK;
        petri_print(first, PETRI_PRINT_STATE, fuzz_append, &one);
        petri_print(second, PETRI_PRINT_STATE, fuzz_append, &two);
    }
    fuzz_check_state(first);
    if (good && !fuzz_end_watch() && !fuzz_texts_equal(&one, &two))
        fuzz_fail("--- restored\n%.3000s\n--- saved and restored\n%.3000s", one.bytes, two.bytes);
    free(one.bytes);
    free(two.bytes);
    petri_close(&second);
}

FUZZ_HARNESS(state) {
    if (size == 0)
        return 0;
    (data[0] == '#' ? fuzz_put : fuzz_put_state)("state", data + 1, size - 1);
    PetriSession *session = fuzz_open(NULL);
    fuzz_load(session, SCRIPT);
    if (petri_restore(session, fuzz_file("state")) == PETRI_OK) {
        fuzz_check_state(session);
        check_round_trip(session);
    }
    fuzz_close(&session);
    return 0;
}
