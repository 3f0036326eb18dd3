// show.c: `petri run --show`: whoever runs a script at a terminal sees its picture there.
#include "run/show.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/bytes.h"
#include "cli/pass_on.h"
#include "cli/progress.h"
#include "cli/script.h"

static bool is_named(const char *word, const char *name) {
    size_t length = strlen(name);
    return strncmp(word, "--", 2) == 0 && strncmp(word + 2, name, length) == 0 && strchr("=", word[2 + length]) != NULL;
}

// What `petri view` does not know asks for text or files.
static bool view_knows(const char *word) {
    for (const OptionSpec *spec = OPTIONS; spec->name != NULL; spec++) {
        if (spec->commands & FOR_VIEW && is_named(word, spec->name)) {
            return true;
        }
    }
    return strncmp(word, "--", 2) != 0 || is_named(word, "show");
}

bool show_wanted(const Options *options) {
#ifdef HAVE_CHAFA
    bool at_terminal = isatty(STDIN_FILENO) && isatty(STDOUT_FILENO) && progress_possible();
#else
    bool at_terminal = false;
#endif
    for (int i = 0; i < options->argc; i++) {
        if (!view_knows(options->argv[i])) {
            return false;
        }
    }
    return options->show && at_terminal && !script_is_stdin(options->script) &&
           (options->verbosity == LOG_NORMAL || options->verbosity == LOG_VERBOSE);
}

// What is wrong is told by the run, or the view, to come.
static void ignore(void *context, const PetriDiagnostic *diagnostic) {
    (void)context;
    (void)diagnostic;
}

// The first frame tells.
static bool is_drawable(const Options *options, const Host *host) {
    PetriSession *session = NULL;
    if (options_open(options, host, ignore, NULL, &session) != OPTIONS_READ) {
        return false;
    }
    bool drawable =
        petri_load(session, options->script) == PETRI_OK && petri_step(session) == PETRI_OK && petri_drawable(session);
    petri_close(&session);
    return drawable;
}

void show(const Options *options, const Host *host) {
    if (!is_drawable(options, host)) {
        return;
    }
    char frames[32];
    snprintf(frames, sizeof frames, "--frames=%" PRId64, options->frames);
    char **words = memory_zeroed(((size_t)options->argc + 6) * sizeof *words);
    char called[] = "view", terminal[] = "--terminal", verbose[] = "--verbose";
    SCOPED_TEXT program = memory_text(host->called);
    char *const first[] = {program, called, terminal, verbose, frames};
    int count = (int)(sizeof first / sizeof first[0]);
    memcpy(words, first, sizeof first);
    for (int i = 0; i < options->argc; i++) {
        if (!is_named(options->argv[i], "show")) {
            words[count++] = options->argv[i];
        }
    }
    fflush(NULL);
    pass_on(words);
    free(words);
}
