// sphere_impostor.c: see sphere_impostor.h.
#include "scene3d/sphere_impostor.h"

#include <math.h>
#include <string.h>

// Returns true if a matrix only rotates and scales uniformly. *scale receives the factor of the scaling.
static bool is_similarity(const Matrix *a, double *scale) {
    double squares[3], product[3];
    for (int k = 0; k < 3; k++)
        squares[k] = vector_dot(a->m + 4 * k, a->m + 4 * k);
    double max = 1e-6 * squares[0];
    for (int k = 0; k < 3; k++)
        if (fabs(squares[k] - squares[0]) > max || fabs(vector_dot(a->m + 4 * k, a->m + 4 * ((k + 1) % 3))) > max)
            return false;
    vector_cross(a->m, a->m + 4, product);
    *scale = sqrt(squares[0]);
    return squares[0] > 0 && vector_dot(product, a->m + 8) > 0; // a mirrored sphere shows its inside
}

bool sphere_impostor(const Eye *eye, const Matrix *view, const Matrix *place, SphereImpostor *disc) {
    double radius, seen[3], axes[3][3];
    memcpy(disc->middle, place->m + 12, sizeof disc->middle);
    matrix_point(view, disc->middle, seen);
    if (!is_similarity(place, &radius) || -seen[2] - radius < eye->near || -seen[2] + radius > eye->far)
        return false;
    double distance = sqrt(vector_dot(seen, seen));
    disc->radius = radius;
    disc->near = eye->state->orthographic ? 0 : radius / distance;
    if (!(disc->near < 0.999))
        return false;
    // Axes in camera coordinates: [2] towards the camera, [0] to the right, [1] up.
    for (int k = 0; k < 3; k++)
        axes[2][k] = eye->state->orthographic ? k == 2 : -seen[k] / distance;
    vector_cross((double[3]){0, 1, 0}, axes[2], axes[0]);
    if (!vector_normalise(axes[0]))
        return false;
    vector_cross(axes[2], axes[0], axes[1]);
    double scale = radius * sqrt(1 - disc->near * disc->near), forward = radius * disc->near;
    disc->place = matrix_identity;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++) // the rows of the view matrix are the camera's axes
            disc->place.m[4 * column + row] = (column < 2 ? scale : 1) * vector_dot(view->m + 4 * row, axes[column]);
    for (int k = 0; k < 3; k++)
        disc->place.m[12 + k] = disc->middle[k] + forward * disc->place.m[8 + k];
    return true;
}
