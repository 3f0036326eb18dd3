// clock.h: frame numbers, time and beat, in lockstep or in real time. Only clock.c modifies a clock.
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef struct ClockRates {
    double fps;     // frames per second
    double tempo;   // beats per minute
    double quantum; // value of `quantum` in scripts
} ClockRates;

// The frame from which time and beat are counted: the last one at which the rates changed or the host gave a time.
// Initially all 0.
typedef struct ClockBase {
    int64_t number;
    double time;
    double beat;
} ClockBase;

// State of the clock in real time. It measures the script's `time`, which is 0 in frame 0 and excludes time that the
// host discarded with petri_resync_clock. Units are seconds.
typedef struct WallClock {
    // False if the next frame must start the wall clock, because it is the first frame or follows a restore.
    bool running;
    double origin;      // value of the monotonic clock at time 0
    double due;         // time at which the next frame is due
    double performance; // value of `performance` in scripts; also set in lockstep
    bool slow_frame;    // value of `slow_frame` in scripts
} WallClock;

// The time of a frame in a recording, and other values that scripts see in real time.
typedef struct FrameClock {
    bool lockstep; // true: the time follows from the frame number and the rates; the other fields are not used
    bool realtime; // value of `realtime` in scripts
    bool slow_frame;
    bool is_base; // true: the time and beat of later frames are counted from this frame (petri_step_at)
    double time;
    double beat;
    double performance;
    double unix_time; // value of `clock` in scripts
} FrameClock;

typedef struct Clock {
    bool realtime;
    int64_t number; // number of the current frame; -1: before the first frame
    double time;
    double beat;
    double delta; // beats since the previous frame
    ClockRates rates;
    ClockBase base;
    WallClock wall;
} Clock;

// Rewinds to before frame 0.
void clock_rewind(Clock *clock);
// Changes the rates from the current frame on, without a jump in time or beat.
void clock_set_rates(Clock *clock, const ClockRates *rates);
// Advances to the next frame. In real time, waits until it is due.
void clock_advance(Clock *clock);
// Advances to the next frame at the given time and beat, from which the clock then continues.
void clock_advance_to(Clock *clock, double time, double beat);
// Advances to the next frame, whose time was recorded. In real time, waits until it is due. Afterwards, `realtime` has
// its recorded value; the caller restores it after the frame.
void clock_advance_recorded(Clock *clock, const FrameClock *recorded);
// Sets the clock to a frame that was restored. Computes time and beat from its number and the current rates.
void clock_resume(Clock *clock, int64_t number);
// Makes real time continue from the time of the current frame. Must be called after a clock was replaced by a copy.
void clock_follow_frame(Clock *clock);
// In real time, returns the seconds until the next frame is due. Otherwise returns 0.
double clock_seconds_until_due(const Clock *clock);
// Implements petri_resync_clock.
void clock_resync(Clock *clock);
