// force_single.c: forces on one particle at a time (4.2). v velocity, r radius, m mass, q charge, S strength.
#include "maths/random.h"
#include "physics/internal.h"

// (force_k + acceleration_k · m) · S
static void constant_force(const Columns *columns, size_t i, const Force *force) {
    size_t n = columns->dimensions, stride = columns->stride;
    for (size_t k = 0; k < n; k++) {
        double acceleration = phys_at(force->given.vector2, k) * columns->mass[i];
        columns->force[k * stride + i] += (phys_at(force->given.vector, k) + acceleration) * force->strength;
    }
}

// S · normal(seed)[index], index counting up by one for each component of each particle, over all steps of a frame
static void random_force(const Columns *columns, size_t i, Force *force) {
    size_t n = columns->dimensions, stride = columns->stride;
    for (size_t k = 0; k < n; k++)
        columns->force[k * stride + i] += force->strength * random_normal(force->given.key, force->item++);
}

// S · direction_k · q
static void field_force(const Columns *columns, size_t i, const Force *force) {
    size_t n = columns->dimensions, stride = columns->stride;
    for (size_t k = 0; k < n; k++)
        columns->force[k * stride + i] += force->strength * phys_at(force->given.vector, k) * columns->charge[i];
}

// r ≠ 0:  − (v_k − flow_k) · c,  c = min(S · sqrt(Σ (v−flow)²) · r^(n−1), m / delta)
static void drag_force(const Columns *columns, size_t i, const Force *force, double delta) {
    if (columns->radius[i] == 0)
        return;
    size_t n = columns->dimensions, stride = columns->stride;
    double square = 0;
    for (size_t k = 0; k < n; k++) {
        double relative = columns->velocity[k * stride + i] - phys_at(force->given.vector, k);
        square += relative * relative;
    }
    double coefficient = force->strength * sqrt(square) * columns->section[i];
    double limit = columns->mass[i] / delta;
    // This way round a NaN (0 · ∞) stays one: the force does not act, instead of stopping the particle.
    if (coefficient > limit)
        coefficient = limit;
    for (size_t k = 0; k < n; k++) {
        double relative = columns->velocity[k * stride + i] - phys_at(force->given.vector, k);
        columns->force[k * stride + i] -= relative * coefficient;
    }
}

// r ≠ 0 and m ≠ 0:  gravity_k · (S · (m − r^n · density))
static void buoyancy_force(const Columns *columns, size_t i, const Force *force) {
    double mass = columns->mass[i];
    if (columns->radius[i] == 0 || mass == 0)
        return;
    size_t n = columns->dimensions, stride = columns->stride;
    double weight = force->strength * (mass - columns->volume[i] * force->given.density);
    for (size_t k = 0; k < n; k++)
        columns->force[k * stride + i] += phys_at(force->given.vector, k) * weight;
}

static void apply_single(const Columns *columns, size_t i, Force *force, double delta) {
    switch (force->given.kind) {
    case PHYS_CONSTANT:
        constant_force(columns, i, force);
        break;
    case PHYS_RANDOM:
        random_force(columns, i, force);
        break;
    case PHYS_FIELD:
        field_force(columns, i, force);
        break;
    case PHYS_DRAG:
        drag_force(columns, i, force, delta);
        break;
    default:
        buoyancy_force(columns, i, force);
        break;
    }
}

void phys_apply_singles(const Columns *columns, const Group *group, ForceRange forces, double delta) {
    for (Force *force = forces.begin; force < forces.end; force++)
        for (size_t i = group->first, end = i + group->count; i < end; i++)
            if (!columns->anchor[i])
                apply_single(columns, i, force, delta);
}
