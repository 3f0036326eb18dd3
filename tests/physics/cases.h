// cases.h: tables of small scripts with expected results that were calculated by hand.
//
// At one frame per second, the first step is taken in frame 1 and has length 1. Afterwards, the velocity of a resting
// particle of mass 1 equals the force on it. The numbers are chosen so that no rounding occurs.
#pragma once

#include "world.h"

typedef struct Case {
    const char *title;
    const char *script; // runs at one frame per second
    int frame;
    // Expected state in that frame, as entries NAME=NUMBERS. NAME is the position of the particle `:NAME` of the system
    // `:s`, NAME' its velocity, :NAME another key of the system, and $ the key of the prefix itself. `none` as value:
    // the key does not exist.
    const char *wanted;
    const char *reported; // codes of all diagnostics up to that frame; NULL: none
} Case;

static inline void case_key(const char *name, size_t len, char key[64]) {
    bool velocity = len > 1 && name[len - 1] == '\'';
    if (*name == '$')
        snprintf(key, 64, ":s");
    else
        snprintf(key, 64, ":s;%s%.*s%s", *name == ':' ? "" : ":", (int)(len - velocity), name,
                 velocity ? ";:velocity" : "");
}

static inline void check_case(const Case *row, const char *file, int line) {
    World world;
    world_open(&world, 1, row->script);
    world_to(&world, row->frame);
    for (const char *at = row->wanted; *at; at += strspn(at, " ")) {
        char key[64];
        double wanted[WORLD_MAX_NUMBERS], found[WORLD_MAX_NUMBERS];
        const char *equals = strchr(at, '=');
        case_key(at, (size_t)(equals - at), key);
        int count = -1;
        if (strncmp(equals + 1, "none", 4) == 0)
            at = equals + 5;
        else
            count = read_numbers(equals + 1, wanted, &at);
        bool same = world_numbers(&world, key, found) == count;
        for (int i = 0; same && i < count; i++)
            same = found[i] == wanted[i];
        if (!same) {
            print_error("%s: wanted %s, the state at frame %d is\n%s", row->title, row->wanted, row->frame,
                        world_state(&world));
            world_print_reported(&world);
            _fail(file, line);
        }
    }
    check_reported(&world, row->reported ? row->reported : "", row->title, file, line);
    world_close(&world);
}

#define CHECK_CASES(table)                                                                                             \
    do {                                                                                                               \
        for (size_t row = 0; row < COUNT_OF(table); row++)                                                             \
            check_case(&(table)[row], __FILE__, __LINE__);                                                             \
    } while (0)
