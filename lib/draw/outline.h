// outline.h: paths as lists of lines and curves, and what path effects make of them (spec canvas.md 7).
#ifndef PETRI_DRAW_OUTLINE_H
#define PETRI_DRAW_OUTLINE_H

#include "draw/display_list.h"

typedef struct OutlinePoint {
    double x;
    double y;
} OutlinePoint;

// PATH_MOVE, PATH_LINE, PATH_CUBIC and PATH_CLOSE; the last of the points is where it ends.
typedef struct OutlineElement {
    PathElement kind;
    OutlinePoint points[3];
} OutlineElement;

typedef struct Outline {
    Arena *arena;
    double fine; // flat enough
    DISPLAY_ARRAY(OutlineElement) elements;
} Outline;

// Whether the paint has an effect that changes the path, other than dashes of its lines.
bool outline_has_effect(const DisplayList *list, const DisplayPaint *paint);
// Whether this effect or one in it dashes lines, and so makes another path of them than of what they enclose.
bool outline_has_dashes(const DisplayList *list, uint32_t effect);
// What this effect and those in it make of an outline, filled or as lines, in its arena. DISPLAY_NONE: as it is.
Outline outline_apply(const DisplayList *list, uint32_t effect, Outline from, bool lines);
// Adds what the list says of a path, its arcs as curves.
void outline_add_path(Outline *out, const DisplayList *list, const DisplayPath *path);

#endif
