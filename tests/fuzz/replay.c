// replay.c: runs a harness once for each file on the command line, for builds without libFuzzer.
#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    for (int i = 1; i < argc; i++) {
        FuzzText text = {0};
        char block[4096];
        size_t length;
        FILE *file = fopen(argv[i], "rb");
        if (!file)
            fuzz_fail("cannot read %s", argv[i]);
        fuzz_append(&text, "", 0);
        while ((length = fread(block, 1, sizeof block, file)) > 0)
            fuzz_append(&text, block, length);
        fclose(file);
        fprintf(stderr, "%s\n", argv[i]);
        LLVMFuzzerTestOneInput((const uint8_t *)text.bytes, text.length);
        free(text.bytes);
    }
    return 0;
}
