// fuzz.h: functions shared by the fuzzing harnesses. Each harness is a file with a function that handles one input. A
// finding aborts the process, through a sanitizer or fuzz_fail.
#pragma once

#include "petri.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Defines the function of a harness, with the parameters `data` and `size`. It is libFuzzer's entry point, or, in
// builds without libFuzzer, a function that replay.c calls. Returns 0.
#ifdef HAVE_LIBFUZZER
#define FUZZ_HARNESS(name)                                                                                             \
    int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);                                                      \
    int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
#else
#define FUZZ_HARNESS(name)                                                                                             \
    int fuzz_##name(const uint8_t *data, size_t size);                                                                 \
    int fuzz_##name(const uint8_t *data, size_t size)
#endif

// Prints a message and aborts.
__attribute__((format(printf, 1, 2), noreturn)) void fuzz_fail(const char *format, ...);

// Time within which an interrupt must take effect, in units of 50 ms of processor time.
extern int fuzz_interrupt_limit;

// Returns options with low limits of memory and stack. Their callback checks diagnostics.
PetriOptions fuzz_options(void);
// Opens a session with these options (NULL: fuzz_options) and starts a watch on it. fuzz_close ends the watch.
PetriSession *fuzz_open(const PetriOptions *options);
// Starts a watch. After two seconds of processor time, the session is interrupted repeatedly. If `session` is NULL,
// SIGINT is raised instead. If this has no effect within fuzz_interrupt_limit, that is a finding.
void fuzz_watch(PetriSession *session);
// Ends the watch. Returns true if the watch has interrupted the session.
bool fuzz_end_watch(void);
void fuzz_close(PetriSession **session);

// Loads a script, which must succeed.
void fuzz_load(PetriSession *session, const char *script);
// Reads particles, forces and parameters of the last frame.
void fuzz_check_frame(PetriSession *session);
// Checks that the state contains only finite numbers, symbols and strings.
void fuzz_check_state(PetriSession *session);

// Callbacks for printing: fuzz_sink reads the text, and fuzz_append appends it to a FuzzText.
bool fuzz_sink(void *host, const char *text, size_t length);
typedef struct FuzzText {
    char *bytes;
    size_t length;
    size_t capacity;
} FuzzText;
bool fuzz_append(void *text, const char *bytes, size_t length);
bool fuzz_texts_equal(const FuzzText *a, const FuzzText *b);

// Reads the next part of an input whose parts are separated by a byte 30: sets *part and *length, and moves *at to the
// start of the part after it. Returns false if *at is `end`.
bool fuzz_next_part(const char **at, const char *end, const char **part, size_t *length);

// Appends a part to a file, for fuzz_put_parts.
typedef void FuzzAddPart(FuzzText *file, const char *part, size_t length);
// Writes a file in the harness's folder (fuzz_put). If the first byte of the input is '#', the rest is the file.
// Otherwise, the file consists of `head`, which is freed, and of what `add` appends for each part (fuzz_next_part).
void fuzz_put_parts(const char *name, FuzzText *head, const uint8_t *data, size_t size, FuzzAddPart *add);

// Returns the path of a file in this process's temporary folder. The string stays valid for the next three calls.
const char *fuzz_file(const char *name);
// Writes a file in that folder.
void fuzz_put(const char *name, const void *bytes, size_t length);
// Writes a state file: the text and a line with its checksum.
void fuzz_put_state(const char *name, const void *text, size_t length);
