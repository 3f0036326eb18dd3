// clock.h: frame numbers, time and beat, in lockstep or by the machine's clock. Only clock.c writes a clock.
#ifndef PETRI_SESSION_CLOCK_H
#define PETRI_SESSION_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

typedef struct ClockRates {
    double fps;
    double tempo;
    double quantum;
} ClockRates;

// From where on the clock runs at its present rates: zeros at first.
typedef struct ClockBase {
    int64_t number;
    double time;
    double beat;
} ClockBase;

// The clock of real time. What it counts is the script's `time`: 0 in frame 0, and the time that the host has held the
// session does not count.
typedef struct WallClock {
    bool running;       // false: the next frame is the first, or the first after a restored state
    double origin;      // what the machine's monotonic clock showed at time 0
    double due;         // the time of the next frame
    double performance; // the script's `performance`, which lockstep has as well
    bool slow_frame;    // … and `slow_frame`
} WallClock;

typedef struct Clock {
    bool realtime;
    int64_t number; // of the present frame; -1 before the first
    double time;
    double beat;
    double delta; // of beats, since the frame before
    ClockRates rates;
    ClockBase base;
    WallClock wall;
} Clock;

double clock_monotonic(void); // seconds
double clock_of_day(void);    // seconds since 1970

// Goes to before frame 0.
void clock_rewind(Clock *clock);
// Changes the rates from the present frame on: time and beat do not jump.
void clock_set_rates(Clock *clock, const ClockRates *rates);
// Goes to the next frame; in real time, waits until it is due.
void clock_advance(Clock *clock);
// Goes to the next frame at another's time and beat, from where the clock goes on.
void clock_advance_to(Clock *clock, double time, double beat);
// Goes to just after a frame at the present rates.
void clock_resume(Clock *clock, int64_t number);
// Real time goes on from that of the present frame, where another clock has been.
void clock_follow_frame(Clock *clock);
// In real time: seconds until the next frame is due, else 0; and see petri_resync_clock.
double clock_seconds_until_due(const Clock *clock);
void clock_resync(Clock *clock);

#endif
