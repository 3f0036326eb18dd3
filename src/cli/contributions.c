// contributions.c: names and values of the forces that act on a particle, as text.
#include "cli/contributions.h"

#include "petri-inspect.h"

void contribution_add_name(PetriSession *session, size_t system, uint32_t force, Text *text) {
    PetriForce found;
    if (force == PETRI_OWN_FORCE)
        text_add_c(text, "own force");
    else if (petri_system_force(session, system, force, &found, sizeof found))
        text_add_c(text, found.kind);
}

void contribution_add_position(PetriSession *session, size_t system, uint32_t force, Text *text) {
    PetriForce found;
    if (petri_system_force(session, system, force, &found, sizeof found) && found.file)
        text_add_format(text, "%s:%u", found.file, (unsigned)found.line);
    else
        text_add_c(text, "-");
}

void contribution_add_partner(PetriSession *session, size_t system, uint32_t partner, Text *text) {
    const char *id =
        partner == PETRI_NO_PARTICLE ? NULL : petri_format_value(session, petri_particle_id(session, system, partner));
    text_add_c(text, id ? id : "-");
}

void contribution_add_vector(PetriSession *session, const double *vector, uint32_t dimensions, Text *text) {
    const char *printed = petri_format_value(session, (PetriValue){.length = dimensions, .numbers = vector});
    text_add_c(text, printed ? printed : "");
}
