// motion.c: properties with a name, about the particles of one run; see property.h.
#include "cli/motion.h"

#include "base/number.h"
#include "property/property.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SPACE = 3 };

static const double ROUNDING = 1e-9; // of positions, relative to their size

void motion_add_key(PetriSession *session, size_t number, uint32_t particle, Text *key) {
    PetriSystem system;
    if (!petri_system(session, number, &system, sizeof system))
        return;
    SCOPED_STRING name = memory_strdup(system.name);
    const char *id = petri_format_value(session, petri_particle_id(session, number, particle));
    text_add_format(key, "%s;%s", name, id ? id : "");
}

static const double *row(PetriColumn column, uint32_t particle) {
    return column.data + (size_t)particle * column.stride;
}

static bool is_anchor(const PetriSystem *system, uint32_t particle) {
    return system->anchor[(size_t)particle * system->anchor_stride];
}

// Adds a vector as it is printed.
static void add_vector(Text *text, const double *vector, uint32_t count) {
    for (uint32_t k = 0; k < count; k++) {
        text_add_c(text, k > 0 ? ";" : "");
        text_add_number(text, vector[k]);
    }
}

static bool is_finite(const double *vector, uint32_t count) {
    for (uint32_t k = 0; k < count; k++)
        if (!isfinite(vector[k]))
            return false;
    return true;
}

static bool check_finite(PetriSession *session, size_t number, const PetriSystem *system, Violation *violation) {
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const double *position = row(system->position, i), *velocity = row(system->velocity, i);
        if (is_finite(position, system->dimensions) && is_finite(velocity, system->dimensions))
            continue;
        bool where = !is_finite(position, system->dimensions);
        text_add_c(&violation->what, where ? "the position is " : "the velocity is ");
        add_vector(&violation->what, where ? position : velocity, system->dimensions);
        motion_add_key(session, number, i, &violation->particle);
        return false;
    }
    return true;
}

// Returns the distance of a particle's centre from a wall; negative: it is behind the wall.
static double wall_distance(const PetriForce *wall, const double *position, uint32_t dimensions) {
    double distance = 0;
    for (uint32_t k = 0; k < dimensions; k++)
        distance += (position[k] - wall->position[k]) * wall->normal[k];
    return distance;
}

static bool check_wall(PetriSession *session, size_t number, const PetriSystem *system, const PetriForce *wall,
                       double amount, Violation *violation) {
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const double *position = row(system->position, i);
        double radius = row(system->radius, i)[0], size = 0;
        for (uint32_t k = 0; k < system->dimensions; k++)
            size = fmax(size, fabs(position[k]));
        double distance = wall_distance(wall, position, system->dimensions) - radius;
        if (is_anchor(system, i) || distance >= -amount * radius - ROUNDING * (1 + size))
            continue;
        text_add_c(&violation->what, "its edge is ");
        text_add_number(&violation->what, -distance);
        text_add_format(&violation->what, " behind the !barrier in line %u", (unsigned)wall->line);
        motion_add_key(session, number, i, &violation->particle);
        return false;
    }
    return true;
}

static bool check_inside(PetriSession *session, size_t number, const PetriSystem *system, double amount,
                         Violation *violation) {
    PetriForce wall;
    for (uint32_t f = 0; petri_system_force(session, number, f, &wall, sizeof wall); f++)
        if (wall.normal && !check_wall(session, number, system, &wall, amount, violation))
            return false;
    return true;
}

// Adds the momentum of a system to a vector, and returns the sum of the momenta's absolute values.
static double add_momentum(const PetriSystem *system, double *momentum) {
    double sum = 0;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const double *velocity = row(system->velocity, i);
        double mass = is_anchor(system, i) ? 0 : row(system->mass, i)[0], square = 0;
        for (uint32_t k = 0; k < system->dimensions && k < SPACE; k++) {
            momentum[k] += mass * velocity[k];
            square += velocity[k] * velocity[k];
        }
        sum += mass * sqrt(square);
    }
    return sum;
}

static bool check_momentum(Attempt *attempt, const Property *property, Violation *violation) {
    PetriSystem system;
    double momentum[SPACE] = {0}, sum = 0, change = 0;
    for (size_t s = 0; petri_system(attempt->session, s, &system, sizeof system); s++)
        sum += add_momentum(&system, momentum);
    if (petri_frame_number(attempt->session) == 1)
        memcpy(attempt->momentum, momentum, sizeof momentum);
    for (uint32_t k = 0; k < SPACE; k++)
        change = fmax(change, fabs(momentum[k] - attempt->momentum[k]));
    attempt->largest_momentum = fmax(attempt->largest_momentum, sum);
    if (change <= property->amount * attempt->largest_momentum)
        return true;
    text_add_c(&violation->what, "the momentum was ");
    add_vector(&violation->what, attempt->momentum, SPACE);
    text_add_c(&violation->what, " in frame 1 and is ");
    add_vector(&violation->what, momentum, SPACE);
    return false;
}

static bool check_energy(Attempt *attempt, const Property *property, size_t index, bool last, Violation *violation) {
    PetriSystem system;
    double kinetic = 0, total = 0;
    for (size_t s = 0; petri_system(attempt->session, s, &system, sizeof system); s++) {
        double own = 0, potential = 0;
        motion_energies(attempt->session, s, &system, &own, &potential);
        kinetic += own;
        total += own + potential;
    }
    attempt->largest = fmax(attempt->largest, kinetic);
    if (property->kind == PROPERTY_SETTLES) {
        if (!last || kinetic <= property->amount * attempt->largest)
            return true;
        text_add_c(&violation->what, "the kinetic energy is still ");
        text_add_number(&violation->what, kinetic);
        text_add_c(&violation->what, ", and was at most ");
        text_add_number(&violation->what, attempt->largest);
        return false;
    }
    if (petri_frame_number(attempt->session) == 1)
        attempt->start[index] = total;
    double start = attempt->start[index], scale = fmax(fabs(start), attempt->largest);
    if (fabs(total - start) <= property->amount * scale)
        return true;
    text_add_c(&violation->what, "the energy was ");
    text_add_number(&violation->what, start);
    text_add_c(&violation->what, " in frame 1 and is ");
    text_add_number(&violation->what, total);
    return false;
}

bool motion_holds(Attempt *attempt, const Property *property, size_t index, bool last, Violation *violation) {
    PetriSystem system;
    if (property->kind == PROPERTY_MOMENTUM)
        return check_momentum(attempt, property, violation);
    if (property->kind == PROPERTY_ENERGY || property->kind == PROPERTY_SETTLES)
        return check_energy(attempt, property, index, last, violation);
    for (size_t s = 0; petri_system(attempt->session, s, &system, sizeof system); s++)
        if (!(property->kind == PROPERTY_FINITE
                  ? check_finite(attempt->session, s, &system, violation)
                  : check_inside(attempt->session, s, &system, property->amount, violation)))
            return false;
    return true;
}
