// window_option.c: see window_option.h.
#include "render/window_option.h"

#include <limits.h>
#include <stdlib.h>

int window_option(PetriSession *session, const char *wanted, int otherwise) {
    if (!wanted)
        return otherwise;
    char *end;
    int found = petri_find_window(session, wanted);
    long number = strtol(wanted, &end, 10);
    bool is_number = *end == '\0' && end > wanted && number >= 0 && number < INT_MAX;
    return found >= 0 ? found : is_number ? (int)number : INT_MAX;
}
