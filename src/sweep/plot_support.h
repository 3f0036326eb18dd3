// plot_support.h: what petri-pictures can do for a sweep and petri, which starts faster, cannot.
#ifndef PETRI_SRC_SWEEP_PLOT_SUPPORT_H
#define PETRI_SRC_SWEEP_PLOT_SUPPORT_H

#include "sweep/sweep.h"

typedef struct PlotSupport {
    // The words of a plan: options and a script, as on a command line. False after a message.
    bool (*plan_read)(const char *path, TextList *words);
    // Whether a plot can be in such a file, by its name.
    bool (*plot_fits)(const char *path);
    // Draws a matrix of plots: metrics over what was swept. False after a message.
    bool (*plot_grid_draw)(const Integrator *sweep, const char *path);
} PlotSupport;

extern const PlotSupport PLOT_SUPPORT;

bool plan_read(const char *path, TextList *words);
bool plot_grid_draw(const Integrator *sweep, const char *path);

#endif
