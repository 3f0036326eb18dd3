// physics_stability.c: reports forces that are certainly unstable (physics/stability.h) and systems whose motion has
// become meaningless (physics/divergence.h).
#include "physics/divergence.h"
#include "physics/explain.h"
#include "physics/stability.h"
#include "scene/systems.h"
#include "value/format.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

enum { NO_FORCE = -1 };

// Returns the position of a force's node in the script, or else that of the system.
static Origin force_place(const PhysicsTree *tree, uint32_t force) {
    const PhysicsSystem *system = tree->system;
    const NodeOrigin *origin = force < system->origin_count ? system->origins[force] : NULL;
    return origin ? origin->origin : node_origin(tree->root, NULL);
}

// Rounds a positive number down to two digits.
static double round_down(double x) {
    double unit = 1;
    while (isfinite(x) && x >= 100 * unit)
        unit *= 10;
    while (x > 0 && x < 10 * unit)
        unit /= 10;
    return unit > 0 ? floor(x / unit * (1 + 1e-9)) * unit : x; // 7199.9999999 is 7200
}

// Adds a resolution of at most `longest` that divides steps of `delta` into equal parts. With unequal steps, springs
// can be unstable although each step is short enough.
static void add_resolution(Text *out, double delta, double longest) {
    double parts = ceil(delta / longest), rate = parts / delta;
    if (fabs(rate - round(rate)) < 1e-9 * rate)
        text_add_format(out, "resolution=1/%.0f", rate);
    else
        text_add_format(out, "resolution=%.6g", delta / parts);
}

void physics_report_instability(PhysicsTree *tree, const Reader *reader, double delta) {
    PhysicsSystem *system = tree->system;
    PhysInstability unstable;
    PhysForce force;
    if (system->stability_checked && system->stability_generation == tree->frame->generation)
        return;
    system->stability_checked = true;
    system->stability_generation = tree->frame->generation;
    if (!phys_find_instability(tree->engine, delta, &unstable) || !phys_get_force(tree->engine, unstable.force, &force))
        return;
    Text out = text_new(reader->arena);
    text_add_format(&out,
                    "this !%s is unstable: with strength=%.6g, each step of %.3g overshoots and energy grows; use "
                    "strength=%.6g or ",
                    schema_kinds[schema_kind_of_force(force.kind)].name, force.strength, delta,
                    round_down(unstable.strength));
    add_resolution(&out, delta, unstable.resolution);
    reader_report_at(reader, "unstable-force", force_place(tree, unstable.force), (Str){0}, text_str(&out));
}

// Returns the number of the force with the largest share in an explanation, PHYS_OWN_FORCE, or NO_FORCE if no force
// acts. The share of a force is the sum over its contributions of their largest components.
static int64_t largest_share(const PhysicsTree *tree, const PhysExplanation *explanation) {
    uint32_t own = phys_force_count(tree->engine), best = 0;
    double *shares = arena_alloc_array(tree->frame->arena, (size_t)own + 1, sizeof *shares);
    memset(shares, 0, ((size_t)own + 1) * sizeof *shares);
    for (uint32_t i = 0; i < explanation->count; i++) {
        uint32_t force = explanation->forces[i] == PHYS_OWN_FORCE ? own : explanation->forces[i];
        const double *vector = explanation->vectors + (size_t)i * tree->dimensions;
        double largest = 0;
        for (uint32_t k = 0; k < tree->dimensions; k++)
            largest = fmax(largest, fabs(vector[k]));
        shares[force] += largest;
        best = shares[force] > shares[best] ? force : best;
    }
    if (!(shares[best] > 0))
        return NO_FORCE;
    return best == own ? (int64_t)PHYS_OWN_FORCE : (int64_t)best;
}

// Adds what drives a particle, and returns its position in the script.
static Origin add_cause(Text *out, const PhysicsTree *tree, int64_t force) {
    PhysForce found;
    bool known = force != NO_FORCE && phys_get_force(tree->engine, (uint32_t)force, &found);
    if (force == PHYS_OWN_FORCE)
        text_add_c(out, "; the largest force on it is its attribute 'force'");
    else if (known)
        text_add_format(out, "; the largest force on it is this !%s; use a smaller 'strength' or 'resolution'",
                        schema_kinds[schema_kind_of_force(found.kind)].name);
    else
        text_add_c(out, "; use a smaller 'resolution'");
    return known ? force_place(tree, (uint32_t)force) : node_origin(tree->root, NULL);
}

void physics_report_divergence(PhysicsTree *tree, const Reader *reader, double clock, double delta) {
    PhysExplanation explanation;
    uint32_t particle;
    PhysDivergence how = phys_find_divergence(tree->engine, &particle);
    if (how == PHYS_CONVERGENT || tree->force_not_finite)
        return;
    const State *state = tree->frame->state;
    Value key = state_slot_key(state, tree->system->mirror.slots[2 * (size_t)particle]);
    Text out = text_new(reader->arena);
    if (how == PHYS_GROWTH)
        text_add_c(&out, "the kinetic energy has grown more than a millionfold in ten steps");
    else
        text_add_c(&out, "a position or velocity has become infinite, or larger than 1e100");
    text_add_format(&out, ", in frame %" PRId64 " at particle ", tree->frame->number);
    format_value(&out, reader->schema->symbols,
                 value_slice(reader->arena, key, tree->prefix.len, key.len - tree->prefix.len));
    PhysStatus status = phys_explain_rows(tree->engine, particle, clock, delta, &explanation);
    Origin place = add_cause(&out, tree, status == PHYS_OK ? largest_share(tree, &explanation) : NO_FORCE);
    phys_explanation_free(&explanation);
    reader_report_at(reader, "divergence", place, (Str){0}, text_str(&out));
}
