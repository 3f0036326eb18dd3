// golden.h: recorded output (NAME.golden) and its comparison with the current output (spec cli.md 3.4).
//
// The first line contains the options of the run. The following lines that start with # are remarks:
//     # run --frames 61 --every 20 --print state
//     # tolerance 1e-9
//     # horizon 40 strict 25
// With a tolerance, close numbers are considered equal. Frames after the horizon are not compared, because they are
// chaotic. Frames between `strict` and the horizon are compared with a larger tolerance. Without a tolerance, the
// horizon is ignored.
#pragma once

#include "cli/memory.h"
#include "cli/output.h"

#include <stdint.h>

typedef struct Golden {
    Text text;          // the whole file
    size_t body;        // offset of the recorded output in `text`
    uint32_t body_line; // line number of the recorded output, from 1
    TextList options;   // words after `# run`
    double tolerance;   // relative tolerance for numbers; 0: numbers must be equal
    int64_t horizon;    // last frame that is compared if there is a tolerance
    int64_t strict;     // last frame that is compared with `tolerance`; later frames get a larger tolerance
} Golden;

// Reads a golden. On failure, returns false and adds the reason to error_text.
bool golden_read(Golden *golden, const char *path, Text *error_text);
void golden_free(Golden *golden);
// Rejects options that write files, because a golden from another author must not write files on this machine. Returns
// false if there is one and adds the reason to error_text.
bool golden_check_options(const TextList *words, Text *error_text);
// Reads a file, without a byte-order mark and with LF instead of CR LF: editors and version control on Windows add
// them. On failure, returns false and adds the reason to error_text.
bool golden_read_text(Text *text, const char *path, Text *error_text);

// Returns true if `output` agrees with the golden. Otherwise adds the first difference to error_text.
bool golden_compare(const Golden *golden, const Text *output, Text *error_text);
// Replaces the recorded output in the file and keeps the lines above it. Sets *changed to true if the output differed,
// else to false. On failure, returns false and adds the reason to error_text.
bool golden_update(const Golden *golden, const char *path, const Text *output, bool *changed, Text *error_text);

// Comparison of lines (golden_line.c).
//
// Lines are compared token by token: words and signs as text, strings by their contents regardless of the type of
// quotes, and numbers by value. With a tolerance R, two lines with the numbers a_i and b_i agree if
//     max |a_i - b_i| <= R * max(1, max |a_i|, max |b_i|)
// Keys of the state and hashes are always compared exactly.

// Offsets into two lines at which they first differ.
typedef struct LineDifference {
    size_t expected_at;
    size_t got_at;
} LineDifference;

// Returns true if two lines agree. A tolerance of 0 means exact; nan equals nan, and -0 equals 0. Both lines must
// be followed by a newline or NUL.
bool line_same(Str expected, Str got, double tolerance, LineDifference *difference);

// Reports: one line per result, and a file for CI systems (report.c).

typedef struct Result {
    const char *name;
    bool passed;
    bool updated;    // true if the golden was rewritten
    Text error_text; // reason for a failure
    double seconds;
} Result;

// Prints `ok NAME`, or `FAIL NAME` and the reason.
void report_result(Output *output, const Result *result);
// Writes a JUnit XML file. Returns false after a message.
bool report_junit(const char *path, const Result *const *results, size_t count);
