// matrix.c: see matrix.h.
//
// Quarter turns are recognised, so that their matrices are exact.
#include "scene3d/matrix.h"

#include "maths/maths.h"

#include <math.h>
#include <string.h>

static const double TURN = 6.283185307179586;

const Matrix matrix_identity = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};

Matrix matrix_product(const Matrix *a, const Matrix *b) {
    Matrix out;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a->m[4 * k + row] * b->m[4 * column + k];
            out.m[4 * column + row] = sum;
        }
    return out;
}

bool matrix_is_finite(const Matrix *a) {
    // Larger values could overflow floats on the GPU.
    for (int i = 0; i < 16; i++)
        if (!(fabs(a->m[i]) < 1e18))
            return false;
    return true;
}

void matrix_point(const Matrix *a, const double p[3], double out[3]) {
    double copy[3] = {p[0], p[1], p[2]};
    for (int row = 0; row < 3; row++)
        out[row] = a->m[row] * copy[0] + a->m[4 + row] * copy[1] + a->m[8 + row] * copy[2] + a->m[12 + row];
}

void matrix_cofactors(const Matrix *a, double out[9]) {
    for (int column = 0; column < 3; column++) // each column is the cross product of the two other columns of a
        vector_cross(a->m + 4 * ((column + 1) % 3), a->m + 4 * ((column + 2) % 3), out + 3 * column);
}

void matrix_direction(const Matrix *a, const double d[3], double out[3]) {
    double cofactors[9], copy[3] = {d[0], d[1], d[2]};
    matrix_cofactors(a, cofactors);
    for (int row = 0; row < 3; row++)
        out[row] = cofactors[row] * copy[0] + cofactors[3 + row] * copy[1] + cofactors[6 + row] * copy[2];
    if (!vector_normalise(out))
        memset(out, 0, 3 * sizeof *out);
}

double vector_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void vector_cross(const double a[3], const double b[3], double out[3]) {
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    out[0] = x, out[1] = y, out[2] = z;
}

bool vector_normalise(double a[3]) {
    double length = sqrt(vector_dot(a, a));
    if (!(length > 1e-150) || !isfinite(length))
        return false;
    for (int k = 0; k < 3; k++)
        a[k] /= length;
    return true;
}

static Matrix translation(const double v[3]) {
    Matrix out = matrix_identity;
    memcpy(out.m + 12, v, 3 * sizeof *v);
    return out;
}

static Matrix scaling(const double v[3]) {
    Matrix out = matrix_identity;
    out.m[0] = v[0], out.m[5] = v[1], out.m[10] = v[2];
    return out;
}

// Returns a rotation about an axis: 0 is x, 1 is y, and 2 is z.
static Matrix rotation_about(int axis, double turns) {
    Matrix out = matrix_identity;
    double part = turns - floor(turns); // without whole turns, so that quarter turns are recognised and exact
    double cosine = part == 0.25 || part == 0.75 ? 0 : maths_cos(TURN * part);
    double sine = part == 0.5 ? 0 : maths_sin(TURN * part);
    int a = (axis + 1) % 3, b = (axis + 2) % 3;
    out.m[4 * a + a] = out.m[4 * b + b] = cosine;
    out.m[4 * a + b] = sine;
    out.m[4 * b + a] = -sine;
    return out;
}

static Matrix rotation(const double v[3]) {
    Matrix x = rotation_about(0, v[0]), y = rotation_about(1, v[1]), z = rotation_about(2, v[2]);
    y = matrix_product(&y, &z);
    return matrix_product(&x, &y);
}

static Matrix quaternion(const double q[4]) {
    double w = q[0], x = q[1], y = q[2], z = q[3], length = sqrt(w * w + x * x + y * y + z * z);
    double k = length > 0 ? 2 / length : 0;
    return (Matrix){{1 - k * (y * y + z * z), k * (x * y + z * w), k * (x * z - y * w), 0, //
                     k * (x * y - z * w), 1 - k * (x * x + z * z), k * (y * z + x * w), 0, //
                     k * (x * z + y * w), k * (y * z - x * w), 1 - k * (x * x + y * y), 0, //
                     0, 0, 0, 1}};
}

static Matrix rotation_of(const AttrValue *attr) {
    const double *x = attr->as.list;
    if (attr->count == 4)
        return quaternion(x);
    if (attr->count == 1)
        return rotation((double[3]){x[0], x[0], x[0]});
    return attr->count == 3 ? rotation(x) : matrix_identity;
}

static Matrix shear(int axis, const double amounts[2]) {
    Matrix out = matrix_identity;
    int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
    out.m[4 * first + axis] = amounts[0];
    out.m[4 * second + axis] = amounts[1];
    return out;
}

static Matrix matrix_of(const AttrValue *attr) {
    Matrix out = matrix_identity;
    if (attr->count == 16)
        memcpy(out.m, attr->as.list, sizeof out.m);
    return out;
}

