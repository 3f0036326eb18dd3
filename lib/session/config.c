// config.c: a session's configuration as one shared thing (petri.h).
#include "session/session.h"

#include <stdlib.h>
#include <string.h>

void session_change_config(PetriSession *session, bool frame_stays) {
    petri_config_free(session->config);
    session->config = NULL;
    session->config_number = ++session->last_number;
    if (!frame_stays)
        session->evaluated = false;
}

uint64_t petri_config_number(const PetriSession *session) {
    return session->config_number;
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

PetriConfig *session_config(PetriSession *session) {
    if (session->config)
        return session->config;
    PetriConfig *config = malloc(sizeof *config);
    Prompt *prompts = config ? share_prompts(session->prompts, session->prompt_count) : NULL;
    if (!prompts) {
        free(config);
        return NULL;
    }
    *config = (PetriConfig){.references = 1,
                            .number = session->config_number,
                            .program = session->program,
                            .prompts = prompts,
                            .prompt_count = session->prompt_count,
                            .defines = session->defines,
                            .define_count = session->define_count,
                            .said = session->said,
                            .rates = {session->frame.fps, session->frame.tempo, session->quantum},
                            .resolution = session->resolution};
    if (config->program)
        config->program->references++;
    return session->config = config;
}

PetriConfig *petri_config(PetriSession *session) {
    PetriConfig *config = session_config(session);
    if (config)
        config->references++;
    return config;
}

void petri_config_free(PetriConfig *config) {
    if (!config || --config->references > 0)
        return;
    free_prompts(config->prompts, config->prompt_count);
    unit_free(config->program);
    free(config);
}

void petri_config_use(PetriSession *session, PetriConfig *config) {
    if (config->number == session->config_number)
        return;
    Prompt *prompts = share_prompts(config->prompts, config->prompt_count);
    if (!prompts)
        return;
    session_clear_frame(session);
    free_prompts(session->prompts, session->prompt_count);
    session->prompts = prompts;
    session->prompt_count = config->prompt_count;
    if (config->program)
        config->program->references++;
    unit_free(session->program);
    session->program = session_put(session, config->program);
    session->defines = config->defines;
    session->define_count = session->told_defines = config->define_count;
    session->said = config->said;
    session_set_rates(session, &config->rates);
    session->resolution = config->resolution;
    session_collect_names(session);
    config->references++;
    petri_config_free(session->config);
    session->config = config;
    session->config_number = config->number;
}
