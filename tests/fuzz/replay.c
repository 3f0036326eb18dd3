// replay.c: runs a harness once for each file that is named, for builds without libFuzzer.
#include <stdio.h>
#include <stdlib.h>

#include "fuzz.h"

int main(int argc, char **argv) {
    for (int i = 1; i < argc; i++) {
        FuzzText text = {0};
        char block[4096];
        size_t length;
        FILE *file = fopen(argv[i], "rb");
        if (!file)
            fuzz_fail("cannot read %s", argv[i]);
        fuzz_keep(&text, "", 0);
        while ((length = fread(block, 1, sizeof block, file)) > 0)
            fuzz_keep(&text, block, length);
        fclose(file);
        fprintf(stderr, "%s\n", argv[i]);
        LLVMFuzzerTestOneInput((const uint8_t *)text.bytes, text.length);
        free(text.bytes);
    }
    return 0;
}
