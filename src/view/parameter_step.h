// parameter_step.h: the value of a parameter after a key press.
#ifndef PETRI_SRC_PARAMETER_STEP_H
#define PETRI_SRC_PARAMETER_STEP_H

#include "petri.h"

// Returns the value that is `steps` steps away. The range in the parameter's comment can give the step size. If it does
// not, the step is a round number: about 1/50 of the range or, without a range, 1/20 of the default. The result is
// within the range, and an integer if the value, the default and the range are integers. Returns NaN if the value is
// not a number, or if the result would be 0, which `or` would replace by the default.
double parameter_stepped(const PetriParameter *parameter, int steps);

#endif
