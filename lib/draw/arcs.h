// arcs.h: conversion of elliptical arcs to Bézier curves.
#ifndef PETRI_DRAW_ARCS_H
#define PETRI_DRAW_ARCS_H

enum { ARCS_MAX = 10 };
// Converts a PATH_ARC to Bézier curves and returns their number. Each curve has two control points and an end point;
// `start` receives the start point of the first curve. A curve spans at most a quarter of the ellipse, or an eighth if
// the error of a quarter would be visible. `scale` is in pixels per unit.
int arcs_of_ellipse(const double n[6], double scale, double start[2], double curves[ARCS_MAX][6]);
// Converts a PATH_ARC_TO that starts at `from`. Returns the number of curves; 0: draw a straight line to its end.
int arcs_to_point(const double from[2], const double n[7], double curves[ARCS_MAX][6]);

#endif
