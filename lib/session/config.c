// config.c: a session's configuration as one shared thing (petri.h).
#include "session/session.h"

#include "base/heap.h"

void session_change_config(PetriSession *session, bool frame_stays) {
    petri_config_free(session->shared);
    session->shared = NULL;
    session->config_number = ++session->last_number;
    if (!frame_stays)
        session->frame.evaluated = false;
}

uint64_t petri_config_number(const PetriSession *session) {
    return session ? session->config_number : 0;
}

void session_set_prompts(PetriSession *session, PromptList *list) {
    prompt_list_free(session->config.prompts);
    session->config.prompts = list;
}

static void refer(const Config *config) {
    config->prompts->references++;
    if (config->program)
        config->program->references++;
}

PetriConfig *petri_config(PetriSession *session) {
    if (!session)
        return NULL;
    PetriConfig *shared = session->shared;
    if (!shared) {
        shared = session->shared = heap_take(sizeof *shared);
        if (!shared)
            return NULL;
        *shared = (PetriConfig){1, session->config_number, session->config, session->clock.rates};
        refer(&shared->config);
    }
    shared->references++;
    return shared;
}

void petri_config_free(PetriConfig *shared) {
    if (!shared || --shared->references > 0)
        return;
    prompt_list_free(shared->config.prompts);
    unit_free(shared->config.program);
    heap_give(shared);
}

void petri_config_use(PetriSession *session, PetriConfig *shared) {
    if (!session || !shared || shared->number == session->config_number)
        return;
    session_clear_frame(session);
    const Unit *program = shared->config.program;
    Str folder = program ? program->folder : (Str){0};
    if (!str_equal(session->reach.own, folder))
        session_forget_files(session);
    session->reach.own = folder;
    session->reach.directory = program ? program->source->directory : (Str){0};
    refer(&shared->config);
    prompt_list_free(session->config.prompts);
    unit_free(session->config.program);
    session->config = shared->config;
    session_put(session, session->config.program);
    session->told_defines = shared->config.define_count;
    clock_set_rates(&session->clock, &shared->rates);
    shared->references++;
    petri_config_free(session->shared);
    session->shared = shared;
    session->config_number = shared->number;
}
