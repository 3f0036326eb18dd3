// arcs.h: conversion of elliptical arcs to Bézier curves.
#pragma once

enum { ARCS_MAX = 10 };
// Converts the arc with the PATH_ARC operands `n` to Bézier curves and returns the number of curves. Each curve has two
// control points and an end point; `start` receives the start point of the first curve. A curve spans at most a quarter
// of the ellipse, or an eighth if the error of a quarter would be visible. `scale` is in pixels per unit.
int arcs_of_ellipse(const double n[6], double scale, double start[2], double curves[ARCS_MAX][6]);
// Like arcs_of_ellipse, for an arc that starts at `from` and has the PATH_ARC_TO operands `n`. If the result is 0, the
// caller must draw a straight line to the end point.
int arcs_to_point(const double from[2], const double n[7], double curves[ARCS_MAX][6]);
