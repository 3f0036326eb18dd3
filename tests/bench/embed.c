// embed.c: a host of petri.h, for comparison with `petri run` by embed.sh. `embed SCRIPT FRAMES` runs a script and
// computes the mean speed of all particles after each frame from the library's columns.
#include "petri.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static double speed_sum(const PetriSystem *system) {
    double sum = 0;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const double *velocity = system->velocity.data + i * system->velocity.stride;
        sum += sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1]);
    }
    return sum;
}

int main(int argc, char **argv) {
    PetriOptions options = petri_default_options();
    options.memory_limit = (size_t)8 << 30;
    options.work_limit = (uint64_t)100 << 30;
    PetriSession *session = petri_open(&options);
    PetriStatus status = argc == 3 ? petri_load(session, argv[1]) : PETRI_INVALID;
    PetriSystem system;
    double sum = 0;
    for (long frame = argc == 3 ? strtol(argv[2], NULL, 10) : 0; frame > 0 && status == PETRI_OK; frame--) {
        status = petri_step(session);
        sum = petri_system(session, 0, &system, sizeof system) ? speed_sum(&system) / system.particle_count : 0;
    }
    printf("%.17g\n", sum);
    petri_close(&session);
    return status != PETRI_OK;
}
