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

#include "cli/byte_buffer.h"
#include "cli/output.h"

#include <stdint.h>

typedef struct Golden {
    ByteBuffer text; // the whole file
    size_t body;     // where the recorded output begins
    uint32_t body_line;
    TextList options; // the words after `# run`
    double tolerance; // 0: exactly
    int64_t horizon;
    int64_t strict;
} Golden;

// False with what is wrong added to `trouble`.
bool golden_read(Golden *golden, const char *path, ByteBuffer *error_text);
void golden_free(Golden *golden);

// Whether `output` agrees with the golden; if not, the first difference is added to `trouble`.
bool golden_compare(const Golden *golden, const ByteBuffer *output, ByteBuffer *error_text);
// Replaces the recorded output in the file and keeps the lines above it. `changed` tells whether it was another.
bool golden_update(const Golden *golden, const char *path, const ByteBuffer *output, bool *changed,
                   ByteBuffer *error_text);

// Lines of output (golden_line.c).

// Lines are compared token by token: words and signs as they are, strings by what they stand for, whatever their
// quotes, and numbers as numbers. With a tolerance R, the numbers a and b of one value agree if
//     max |a_i - b_i| <= R * max(1, max |a_i|, max |b_i|)
// but a key of the state and a hash are always compared exactly.

// Where two lines first differ, as offsets into them.
typedef struct LineDifference {
    size_t expected_at;
    size_t got_at;
} LineDifference;

// A tolerance of 0 means exactly; nan agrees with nan and -0 with 0. Behind each text is an end of line or NUL.
bool line_same(Str expected, Str got, double tolerance, LineDifference *difference);

// Scripts that must be rejected: NAME.err beside NAME.fl (rejection.c).

// Whether a run of script `name` that ended with `status` (of waitpid) and these errors is what the .err file `path`
// asks for: `line N`, or `line *` for any line. If not, the reason is added to `trouble`.
bool rejection_check(const char *path, const char *name, int status, const ByteBuffer *errors, ByteBuffer *error_text);

// How results are told: a line each, and as a file for CI systems (report.c).

typedef struct Result {
    const char *name;
    bool passed;
    bool updated;          // the golden was rewritten
    ByteBuffer error_text; // why it failed
    double seconds;
} Result;

// `ok NAME`, or `FAIL NAME` and why.
void report_result(Output *output, const Result *result);
// Writes a JUnit file. False after a message if that fails.
bool report_junit(const char *path, Result *const *results, size_t count);

#endif
