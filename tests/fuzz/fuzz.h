// fuzz.h: what the harnesses share. Each is a file of its own with libFuzzer's entry, which one input is given; what is
// found ends the process: a sanitizer does that, or fuzz_fail.
#ifndef PETRI_TESTS_FUZZ_H
#define PETRI_TESTS_FUZZ_H

#include "petri.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Says what is wrong and aborts.
__attribute__((format(printf, 1, 2), noreturn)) void fuzz_fail(const char *format, ...);

// How many times 50 ms of the processor's time may pass until an interrupt is answered.
extern int fuzz_interrupt_limit;

// A session with little memory and stack whose diagnostics are looked at. After two seconds of processor time it is
// interrupted, again and again, and Ctrl-C is typed (SIGINT); one that goes on for four seconds more is a finding.
PetriOptions fuzz_options(void);
PetriSession *fuzz_open(const PetriOptions *options);
// Such a watch without a session: only Ctrl-C. fuzz_end_watch ends a watch and tells whether it had to interrupt.
void fuzz_watch(PetriSession *session);
bool fuzz_end_watch(void);
void fuzz_close(PetriSession **session);

// Loads a text that must be a good script.
void fuzz_load(PetriSession *session, const char *script);
// Looks at each particle, force and parameter of the last frame.
void fuzz_check_frame(PetriSession *session);
// The state holds nothing but finite numbers, symbols and texts.
void fuzz_check_state(PetriSession *session);

// A PetriWriteCallback that reads what it is given, and one that keeps it.
bool fuzz_sink(void *host, const char *text, size_t length);
typedef struct FuzzText {
    char *bytes;
    size_t length;
    size_t capacity;
} FuzzText;
bool fuzz_append(void *text, const char *bytes, size_t length);
bool fuzz_texts_equal(const FuzzText *a, const FuzzText *b);

// The path of a file in this process's own folder, which is in memory and is the current one; and puts bytes there.
const char *fuzz_file(const char *name);
void fuzz_put(const char *name, const void *bytes, size_t length);
// Likewise a state file: the text, and the line that vouches for it.
void fuzz_put_state(const char *name, const void *text, size_t length);

#endif
