// no_cairo.c: opens painters in builds without Cairo, which have no backend until a host sets its own.
#include "picture/painter.h"

PetriPainter *petri_painter_open(void) {
    return painter_open(NULL);
}
