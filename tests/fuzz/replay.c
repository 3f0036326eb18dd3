// replay.c: runs a harness once for each file on the command line, for builds without libFuzzer. Exits with 77 if this
// program does not contain the harness. usage: PROGRAM HARNESS FILE... HARNESSES, which meson.build defines, lists the
// harnesses: HARNESS(NAME) HARNESS(NAME)...
#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef int RunInput(const uint8_t *data, size_t size);
enum { SKIPPED = 77 };

#define HARNESS(name) RunInput fuzz_##name;
HARNESSES
#undef HARNESS

static const struct {
    const char *name;
    RunInput *run;
} harnesses[] = {
#define HARNESS(name) {#name, fuzz_##name},
    HARNESSES
#undef HARNESS
};

static RunInput *find_harness(const char *name) {
    for (size_t i = 0; i < sizeof harnesses / sizeof harnesses[0]; i++)
        if (strcmp(harnesses[i].name, name) == 0)
            return harnesses[i].run;
    return NULL;
}

static void replay(RunInput *run, const char *path) {
    FuzzText text = {0};
    char block[4096];
    size_t length;
    FILE *file = fopen(path, "rb");
    if (!file)
        fuzz_fail("cannot read %s", path);
    fuzz_append(&text, "", 0);
    while ((length = fread(block, 1, sizeof block, file)) > 0)
        fuzz_append(&text, block, length);
    fclose(file);
    fprintf(stderr, "%s\n", path);
    run((const uint8_t *)text.bytes, text.length);
    free(text.bytes);
}

int main(int argc, char **argv) {
    RunInput *run = argc > 1 ? find_harness(argv[1]) : NULL;
    if (!run)
        return SKIPPED;
    for (int i = 2; i < argc; i++)
        replay(run, argv[i]);
    return 0;
}
