// meter.h: how much work and memory a script may have: one budget for all that a session does for it.
//
// Work is counted in units of about ten nanoseconds: a round of a loop, a call, a node, sixteen numbers that are added.
// It is charged before it is done, by what an operation will look at, through the arena that the operation works in
// (arena.h); where that is much, in portions, for each charge is also where an end that the host asks for is heard.
// Memory is what blocks hold, whoever asked for them and whatever is still in use in them.
#ifndef PETRI_BASE_METER_H
#define PETRI_BASE_METER_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Meter {
    uint64_t work;  // done since meter_begin
    uint64_t pause; // when to look next whether to go on
    uint64_t work_limit;
    size_t memory; // bytes held
    size_t memory_limit;
    bool memory_refused;           // since meter_begin
    atomic_bool *interrupt;        // true: the host wants an end; NULL: nobody can ask for one
    bool (*wants_end)(void *host); // asked for such a wish, by the thread that charges; NULL: nobody
    void *host;
    bool keeps; // the host still looks at what is to be freed (arena_retire)
    void *kept; // … which is here: ArenaBlock
} Meter;

// What an array of so many bytes costs that is filled or looked at in a simple loop.
enum { METER_BYTES = 128, METER_NUMBERS = METER_BYTES / sizeof(double) };
// A portion of an array: little enough to be done at once, enough for the charge not to be felt.
enum { METER_PORTION = 1 << 14 };

typedef enum MeterAnswer { METER_GOES_ON, METER_WORK, METER_INTERRUPTED } MeterAnswer;

// Begins a piece of work with a budget of its own.
void meter_begin(Meter *meter, uint64_t work_limit, atomic_bool *interrupt);
// What comes of a charge that went past `pause`.
MeterAnswer meter_look(Meter *meter);

// Charges `units`, and tells whether to go on; NULL is free of charge.
static inline MeterAnswer meter_charge(Meter *meter, uint64_t units) {
    if (!meter)
        return METER_GOES_ON;
    meter->work = units < meter->work_limit - meter->work ? meter->work + units : meter->work_limit + 1;
    return meter->work <= meter->pause ? METER_GOES_ON : meter_look(meter);
}

// Takes bytes from the budget, if they are left; gives them back.
bool meter_take(Meter *meter, size_t bytes);
void meter_give(Meter *meter, size_t bytes);

#endif
