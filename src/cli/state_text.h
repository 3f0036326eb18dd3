// state_text.h: the state in printed form (PETRI_PRINT_STATE), and the comparison of two states.
//
// Printed numbers are exact: different numbers have different texts, also 0 and -0.
#pragma once

#include "cli/memory.h"
#include "petri-inspect.h"

// Entries of a state, sorted by key. Strings point into the printed text.
typedef struct StateEntry {
    Str key;     // without `$` and parentheses, such as `:cells;3`
    Str value;   // as printed
    size_t line; // index of its line in the printed text
} StateEntry;

typedef struct StateText {
    StateEntry *entries;
    size_t count;
} StateText;

// An entry that is not the same in two states.
typedef struct StateDifference {
    Str key;
    Str values[2];    // of the first and the second state; `bytes` is NULL if the state lacks the entry
    size_t line;      // index of its line in the first text that has it
    bool of_particle; // position or velocity of a particle, as the user of the comparison has found out
} StateDifference;

typedef struct StateDifferences {
    StateDifference *items; // sorted by key
    size_t count;
    size_t total; // number of keys in either state
} StateDifferences;

// Reads the entries of a printed frame. Other lines, such as the `@` line, are ignored. The caller frees the result
// with state_text_free.
StateText state_text_read(Str printed);
void state_text_free(StateText *state);
// The caller frees the result with state_differences_free.
StateDifferences state_text_compare(const StateText *a, const StateText *b);
void state_differences_free(StateDifferences *differences);
// Returns the difference that is printed first, or NULL.
const StateDifference *state_first_difference(const StateDifferences *differences);
// Returns the difference with this key, or NULL.
StateDifference *state_find_difference(const StateDifferences *differences, Str key);

// Appends the distance of two printed values, as the number of doubles from one to the other: one number per element,
// such as `0;1`. Appends nothing unless both consist of equally many numbers that are not nan.
void value_add_ulps(Text *text, Str a, Str b);
// Appends two values that differ: `- A` and `+ B`, each followed by its position unless that is NULL, and the distance.
void state_add_values(Text *text, const Str *values, const char *const *positions);
// Appends a report of the first frame that differs: the names of both runs, the frame, its time (NaN: unknown), the
// number of entries that differ, and one of them.
void state_add_report(Text *text, const char *const *labels, int64_t frame, double time,
                      const StateDifferences *differences, const StateDifference *shown);
