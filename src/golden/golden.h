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

#include "cli/cli.h"
#include "cli/memory.h"

#include <stdint.h>

typedef struct Golden {
    Text text;          // the whole file
    size_t body;        // offset of the recorded output in `text`
    uint32_t body_line; // line number of the recorded output, from 1
    bool renders;       // true: the first line begins with `# render`, false: with `# run`
    TextList options;   // words after that
    double tolerance;   // of pictures: of each channel, in 255ths; otherwise relative tolerance for numbers; 0: numbers
                        // must be equal
    int64_t horizon;    // last frame that is compared if there is a tolerance
    int64_t strict;     // last frame that is compared with `tolerance`; later frames get a larger tolerance
} Golden;

// The result of a test.
typedef struct Result {
    const char *name;
    bool passed;
    bool updated;     // true if the test file was rewritten
    const char *file; // that a failure is in, for editors; NULL: the test file
    uint32_t line;    // of a failure, in `file`; 0: not known
    Text error_text;  // reason of a failure, in one line
    Text details;     // further lines about a failure
    bool differs;     // true if the recorded output differs, so that it can be updated
    double seconds;
} Result;

// Reads a golden. On failure, returns false and adds the reason to error_text.
bool golden_read(Golden *golden, const char *path, Text *error_text);
void golden_free(Golden *golden);
// Returns the option that a word of a golden's first line names, or NULL.
const OptionSpec *golden_option(const OptionSpec *rows, const char *word);
// Returns true if the value of the option, if it has one, is the next word.
bool golden_option_is_alone(const char *word);
// Rejects options that write files, because a golden from another author must not write files on this machine. Returns
// false if there is one and adds the reason to error_text.
// `rows` are the options of the command.
bool golden_check_options(const OptionSpec *rows, const TextList *words, Text *error_text);
// Returns the options of the command that the golden records.
const OptionSpec *golden_rows(const Golden *golden);
// Reads a file, without a byte-order mark and with LF instead of CR LF: editors and version control on Windows add
// them. On failure, returns false and adds the reason to error_text.
bool golden_read_text(Text *text, const char *path, Text *error_text);

// Returns true if `output` agrees with the golden. Otherwise puts the first difference and a unified diff into
// `result`.
bool golden_compare(const Golden *golden, const Text *output, Result *result);
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
