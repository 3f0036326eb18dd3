// particle.c: the particle that an operand names, by its id or by its key in the state.
#include "petri-inspect.h"
#include "prompt/prompt.h"

#include <inttypes.h>
#include <string.h>

bool particle_read(Prompt *prompt, const char *text, ParticleName *name) {
    PetriEvaluation result;
    *name = (ParticleName){.typed = text};
    prompt_busy(prompt);
    PetriStatus status =
        petri_evaluate(prompt->session, text, PETRI_NUL_TERMINATED, &result, sizeof result, text_collect, &name->value);
    prompt_idle(prompt);
    name->number = result.number;
    text_add_c(&name->value, "");
    if (!prompt_status(prompt, status))
        return false;
    prompt_complete_frame(prompt);
    return true;
}

// Returns true if the value is the particle's id, or its key in the state, such as `:cells;3`.
static bool is_named(Prompt *prompt, const char *value, size_t number, const PetriSystem *system, uint32_t particle) {
    const char *id = petri_format_value(prompt->session, petri_particle_id(prompt->session, number, particle));
    size_t prefix = strlen(system->name);
    if (!id || strcmp(id, value) == 0)
        return id;
    return strncmp(value, system->name, prefix) == 0 && value[prefix] == ';' && strcmp(value + prefix + 1, id) == 0;
}

bool particle_find(Prompt *prompt, const ParticleName *name, size_t number, const PetriSystem *system,
                   uint32_t *particle) {
    const PetriValue id = {.length = 1, .numbers = &name->number};
    if (petri_find_particle(prompt->session, number, id, particle))
        return true;
    for (*particle = 0; *particle < system->particle_count; ++*particle)
        if (is_named(prompt, name->value.bytes, number, system, *particle))
            return true;
    return false;
}

void particle_add_key(Prompt *prompt, size_t number, const PetriSystem *system, uint32_t particle, Text *key) {
    const char *id = petri_format_value(prompt->session, petri_particle_id(prompt->session, number, particle));
    text_add_format(key, "%s;%s", system->name, id ? id : "");
}

const char *particle_none(const Prompt *prompt) {
    return petri_frame_number(prompt->session) < 0 ? "no particles before the first frame; run .step"
                                                   : "no particle system was updated in this frame";
}

bool particle_unknown(Prompt *prompt, const ParticleName *name) {
    return prompt_fail(prompt, "no particle has this id: '%.40s'", name->typed);
}
