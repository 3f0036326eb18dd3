// helpers.c: see helpers.h.
//
// build_petri.py inserts the text of helpers.h before this file. The handler of SIGINT is installed only during calls
// that compute frames, and then restored. If a function of the script makes such a call of another session, the handler
// stays, and only the active session changes.
#include <signal.h>
#include <string.h>

static PetriSession *volatile active_session; // session that the main thread is computing; NULL: none
static volatile sig_atomic_t interrupted;     // 1 if Ctrl-C was pressed since install_handler
static struct sigaction outer;                // Python's handler of SIGINT

static void on_interrupt(int number, siginfo_t *info, void *context) {
    interrupted = 1;
    petri_interrupt(active_session);
    if (outer.sa_flags & SA_SIGINFO)
        outer.sa_sigaction(number, info, context);
    else
        outer.sa_handler(number);
}

// Installs a handler with which Ctrl-C interrupts the active session and is then passed to Python's handler. Returns
// false if Python has no handler.
static bool install_handler(void) {
    struct sigaction ours = {.sa_flags = SA_SIGINFO | SA_RESTART};
    ours.sa_sigaction = on_interrupt;
    interrupted = 0;
    return outer.sa_handler != SIG_IGN && outer.sa_handler != SIG_DFL && sigaction(SIGINT, &ours, NULL) == 0;
}

// A call that Ctrl-C interrupts.
typedef struct Guard {
    PetriSession *before; // the outer session, if this call is made by a function of its script
    bool active;
    bool nested;
} Guard;

static Guard begin_guard(PetriSession *session, bool interruptible) {
    Guard guard = {.before = active_session};
    struct sigaction now = {0};
    guard.active = interruptible && session && sigaction(SIGINT, NULL, &now) == 0;
    guard.nested = guard.active && now.sa_flags & SA_SIGINFO && now.sa_sigaction == on_interrupt;
    if (guard.active)
        active_session = session;
    if (guard.active && !guard.nested) {
        outer = now;
        guard.active = install_handler();
    }
    return guard;
}

static PetriStatus end_guard(PetriSession *session, Guard guard, PetriStatus status) {
    if (guard.active && !guard.nested) {
        sigaction(SIGINT, &outer, NULL);
        if (interrupted && status != PETRI_INTERRUPTED)
            petri_clear_interrupt(session); // Ctrl-C came after the call and must not abort the next one
    }
    if (guard.nested)
        active_session = guard.before;
    return status;
}

PetriStatus petri_python_step(PetriSession *session, size_t count, bool interruptible, const bool *stop) {
    PetriStatus status = session ? PETRI_OK : PETRI_INVALID;
    Guard guard = begin_guard(session, interruptible);
    while (status == PETRI_OK && !(stop && *stop) && count-- > 0)
        status = petri_step(session);
    return end_guard(session, guard, status);
}

PetriStatus petri_python_run_trust(PetriSession *session, const PetriTrustOptions *options, bool interruptible) {
    Guard guard = begin_guard(session, interruptible);
    return end_guard(session, guard, petri_trust(session, options));
}

PetriStatus petri_python_replay(PetriArchive *archive, PetriSession *session, int64_t frame, bool interruptible) {
    Guard guard = begin_guard(session, interruptible);
    return end_guard(session, guard, petri_archive_replay(archive, session, frame));
}

int petri_python_system(PetriSession *session, int number, const char *name, PetriSystem *system) {
    if (number >= 0 && petri_system(session, (size_t)number, system, sizeof *system) &&
        (!name || strcmp(system->name, name) == 0))
        return number;
    for (int i = 0; name && petri_system(session, (size_t)i, system, sizeof *system); i++)
        if (strcmp(system->name, name) == 0)
            return i;
    return -1;
}

bool petri_python_view(PetriSession *session, int number, const char *name, char which, PetriPythonView *view) {
    PetriSystem system;
    if (petri_python_system(session, number, name, &system) < 0)
        return false;
    const PetriColumn *column = which == 'p'   ? &system.position
                                : which == 'v' ? &system.velocity
                                : which == 'f' ? &system.force
                                : which == 'r' ? &system.radius
                                : which == 'm' ? &system.mass
                                               : &system.charge;
    view->address = (uintptr_t)column->data;
    view->count = system.particle_count;
    view->width = strchr("pvf", which) ? system.dimensions : 1;
    view->stride = column->stride;
    return true;
}

bool petri_python_state(PetriSession *session, const double *key, uint32_t length, PetriValue *value) {
    *value = petri_state_get(session, (PetriValue){.length = length, .numbers = key});
    return value->length == 0 || value->numbers;
}

bool petri_python_pair(PetriSession *session, double symbol, double number, PetriValue *value) {
    return petri_python_state(session, (const double[]){symbol, number}, 2, value);
}

void petri_python_called(PetriCall *call, void *user_data, const PetriValue *arguments, uint32_t count,
                         PetriValue *out);

PetriValue petri_python_call(PetriCall *call, void *user_data, const PetriValue *arguments, uint32_t count) {
    PetriValue result = {0};
    petri_python_called(call, user_data, arguments, count, &result);
    return result;
}

void petri_python_close(PetriSession *session) {
    petri_close(&session);
}

void petri_python_painter_close(PetriPainter *painter) {
    petri_painter_close(&painter);
}

void petri_python_picture_free(PetriPicture *picture) {
    petri_picture_free(&picture);
}

void petri_python_picture_options(PetriPictureOptions *options) {
    *options = petri_default_picture_options();
}
