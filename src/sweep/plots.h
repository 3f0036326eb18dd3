// plots.h: functions of petri sweep that need libraries which petri itself does not link: reading plans and drawing
// plots. petri links src/main/no_pictures.c instead.
#pragma once

#include "sweep/sweep.h"

// Appends the options and the script of a plan as command-line arguments. Returns false after a message.
bool plan_read(const char *path, TextList *words);
// Returns true if a plot can be written to a file with this suffix.
bool plot_grid_fits(const char *path);
// Writes a grid of plots to the file `path`: each metric against each swept name. Returns false after a message.
bool plot_grid_draw(const Sweep *sweep, const char *path);
