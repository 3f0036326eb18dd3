// fuzz_arguments.c: fuzzes command lines. The input is a list of words, separated by NUL. The command only opens a
// session.
#include "cli/options.h"
#include "fuzz.h"
#include "petri-inspect.h"
#include "run/options.h"

#include <stdlib.h>
#include <string.h>

static Command commands[4]; // copies of the real commands that only open a session and step one frame

static int run_command(const CommandContext *host, Options *options) {
    PetriSession *session = NULL;
    int status = options_open(options, host, fuzz_options().on_diagnostic, NULL, &session);
    if (!session)
        return status;
    fuzz_watch(session);
    if (petri_load_text(session, "x.fl", "!a x=A y=B z=COUNT\n", PETRI_NUL_TERMINATED) == PETRI_OK &&
        !options->realtime)
        petri_step(session);
    petri_print(session, options->table == &RUN_OPTIONS ? run_options(options)->sections : 0, fuzz_sink, NULL);
    fuzz_close(&session);
    return STATUS_DONE;
}

static void copy_commands(void) {
    const Command *const real[] = {&RUN_COMMAND, &RENDER_COMMAND, &VIEW_COMMAND, &REPL_COMMAND};
    for (size_t i = 0; i < sizeof real / sizeof real[0]; i++) {
        commands[i] = *real[i];
        commands[i].run = run_command;
    }
}

FUZZ_HARNESS(arguments) {
    enum { MAX_WORDS = 64 };
    static const CommandContext host = {.program = "petri", .invoked_as = "petri", .stack_bytes = 1 << 20};
    char *text = calloc(1, size + 1), *words[MAX_WORDS];
    int count = 0;
    copy_commands();
    if (size)
        memcpy(text, data, size);
    for (char *at = text; count < MAX_WORDS && at < text + size; at += strlen(at) + 1)
        words[count++] = at;
    command_run(&commands[count % 4], &host, count, words);
    free(text);
    return 0;
}
