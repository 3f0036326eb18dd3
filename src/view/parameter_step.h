// parameter_step.h: the value of a parameter after a key press.
#pragma once

#include "petri.h"

// Returns the parameter's value plus `steps` steps; `steps` can be negative. The range in the parameter's comment can
// give the step size. If it does not, the step is a round number: about 1/50 of the range or, without a range, 1/20 of
// the default. The result is within the range, and an integer if the value, the default and the range are integers.
// Returns NaN if the value is not a number. Also returns NaN if the result would be 0 and the operator `or` in the
// parameter's declaration would replace 0 by the default.
double parameter_stepped(const PetriParameter *parameter, int steps);
// Returns the value at a fraction of the parameter's range, from 0 to 1. The range must have two ends. The result is a
// multiple of the range's step. Without a step, it is an integer if the value, the default and the range are integers,
// else a multiple of 1/200 of the range. If `or` would replace it by the default, returns the next value instead.
double parameter_at(const PetriParameter *parameter, double fraction);
