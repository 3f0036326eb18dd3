// state_file.c: see state_file.h.
#include "cli/state_file.h"

#include "base/clock.h"
#include "cli/cli.h"

#include <stddef.h>

enum { SECONDS_BETWEEN = 5 };

bool state_file_restore(StateFile *file, PetriSession *session, const char *name) {
    file->name = name;
    PetriStatus status = !name ? PETRI_OK : petri_restore(session, name);
    file->unreadable = status != PETRI_OK;
    file->last_attempt = clock_seconds();
    if (file->unreadable) {
        message("%sstarting without the saved state; '%s' is not changed, and no state is saved",
                status == PETRI_OUT_OF_MEMORY ? "out of memory: " : "", name);
    }
    return !file->unreadable;
}

const char *state_file_save(StateFile *file, PetriSession *session, bool at_once) {
    if (!file->name || file->unreadable || (!at_once && clock_seconds() - file->last_attempt <= SECONDS_BETWEEN))
        return NULL;
    bool before = file->outdated;
    if (file->before && !file->before(file->context)) { // `before` has printed a message
        file->outdated = true;
        return NULL;
    }
    PetriStatus status = petri_save(session, file->name);
    file->outdated = status != PETRI_OK;
    file->last_attempt = clock_seconds();
    if (file->outdated == before)
        return NULL;
    return !file->outdated                 ? "saving the state works again"
           : status == PETRI_OUT_OF_MEMORY ? "out of memory: cannot save the state; retrying every few seconds"
                                           : "cannot save the state; retrying every few seconds";
}
