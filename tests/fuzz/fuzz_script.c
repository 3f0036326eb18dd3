// fuzz_script.c: fuzzes scripts. Runs three frames, prints everything, and dumps the syntax tree and the code. Inputs
// of odd length use neighbour lists also for a few particles.
#include "fuzz.h"
#include "petri-edit.h"
#include "petri-inspect.h"

FUZZ_HARNESS(script) {
    PetriOptions options = fuzz_options();
    options.tuning = &(PetriTuning){.size = sizeof(PetriTuning),
                                    .neighbours = size % 2 ? PETRI_NEIGHBOURS_ALWAYS : PETRI_NEIGHBOURS_AUTO};
    PetriSession *session = fuzz_open(&options);
    petri_define(session, "COUNT=7");
    if (petri_load_text(session, "fuzz.fl", (const char *)data, size) == PETRI_OK) {
        for (int i = 0; i < 3 && petri_step(session) == PETRI_OK; i++) {
            petri_print(session, PETRI_PRINT_TREE | PETRI_PRINT_STATE | PETRI_PRINT_LOG, fuzz_sink, NULL);
            fuzz_check_frame(session);
            fuzz_check_state(session);
        }
        petri_dump(session, PETRI_DUMP_AST, fuzz_sink, NULL);
        petri_dump(session, PETRI_DUMP_CODE, fuzz_sink, NULL);
        petri_check_text(session, "fuzz.fl", (const char *)data, size);
    }
    fuzz_close(&session);
    return 0;
}
