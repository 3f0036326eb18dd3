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

// p_k = p_k − τ · v_k;  v_k = v_k − τ · a_k
static void move_back_to_contact(const Columns *columns, size_t i, double tau) {
    size_t n = columns->dimensions, stride = columns->stride;
    const double *acceleration = phys_acceleration(columns);
    for (size_t k = 0; k < n; k++) {
        double *v = &columns->velocity[k * stride + i];
        columns->position[k * stride + i] -= tau * *v;
        *v -= tau * acceleration[k];
    }
}

// v_k = v_k − speed · normal_k
static void reduce_velocity(const Columns *columns, size_t i, const PhysForce *barrier, double speed) {
    size_t n = columns->dimensions, stride = columns->stride;
    for (size_t k = 0; k < n; k++)
        columns->velocity[k * stride + i] -= speed * phys_at(barrier->vector2, k);
}

// b = Σ a_k · normal_k
static double acceleration_along(const Columns *columns, const PhysForce *barrier) {
    const double *acceleration = phys_acceleration(columns);
    double sum = 0;
    for (size_t k = 0; k < columns->dimensions; k++)
        sum += acceleration[k] * phys_at(barrier->vector2, k);
    return sum;
}

// v_k = v_k · restitution, reflected if it still points behind the barrier
static void hit(const Columns *columns, size_t i, const PhysForce *barrier) {
    for (size_t k = 0; k < columns->dimensions; k++)
        columns->velocity[k * columns->stride + i] *= barrier->restitution;
    double c = velocity_along(columns, i, barrier);
    if (c < 0)
        reduce_velocity(columns, i, barrier, 2 * c);
}

// Keeps a particle that has moved for the time `tau` since its contact on the right side of the barrier. Sets
// a_k = (v_k − u_k) / tau, where u is its velocity at the contact, or 0 if tau is not above 0.
static void end_bounce(const Columns *columns, size_t i, const PhysForce *barrier, double tau, const double *u) {
    double w = velocity_along(columns, i, barrier);
    if (w < 0)
        reduce_velocity(columns, i, barrier, w);
    double x = particle_height(columns, i, barrier, -columns->radius[phys_numbers_at(columns, i)]);
    if (x < 0)
        put_on_surface(columns, i, barrier, x);
    double *acceleration = phys_acceleration(columns);
    for (size_t k = 0; k < columns->dimensions; k++)
        acceleration[k] = tau > 0 ? (columns->velocity[k * columns->stride + i] - u[k]) / tau : 0;
}

// Returns true if particle i is behind the barrier and moves further behind it; sets *x to its height and *w to its
// velocity along the normal. Puts a particle that is behind it and moves away on the surface.
static bool has_arrived(const Columns *columns, size_t i, const PhysForce *barrier, double *x, double *w) {
    *x = particle_height(columns, i, barrier, -columns->radius[phys_numbers_at(columns, i)]);
    if (*x >= 0)
        return false;
    *w = velocity_along(columns, i, barrier);
    if (*w < 0)
        return true;
    put_on_surface(columns, i, barrier, *x);
    return false;
}

// Moves particle i for the time `tau` with the same force. Returns its velocity before, in the scratch of `columns`.
static const double *move_again(const Columns *columns, size_t i, double tau, double speed_of_light) {
    Block block = block_at(columns, i);
    double *u = phys_acceleration(columns) + columns->dimensions;
    for (size_t k = 0; k < columns->dimensions; k++)
        u[k] = velocity_component(&block, k);
    if (tau > 0)
        move_particles(columns->dimensions, &block, tau, speed_of_light);
    return u;
}

