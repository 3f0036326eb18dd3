// fuzz_golden.c: fuzzes goldens. The input is a golden, then a byte 30, then the output that is compared with the
// golden.
#include "cli/cli.h"
#include "fuzz.h"
#include "golden/golden.h"

#include <string.h>

FUZZ_HARNESS(golden) {
    const uint8_t *part = memchr(data, 30, size);
    size_t length = part ? (size_t)(part - data) : size;
    Golden golden;
    Text error_text = {0}, output = {0};
    Result result = {0};
    fuzz_put("fuzz.golden", data, length);
    text_add(&output, (Str){part ? (const char *)part + 1 : "", part ? size - length - 1 : 0});
    if (golden_read(&golden, fuzz_file("fuzz.golden"), &error_text))
        golden_compare(&golden, &output, &result);
    golden_free(&golden);
    text_free(&error_text);
    text_free(&result.error_text);
    text_free(&result.details);
    text_free(&output);
    return 0;
}
