// motion.c: see motion.h.
#include "cli/motion.h"

#include "cli/cells.h"
#include "petri-inspect.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SPACE = 3 };

// Sums over all particles except anchors.
typedef struct Motion {
    double kinetic_energy;
    double *momentum;      // sum of mass * velocity, one value per dimension
    double angular[SPACE]; // sum of mass * position × velocity; in two dimensions, only the last component
    double fastest;        // highest speed
    uint32_t fastest_particle;
} Motion;

typedef struct Rows {
    PetriSession *session;
    const PetriSystem *system;
    int digits;
    MotionRow *row;
    void *user_data;
} Rows;

static const double *at_particle(PetriColumn column, uint32_t particle) {
    return column.data + particle * column.stride;
}

static double speed_square(const PetriSystem *system, uint32_t particle) {
    const double *velocity = at_particle(system->velocity, particle);
    double square = 0;
    for (uint32_t k = 0; k < system->dimensions; k++)
        square += velocity[k] * velocity[k];
    return square;
}

double particle_speed(const PetriSystem *system, uint32_t particle) {
    return sqrt(speed_square(system, particle));
}

static bool is_anchor(const PetriSystem *system, uint32_t particle) {
    return system->anchor[particle * system->anchor_stride];
}

uint32_t motion_count(const PetriSystem *system) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < system->particle_count; i++)
        count += !is_anchor(system, i);
    return count;
}

static void add_angular_momentum(Motion *motion, const PetriSystem *system, uint32_t i, double mass) {
    double p[SPACE] = {0}, v[SPACE] = {0};
    for (uint32_t k = 0; k < system->dimensions && k < SPACE; k++) {
        p[k] = at_particle(system->position, i)[k];
        v[k] = at_particle(system->velocity, i)[k];
    }
    for (int k = 0; k < SPACE; k++) {
        int a = (k + 1) % SPACE, b = (k + 2) % SPACE;
        motion->angular[k] += mass * (p[a] * v[b] - p[b] * v[a]);
    }
}

static void add_particle(Motion *motion, const PetriSystem *system, uint32_t i) {
    const double *velocity = at_particle(system->velocity, i);
    double square = speed_square(system, i), speed = sqrt(square), mass = *at_particle(system->mass, i);
    for (uint32_t k = 0; k < system->dimensions; k++)
        motion->momentum[k] += mass * velocity[k];
    motion->kinetic_energy += 0.5 * mass * square;
    add_angular_momentum(motion, system, i, mass);
    if (motion->fastest < 0 || speed > motion->fastest) {
        motion->fastest_particle = i;
        motion->fastest = speed;
    }
}

static void add_vector_row(const Rows *rows, const char *name, const double *vector, uint32_t count, bool complete) {
    SCOPED_TEXT text = {0};
    for (uint32_t k = 0; k < count; k++)
        text_add_format(&text, "%s%.*g", k == 0 ? "" : ";", rows->digits, vector[k]);
    text_add_c(&text, complete ? "" : ";…");
    rows->row(rows->user_data, name, text.bytes);
}

static void add_force_row(const Rows *rows, size_t system, uint32_t number, double energy) {
    SCOPED_TEXT name = {0};
    PetriForce force;
    if (!petri_system_force(rows->session, system, number, &force, sizeof force))
        return;
    text_add_format(&name, "  !%s", force.kind);
    if (force.line > 0)
        text_add_format(&name, ", line %" PRIu32, force.line);
    if (isnan(energy))
        rows->row(rows->user_data, name.bytes, "none");
    else
        add_vector_row(rows, name.bytes, &energy, 1, true);
}

const char *const motion_quantity_names[MOTION_QUANTITIES] = {"energy", "kinetic_energy", "potential_energy",
                                                              "momentum", "angular_momentum"};

MotionQuantity motion_quantity(const char *name) {
    MotionQuantity quantity = 0;
    while (quantity < MOTION_QUANTITIES && strcmp(name, motion_quantity_names[quantity]) != 0)
        quantity++;
    return quantity;
}

static Motion measure_motion(const PetriSystem *system) {
    Motion motion = {.momentum = memory_calloc(system->dimensions * sizeof(double)), .fastest = -1};
    for (uint32_t i = 0; i < system->particle_count; i++)
        if (!is_anchor(system, i))
            add_particle(&motion, system, i);
    return motion;
}

// Adds the potential energy of a system to *sum.
static PetriStatus add_potential_energy(PetriSession *session, size_t number, const PetriSystem *system, double *sum) {
    for (uint32_t i = 0; i < system->force_count; i++) {
        double energy;
        PetriStatus status = petri_potential_energy(session, number, i, &energy);
        if (status != PETRI_OK)
            return status;
        *sum += isnan(energy) ? 0 : energy;
    }
    return PETRI_OK;
}

