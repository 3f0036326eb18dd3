// id_numbers.h: whole numbers for the ids of particles, for trajectory formats whose ids are integers.
//
// An id that is a whole number of 0 or more is unchanged. The K-th other id that occurs in a file, counted from 0, has
// the number -2-K in all its frames. -1 is not used, because it means "no particle" in H5MD.
#pragma once

#include "base/hash_index.h"
#include "cli/memory.h"
#include "petri.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct IdNumbers {
    TextList texts;  // printed forms of the ids that are not whole numbers, in order of their first use
    HashIndex index; // finds the position of a string in `texts`
} IdNumbers;

void id_numbers_free(IdNumbers *numbers);
// Sets *position to the position of a string in `texts`. Adds the string if it is new. Returns false if out of memory.
bool id_numbers_find(IdNumbers *numbers, const char *text, uint32_t *position);
// Appends the numbers of all particles of a system to `ids`, as int64_t values. Returns false if out of memory.
bool id_numbers_of_system(IdNumbers *numbers, PetriSession *session, size_t number, const PetriSystem *system,
                          Text *ids);
// Returns the printed form of an id, or NULL if the number is the id itself. Valid until the next id_numbers_find.
const char *id_numbers_text(const IdNumbers *numbers, int64_t id);
