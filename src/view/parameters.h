// parameters.h: keys that choose a parameter of the script and change it while the world goes on.
#ifndef PETRI_SRC_VIEW_PARAMETERS_H
#define PETRI_SRC_VIEW_PARAMETERS_H

#include "cli/byte_buffer.h"
#include "petri.h"
#include "view/live_script.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct ParameterKeys {
    size_t chosen;
    bool used; // one of the keys was pressed: which parameter is chosen has been seen
} ParameterKeys;

typedef enum ParameterResult {
    PARAMETER_NOT_A_KEY, // no key for parameters
    PARAMETER_MESSAGE,   // something is to be told
    PARAMETER_CHANGED    // … and the script has another value
} ParameterResult;

// Does what a key means. `text` gets what is to be told about it.
ParameterResult parameter_key(ParameterKeys *keys, LiveScript *live, const char *key, ByteBuffer *text);
// Whether a key that is held means the same again and again.
bool parameter_key_repeats(const char *key);
// Adds lines about the chosen parameter and the keys, if the script has parameters.
void parameter_status(const ParameterKeys *keys, LiveScript *live, ByteBuffer *text);

#endif
