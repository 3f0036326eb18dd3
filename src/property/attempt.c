// attempt.c: runs one case; see property.h.
#include "base/clock.h"
#include "cli/script.h"
#include "property/property.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void violation_free(Violation *violation) {
    text_free(&violation->what);
    text_free(&violation->particle);
    *violation = (Violation){0};
}

static void on_diagnostic(void *context, const PetriDiagnostic *diagnostic) {
    Attempt *attempt = context;
    if (diagnostic->level == PETRI_NOTE)
        return;
    attempt->problems++;
    if (attempt->first_problem.len == 0)
        text_add_c(&attempt->first_problem, diagnostic->text);
}

// Interrupts a frame that would last beyond the deadline.
static bool is_late(void *context) {
    Attempt *attempt = context;
    attempt->expired = attempt->expired || clock_seconds() > attempt->deadline;
    return attempt->expired;
}

PetriSession *attempt_open(Attempt *attempt, const char *text) {
    const Properties *properties = attempt->properties;
    PetriOptions wanted = petri_default_options();
    wanted.stack_limit = properties->host->stack_bytes;
    wanted.threads = 1;
    wanted.keep_modules = true;
    wanted.on_diagnostic = on_diagnostic;
    wanted.user_data = attempt;
    wanted.should_interrupt = isinf(attempt->deadline) ? NULL : is_late;
    PetriSession *session = petri_open(&wanted);
    PetriStatus status = session ? PETRI_OK : PETRI_OUT_OF_MEMORY;
    for (size_t i = 0; status == PETRI_OK && attempt->values && i < properties->range_count; i++) {
        SCOPED_TEXT definition = {0};
        const Range *range = &properties->ranges[i];
        if (attempt->values[i] == range->usual)
            continue;
        text_add_format(&definition, "%s=%.17g", range->name, attempt->values[i]);
        status = petri_define(session, definition.bytes);
    }
    if (status == PETRI_OK)
        status = text ? petri_load_text(session, properties->script, text, strlen(text))
                      : petri_load(session, properties->script);
    if (status != PETRI_OK) {
        if (attempt->first_problem.len == 0)
            text_add_c(&attempt->first_problem, petri_status_text(status));
        petri_close(&session);
    }
    return session;
}

static size_t count_particles(PetriSession *session) {
    PetriSystem system;
    size_t count = 0;
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); s++)
        count += system.particle_count;
    return count;
}

// Checks one property after a frame.
static void check_property(Attempt *attempt, size_t index, bool last) {
    const Property *property = &attempt->properties->items[index];
    Violation *violation = &attempt->violations[index];
    if (violation->found || (attempt->only >= 0 && (size_t)attempt->only != index))
        return;
    bool holds = property->expression              ? expression_holds(attempt, property, last, violation)
                 : property->kind < PROPERTY_ORDER ? motion_holds(attempt, property, index, last, violation)
                                                   : true;
    if (!holds) {
        violation->found = true;
        violation->frame = petri_frame_number(attempt->session);
        violation->particles = count_particles(attempt->session);
    }
}

static bool all_found(const Attempt *attempt) {
    for (size_t i = 0; i < attempt->properties->count; i++)
        if (!attempt->violations[i].found && (attempt->only < 0 || (size_t)attempt->only == i))
            return false;
    return true;
}

// Runs the frames. Properties are checked from frame 1 on, because frame 0 has no state yet.
static bool run_frames(Attempt *attempt) {
    const Properties *properties = attempt->properties;
    for (int64_t frame = 0; frame < properties->frames; frame++) {
        if (petri_step(attempt->session) != PETRI_OK)
            return false;
        for (size_t i = 0; frame > 0 && i < properties->count; i++)
            check_property(attempt, i, frame + 1 == properties->frames);
        if (attempt->expired || (frame > 0 && all_found(attempt)))
            break;
    }
    return true;
}

bool attempt_run(Attempt *attempt) {
    const Properties *properties = attempt->properties;
    attempt->session = attempt_open(attempt, properties->override);
    if (!attempt->session)
        return false;
    attempt->start = memory_calloc(properties->count * sizeof *attempt->start);
    attempt->largest = attempt->largest_momentum = 0;
    bool good = run_frames(attempt);
    petri_close(&attempt->session);
    for (size_t i = 0; i < properties->count && good && !attempt->expired; i++) {
        const Property *property = &properties->items[i];
        bool wanted = attempt->only < 0 || (size_t)attempt->only == i;
        if (wanted && !property->expression && property->kind >= PROPERTY_ORDER)
            attempt->violations[i].found = !compare_holds(attempt, property, &attempt->violations[i]);
    }
    free(attempt->start);
    attempt->start = NULL;
    return good && !attempt->expired;
}

void attempt_free(Attempt *attempt) {
    text_free(&attempt->first_problem);
}