void motion_energies(PetriSession *session, size_t number, const PetriSystem *system, double *kinetic,
                     double *potential) {
    Motion motion = measure_motion(system);
    *kinetic = motion.kinetic_energy;
    *potential = 0;
    if (add_potential_energy(session, number, system, potential) != PETRI_OK)
        *potential = NAN;
    free(motion.momentum);
}

static void add_cell(Text *cells, const double *values, uint32_t count) {
    SCOPED_TEXT text = {0};
    for (uint32_t k = 0; count > 1 && k < count; k++)
        text_add_format(&text, "%s%.17g", k == 0 ? "" : ";", values[k]);
    cell_add(cells, count == 0   ? (Cell){.kind = CELL_NONE}
                    : count == 1 ? (Cell){CELL_NUMBER, {.number = values[0]}}
                                 : (Cell){CELL_TEXT, {.text = text.bytes}});
}

PetriStatus motion_add_quantity(PetriSession *session, MotionQuantity quantity, Text *cells) {
    PetriSystem system;
    double energy = 0, angular[SPACE] = {0}, *momentum = NULL;
    uint32_t dimensions = 0;
    PetriStatus status = PETRI_OK;
    for (size_t number = 0; status == PETRI_OK && petri_system(session, number, &system, sizeof system); number++) {
        Motion motion = measure_motion(&system);
        if (system.dimensions > dimensions) {
            momentum = memory_realloc(momentum, system.dimensions * sizeof *momentum);
            for (; dimensions < system.dimensions; dimensions++)
                momentum[dimensions] = 0;
        }
        for (uint32_t k = 0; k < system.dimensions; k++)
            momentum[k] += motion.momentum[k];
        for (int k = 0; k < SPACE; k++)
            angular[k] += motion.angular[k];
        energy += quantity == MOTION_POTENTIAL_ENERGY ? 0 : motion.kinetic_energy;
        if (quantity == MOTION_ENERGY || quantity == MOTION_POTENTIAL_ENERGY)
            status = add_potential_energy(session, number, &system, &energy);
        free(motion.momentum);
    }
    const double *values = quantity == MOTION_MOMENTUM ? momentum : &energy;
    uint32_t count = quantity == MOTION_MOMENTUM ? dimensions : 1;
    if (quantity == MOTION_ANGULAR_MOMENTUM) {
        values = angular + (dimensions == 2 ? 2 : 0);
        count = dimensions == 2 ? 1 : dimensions == SPACE ? SPACE : 0;
    }
    if (status == PETRI_OK)
        add_cell(cells, values, count);
    free(momentum);
    return status;
}

// Adds rows of potential energies and of the total energy, unless no force has a potential energy.
static void add_potential_rows(const Rows *rows, size_t system, double kinetic) {
    enum { MAX_FORCES = 20 };
    double energies[MAX_FORCES], potential = 0;
    uint32_t known = 0, count = rows->system->force_count;
    for (uint32_t i = 0; i < count; i++) {
        double energy;
        PetriStatus status = petri_potential_energy(rows->session, system, i, &energy);
        if (status != PETRI_OK) {
            rows->row(rows->user_data, "potential energy", petri_status_text(status));
            return;
        }
        known += !isnan(energy);
        potential += isnan(energy) ? 0 : energy;
        if (i < MAX_FORCES)
            energies[i] = energy;
    }
    if (known == 0)
        return;
    add_vector_row(rows, "potential energy", &potential, 1, true);
    for (uint32_t i = 0; i < count && count > 1 && count <= MAX_FORCES; i++)
        add_force_row(rows, system, i, energies[i]);
    add_vector_row(rows, "total energy", &(double){kinetic + potential}, 1, true);
}

void motion_rows(PetriSession *session, size_t number, const PetriSystem *system, int digits, uint32_t max_components,
                 MotionRow *row, void *user_data) {
    const Rows rows = {session, system, digits, row, user_data};
    uint32_t n = system->dimensions, components = n < max_components ? n : max_components;
    Motion motion = measure_motion(system);
    if (motion.fastest >= 0) {
        SCOPED_TEXT fastest = {0};
        add_vector_row(&rows, "kinetic energy", &motion.kinetic_energy, 1, true);
        add_vector_row(&rows, "momentum", motion.momentum, components, components == n);
        if (n == 2 || n == SPACE)
            add_vector_row(&rows, "angular momentum", motion.angular + (n == 2 ? 2 : 0), n == 2 ? 1 : n, true);
        const char *id = petri_format_value(session, petri_particle_id(session, number, motion.fastest_particle));
        text_add_format(&fastest, "%s at %.*g", !id ? "" : id, digits, motion.fastest);
        row(user_data, "fastest particle", fastest.bytes);
        add_potential_rows(&rows, number, motion.kinetic_energy);
    }
    free(motion.momentum);
}
