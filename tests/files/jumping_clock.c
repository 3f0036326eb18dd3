// jumping_clock.c: replaces clock_gettime by clocks that jump, for LD_PRELOAD. About every 20th call moves a clock: the
// real-time clock by up to a day in any direction, as if it were set, and the monotonic clock by up to an hour
// forwards, as if the machine had been suspended. CLOCK_JUMP: seed of the jumps.
#include <stdint.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

enum { HOUR = 3600, DAY = 24 * HOUR, CALLS = 20 };

#pragma GCC visibility push(default)
int clock_gettime(clockid_t clock, struct timespec *now) {
    static time_t real_offset, monotonic_offset;
    static uint32_t number;
    int result = (int)syscall(SYS_clock_gettime, clock, now);
    if (result != 0 || (clock != CLOCK_REALTIME && clock != CLOCK_MONOTONIC))
        return result;
    const char *seed = getenv("CLOCK_JUMP");
    number = (number ? number : seed ? (uint32_t)atoi(seed) : 1) * 1664525 + 1013904223;
    if ((number >> 16) % CALLS == 0) {
        real_offset += (time_t)((number >> 8) % (2 * DAY)) - DAY;
        monotonic_offset += (time_t)((number >> 8) % HOUR);
    }
    now->tv_sec += clock == CLOCK_REALTIME ? real_offset : monotonic_offset;
    return 0;
}
