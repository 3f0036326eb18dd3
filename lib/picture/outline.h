// outline.h: paths as lists of lines and curves, and path effects on them (spec canvas.md 7).
#pragma once

#include "picture/display_list.h"

typedef struct OutlinePoint {
    double x;
    double y;
} OutlinePoint;

// An element: PATH_MOVE, PATH_LINE, PATH_CUBIC or PATH_CLOSE. PATH_CUBIC uses three points, the other kinds one. The
// last point that is used is the end point of the element.
typedef struct OutlineElement {
    PathElement kind;
    OutlinePoint points[3];
} OutlineElement;

typedef struct Outline {
    Arena *arena;
    double fine; // length of two pixels in the path's units; determines how finely curves are flattened
    DISPLAY_ARRAY(OutlineElement) elements;
} Outline;

// `effect` is an effect of a display list: its kind and operands.
//
// Returns true if this effect, or one inside it, dashes lines. If so, the paths for filling and for stroking differ.
bool outline_has_dashes(const double *effect);
// Applies an effect, and the effects nested in it, to the outline `from`. If `lines` is true, the result is for
// stroking, otherwise for filling. The result is allocated from the arena of `from`.
Outline outline_apply(const double *effect, Outline from, bool lines);
// Adds the elements of a path. Arcs are converted to curves.
void outline_add_path(Outline *out, DisplayNumbers path);

// Conversion of elliptical arcs to Bézier curves.
enum { ARCS_MAX = 10 };
// Converts the arc with the PATH_ARC operands `n` to Bézier curves and returns the number of curves. Each curve has two
// control points and an end point; `start` receives the start point of the first curve. A curve spans at most a quarter
// of the ellipse, or an eighth if the error of a quarter would be visible. `scale` is in pixels per unit.
int arcs_of_ellipse(const double n[6], double scale, double start[2], double curves[ARCS_MAX][6]);
// Like arcs_of_ellipse, for an arc that starts at `from` and has the PATH_ARC_TO operands `n`. If the result is 0, the
// caller must draw a straight line to the end point.
int arcs_to_point(const double from[2], const double n[7], double curves[ARCS_MAX][6]);
