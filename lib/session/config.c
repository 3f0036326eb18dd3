// config.c: configurations of a session as shared, reference-counted objects (petri_config_get).
#include "base/heap.h"
#include "session/session.h"

void session_change_config(PetriSession *session, bool frame_valid) {
    petri_config_free(session->shared_config);
    session->shared_config = NULL;
    session->config_revision = ++session->last_revision;
    if (!frame_valid)
        session->frame.evaluated = false;
}

uint64_t petri_config_revision(const PetriSession *session) {
    return session ? session->config_revision : 0;
}

void session_set_prompts(PetriSession *session, PromptList *list) {
    prompt_list_free(session->config.prompts);
    session->config.prompts = list;
}

static void add_references(const Config *config) {
    config->prompts->references++;
    if (config->program)
        config->program->references++;
}

PetriConfig *petri_config_get(PetriSession *session) {
    if (!session)
        return NULL;
    PetriConfig *shared = session->shared_config;
    if (!shared) {
        shared = session->shared_config = heap_alloc(sizeof *shared);
        if (!shared)
            return NULL;
        *shared = (PetriConfig){1, session->config_revision, session->config, session->clock.rates};
        add_references(&shared->config);
    }
    shared->references++;
    return shared;
}

void petri_config_free(PetriConfig *shared) {
    if (!shared || --shared->references > 0)
        return;
    prompt_list_free(shared->config.prompts);
    unit_free(shared->config.program);
    heap_free(shared);
}

void petri_config_apply(PetriSession *session, PetriConfig *shared) {
    if (!session || !shared || shared->revision == session->config_revision)
        return;
    session_clear_frame(session);
    const Unit *program = shared->config.program;
    Str folder = program ? program->folder : (Str){0};
    if (!str_equal(session->reach.script_folder, folder))
        session_clear_files(session);
    session->reach.script_folder = folder;
    session->reach.directory = program ? program->source->directory : (Str){0};
    add_references(&shared->config);
    prompt_list_free(session->config.prompts);
    unit_free(session->config.program);
    session->config = shared->config;
    session_use_unit(session, session->config.program);
    session->reported_defines = shared->config.define_count;
    clock_set_rates(&session->clock, &shared->rates);
    shared->references++;
    petri_config_free(session->shared_config);
    session->shared_config = shared;
    session->config_revision = shared->revision;
}
