// setup.c: what a session computes with, as one shared thing (petri.h).
#include "session/session.h"

#include <stdlib.h>
#include <string.h>

void session_change_setup(PetriSession *session, bool frame_stays) {
    petri_setup_free(session->setup);
    session->setup = NULL;
    session->setup_number = ++session->last_number;
    if (!frame_stays)
        session->evaluated = false;
}

uint64_t petri_setup_number(const PetriSession *session) {
    return session->setup_number;
}

static Prompt *share_prompts(const Prompt *prompts, uint32_t count) {
    Prompt *shared = malloc((count + 1) * sizeof *shared); // one more: no size of 0
    for (uint32_t i = 0; shared && i < count; i++) {
        shared[i] = prompts[i];
        shared[i].unit->references++;
    }
    return shared;
}

static void free_prompts(Prompt *prompts, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        unit_free(prompts[i].unit);
    free(prompts);
}

PetriSetup *session_setup(PetriSession *session) {
    if (session->setup)
        return session->setup;
    PetriSetup *setup = malloc(sizeof *setup);
    Prompt *prompts = setup ? share_prompts(session->prompts, session->prompt_count) : NULL;
    if (!prompts) {
        free(setup);
        return NULL;
    }
    *setup = (PetriSetup){.references = 1,
                          .number = session->setup_number,
                          .program = session->program,
                          .prompts = prompts,
                          .prompt_count = session->prompt_count,
                          .defines = session->defines,
                          .define_count = session->define_count,
                          .said = session->said,
                          .rates = {session->frame.fps, session->frame.tempo, session->quantum},
                          .resolution = session->resolution};
    if (setup->program)
        setup->program->references++;
    return session->setup = setup;
}

PetriSetup *petri_setup(PetriSession *session) {
    PetriSetup *setup = session_setup(session);
    if (setup)
        setup->references++;
    return setup;
}

void petri_setup_free(PetriSetup *setup) {
    if (!setup || --setup->references > 0)
        return;
    free_prompts(setup->prompts, setup->prompt_count);
    unit_free(setup->program);
    free(setup);
}

void petri_setup_use(PetriSession *session, PetriSetup *setup) {
    if (setup->number == session->setup_number)
        return;
    Prompt *prompts = share_prompts(setup->prompts, setup->prompt_count);
    if (!prompts)
        return;
    session_clear_frame(session);
    free_prompts(session->prompts, session->prompt_count);
    session->prompts = prompts;
    session->prompt_count = setup->prompt_count;
    if (setup->program)
        setup->program->references++;
    unit_free(session->program);
    session->program = session_put(session, setup->program);
    session->defines = setup->defines;
    session->define_count = session->told_defines = setup->define_count;
    session->said = setup->said;
    session_set_rates(session, &setup->rates);
    session->resolution = setup->resolution;
    session_collect_names(session);
    setup->references++;
    petri_setup_free(session->setup);
    session->setup = setup;
    session->setup_number = setup->number;
}
