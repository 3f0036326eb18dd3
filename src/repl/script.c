// script.c: the script at the prompt: loading, and noticing that somebody has changed it.
#include <stdlib.h>
#include <string.h>

#include "cli/script.h"
#include "repl/diff.h"
#include "repl/repl.h"

void repl_watch_files(Repl *repl) {
    if (repl->files == NULL) {
        return;
    }
    if (repl->script != NULL) {
        watch_file(repl->files, repl->script);
    }
    const char *path;
    for (size_t i = 0; (path = petri_source(repl->session, i)) != NULL; i++) {
        watch_file(repl->files, path);
    }
}

static void remember_text(Repl *repl) {
    bytes_free(&repl->script_text);
    if (repl->script != NULL) {
        bytes_read_file(&repl->script_text, repl->script);
    }
}

static bool loaded(Repl *repl, PetriStatus status) {
    repl_watch_files(repl);
    repl->changed = false;
    if (status == PETRI_OK) {
        remember_text(repl);
        repl->loaded = true;
    }
    repl->failed = repl->failed || status != PETRI_OK;
    return status == PETRI_OK;
}

bool repl_load(Repl *repl, const char *file) {
    PetriStatus status = script_load(repl->session, file);
    repl->rates_changed = repl->rates_changed && status != PETRI_OK;
    if (status == PETRI_OK && file != repl->script) {
        free(repl->script);
        repl->script = memory_copied(file, strlen(file));
    }
    return loaded(repl, status);
}

bool repl_reload(Repl *repl) {
    if (repl->script == NULL) {
        return repl_fail(repl, "no script is loaded; .load FILE loads one");
    }
    // What was never running has no state that could stay.
    PetriStatus status =
        repl->loaded ? petri_reload(repl->session, repl->script) : petri_load(repl->session, repl->script);
    bool first = !repl->loaded;
    if (!loaded(repl, status)) {
        return false;
    }
    if (first) {
        history_start(&repl->history, repl->session, NULL);
    }
    repl_say(repl, "%s is loaded anew", repl->script);
    return true;
}

void repl_refresh(Repl *repl) {
    repl_notice(repl, false);
    if (repl->changed) {
        repl->changed = false;
        if (!repl_reload(repl)) {
            repl_say(repl, repl->loaded ? "the script as it was goes on" : "no script is running");
        }
    }
}

bool repl_notice(Repl *repl, bool at_prompt) {
    if (repl->files == NULL || !watch_changed(repl->files)) {
        return false;
    }
    Bytes now = {0}, what = {0};
    bool changed = repl->script != NULL && bytes_read_file(&now, repl->script);
    if (changed) {
        repl->changed = true;
        diff_describe(&repl->script_text, &now, &what);
        if (at_prompt) {
            output_write(&repl->output, "\n", 1);
        }
        // If nothing is different here, it is a file that the script includes or imports.
        repl_say(repl, "%s%s was changed%s%s; it is loaded anew before the next step",
                 what.length == 0 ? "what goes into " : "", repl->script, what.length == 0 ? "" : ": ",
                 what.length == 0 ? "" : what.data);
        output_flush(&repl->output);
    }
    bytes_free(&now);
    bytes_free(&what);
    return changed;
}
