// clock.h: the clocks of the system.
#pragma once

#include <stdint.h>
#include <time.h>

// Returns the time of a clock in seconds.
double clock_read(clockid_t clock);
// Return the time of the monotonic clock, which never jumps, in seconds and in nanoseconds.
double clock_seconds(void);
uint64_t clock_nanoseconds(void);
