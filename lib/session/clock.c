// clock.c: implementation of clock.h.
#include "session/clock.h"

#include "base/clock.h"

#include <math.h>

void clock_rewind(Clock *clock) {
    *clock = (Clock){
        .realtime = clock->realtime, .number = -1, .rates = clock->rates, .wall.performance = clock->realtime ? 1 : 2};
}

void clock_set_rates(Clock *clock, const ClockRates *rates) {
    bool same = rates->fps == clock->rates.fps && rates->tempo == clock->rates.tempo;
    if (!same && clock->number >= 0)
        clock->base = (ClockBase){clock->number, clock->time, clock->beat};
    clock->rates = *rates;
}

void clock_resume(Clock *clock, int64_t number) {
    clock->base = (ClockBase){0};
    clock->wall.running = false;
    clock->number = number;
    clock->time = (double)number / clock->rates.fps;
    clock->beat = clock->time / (60 / clock->rates.tempo);
}

static double wall_time(const Clock *clock) {
    return clock_seconds() - clock->wall.origin;
}

// Longest delay, in seconds, that a session catches up. If a session is further behind real time, it skips the rest.
static const double MAX_LAG = 0.1;
// Maximum argument of nanosleep in seconds, about three years.
static const double MAX_PAUSE = 1e8;

static double lockstep_time(const Clock *clock) {
    return clock->base.time + (double)(clock->number - clock->base.number) / clock->rates.fps;
}

// Starts the wall clock at the time that the current frame has in lockstep: 0 in frame 0, more after a restore. Returns
// this time.
static double start_wall_clock(Clock *clock) {
    double time = lockstep_time(clock);
    clock->wall.running = true;
    clock->wall.origin = clock_seconds() - time;
    clock->wall.due = time + 1 / clock->rates.fps;
    return time;
}

// Sleeps until the next frame is due, or starts the wall clock if it is not running. Returns the script's `time` of the
// frame: the time at which it was due, unless the session is more than MAX_LAG behind. The threads' moments of waking
// would make all steps of systems unequal, and a system that loses the excess of long steps would be slow.
static double wait_for_frame(Clock *clock) {
    WallClock *wall = &clock->wall;
    if (!wall->running)
        return start_wall_clock(clock);
    double at = wall_time(clock), spare = wall->due - at;
    wall->slow_frame = spare < 0;
    wall->performance += spare > 0.001 ? 0.001 : -0.01;
    wall->performance = fmin(2, fmax(0.5, wall->performance));
    if (spare > 0) {
        spare = fmin(spare, MAX_PAUSE);
        struct timespec pause = {(time_t)spare, (long)((spare - floor(spare)) * 1e9)};
        nanosleep(&pause, NULL);
    }
    double time = fmax(wall->due, at - MAX_LAG);
    wall->due = time + 1 / clock->rates.fps;
    return time;
}

void clock_advance(Clock *clock) {
    const ClockBase *base = &clock->base;
    double last_beat = clock->beat, beat_length = 60 / clock->rates.tempo;
    clock->number++;
    clock->time = clock->realtime ? wait_for_frame(clock) : lockstep_time(clock);
    clock->beat = base->beat + (clock->time - base->time) / beat_length;
    clock->delta = clock->number == 0 ? 0 : clock->beat - last_beat;
}

void clock_advance_to(Clock *clock, double time, double beat) {
    clock->delta = clock->number < 0 ? 0 : beat - clock->beat;
    clock->number++;
    clock->time = time;
    clock->beat = beat;
    clock->base = (ClockBase){clock->number, time, beat};
    clock_follow_frame(clock);
}

void clock_advance_recorded(Clock *clock, const FrameClock *recorded) {
    if (clock->realtime)
        wait_for_frame(clock);
    clock->realtime = !recorded->lockstep && recorded->realtime;
    clock->wall.performance = recorded->lockstep ? 2 : recorded->performance;
    clock->wall.slow_frame = !recorded->lockstep && recorded->slow_frame;
    if (recorded->lockstep) {
        clock_advance(clock);
        return;
    }
    double last_beat = clock->beat;
    clock->number++;
    clock->time = recorded->time;
    clock->beat = recorded->beat;
    clock->delta = clock->number == 0 ? 0 : clock->beat - last_beat;
    if (recorded->is_base)
        clock->base = (ClockBase){clock->number, clock->time, clock->beat};
}

double clock_seconds_until_due(const Clock *clock) {
    return clock->wall.running ? fmax(0, clock->wall.due - wall_time(clock)) : 0;
}

// Changes the origin of the wall clock so that the next frame is due now.
static void set_to_due(Clock *clock) {
    clock->wall.due = clock->time + 1 / clock->rates.fps;
    clock->wall.origin = clock_seconds() - clock->wall.due;
}

void clock_resync(Clock *clock) {
    if (!clock->wall.running)
        return;
    double due = clock->time + 1 / clock->rates.fps;
    if (wall_time(clock) > due)
        set_to_due(clock);
    clock->wall.due = due;
}

void clock_follow_frame(Clock *clock) {
    clock->wall.running = clock->wall.running && clock->number >= 0;
    if (clock->wall.running)
        set_to_due(clock);
}
