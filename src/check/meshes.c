// meshes.c: see meshes.h. Only programs that can draw contain it.
#include "check/meshes.h"

#include "cli/script.h"
#include "petri-draw.h"

#include <stdio.h>

// A host's on_diagnostic. The check has already reported all diagnostics except that of an exceeded limit.
static void show_limit(void *host, const PetriDiagnostic *diagnostic) {
    const bool *counting = host;
    if (*counting && diagnostic->level == PETRI_ERROR)
        fputs(diagnostic->rendered, stderr);
}

static bool write_stderr(void *host, const char *text, size_t length) {
    (void)host;
    return fwrite(text, 1, length, stderr) == length;
}

void check_print_meshes(const CommandContext *host, const Options *options, const char *path) {
    PetriSession *session = NULL;
    bool counting = false;
    if (options_open(options, host, show_limit, &counting, &session) != OPTIONS_READ)
        return;
    PetriStatus status = options->replayed ? options_load(options, session) : script_load(session, path);
    if (status == PETRI_OK && petri_step(session) == PETRI_OK) {
        counting = true;
        petri_print_meshes(session, write_stderr, NULL);
    }
    petri_close(&session);
}
