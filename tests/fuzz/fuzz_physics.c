// fuzz_physics.c: fuzzes systems that change from frame to frame: dimensions (1 to 40), numbers of particles, groups,
// attributes and kinds of forces. Each frame is described by FRAME_SIZE bytes of the input. Two sessions, with
// neighbour lists and without, must have equal states after each frame.
#include "fuzz.h"
#include "petri-inspect.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAME_SIZE = 6, MAX_FRAMES = 8, MAX_DIMENSIONS = 40 };

static const char SCRIPT[] =
    "let D=DS[frame] N=NS[frame] G=GS[frame] F=FS[frame] K=KS[frame] A=AS[frame]\n"
    "let strength=(20 if A//4%2 else 0.5) far=(2 if A//8%2 else null)\n"
    "func numbers(name, i)\n"
    "    uniform(name;i)[..D]\n"
    "!physics state=:s dimensions=D time=frame/50 resolution=(0.01 if A//16%2 else 0.05)\n"
    "    for i in ..N\n"
    "        let force=(numbers(:f, i) if A//32%2 else null) radius=(0.5 if A%2 else uniform(:r;i))\n"
    "        !particle id=i position=9*numbers(:p, i) velocity=numbers(:v, i) radius=radius "
    "charge=A//2%2 force=force ease=A//64%2\n"
    "    !anchor id=:a position=4\n"
    "    if G > 0\n"
    "        !group\n"
    "            for i in ..G\n"
    "                !particle id=:g;i position=9*numbers(:q, i) radius=0.5\n"
    "            if A//128%2\n"
    "                !collision strength=9\n"
    "    if F%2\n"
    "        !collision strength=strength max_distance=far\n"
    "    if F//2%2\n"
    "        !adhesion max_distance=far\n"
    "    if F//4%2\n"
    "        !gravity strength=strength max_distance=far theta=(0.5 if K//128%2 else null)\n"
    "    if F//8%2\n"
    "        !electrostatic max_distance=far\n"
    "    if F//16%2\n"
    "        !distance from=0 to=3 fixed=1\n"
    "    if F//32%2\n"
    "        !random strength=strength\n"
    "    if F//64%2\n"
    "        !drag strength=strength\n"
    "    if F//128%2\n"
    "        !constant acceleration=-strength\n"
    "    if K%2\n"
    "        !barrier normal=1 position=1 restitution=0.5\n"
    "    if K//2%2\n"
    "        !barrier normal=-1 position=8 minimum=2\n"
    "    if K//4%2\n"
    "        !field direction=strength\n"
    "    if K//8%2\n"
    "        !buoyancy gravity=-1\n"
    "    for j in ..K//16%8\n"
    "        !collision strength=j\n";

// Adds `let NAME=` and the values of one byte of each frame.
static void add_list(FuzzText *script, const char *name, const uint8_t *data, size_t frames, int (*value)(int)) {
    char text[32];
    fuzz_append(script, "let ", 4);
    fuzz_append(script, name, strlen(name));
    for (size_t i = 0; i < frames; i++) {
        int length = snprintf(text, sizeof text, "%c%d", i ? ';' : '=', value(data[i * FRAME_SIZE]));
        fuzz_append(script, text, (size_t)length);
    }
    fuzz_append(script, "\n", 1);
}

static int dimensions_of(int byte) {
    return byte < 224 ? byte % 4 + 1 : byte % MAX_DIMENSIONS + 1;
}

// Few inputs have many particles, so that there are many inputs; small systems reach the same lines, because one of the
// two sessions uses neighbour lists always. 170 particles are more than one block of columns.
static int count_of(int byte) {
    return byte < 248 ? byte % 24 : 170;
}

static int group_count_of(int byte) {
    return byte < 128 ? 0 : byte % 16;
}

static int itself(int byte) {
    return byte;
}

static void compare(PetriSession *first, PetriSession *second) {
    uint8_t a[16], b[16];
    if (petri_digest(first, a) == PETRI_OK && petri_digest(second, b) == PETRI_OK && memcmp(a, b, sizeof a) != 0)
        fuzz_fail("neighbour lists change the state");
}

FUZZ_HARNESS(physics) {
    size_t frames = size / FRAME_SIZE < MAX_FRAMES ? size / FRAME_SIZE : MAX_FRAMES;
    if (!frames)
        return 0;
    FuzzText script = {0};
    add_list(&script, "DS", data, frames, dimensions_of);
    add_list(&script, "NS", data + 1, frames, count_of);
    add_list(&script, "GS", data + 2, frames, group_count_of);
    add_list(&script, "FS", data + 3, frames, itself);
    add_list(&script, "KS", data + 4, frames, itself);
    add_list(&script, "AS", data + 5, frames, itself);
    fuzz_append(&script, SCRIPT, strlen(SCRIPT));
    PetriOptions options = fuzz_options();
    PetriTuning tuning = {.size = sizeof tuning, .neighbours = PETRI_NEIGHBOURS_NEVER};
    options.tuning = &tuning;
    PetriSession *plain = petri_open(&options);
    tuning.neighbours = PETRI_NEIGHBOURS_ALWAYS;
    PetriSession *listed = fuzz_open(&options);
    if (!plain)
        fuzz_fail("cannot open a session");
    fuzz_load(plain, script.bytes);
    fuzz_load(listed, script.bytes);
    for (size_t i = 0; i < frames && petri_step(listed) == PETRI_OK && petri_step(plain) == PETRI_OK; i++) {
        fuzz_check_frame(listed);
        compare(plain, listed);
    }
    petri_close(&plain);
    fuzz_close(&listed);
    free(script.bytes);
    return 0;
}
