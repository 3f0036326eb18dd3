// barrier.c: reflections at hard boundaries (spec physics.md 4.4). single_formulas.h has the formulas of soft
// boundaries, and those that are shared by both kinds.
#define LANES 1
#include "physics/single_formulas.h"

static double particle_height(const Columns *columns, size_t i, const PhysForce *barrier, double start) {
    Block block = block_at(columns, i);
    return height_above(barrier, columns->dimensions, &block, start);
}

// Σ v_k · normal_k
static double velocity_along(const Columns *columns, size_t i, const PhysForce *barrier) {
    size_t n = columns->dimensions, stride = columns->stride;
    double sum = 0;
    for (size_t k = 0; k < n; k++)
        sum += columns->velocity[k * stride + i] * phys_at(barrier->vector2, k);
    return sum;
}

// p_k = p_k − x · normal_k
static void put_on_surface(const Columns *columns, size_t i, const PhysForce *barrier, double x) {
    size_t n = columns->dimensions, stride = columns->stride;
    for (size_t k = 0; k < n; k++)
        columns->position[k * stride + i] -= x * phys_at(barrier->vector2, k);
}

// p_k = p_k − τ · v_k;  v_k = (v_k − τ · a_k) · restitution
static void move_back_to_contact(const Columns *columns, size_t i, double tau, double restitution) {
    size_t n = columns->dimensions, stride = columns->stride;
    const double *acceleration = phys_acceleration(columns);
    for (size_t k = 0; k < n; k++) {
        double *v = &columns->velocity[k * stride + i];
        columns->position[k * stride + i] -= tau * *v;
        *v = (*v - tau * acceleration[k]) * restitution;
    }
}

// v_k = v_k − (2 · w) · normal_k
static void reflect(const Columns *columns, size_t i, const PhysForce *barrier, double w) {
    size_t n = columns->dimensions, stride = columns->stride;
    for (size_t k = 0; k < n; k++)
        columns->velocity[k * stride + i] -= 2 * w * phys_at(barrier->vector2, k);
}

// b = Σ a_k · normal_k
static double acceleration_along(const Columns *columns, const PhysForce *barrier) {
    const double *acceleration = phys_acceleration(columns);
    double sum = 0;
    for (size_t k = 0; k < columns->dimensions; k++)
        sum += acceleration[k] * phys_at(barrier->vector2, k);
    return sum;
}

// Moves particle i for the time `delta` and sets a_k = (v_k after − v_k before) / delta.
static void move_again(const Columns *columns, size_t i, double delta, double speed_of_light) {
    size_t n = columns->dimensions;
    Block block = block_at(columns, i);
    double *acceleration = phys_acceleration(columns), *before = acceleration + n;
    for (size_t k = 0; k < n; k++)
        before[k] = velocity_component(&block, k);
    move_particles(n, &block, delta, speed_of_light);
    for (size_t k = 0; k < n; k++)
        acceleration[k] = (velocity_component(&block, k) - before[k]) / delta;
}

// Symbols are those of single_formulas.h, and a is the acceleration in the move:
//
//   x = −r + Σ (p_k − position_k)·normal_k, added in this order;   w = Σ v_k·normal_k;   b = Σ a_k·normal_k
//   if x ≥ 0: done
//   if not w < 0: put on the surface; done                     because it is already moving away
//   τ = x / w;  outside = τ > delta;  if outside: τ = delta    time since contact, at most the whole step
//   move back to the contact
//   w' = Σ v_k·normal_k
//   if outside: x' as x above; if x' < 0: put on the surface
//   if w' < 0: reflect
//   if b < 0 and w'/b < τ: τ = max(w'/b, 0)                    not beyond the apex of the bounce
//   if τ > 0: move again for the time τ, with the same force; else a = 0
void phys_reflect(const Columns *columns, size_t i, const Force *force, double delta, double speed_of_light) {
    const PhysForce *barrier = &force->given;
    double radius = columns->radius[phys_numbers_at(columns, i)], x = particle_height(columns, i, barrier, -radius);
    if (x >= 0)
        return;
    double w = velocity_along(columns, i, barrier), b = acceleration_along(columns, barrier);
    if (!(w < 0)) {
        put_on_surface(columns, i, barrier, x);
        return;
    }
    double tau = x / w;
    bool outside = tau > delta;
    if (outside)
        tau = delta;
    move_back_to_contact(columns, i, tau, barrier->restitution);
    w = velocity_along(columns, i, barrier);
    if (outside) {
        x = particle_height(columns, i, barrier, -radius);
        if (x < 0)
            put_on_surface(columns, i, barrier, x);
    }
    if (w < 0)
        reflect(columns, i, barrier, w);
    if (b < 0 && w / b < tau)
        tau = w / b > 0 ? w / b : 0;
    if (tau > 0) {
        move_again(columns, i, tau, speed_of_light);
        return;
    }
    double *acceleration = phys_acceleration(columns);
    for (size_t k = 0; k < columns->dimensions; k++)
        acceleration[k] = 0;
}
