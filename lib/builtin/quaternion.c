// quaternion.c: quaternions w;x;y;z (spec builtins.md B5).
#include "builtin/family.h"
#include "maths/maths.h"
#include "maths/random.h"

#include <math.h>

typedef struct Quaternion {
    double w, x, y, z;
} Quaternion;

static Quaternion quaternion_of(Value v) {
    const double *q = v.as.numbers;
    return (Quaternion){q[0], q[1], q[2], q[3]};
}

static Value quaternion_value(Arena *arena, Quaternion q) {
    return builtin_numbers(arena, (double[]){q.w, q.x, q.y, q.z}, 4);
}

// Returns the quaternion cos(h); k*axis, where h is half the angle and k = sin(h)/|axis| (B5.1).
Value builtin_quaternion(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!is_numeric_of(args[0], 3) || !value_is_number(args[1]))
        return VALUE_NULL;
    const double *axis = args[0].as.numbers;
    double x = axis[0], y = axis[1], z = axis[2], h = args[1].as.number / 2;
    double k = turns_sin(h) / sqrt(x * x + y * y + z * z);
    return quaternion_value(context->arena, (Quaternion){turns_cos(h), k * x, k * y, k * z});
}

static Quaternion multiply_quaternions(Quaternion a, Quaternion b) {
    return (Quaternion){
        a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
        a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
        a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x,
    };
}

// Returns the vector v rotated by a: (a v) a^-1 (B5.2).
static Value rotate_vector(Arena *arena, Quaternion a, const double *v) {
    double x = v[0], y = v[1], z = v[2];
    double bw = -a.x * x - a.y * y - a.z * z;
    double bx = a.w * x + a.y * z - a.z * y;
    double by = a.w * y + a.z * x - a.x * z;
    double bz = a.w * z + a.x * y - a.y * x;
    double s = 1 / (a.x * a.x + a.y * a.y + a.z * a.z + a.w * a.w);
    double aw = a.w * s, ax = a.x * (-s), ay = a.y * (-s), az = a.z * (-s);
    double turned[3] = {
        bw * ax + bx * aw + by * az - bz * ay,
        bw * ay + by * aw + bz * ax - bx * az,
        bw * az + bz * aw + bx * ay - by * ax,
    };
    return builtin_numbers(arena, turned, 3);
}

Value builtin_qmul(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!is_numeric_of(args[0], 4))
        return VALUE_NULL;
    if (is_numeric_of(args[1], 3))
        return rotate_vector(context->arena, quaternion_of(args[0]), args[1].as.numbers);
    if (!is_numeric_of(args[1], 4))
        return VALUE_NULL;
    return quaternion_value(context->arena, multiply_quaternions(quaternion_of(args[0]), quaternion_of(args[1])));
}

// Returns the rotation from a to the opposite direction: half a turn about an axis perpendicular to a (B5.3).
static Quaternion half_turn(double ax, double ay, double az) {
    bool flat = ax != 0 || ay != 0;
    double x = flat ? -ay : 0, y = flat ? ax : -az, z = flat ? 0 : ay;
    double s = 1 / sqrt(x * x + y * y + z * z);
    return (Quaternion){0, x * s, y * s, z * s};
}

Value builtin_qbetween(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!is_numeric_of(args[0], 3) || !is_numeric_of(args[1], 3))
        return VALUE_NULL;
    const double *a = args[0].as.numbers, *b = args[1].as.numbers;
    double ka = 1 / sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    double kb = 1 / sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    double ax = a[0] * ka, ay = a[1] * ka, az = a[2] * ka;
    double bx = b[0] * kb, by = b[1] * kb, bz = b[2] * kb;
    double c = ax * bx + ay * by + az * bz;
    double s = sqrt((1 + c) * 2);
    if (s == 0)
        return quaternion_value(context->arena, half_turn(ax, ay, az));
    double k = 1 / s;
    Quaternion result = {s / 2, (ay * bz - az * by) * k, (az * bx - ax * bz) * k, (ax * by - ay * bx) * k};
    return quaternion_value(context->arena, result);
}

// Computes (b a^-1)^t a (B5.4).
Value builtin_slerp(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!value_is_number(args[0]) || !is_numeric_of(args[1], 4) || !is_numeric_of(args[2], 4))
        return VALUE_NULL;
    Quaternion a = quaternion_of(args[1]), b = quaternion_of(args[2]);
    double n = 1 / (a.x * a.x + a.y * a.y + a.z * a.z + a.w * a.w);
    Quaternion inverse = {a.w * n, (-a.x) * n, (-a.y) * n, (-a.z) * n};
    Quaternion r = multiply_quaternions(b, inverse);
    double theta = maths_acos(r.w), u = maths_sin(theta);
    theta = theta * args[0].as.number;
    double v = u != 0 ? maths_sin(theta) / u : 0;
    Quaternion e = {maths_cos(theta), r.x * v, r.y * v, r.z * v};
    return quaternion_value(context->arena, multiply_quaternions(e, a));
}
