// particles.c: the particle systems of a frame, as tables: particles, energies.
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/table.h"
#include "repl/repl.h"
#include "repl/words.h"

static bool is_meant(const char *name, const char *wanted) {
    return wanted[0] == '\0' || strcmp(name, wanted) == 0 || (name[0] == ':' && strcmp(name + 1, wanted) == 0);
}

// What a table is asked for.
typedef struct Wish {
    const char *system; // "": all of them
    size_t most;        // rows of each
} Wish;

// Calls `show` for each system that is meant.
static bool each_system(Repl *repl, const Wish *wish, void (*show)(Repl *, size_t, const PetriSystem *, const Wish *)) {
    PetriSystem system;
    const char *wanted = wish->system;
    size_t count = 0, shown = 0;
    repl_complete_frame(repl);
    for (; petri_system(repl->session, count, &system); count++) {
        char *name = memory_copied(system.name, strlen(system.name)); // the next call takes it
        system.name = name;
        if (is_meant(name, wanted)) {
            show(repl, count, &system, wish);
            shown++;
        }
        free(name);
    }
    if (count == 0) {
        repl_say(repl, petri_frame(repl->session).number < 0
                           ? "there are no particles before the first frame; .step makes it"
                           : "no particle system was updated in this frame");
    } else if (shown == 0) {
        return repl_fail(repl, "there is no system '%.40s'", wanted);
    }
    return true;
}

static void add_vector(Table *table, const double *vector, uint32_t dimensions) {
    char number[40];
    Bytes cell = {0};
    for (uint32_t k = 0; k < dimensions && vector != NULL; k++) {
        snprintf(number, sizeof number, "%s%.6g", k == 0 ? "" : ";", vector[k]);
        bytes_add(&cell, number, strlen(number));
    }
    table_add(table, vector == NULL ? "-" : cell.data);
    bytes_free(&cell);
}

static void add_number(Table *table, double x) {
    add_vector(table, &x, 1);
}

static double speed_of(const PetriParticle *particle, uint32_t dimensions) {
    double sum = 0;
    for (uint32_t k = 0; k < dimensions; k++) {
        sum += particle->velocity[k] * particle->velocity[k];
    }
    return sqrt(sum);
}

static uint32_t count_anchors(const Repl *repl, size_t number) {
    PetriParticle particle;
    uint32_t anchors = 0;
    for (uint32_t i = 0; petri_particle(repl->session, number, i, &particle); i++) {
        anchors += particle.anchor;
    }
    return anchors;
}

static void show_particles(Repl *repl, size_t number, const PetriSystem *system, const Wish *wish) {
    Table table = table_new(5);
    PetriParticle particle;
    uint32_t anchors = count_anchors(repl, number), moving = system->particle_count - anchors;
    output_format(&repl->output, "%s: %" PRIu32 " particle%s", system->name, moving, moving == 1 ? "" : "s");
    if (anchors > 0) {
        output_format(&repl->output, ", %" PRIu32 " anchor%s", anchors, anchors == 1 ? "" : "s");
    }
    output_write(&repl->output, "\n", 1);
    const char *const heads[] = {"id", "position", "velocity", "speed", "force"};
    for (size_t i = 0; i < 5; i++) {
        table_add(&table, heads[i]);
    }
    for (uint32_t i = 0; i < wish->most && petri_particle(repl->session, number, i, &particle); i++) {
        table_add(&table, particle.id);
        add_vector(&table, particle.position, system->dimensions);
        add_vector(&table, particle.velocity, system->dimensions);
        add_number(&table, speed_of(&particle, system->dimensions));
        if (particle.anchor) {
            table_add(&table, "anchor");
        } else {
            add_vector(&table, particle.force, system->dimensions);
        }
    }
    table_write(&table, &repl->output);
    table_free(&table);
    if (system->particle_count > wish->most) {
        repl_say(repl, "%zu more; .particles%s%s all shows all", system->particle_count - wish->most,
                 wish->system[0] == '\0' ? "" : " ", wish->system);
    }
}

bool repl_show_particles(Repl *repl, const char *rest) {
    enum { AROUND = 5 }; // lines of the screen beside the rows: command, title, heads, closing line, prompt
    char *system = memory_copied(rest, strlen(rest));
    Wish wish = {.system = system, .most = word_lines(repl, system, AROUND)};
    bool good = each_system(repl, &wish, show_particles);
    free(system);
    return good;
}

static void show_energy(Repl *repl, size_t number, const PetriSystem *system, const Wish *wish) {
    (void)wish;
    PetriParticle particle;
    double *momentum = memory_zeroed(system->dimensions * sizeof *momentum);
    double energy = 0, fastest = -1;
    uint32_t moving = 0;
    Bytes id = {0};
    for (uint32_t i = 0; petri_particle(repl->session, number, i, &particle); i++) {
        if (particle.anchor) {
            continue;
        }
        double speed = speed_of(&particle, system->dimensions);
        moving++;
        energy += 0.5 * particle.mass * speed * speed;
        for (uint32_t k = 0; k < system->dimensions; k++) {
            momentum[k] += particle.mass * particle.velocity[k];
        }
        if (speed > fastest) {
            fastest = speed;
            id.length = 0;
            bytes_add(&id, particle.id, strlen(particle.id));
        }
    }
    output_format(&repl->output, "%s: %" PRIu32 " particle%s, %" PRIu64 " step%s\n", system->name, moving,
                  moving == 1 ? "" : "s", system->steps, system->steps == 1 ? "" : "s");
    if (moving > 0) {
        Table table = table_new(2);
        table_add(&table, "  kinetic energy");
        add_number(&table, energy);
        table_add(&table, "  momentum");
        add_vector(&table, momentum, system->dimensions);
        table_add(&table, "  fastest");
        bytes_format(&id, " at %.6g", fastest);
        table_add(&table, id.data);
        table_write(&table, &repl->output);
        table_free(&table);
    }
    bytes_free(&id);
    free(momentum);
}

bool repl_show_energy(Repl *repl, const char *wanted) {
    return each_system(repl, &(Wish){.system = wanted}, show_energy);
}
