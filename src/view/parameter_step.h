// parameter_step.h: the value of a parameter after a key press.
#ifndef PETRI_SRC_PARAMETER_STEP_H
#define PETRI_SRC_PARAMETER_STEP_H

#include "petri.h"

// Returns the value that is `steps` steps away. A step is that of the range in the parameter's comment, else a round
// number: about 1/50 of the range or 1/20 of the default. The result stays within the range, and whole if all of the
// script's numbers are. Returns NaN if the value is not a number, or if the result would be 0, which `or` replaces by
// the default.
double parameter_stepped(const PetriParameter *parameter, int steps);

#endif
