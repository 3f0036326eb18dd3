// fuzz_fmt.c: fuzzes `petri fmt`. The input is a script. Formatting must keep its meaning, and formatting the result
// again must not change it.
#include "fmt/layout.h"
#include "fuzz.h"

FUZZ_HARNESS(fmt) {
    SCOPED_TEXT text = {0}, once = {0}, twice = {0};
    PetriSession *session = fuzz_open(NULL);
    text_add(&text, (Str){(const char *)data, size});
    Str script = layout_normalise(&text);
    if (petri_load_text(session, "fuzz.fl", script.bytes, script.len) == PETRI_OK &&
        layout_text(session, script, &once)) {
        Str formatted = {once.bytes, once.len};
        bool same = layout_same(session, "fuzz.fl", script, formatted);
        bool repeats = layout_text(session, formatted, &twice) && str_equal(formatted, text_str(&twice));
        if (!(same && repeats) && !fuzz_end_watch())
            fuzz_fail("formatting %s:\n%.*s", same ? "is not idempotent" : "changes the meaning", (int)formatted.len,
                      formatted.bytes);
    }
    fuzz_close(&session);
    return 0;
}
