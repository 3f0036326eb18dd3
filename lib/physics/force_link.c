// force_link.c: forces between two given particles (4.1, `!distance`).
//
//   d_k = to_k − from_k;  l = sqrt(d_0² + d_1² + …);  inv = 1 / l;  u_k = d_k · inv
//   l < min:       f_k = u_k · ((min − l)^power · strength),  from − f,  to + f
//   else l > max:  f_k = u_k · ((l − max)^power · strength),  from + f,  to − f
#include "physics/internal.h"

#include <float.h>

static double link_length(const Columns *columns, size_t from, size_t to) {
    size_t n = columns->dimensions, stride = columns->stride;
    double square = 0;
    for (size_t k = 0; k < n; k++) {
        double d = columns->position[k * stride + to] - columns->position[k * stride + from];
        square += d * d;
    }
    return sqrt(square);
}

static void apply_link(const Columns *columns, const Force *force) {
    const PhysForce *link = &force->given;
    if (link->from == link->to)
        return;
    double length = link_length(columns, link->from, link->to);
    if (!(length > 0 && length <= DBL_MAX))
        return;
    double coefficient; // positive pulls the two together
    if (link->has_minimum && length < link->minimum)
        coefficient = -(phys_power(link->minimum - length, link->power) * force->strength);
    else if (link->has_maximum && length > link->maximum)
        coefficient = phys_power(length - link->maximum, link->power) * force->strength;
    else
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
