// fuzz_fmt.c: fuzzes `petri fmt`. The input is a script. Formatting must keep its meaning, and formatting the result
// again must not change it.
#include "fmt/layout.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    SCOPED_TEXT text = {0}, once = {0}, twice = {0};
    PetriSession *session = fuzz_open(NULL);
    text_add(&text, (Str){(const char *)data, size});
    Str script = layout_normalise(&text);
    if (petri_load_text(session, "fuzz.fl", script.bytes, script.len) == PETRI_OK &&
        layout_text(session, script, &once)) {
        Str formatted = {once.bytes, once.len};
        if (!layout_same(session, "fuzz.fl", script, formatted))
            fuzz_fail("formatting changes the meaning:\n%.*s", (int)formatted.len, formatted.bytes);
        if (!layout_text(session, formatted, &twice) || !str_equal(formatted, text_str(&twice)))
            fuzz_fail("formatting is not idempotent:\n%.*s", (int)formatted.len, formatted.bytes);
    }
    fuzz_close(&session);
    return 0;
}
