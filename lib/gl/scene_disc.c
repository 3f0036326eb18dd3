// scene_disc.c: see scene_disc.h.
#include "gl/scene_disc.h"

#include <math.h>
#include <string.h>

// Whether a matrix only turns and enlarges; the factor in *scale.
static bool keeps_balls(const Matrix *a, double *scale) {
    double squares[3], product[3];
    for (int k = 0; k < 3; k++)
        squares[k] = vector_dot(a->m + 4 * k, a->m + 4 * k);
    double most = 1e-6 * squares[0];
    for (int k = 0; k < 3; k++)
        if (fabs(squares[k] - squares[0]) > most || fabs(vector_dot(a->m + 4 * k, a->m + 4 * ((k + 1) % 3))) > most)
            return false;
    vector_cross(a->m, a->m + 4, product);
    *scale = sqrt(squares[0]);
    return squares[0] > 0 && vector_dot(product, a->m + 8) > 0; // mirrored, the inside is seen
}

bool scene_disc(const Eye *eye, const Matrix *view, const Matrix *place, SceneDisc *disc) {
    double radius, seen[3], axes[3][3];
    memcpy(disc->middle, place->m + 12, sizeof disc->middle);
    matrix_point(view, disc->middle, seen);
    if (!keeps_balls(place, &radius) || -seen[2] - radius < eye->near || -seen[2] + radius > eye->far)
        return false;
    double distance = sqrt(vector_dot(seen, seen));
    disc->radius = radius;
    disc->near = eye->look->orthographic ? 0 : radius / distance;
    if (!(disc->near < 0.999))
        return false;
    // In the camera's coordinates: towards it, to the right, up.
    for (int k = 0; k < 3; k++)
        axes[2][k] = eye->look->orthographic ? k == 2 : -seen[k] / distance;
    vector_cross((double[3]){0, 1, 0}, axes[2], axes[0]);
    if (!vector_unit(axes[0]))
        return false;
    vector_cross(axes[2], axes[0], axes[1]);
    double scale = radius * sqrt(1 - disc->near * disc->near), forward = radius * disc->near;
    disc->place = matrix_one;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++) // the view's rows are its axes
            disc->place.m[4 * column + row] = (column < 2 ? scale : 1) * vector_dot(view->m + 4 * row, axes[column]);
    for (int k = 0; k < 3; k++)
        disc->place.m[12 + k] = disc->middle[k] + forward * disc->place.m[8 + k];
    return true;
}
