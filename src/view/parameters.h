// parameters.h: keys that choose a parameter of the script and change it while the world goes on.
#ifndef PETRI_SRC_VIEW_PARAMETERS_H
#define PETRI_SRC_VIEW_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>

#include "cli/bytes.h"
#include "petri.h"
#include "view/world.h"

typedef struct ParameterKeys {
    size_t chosen;
    bool used; // one of the keys was pressed: which parameter is chosen has been seen
} ParameterKeys;

typedef enum ParameterAct {
    PARAMETER_OTHER,  // no key for parameters
    PARAMETER_TELLS,  // something is to be told
    PARAMETER_CHANGES // … and the script has another value
} ParameterAct;

// Does what a key means. `text` gets what is to be told about it.
ParameterAct parameter_key(ParameterKeys *keys, World *world, const char *key, Bytes *text);
// Whether a key that is held means the same again and again.
bool parameter_key_repeats(const char *key);
// Adds lines about the chosen parameter and the keys, if the script has parameters.
void parameter_status(const ParameterKeys *keys, World *world, Bytes *text);

#endif