// Symbols are those of single_formulas.h, and a is the acceleration in the move:
//
//   x = −r + Σ (p_k − position_k)·normal_k, added in this order;   w = Σ v_k·normal_k;   b = Σ a_k·normal_k
//   if x ≥ 0: done
//   if not w < 0: put on the surface; done                     because it is already moving away
//   τ = x / w;  if τ > delta: τ = delta                        time since contact, at most the whole step
//   move back to the contact
//   c = Σ v_k·normal_k                                         the speed at which it arrives
//   if c < (b·delta if b < 0, else 0): hit                     it is faster than the force alone makes it in one step
//   else if c < 0: v_k = v_k − (c·(1 + restitution))·normal_k  it lies on the barrier and keeps its speed along it
//   u = v
//   if τ > 0: move again for the time τ, with the same force
//   w as above; if w < 0: v_k = v_k − w·normal_k               not beyond the apex of the bounce
//   x as above; if x < 0: put on the surface
//   a_k = (v_k − u_k) / τ if τ > 0, else 0                     for the next barrier
static void reflect(const Columns *columns, size_t i, const Force *force, double delta, double speed_of_light) {
    const PhysForce *barrier = &force->given;
    double x, w;
    if (!has_arrived(columns, i, barrier, &x, &w))
        return;
    double b = acceleration_along(columns, barrier);
    double tau = x / w;
    if (tau > delta)
        tau = delta;
    move_back_to_contact(columns, i, tau);
    double c = velocity_along(columns, i, barrier);
    if (c < (b < 0 ? b * delta : 0))
        hit(columns, i, barrier);
    else if (c < 0)
        reduce_velocity(columns, i, barrier, c * (1 + barrier->restitution));
    const double *u = move_again(columns, i, tau, speed_of_light);
    end_bounce(columns, i, barrier, tau, u);
}

// The rule of version 0.3 of the specification, which takes back all motion since the contact. Symbols as above.
//
//   x, w and b as above; if x ≥ 0: done; if not w < 0: put on the surface; done
//   τ = x / w;  outside = τ > delta;  if outside: τ = delta
//   move back to the contact;  v_k = v_k·restitution
//   w = Σ v_k·normal_k
//   if outside: x as above; if x < 0: put on the surface
//   if w < 0: v_k = v_k − (2·w)·normal_k
//   if b < 0 and w/b < τ: τ = max(w/b, 0)                      not beyond the apex of the bounce
//   if τ > 0: move again for the time τ, with the same force
//   a_k = (v_k − u_k) / τ if τ > 0, else 0
static void reflect_0_3(const Columns *columns, size_t i, const Force *force, double delta, double speed_of_light) {
    const PhysForce *barrier = &force->given;
    size_t n = columns->dimensions, stride = columns->stride;
    double x, w;
    if (!has_arrived(columns, i, barrier, &x, &w))
        return;
    double b = acceleration_along(columns, barrier);
    double tau = x / w > delta ? delta : x / w;
    bool outside = x / w > delta;
    move_back_to_contact(columns, i, tau);
    for (size_t k = 0; k < n; k++)
        columns->velocity[k * stride + i] *= barrier->restitution;
    w = velocity_along(columns, i, barrier);
    if (outside && (x = particle_height(columns, i, barrier, -columns->radius[phys_numbers_at(columns, i)])) < 0)
        put_on_surface(columns, i, barrier, x);
    if (w < 0)
        reduce_velocity(columns, i, barrier, 2 * w);
    if (b < 0 && w / b < tau)
        tau = w / b > 0 ? w / b : 0;
    const double *u = move_again(columns, i, tau, speed_of_light);
    double *acceleration = phys_acceleration(columns);
    for (size_t k = 0; k < n; k++)
        acceleration[k] = tau > 0 ? (columns->velocity[k * stride + i] - u[k]) / tau : 0;
}

void phys_integrate_reflect(const IntegratePass *pass, size_t i, const double *before) {
    const Columns *columns = pass->columns;
    double *acceleration = phys_acceleration(columns);
    for (size_t k = 0; k < columns->dimensions; k++)
        acceleration[k] = (columns->velocity[k * columns->stride + i] - before[k]) / pass->delta;
    for (uint32_t b = 0; b < pass->barrier_count; b++)
        (pass->old_barriers ? reflect_0_3 : reflect)(columns, i, phys_barriers(pass)[b], pass->delta,
                                                     pass->speed_of_light);
}
