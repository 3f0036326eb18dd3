// fuzz_simplify.c: fuzzes the simplifier. The input is a script, whose frames must be the same with and without the
// simplifier. The run without it also has profiling, which executes loop iterations one by one instead of in batches.
#include "fuzz.h"
#include "petri-inspect.h"

#include <stdlib.h>
#include <string.h>

typedef struct Run {
    FuzzText frames;
    PetriStatus loaded;
    // True if a limit was exceeded. With the simplifier, the limit may not be reached. Also true if recursion reached
    // the stack limit, because the depth at that point varies between the runs.
    bool aborted;
} Run;

static bool stack_limit_reached(PetriSession *session) {
    PetriDiagnostic diagnostic;
    bool reached = false;
    for (size_t i = 0; petri_diagnostic(session, i, &diagnostic, sizeof diagnostic); i++)
        reached |=
            diagnostic.code && strcmp(diagnostic.code, "recursion-depth") == 0 && !strstr(diagnostic.text, "limit of");
    return reached;
}

static Run run_script(const uint8_t *data, size_t size, bool simplify) {
    Run run = {0};
    PetriOptions options = fuzz_options();
    options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .no_simplify = !simplify};
    options.profile = !simplify;
    PetriSession *session = fuzz_open(&options);
    run.loaded = petri_load_text(session, "fuzz.fl", (const char *)data, size);
    for (int i = 0; i < 3 && run.loaded == PETRI_OK && !run.aborted; i++)
        run.aborted = petri_step(session) != PETRI_OK ||
                      petri_print(session, PETRI_PRINT_TREE | PETRI_PRINT_STATE, fuzz_append, &run.frames) != PETRI_OK;
    run.aborted |= fuzz_end_watch() || stack_limit_reached(session);
    fuzz_close(&session);
    return run;
}

FUZZ_HARNESS(simplify) {
    Run plain = run_script(data, size, false), simplified = run_script(data, size, true);
    bool same = plain.loaded == simplified.loaded && fuzz_texts_equal(&plain.frames, &simplified.frames);
    if (!same && !plain.aborted && !simplified.aborted)
        fuzz_fail("--- without the simplifier\n%.3000s\n--- with it\n%.3000s",
                  plain.frames.bytes ? plain.frames.bytes : "", simplified.frames.bytes ? simplified.frames.bytes : "");
    free(plain.frames.bytes);
    free(simplified.frames.bytes);
    return 0;
}
