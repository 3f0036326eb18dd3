// plot_support.c: see plot_support.h.
#include "sweep/plot_support.h"

#include "petri-draw.h"

const PlotSupport PLOT_SUPPORT = {plan_read, petri_picture_can_save, plot_grid_draw};
