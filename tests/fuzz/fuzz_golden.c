// fuzz_golden.c: the input is a golden and, behind a byte 30, what it is compared with.
#include "cli/cli.h"
#include "fuzz.h"
#include "golden/golden.h"

#include <string.h>

// What help would list, which no golden asks for.
const Command *const COMMANDS[] = {&RUN_COMMAND, NULL};

const Command *command_find(const char *name) {
    (void)name;
    return NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const uint8_t *part = memchr(data, 30, size);
    size_t length = part ? (size_t)(part - data) : size;
    Golden golden;
    ByteBuffer trouble = {0}, output = {0};
    fuzz_put("fuzz.golden", data, length);
    byte_buffer_add(&output, part ? (const char *)part + 1 : "", part ? size - length - 1 : 0);
    if (golden_read(&golden, fuzz_file("fuzz.golden"), &trouble))
        golden_compare(&golden, &output, &trouble);
    golden_free(&golden);
    byte_buffer_free(&trouble);
    byte_buffer_free(&output);
    return 0;
}
