// state_file.c: see state_file.h.
#include "cli/state_file.h"

#include <stddef.h>

#include "cli/cli.h"
#include "cli/progress.h"

enum { SECONDS_BETWEEN = 5 };

bool state_file_restore(StateFile *file, PetriSession *session, const char *name) {
    file->name = name;
    PetriStatus status = name == NULL ? PETRI_OK : petri_restore(session, name);
    file->unread = status != PETRI_OK;
    file->saved = clock_seconds();
    if (file->unread) {
        message("%sit starts afresh; '%s' is left alone and nothing is saved",
                status == PETRI_MEMORY ? "out of memory: " : "", name);
    }
    return !file->unread;
}

const char *state_file_save(StateFile *file, PetriSession *session, bool at_once) {
    if (file->name == NULL || file->unread || (!at_once && clock_seconds() - file->saved <= SECONDS_BETWEEN)) {
        return NULL;
    }
    bool before = file->behind;
    if (file->before != NULL && !file->before(file->context)) { // which has told why
        file->behind = true;
        return NULL;
    }
    PetriStatus status = petri_save(session, file->name);
    file->behind = status != PETRI_OK;
    file->saved = clock_seconds();
    if (file->behind == before) {
        return NULL;
    }
    return !file->behind            ? "the state is saved again"
           : status == PETRI_MEMORY ? "out of memory: the state is not saved; it is tried again every few seconds"
                                    : "the state is not saved; it is tried again every few seconds";
}
