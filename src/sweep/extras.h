// extras.h: what petri-pictures can do for a sweep and petri, which starts faster, cannot.
#ifndef PETRI_SRC_SWEEP_EXTRAS_H
#define PETRI_SRC_SWEEP_EXTRAS_H

#include "sweep/sweep.h"

typedef struct SweepExtras {
    // The words of a plan: options and a script, as on a command line. False after a message.
    bool (*plan_read)(const char *path, TextList *words);
    // Whether a plot can be in such a file, by its name.
    bool (*plot_fits)(const char *path);
    // Draws a matrix of plots: metrics over what was swept. False after a message.
    bool (*matrix_draw)(const Sweep *sweep, const char *path);
} SweepExtras;

extern const SweepExtras SWEEP_EXTRAS;

bool plan_read(const char *path, TextList *words);
bool matrix_draw(const Sweep *sweep, const char *path);

#endif
