// parameter_step.h: how far a key press takes a parameter.
#ifndef PETRI_SRC_PARAMETER_STEP_H
#define PETRI_SRC_PARAMETER_STEP_H

#include "petri.h"

// The value that is `steps` steps from the present one: those of the comment's range, else round ones, fifty to a range
// or twenty to the default. It stays in the range, and whole where the script's numbers are. NaN if there is none: the
// value is no number, or 0 is all that is left, which `or` takes for nothing.
double parameter_stepped(const PetriParameter *parameter, int steps);

#endif
