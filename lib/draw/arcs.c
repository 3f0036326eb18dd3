// arcs.c: see arcs.h.
#include "draw/arcs.h"

#include "maths/maths.h"

#include <math.h>

static const double TURN = 6.283185307179586;

int arcs_of_ellipse(const double n[6], double scale, double start[2], double curves[ARCS_MAX][6]) {
    double x = n[0], y = n[1], rx = n[2], ry = n[3], turns = fmin(fmax(n[5], -1), 1);
    double max_radius = fmax(rx, ry) * scale;
    int count = (int)ceil(fabs(turns) * (max_radius < 64 ? 4 : 8));
    double from = (n[4] - floor(n[4])) * TURN, step = turns * TURN / (count ? count : 1);
    double handle = 4.0 / 3 * maths_tan(step / 4);
    double c = maths_cos(from), s = maths_sin(from);
    start[0] = x + rx * c;
    start[1] = y + ry * s;
    for (int i = 1; i <= count; i++) {
        double c2 = maths_cos(from + i * step), s2 = maths_sin(from + i * step), *curve = curves[i - 1];
        curve[0] = x + rx * (c - handle * s);
        curve[1] = y + ry * (s + handle * c);
        curve[2] = x + rx * (c2 + handle * s2);
        curve[3] = y + ry * (s2 - handle * c2);
        curve[4] = x + rx * c2;
        curve[5] = y + ry * s2;
        c = c2;
        s = s2;
    }
    return count;
}

// Follows the implementation notes on elliptical arcs in the SVG specification. Dividing coordinates by the radii maps
// the arc to a circle. Its centre is computed from the chord. If the radii are too short for the chord, the circle
// grows.
int arcs_to_point(const double start[2], const double n[7], double curves[ARCS_MAX][6]) {
    double x = n[5], y = n[6], c = maths_cos(n[2] * TURN), s = maths_sin(n[2] * TURN);
    double rx = n[0], ry = n[1], dx = (x - start[0]) / 2, dy = (y - start[1]) / 2;
    double a = (c * dx + s * dy) / rx, b = (c * dy - s * dx) / ry; // half the chord, scaled to the unit circle
    double half = maths_hypot(a, b);
    if (!(half > 0) || !isfinite(half)) // the arc has no length or no radius: draw a line
        return 0;
    double grow = fmax(half, 1), height = sqrt(fmax(grow * grow / (half * half) - 1, 0));
    double side = (n[3] != 0) == (n[4] != 0) ? -1 : 1;
    double mx = -b * height * side,
           my = a * height * side; // vector from the middle of the chord to the centre of the circle
    double from = maths_atan2(-b - my, -a - mx), to = maths_atan2(b - my, a - mx);
    double sweep = to - from + (n[4] != 0 && to < from ? TURN : n[4] == 0 && to > from ? -TURN : 0);
    int count = (int)ceil(fabs(sweep) / (TURN / 8));
    double step = sweep / (count ? count : 1), handle = 4.0 / 3 * maths_tan(step / 4);
    for (int i = 1; i <= count; i++) {
        double at = from + (i - 1) * step, next = from + i * step;
        double c1 = maths_cos(at), s1 = maths_sin(at), c2 = maths_cos(next), s2 = maths_sin(next);
        const double circle[3][2] = {
            {c1 - handle * s1, s1 + handle * c1}, {c2 + handle * s2, s2 - handle * c2}, {c2, s2}};
        for (int k = 0; k < 3; k++) {
            double u = (circle[k][0] * grow + mx) * rx, v = (circle[k][1] * grow + my) * ry;
            curves[i - 1][2 * k] = (start[0] + x) / 2 + c * u - s * v;
            curves[i - 1][2 * k + 1] = (start[1] + y) / 2 + s * u + c * v;
        }
    }
    return count;
}