Matrix matrix_transformed(Matrix a, const DrawNode *node) {
    for (uint32_t i = 0; i < node->attr_count; i++) {
        const AttrValue *attr = &node->attrs[i];
        const double *x = attr->as.numbers;
        int name = attr->name;
        Matrix b = name == ATTR_TRANSLATE  ? translation(x)
                   : name == ATTR_SCALE    ? scaling(x)
                   : name == ATTR_ROTATE   ? rotation_of(attr)
                   : name == ATTR_ROTATE_X ? rotation_about(0, x[0])
                   : name == ATTR_ROTATE_Y ? rotation_about(1, x[0])
                   : name == ATTR_ROTATE_Z ? rotation_about(2, x[0])
                   : name == ATTR_SHEAR_X  ? shear(0, x)
                   : name == ATTR_SHEAR_Y  ? shear(1, x)
                   : name == ATTR_SHEAR_Z  ? shear(2, x)
                   : name == ATTR_MATRIX   ? matrix_of(attr)
                                           : matrix_identity;
        if (memcmp(&b, &matrix_identity, sizeof b) != 0)
            a = matrix_product(&a, &b);
    }
    return a;
}

// Multiplies *a by the transform that places a model along the line from the attribute `start` to `end`. If that is not
// possible, returns false.
static bool place_along(Matrix *a, const DrawNode *node, const double end[3]) {
    const AttrValue *attr = draw_attr(node, ATTR_START);
    double zero[3] = {0}, axis[3], middle[3], radius = draw_number(node, ATTR_RADIUS);
    const double *start = attr ? attr->as.numbers : zero;
    for (int k = 0; k < 3; k++) {
        axis[k] = end[k] - start[k];
        middle[k] = start[k] + axis[k] / 2;
    }
    double length = sqrt(vector_dot(axis, axis));
    if (!(radius > 0) || !vector_normalise(axis))
        return false;
    // The shortest rotation from z to the axis. It is a half turn if the axis points to -z; otherwise, it is computed
    // as a quaternion.
    Matrix turn = axis[2] < -0.9999999999 ? rotation_about(1, 0.5) : matrix_identity;
    if (axis[2] >= -0.9999999999) {
        double q[4] = {1 + axis[2], -axis[1], axis[0], 0}, size = sqrt(2 * q[0]);
        for (int k = 0; k < 4; k++)
            q[k] /= size;
        turn = quaternion(q);
    }
    Matrix place = translation(middle), size = scaling((double[3]){radius, radius, length});
    place = matrix_product(&place, &turn);
    place = matrix_product(&place, &size);
    *a = matrix_product(a, &place);
    return true;
}

Matrix matrix_placed(Matrix a, const DrawNode *node) {
    const AttrValue *end = draw_attr(node, ATTR_END), *attr;
    if (end) {
        place_along(&a, node, end->as.numbers);
        return a;
    }
    if ((attr = draw_attr(node, ATTR_POSITION))) {
        double moved[3];
        matrix_point(&a, attr->as.numbers, moved);
        memcpy(a.m + 12, moved, sizeof moved);
    }
    if ((attr = draw_attr(node, ATTR_ROTATION))) {
        Matrix turn = rotation(attr->as.numbers);
        a = matrix_product(&a, &turn);
    }
    if ((attr = draw_attr(node, ATTR_SIZE)))
        for (int i = 0; i < 12; i++)
            a.m[i] *= attr->as.numbers[i / 4];
    return a;
}

Matrix matrix_of_member(const Matrix *outside, const DrawNode *node) {
    return node->kind == KIND_MIX           ? *outside
           : node->kind == KIND_TRANSFORM3D ? matrix_transformed(*outside, node)
                                            : matrix_placed(*outside, node);
}

Matrix matrix_view(const Eye *eye) {
    double z[3], y[3], x[3];
    for (int k = 0; k < 3; k++)
        z[k] = eye->position[k] - eye->focus[k];
    if (!vector_normalise(z))
        return matrix_identity;
    double along = vector_dot(eye->up, z);
    for (int k = 0; k < 3; k++)
        y[k] = eye->up[k] - along * z[k];
    if (vector_dot(y, y) <= 1e-24 * vector_dot(eye->up, eye->up) || !vector_normalise(y))
        return matrix_identity;
    vector_cross(y, z, x);
    const double *p = eye->position;
    return (Matrix){{x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -vector_dot(x, p),
                     -vector_dot(y, p), -vector_dot(z, p), 1}};
}

Matrix matrix_projection(const Eye *eye) {
    double n = eye->near, f = eye->far, a = eye->aspect, g = maths_tan(TURN / 2 * eye->state->fov);
    double gx = g, gy = g / a;
    int reference = eye->state->fov_ref;
    if (reference == FOV_WIDE)
        reference = a > 1 ? FOV_HORIZONTAL : FOV_VERTICAL;
    if (reference == FOV_NARROW)
        reference = a > 1 ? FOV_VERTICAL : FOV_HORIZONTAL;
    if (reference != FOV_HORIZONTAL) {
        double part = reference == FOV_DIAGONAL ? sqrt(1 + a * a) : 1;
        gx = a * g / part, gy = g / part;
    }
    if (eye->state->orthographic)
        return (Matrix){
            {2 / eye->width, 0, 0, 0, 0, 2 * a / eye->width, 0, 0, 0, 0, -2 / (f - n), 0, 0, 0, -(f + n) / (f - n), 1}};
    return (Matrix){{1 / gx, 0, 0, 0, 0, 1 / gy, 0, 0, 0, 0, -(f + n) / (f - n), -1, 0, 0, -2 * f * n / (f - n), 0}};
}
