// force_link.c: forces between two given particles (`!distance`, spec physics.md 4.1). The formulas are in
// pair_formulas.h. Links are computed one at a time, in one lane.
#define LANES 1
#include "physics/internal.h"
#include "physics/pair_formulas.h"

static double link_length(const Columns *columns, size_t from, size_t to) {
    size_t n = columns->dimensions, stride = columns->stride;
    double square = 0;
    for (size_t k = 0; k < n; k++) {
        double d = columns->position[k * stride + to] - columns->position[k * stride + from];
        square += d * d;
    }
    return sqrt(square);
}

static bool link_coefficient(const Force *force, double length, double *coefficient) {
    switch (force->given.kind) {
#define LINK(KIND, name)                                                                                               \
    case PHYS_##KIND:                                                                                                  \
        return link_##name(&force->given, force->strength, length, coefficient);
#define OTHER(KIND, ...) case PHYS_##KIND:
        PHYS_FORCES(PHYS_NO_ROW, LINK, PHYS_NO_ROW, PHYS_NO_ROW)
        PHYS_FORCES(OTHER, PHYS_NO_ROW, OTHER, OTHER)
#undef LINK
#undef OTHER
    case PHYS_FORCE_KINDS:
        break;
    }
    __builtin_unreachable(); // STAGE_LINK has only links
}

static void apply_link(const Columns *columns, const Force *force) {
    const PhysForce *link = &force->given;
    if (link->from == link->to)
        return;
    double length = link_length(columns, link->from, link->to);
    if (!(length > 0 && length <= DBL_MAX))
        return;
    double coefficient;
    if (!link_coefficient(force, length, &coefficient))
        return;
    double inverse = 1 / length;
    size_t n = columns->dimensions, stride = columns->stride;
    for (size_t k = 0; k < n; k++) {
        size_t from = k * stride + link->from, to = k * stride + link->to;
        double f = (columns->position[to] - columns->position[from]) * inverse * coefficient;
        columns->force[from] += f;
        columns->force[to] -= f;
    }
}

void phys_apply_links(const Columns *columns, ForceRange forces) {
    for (const Force *force = forces.begin; force < forces.end; force++)
        apply_link(columns, force);
}
