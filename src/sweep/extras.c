// extras.c: see extras.h.
#include "sweep/extras.h"

#include "petri-draw.h"

const SweepExtras SWEEP_EXTRAS = {plan_read, petri_picture_format, matrix_draw};
