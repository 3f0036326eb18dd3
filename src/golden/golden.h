// golden.h: recorded output (NAME.golden) and its comparison with what a script prints now (spec cli.md 3.4).
//
// The first line holds the options of the run; further lines at the top that start with # are remarks:
//     # run --frames 61 --every 20 --print state
//     # tolerance 1e-9
//     # horizon 40 strict 25
// A tolerance makes numbers agree that are close. Frames after the horizon are chaotic and then not compared; between
// `strict` and the horizon they are compared loosely. Without a tolerance the horizon means nothing.
#ifndef PETRI_SRC_GOLDEN_H
#define PETRI_SRC_GOLDEN_H

#include <stdint.h>

#include "cli/bytes.h"

typedef struct Golden {
    Bytes text;  // the whole file
    size_t body; // where the recorded output begins
    uint32_t body_line;
    char **options; // the words after `# run`
    int option_count;
    double tolerance; // 0: exactly
    int64_t horizon;
    int64_t strict;
} Golden;

// False with what is wrong added to `trouble`.
bool golden_read(Golden *golden, const char *path, Bytes *trouble);
void golden_free(Golden *golden);

// Whether `output` agrees with the golden; if not, the first difference is added to `trouble`.
bool golden_compare(const Golden *golden, const Bytes *output, Bytes *trouble);
// Replaces the recorded output in the file and keeps the lines above it. `changed` tells whether it was another.
bool golden_update(const Golden *golden, const char *path, const Bytes *output, bool *changed, Bytes *trouble);

#endif
