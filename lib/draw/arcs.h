// arcs.h: parts of ellipses as Bézier curves.
#ifndef PETRI_DRAW_ARCS_H
#define PETRI_DRAW_ARCS_H

enum { ARCS_MAX = 10 };
// A PATH_ARC as Bézier curves, each of at most a quarter of the ellipse or, where the difference would show at this
// scale, an eighth of it: where it starts, and two controls and an end for each. Returns their number.
int arcs_of_ellipse(const double n[6], double scale, double start[2], double curves[ARCS_MAX][6]);
// The same of a PATH_ARC_TO from a point. 0: it is a straight line.
int arcs_to_point(const double from[2], const double n[7], double curves[ARCS_MAX][6]);

#endif
