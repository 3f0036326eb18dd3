// speed.c: runs a script without drawing it and prints the mean speed of its particles every 40 frames.
//
//   cc speed.c -o speed $(pkg-config --cflags --libs petri) -lm && ./speed
//
// The script calls `kick`, a function of this program. The program reads the value of a counter from the state, which a
// script would read as `$:age`.
#include <math.h>
#include <petri.h>
#include <stdio.h>

static const char script[] = "%pragma fps 60\n"
                             "!physics state=:gas dimensions=2 time=time resolution=1/120\n"
                             "    for i in ..1000\n"
                             "        !particle id=i position=(uniform(:x;i)[..2]-0.5)*400 radius=2 force=kick(i)\n"
                             "    !collision strength=200\n"
                             "    !drag strength=0.01\n"
                             "!counter state=:age rate=1\n";

// Returns a force vector whose direction depends on the argument, the number of a particle.
static PetriValue kick(PetriCall *call, void *user_data, const PetriValue *arguments, uint32_t count) {
    (void)count;
    double *push = petri_call_alloc_numbers(call, 2);
    if (push == NULL || arguments[0].length != 1 || arguments[0].numbers == NULL) {
        petri_call_error(call, "expected one number");
        return (PetriValue){0};
    }
    push[0] = *(double *)user_data * cos(arguments[0].numbers[0]);
    push[1] = *(double *)user_data * sin(arguments[0].numbers[0]);
    return (PetriValue){.length = 2, .numbers = push};
}

static double mean_speed(const PetriSystem *system) {
    double sum = 0;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const double *velocity = system->velocity.data + i * system->velocity.stride;
        sum += hypot(velocity[0], velocity[1]);
    }
    return system->particle_count > 0 ? sum / system->particle_count : 0;
}

static void tell(void *user_data, const PetriDiagnostic *diagnostic) {
    (void)user_data;
    fputs(diagnostic->rendered, stderr);
}

int main(void) {
    double strength = 100;
    PetriOptions options = petri_default_options();
    options.on_diagnostic = tell;
    PetriSession *session = petri_open(&options);
    PetriFunction function = {.size = sizeof function,
                              .name = "kick",
                              .parameters = "number",
                              .help = "A push in a different direction for each number.",
                              .call = kick,
                              .user_data = &strength};
    PetriStatus status = petri_add_function(session, &function);
    if (status == PETRI_OK)
        status = petri_load_text(session, "speed.fl", script, PETRI_NUL_TERMINATED);
    double key = petri_symbol(session, "age");
    for (int frame = 0; frame <= 120 && status == PETRI_OK; frame++) {
        PetriSystem gas;
        status = petri_step(session);
        PetriValue age = petri_state_get(session, (PetriValue){.length = 1, .numbers = &key});
        if (frame % 40 == 0 && petri_system(session, 0, &gas, sizeof gas))
            printf("%3d: %u particles, age %.3g, mean speed %.2f\n", frame, gas.particle_count,
                   age.length == 1 ? age.numbers[0] : 0, mean_speed(&gas));
    }
    if (status != PETRI_OK)
        fprintf(stderr, "speed: %s\n", petri_status_text(status));
    petri_close(&session);
    return status != PETRI_OK;
}
