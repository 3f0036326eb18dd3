// interrupt.c: Ctrl-C, notes and messages, which all commands use; see repl.h.
//
// Ctrl-C sets a flag. Between repl_busy and repl_idle, it also interrupts the session. An interrupt that comes too late
// is dropped.
#include "repl/repl.h"

#include <signal.h>
#include <stdarg.h>
#include <stdio.h>

// Globals, because the signal handler needs them.
static volatile sig_atomic_t interrupted;
static PetriSession *volatile working; // session that Ctrl-C interrupts; NULL: none

static void on_interrupt(int signal_number) {
    (void)signal_number;
    interrupted = 1;
    PetriSession *session = working;
    if (session)
        petri_interrupt(session);
}

void repl_catch_interrupt(void) {
    struct sigaction action = {.sa_handler = on_interrupt};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
}

void repl_busy(Repl *repl) {
    interrupted = 0;
    petri_clear_interrupt(repl->session);
    working = repl->session;
}

bool repl_idle(Repl *repl) {
    working = NULL;
    petri_clear_interrupt(repl->session); // an interrupt that arrived too late must not stop the next input
    if (interrupted && repl->terminal)
        output_write(&repl->output, "\n", 1); // end the line on which the terminal shows ^C
    return interrupted != 0;
}

bool repl_interrupted(void) {
    return interrupted != 0;
}

void repl_clear_interrupt(void) {
    interrupted = 0;
}

void repl_note(Repl *repl, const char *format, ...) {
    SCOPED_TEXT text = {0};
    char line[1024];
    va_list list;
    va_start(list, format);
    vsnprintf(line, sizeof line, format, list);
    va_end(list);
    text_add_format(&text, repl->options->colour ? "\033[2m-- %s\033[0m\n" : "-- %s\n", line);
    output_write(&repl->output, text.bytes, text.len);
}

bool repl_fail(Repl *repl, const char *format, ...) {
    char line[1024];
    va_list list;
    va_start(list, format);
    vsnprintf(line, sizeof line, format, list);
    va_end(list);
    output_flush(&repl->output);
    message("%s", line);
    repl->failed = true;
    return false;
}

bool repl_status(Repl *repl, PetriStatus status) {
    repl->failed = repl->failed || status != PETRI_OK;
    if (status == PETRI_INTERRUPTED)
        return repl_fail(repl, "interrupted");
    if (status == PETRI_OUT_OF_MEMORY)
        return repl_fail(repl, "out of memory");
    return status == PETRI_OK;
}

void repl_complete_frame(Repl *repl) {
    if (!repl->incomplete)
        return;
    repl_busy(repl);
    PetriStatus status = petri_history_recompute(repl->history);
    repl_idle(repl);
    repl->incomplete = status != PETRI_OK;
    repl_status(repl, status);
}
