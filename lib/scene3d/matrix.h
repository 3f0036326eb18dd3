// matrix.h: matrices and cameras of scenes (spec canvas3d.md 1.4, 6.1). Vectors are columns, and matrices are
// column-major.
#pragma once

#include "canvas/drawing.h"

typedef struct Matrix {
    double m[16];
} Matrix;

extern const Matrix matrix_identity;

Matrix matrix_product(const Matrix *a, const Matrix *b); // a · b, which applies b first
bool matrix_is_finite(const Matrix *a);
void matrix_point(const Matrix *a, const double p[3], double out[3]);
// Computes the matrix of cofactors of the upper left 3 x 3 elements, column-major. It transforms normals and
// directions.
void matrix_cofactors(const Matrix *a, double out[9]);
void matrix_direction(const Matrix *a, const double d[3], double out[3]); // `out` has length 1, or is 0;0;0

// Returns `a` multiplied by the node's transform attributes, in the order in which they are written.
Matrix matrix_transformed(Matrix a, const DrawNode *node);
// Returns `a` multiplied by the transform that the position, size and other attributes of a model describe.
Matrix matrix_placed(Matrix a, const DrawNode *node);
// Returns the matrix of a member of a solid or distance field, in the coordinates of the enclosing node.
Matrix matrix_of_member(const Matrix *outside, const DrawNode *node);
// The parameters of a camera's view and projection (spec 3.2, 3.3).
typedef struct Eye {
    double position[3];
    double focus[3];
    double up[3];
    const GraphicsState3D *state;
    double near;
    double far;
    double width; // width of the view, if the projection is orthographic
    double aspect;
} Eye;
Matrix matrix_view(const Eye *eye);
Matrix matrix_projection(const Eye *eye);

double vector_dot(const double a[3], const double b[3]);
void vector_cross(const double a[3], const double b[3], double out[3]);
bool vector_normalise(double a[3]); // returns false, and changes nothing, if the vector has no direction
