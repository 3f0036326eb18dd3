// interrupt.c: Ctrl-C; see repl.h.
//
// Ctrl-C sets a flag, until the next input is read. Between repl_begin and repl_end, it also interrupts the session. An
// interrupt that comes too late is dropped.
#include "repl/repl.h"

#include <signal.h>

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

void repl_begin(Prompt *prompt) {
    petri_clear_interrupt(prompt->session);
    working = prompt->session;
    if (interrupted) // since the input was read
        petri_interrupt(prompt->session);
}

void repl_end(Prompt *prompt) {
    const Repl *repl = prompt->user_data;
    working = NULL;
    petri_clear_interrupt(prompt->session); // an interrupt that arrived too late must not stop the next input
    if (interrupted && repl->terminal)
        output_write(prompt->output, "\n", 1); // end the line on which the terminal shows ^C
}

bool repl_interrupted(void) {
    return interrupted != 0;
}

void repl_clear_interrupt(void) {
    interrupted = 0;
}
