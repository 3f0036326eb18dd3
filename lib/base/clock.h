// clock.h: the clocks of the system.
#pragma once

#include "base/private_api.h"

#include <stdint.h>
#include <time.h>

// Returns the time of a clock in seconds.
double clock_read(clockid_t clock) PRIVATE_API(clock_read);
// Return the time of the monotonic clock, which never jumps, in seconds and in nanoseconds.
double clock_seconds(void) PRIVATE_API(clock_seconds);
uint64_t clock_nanoseconds(void);
