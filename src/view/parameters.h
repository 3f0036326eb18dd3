// parameters.h: handles the keys that select and change parameters while the script runs.
#pragma once

#include "cli/memory.h"
#include "petri.h"
#include "view/live_script.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct ParameterKeys {
    size_t chosen; // index of the selected parameter
    bool used;     // true if a parameter key was pressed, so that the user has seen which parameter is selected
} ParameterKeys;

typedef enum ParameterResult {
    PARAMETER_NOT_A_KEY, // not a parameter key
    PARAMETER_MESSAGE,   // there is a message to show
    PARAMETER_CHANGED    // there is a message to show, and the parameter has changed
} ParameterResult;

// Handles a key press and appends the message to `text`.
ParameterResult parameter_key(ParameterKeys *keys, LiveScript *live, const char *key, Text *text);
// Sets the selected parameter to a number and appends the message to `text`.
ParameterResult parameter_set(const ParameterKeys *keys, LiveScript *live, double value, Text *text);
// Returns true for keys that act repeatedly while held.
bool parameter_key_repeats(const char *key);
// If the script has parameters, appends lines about the selected parameter and the keys to `text`. `has_sliders` is
// true if the display has sliders.
void parameter_status(const ParameterKeys *keys, LiveScript *live, bool has_sliders, Text *text);
