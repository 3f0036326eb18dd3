// integrate.c: motion of one particle (4.3).
//
//   if m ≠ 0 and every component of the force is finite:
//       c = delta / m;  v_k = v_k + F_k · c
//       if speed_of_light > 0 and Σ v_k² > speed_of_light²:  v_k = v_k · (speed_of_light / sqrt(Σ v_k²))
//   a_k = (v_k − v_k before) / delta
//   p_k = p_k + v_k · delta
#include "physics/internal.h"

static bool force_is_finite(const Columns *columns, size_t i) {
    for (size_t k = 0; k < columns->dimensions; k++)
        if (!isfinite(columns->force[k * columns->stride + i]))
            return false;
    return true;
}

static void accelerate(const Columns *columns, size_t i, double delta, double speed_of_light) {
    size_t n = columns->dimensions, stride = columns->stride;
    double c = delta / columns->mass[i], square = 0;
    for (size_t k = 0; k < n; k++) {
        double v = columns->velocity[k * stride + i] + columns->force[k * stride + i] * c;
        columns->velocity[k * stride + i] = v;
        square += v * v;
    }
    if (!(speed_of_light > 0 && square > speed_of_light * speed_of_light))
        return;
    double factor = speed_of_light / sqrt(square);
    for (size_t k = 0; k < n; k++)
        columns->velocity[k * stride + i] *= factor;
}

void phys_move(const Columns *columns, size_t i, double delta, double speed_of_light) {
    size_t n = columns->dimensions, stride = columns->stride;
    double *acceleration = phys_acceleration(columns), *before = acceleration + n;
    for (size_t k = 0; k < n; k++)
        before[k] = columns->velocity[k * stride + i];
    if (columns->mass[i] != 0 && force_is_finite(columns, i))
        accelerate(columns, i, delta, speed_of_light);
    for (size_t k = 0; k < n; k++) {
        double v = columns->velocity[k * stride + i];
        acceleration[k] = (v - before[k]) / delta;
        columns->position[k * stride + i] += v * delta;
    }
}
