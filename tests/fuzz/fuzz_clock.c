// fuzz_clock.c: fuzzes the clock with rates from 1e-300 to 1e300, frame numbers above 2^53, and pauses of years. The
// input is a sequence of actions. Each consists of a byte that selects the action, and a double.
#include "fuzz.h"
#include "petri-inspect.h"
#include "petri-live.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

// The linker uses the functions __wrap_… instead of those without this prefix (meson.build).
int __real_clock_gettime(clockid_t clock, struct timespec *time);
int __wrap_clock_gettime(clockid_t clock, struct timespec *time);
int __real_nanosleep(const struct timespec *pause, struct timespec *left);
int __wrap_nanosleep(const struct timespec *pause, struct timespec *left);

static bool simulated; // true once this harness runs; other harnesses in its program use the real clock
static double now;     // time of the simulated clock in seconds

int __wrap_clock_gettime(clockid_t clock, struct timespec *time) {
    if (!simulated)
        return __real_clock_gettime(clock, time);
    now += 1e-5;
    *time = (struct timespec){(time_t)now + (clock == CLOCK_REALTIME ? 1600000000 : 0), (long)(fmod(now, 1) * 1e9)};
    return 0;
}

int __wrap_nanosleep(const struct timespec *pause, struct timespec *left) {
    if (!simulated)
        return __real_nanosleep(pause, left);
    if (pause->tv_sec < 0 || pause->tv_nsec < 0 || pause->tv_nsec >= 1000000000)
        fuzz_fail("a pause of %lld s %ld ns", (long long)pause->tv_sec, pause->tv_nsec);
    now = fmin(1e15, now + (double)pause->tv_sec + 1e-9 * (double)pause->tv_nsec);
    return 0;
}

static const char SCRIPT[] = "!physics state=:c dimensions=1 time=time\n"
                             "    !particle id=1 velocity=1 ease=1\n"
                             "    !random\n"
                             "!physics state=:b dimensions=1 time=beat resolution=1\n"
                             "    !particle id=1 velocity=1\n"
                             "!counter state=:n rate=1;-2\n"
                             "!counter state=:m rate=frame time=beat reset=(frame==3)\n"
                             "!s t=time b=beat d=delta f=frame c=clock q=quantum p=performance n=$:n\n";

static void jump_to(PetriSession *session, double frame) {
    char text[80];
    if (!(fabs(frame) < 9e17))
        return;
    int length = snprintf(text, sizeof text, "petri-state 1\nframe %lld\n$(:n) = 1;2\n", (long long)frame);
    fuzz_put_state("state", text, (size_t)length);
    petri_restore(session, fuzz_file("state"));
}

static void perform_action(PetriSession *session, PetriSnapshot **snapshot, int what, double x) {
    switch (what & 7) {
    case 0:
        petri_set_fps(session, x);
        break;
    case 1:
        petri_set_tempo(session, x);
        break;
    case 2:
        petri_set_resolution(session, x);
        break;
    case 3:
        now = fmin(1e15, now + (isfinite(x) ? fabs(x) : 0));
        break;
    case 4:
        jump_to(session, x);
        break;
    case 5:
        petri_resync_clock(session);
        if (!(petri_seconds_until_due(session) >= 0))
            fuzz_fail("a frame is due in %g s", petri_seconds_until_due(session));
        break;
    case 6:
        petri_snapshot_free(*snapshot);
        *snapshot = petri_snapshot(session);
        break;
    default:
        if (*snapshot)
            petri_rewind(session, *snapshot);
    }
    petri_step(session);
    fuzz_check_state(session);
}

FUZZ_HARNESS(clock) {
    simulated = true;
    enum { ACTION_SIZE = 1 + sizeof(double), MAX_ACTIONS = 8 };
    PetriOptions options = fuzz_options();
    PetriSnapshot *snapshot = NULL;
    options.work_limit = 1 << 16; // a frame after a long pause has many steps of physics
    options.realtime = size > 0 && data[0] & 128;
    now = 1000;
    PetriSession *session = fuzz_open(&options);
    fuzz_load(session, SCRIPT);
    for (size_t i = 0; i < MAX_ACTIONS && size >= ACTION_SIZE; i++, data += ACTION_SIZE, size -= ACTION_SIZE) {
        double x;
        memcpy(&x, data + 1, sizeof x);
        perform_action(session, &snapshot, data[0], x);
    }
    petri_print(session, PETRI_PRINT_TREE | PETRI_PRINT_STATE, fuzz_sink, NULL);
    petri_snapshot_free(snapshot);
    fuzz_close(&session);
    return 0;
}
