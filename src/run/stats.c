// stats.c: the table that `petri run --stats` closes with.
#include "run/stats.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/bytes.h"

void stats_count(Stats *stats, PetriSession *session) {
    PetriFrame frame = petri_frame(session);
    stats->frames++;
    stats->physics_steps += frame.physics_steps;
    stats->evaluation_seconds += frame.evaluation_seconds;
    stats->physics_seconds += frame.physics_seconds;
    PetriSystem system;
    for (size_t i = 0; frame.physics_steps > 0 && petri_system(session, i, &system); i++) {
        stats->particle_steps += (double)system.steps * system.particle_count;
    }
}

// What is measured of one system (kinetic energy: half the mass times the speed squared; momentum: mass times
// velocity).
typedef struct Motion {
    uint32_t moving;
    double kinetic_energy;
    double *momentum;
    double fastest;
    char *fastest_id; // or NULL
} Motion;

static void add_particle(Motion *motion, const PetriParticle *particle, uint32_t dimensions) {
    double square = 0;
    for (uint32_t k = 0; k < dimensions; k++) {
        square += particle->velocity[k] * particle->velocity[k];
        motion->momentum[k] += particle->mass * particle->velocity[k];
    }
    motion->moving++;
    motion->kinetic_energy += 0.5 * particle->mass * square;
    if (motion->fastest_id == NULL || sqrt(square) > motion->fastest) {
        Bytes id = {0};
        bytes_format(&id, "%s", particle->id);
        free(motion->fastest_id);
        motion->fastest_id = id.data;
        motion->fastest = sqrt(square);
    }
}

static void print_system(PetriSession *session, size_t number, const PetriSystem *system) {
    enum { MOST_COMPONENTS = 4 };
    Motion motion = {.momentum = memory_zeroed(system->dimensions * sizeof(double))};
    PetriParticle particle;
    fprintf(stderr, "  system %s, %" PRIu32 "-dimensional", system->name, system->dimensions);
    for (uint32_t i = 0; i < system->particle_count && petri_particle(session, number, i, &particle); i++) {
        if (!particle.anchor) {
            add_particle(&motion, &particle, system->dimensions);
        }
    }
    fprintf(stderr, ": %" PRIu32 " particle%s", motion.moving, motion.moving == 1 ? "" : "s");
    if (system->particle_count > motion.moving) {
        fprintf(stderr, ", %" PRIu32 " anchor%s", system->particle_count - motion.moving,
                system->particle_count - motion.moving == 1 ? "" : "s");
    }
    fprintf(stderr, "\n    kinetic energy    %.9g\n    momentum          ", motion.kinetic_energy);
    for (uint32_t k = 0; k < system->dimensions && k < MOST_COMPONENTS; k++) {
        fprintf(stderr, "%s%.9g", k == 0 ? "" : ";", motion.momentum[k]);
    }
    fputs(system->dimensions > MOST_COMPONENTS ? ";…\n" : "\n", stderr);
    if (motion.fastest_id != NULL) {
        fprintf(stderr, "    fastest particle  %s at %.9g\n", motion.fastest_id, motion.fastest);
    }
    free(motion.fastest_id);
    free(motion.momentum);
}

static void print_time(const char *what, double seconds, int64_t frames) {
    fprintf(stderr, "  %-18s%.4f ms a frame\n", what, frames > 0 ? seconds * 1e3 / (double)frames : 0);
}

void stats_print(const Stats *stats, PetriSession *session, double seconds) {
    fprintf(stderr, "statistics\n  %-18s%" PRId64 "\n  %-18s%" PRIu64 "\n  %-18s%.3f s\n", "frames", stats->frames,
            "simulation steps", stats->physics_steps, "wall time", seconds);
    print_time("evaluation", stats->evaluation_seconds, stats->frames);
    print_time("physics", stats->physics_seconds, stats->frames);
    print_time("output", stats->output_seconds, stats->frames);
    double rate = stats->physics_seconds > 0 ? stats->particle_steps / stats->physics_seconds : 0;
    fprintf(stderr, "  %-18s%.4g million a second of physics\n", "particle-steps", rate * 1e-6);
    PetriSystem system;
    for (size_t i = 0; petri_system(session, i, &system); i++) {
        Bytes name = {0}; // its text lasts only until the next particle is read
        bytes_format(&name, "%s", system.name);
        system.name = name.data;
        print_system(session, i, &system);
        bytes_free(&name);
    }
}
