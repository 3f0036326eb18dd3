// no_pictures.c: lets petri link without the drawing libraries and libyaml. None of these functions is called:
// Command.needs_pictures makes petri execute petri-pictures, which has the real ones.
#include "check/meshes.h"
#include "sweep/plots.h"

bool plan_read(const char *path, TextList *words) {
    (void)path;
    (void)words;
    return false;
}

bool plot_grid_fits(const char *path) {
    (void)path;
    return false;
}

bool plot_grid_draw(const Sweep *sweep, const char *path) {
    (void)sweep;
    (void)path;
    return false;
}

void check_print_meshes(const CommandContext *context, const Options *options, const char *path) {
    (void)context;
    (void)options;
    (void)path;
}
