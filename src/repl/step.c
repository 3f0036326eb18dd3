// step.c: making frames at the prompt, forward and back, and what is said of them.
#include <inttypes.h>
#include <string.h>

#include "cli/progress.h"
#include "repl/repl.h"

// Adds `EXPR = value` for each expression that is watched.
static void add_watched(Repl *repl, Bytes *text) {
    for (size_t i = 0; i < repl->watched_count; i++) {
        PetriResult result;
        Bytes value = {0};
        const char *expression = repl->watched[i];
        PetriStatus status = petri_evaluate(repl->session, expression, PETRI_Z, &result, repl_collect, &value);
        bytes_format(text, "%s = ", expression);
        bytes_add(text, status == PETRI_OK ? value.data : "?", status == PETRI_OK ? value.length : 1);
        bytes_add(text, "\n", 1);
        bytes_free(&value);
    }
}

// The frame's text; true if there is more to it than its first line.
static bool describe(Repl *repl, Bytes *text) {
    petri_print(repl->session, PETRI_PRINT_LOG, repl_collect, text);
    add_watched(repl, text);
    return memchr(text->data, '\n', text->length) != text->data + text->length - 1;
}

void repl_show_frame(Repl *repl) {
    Bytes text = {0};
    if (petri_frame(repl->session).number < 0) {
        repl_say(repl, "before the first frame");
        return;
    }
    describe(repl, &text);
    output_write(&repl->output, text.data, text.length);
    bytes_free(&text);
}

// Writes a frame if it has something to say or is the last; whether it did.
static bool show_step(Repl *repl, Progress *progress, bool last) {
    Bytes text = {0};
    bool shown = describe(repl, &text) || last;
    if (shown) {
        progress_erase(progress);
        output_write(&repl->output, text.data, text.length);
        if (repl->terminal) {
            output_flush(&repl->output);
        }
    }
    bytes_free(&text);
    return shown;
}

typedef enum Outcome { GOING, REACHED, GIVEN_UP } Outcome;

static Outcome one_step(Repl *repl, const Walk *walk) {
    PetriResult result = {0};
    PetriStatus status = history_step(&repl->history, repl->session);
    if (status == PETRI_OK && walk->until != NULL) {
        status = petri_evaluate(repl->session, walk->until, PETRI_Z, &result, NULL, NULL);
    }
    if (status != PETRI_OK && status != PETRI_INTERRUPTED) {
        repl_status(repl, status);
        return GIVEN_UP;
    }
    return result.is_true ? REACHED : GOING;
}

static void conclude(Repl *repl, const Walk *walk, int64_t made, Outcome outcome) {
    repl->incomplete = repl_interrupted();
    if (repl_interrupted()) {
        repl_fail(repl, "interrupted after %" PRId64 " frame%s", made, made == 1 ? "" : "s");
    } else if (outcome == GOING && walk->until != NULL) {
        repl_fail(repl, "not true within %" PRId64 " frame%s (--limit)", made, made == 1 ? "" : "s");
    } else if (outcome == GOING && walk->limited) {
        repl_say(repl, "stopped after %" PRId64 " frames (--limit)", made);
    }
}

bool repl_walk(Repl *repl, const Walk *walk) {
    Progress progress;
    Outcome outcome = GOING;
    int64_t made = 0;
    repl_refresh(repl);
    repl->failed = false; // a script that is wrong does not stop the old one
    progress_start(&progress, repl->terminal && progress_possible(), walk->count);
    repl_busy(repl);
    bool shown = true;
    while (made < walk->count && outcome == GOING && !repl_interrupted() && repl->output.error == 0) {
        int64_t before = petri_frame(repl->session).number;
        outcome = one_step(repl, walk);
        if (petri_frame(repl->session).number == before) {
            break;
        }
        made++;
        shown = show_step(repl, &progress, made == walk->count || outcome != GOING);
        progress_update(&progress, made);
    }
    progress_erase(&progress);
    repl_idle(repl);
    if (!shown) {
        show_step(repl, &progress, true);
    }
    conclude(repl, walk, made, outcome);
    repl_watch_files(repl); // modules that were imported
    return !repl->failed;
}

void repl_complete_frame(Repl *repl) {
    if (!repl->incomplete) {
        return;
    }
    repl_busy(repl);
    PetriStatus status = history_remake(&repl->history, repl->session);
    repl_idle(repl);
    repl->incomplete = status != PETRI_OK;
    repl_status(repl, status);
}

// Within the timeline at one go, beyond it by steps that show how far it is.
static PetriStatus go(Repl *repl, int64_t frame, Bytes *why) {
    int64_t last = repl->history.last, made = 0;
    Progress progress;
    PetriStatus status = history_goto(&repl->history, repl->session, frame < last ? frame : last, why);
    progress_start(&progress, repl->terminal && progress_possible(), frame - last);
    while (status == PETRI_OK && petri_frame(repl->session).number < frame) {
        status = history_goto(&repl->history, repl->session, last + ++made, why);
        progress_update(&progress, made);
    }
    progress_erase(&progress);
    return status;
}

bool repl_goto(Repl *repl, int64_t frame) {
    Bytes why = {0};
    repl_refresh(repl);
    repl->failed = false;
    repl_busy(repl);
    PetriStatus status = go(repl, frame, &why);
    bool stopped = repl_idle(repl);
    repl->incomplete = stopped;
    if (stopped) {
        repl_fail(repl, "interrupted");
    } else if (status == PETRI_INVALID) {
        repl_fail(repl, "%s", why.length == 0 ? "this cannot be done" : why.data);
    } else {
        repl_status(repl, status);
    }
    bytes_free(&why);
    if (status == PETRI_OK || stopped) {
        repl_show_frame(repl);
    }
    return status == PETRI_OK;
}
