// step_commands.c: commands that move forward and back by frames, and their output.
#include "cli/progress.h"
#include "petri-inspect.h"
#include "repl/repl.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// A request to compute frames. Computing ends after `count` frames, when `until` is true, or on Ctrl-C.
typedef struct StepRequest {
    int64_t count;
    const char *until; // expression; NULL: none
    bool limited;      // true if `count` is the limit that --limit sets; a note then reports that the limit was reached
} StepRequest;

// Appends `EXPR = value` for each watched expression.
static void add_watched(Repl *repl, Text *text) {
    for (size_t i = 0; i < repl->watched.count; i++) {
        PetriEvaluation result;
        SCOPED_TEXT value = {0};
        const char *expression = repl->watched.items[i];
        PetriStatus status = petri_evaluate(repl->session, expression, PETRI_NUL_TERMINATED, &result, sizeof result,
                                            text_collect, &value);
        text_add_format(text, "%s = ", expression);
        text_add(text, (Str){status == PETRI_OK ? value.bytes : "?", status == PETRI_OK ? value.len : 1});
        text_add_c(text, "\n");
    }
}

// Appends the frame's text. Returns true if other lines follow its `@` line.
static bool format_frame(Repl *repl, Text *text) {
    petri_print(repl->session, PETRI_PRINT_LOG, text_collect, text);
    add_watched(repl, text);
    return memchr(text->bytes, '\n', text->len) != text->bytes + text->len - 1;
}

// Writes the current frame's `@` line, its log and the watched expressions.
static void repl_show_frame(Repl *repl) {
    SCOPED_TEXT text = {0};
    if (petri_frame_number(repl->session) < 0) {
        repl_note(repl, "this is before the first frame");
        return;
    }
    petri_preview(repl->session); // recomputes the log if a change of settings has discarded it
    format_frame(repl, &text);
    output_write(&repl->output, text.bytes, text.len);
}

// Writes the frame if it is the last frame or has a log or watched expressions. Returns true if it was written.
static bool show_step(Repl *repl, Progress *progress, bool last) {
    SCOPED_TEXT text = {0};
    bool shown = format_frame(repl, &text) || last;
    if (shown) {
        progress_erase(progress);
        output_write(&repl->output, text.bytes, text.len);
        if (repl->terminal)
            output_flush(&repl->output);
    }
    return shown;
}

typedef enum Outcome { RUNNING, REACHED, ABORTED } Outcome;

static Outcome step_once(Repl *repl, const StepRequest *request) {
    PetriEvaluation result = {0};
    PetriStatus status = petri_history_step(repl->history);
    if (status == PETRI_OK && request->until)
        status =
            petri_evaluate(repl->session, request->until, PETRI_NUL_TERMINATED, &result, sizeof result, NULL, NULL);
    if (status != PETRI_OK && status != PETRI_INTERRUPTED) {
        repl_status(repl, status);
        return ABORTED;
    }
    return result.is_true ? REACHED : RUNNING;
}

static void report_outcome(Repl *repl, const StepRequest *request, int64_t frames, Outcome outcome) {
    repl->incomplete = repl_interrupted();
    if (repl_interrupted())
        repl_fail(repl, "interrupted after %" PRId64 " frame%s", frames, frames == 1 ? "" : "s");
    else if (outcome == RUNNING && request->until)
        repl_fail(repl, "the condition was not true within %" PRId64 " frame%s; --limit sets this maximum", frames,
                  frames == 1 ? "" : "s");
    else if (outcome == RUNNING && request->limited)
        repl_note(repl, "stopped after %" PRId64 " frames; --limit sets this maximum", frames);
}

static bool step_frames(Repl *repl, const StepRequest *request) {
    Progress progress;
    Outcome outcome = RUNNING;
    int64_t frames = 0;
    repl_refresh(repl);
    repl->failed = false; // a failed reload is not a failure of the step, because the old script continues
    progress_start(&progress, repl->terminal && progress_possible(), request->count);
    repl_busy(repl);
    bool shown = true;
    while (frames < request->count && outcome == RUNNING && !repl_interrupted() && repl->output.error == 0) {
        int64_t before = petri_frame_number(repl->session);
        outcome = step_once(repl, request);
        if (petri_frame_number(repl->session) == before)
            break;
        frames++;
        shown = show_step(repl, &progress, frames == request->count || outcome != RUNNING);
        progress_update(&progress, frames);
    }
    progress_erase(&progress);
    repl_idle(repl);
    if (!shown)
        show_step(repl, &progress, true);
    report_outcome(repl, request, frames, outcome);
    repl_watch_files(repl); // the frames may have imported modules
    return !repl->failed;
}

// Goes to a frame. Within the history, goes there directly. Beyond its end, computes frame by frame and shows a
// progress line. `last` is the last frame of the history.
static PetriStatus seek_frame(Repl *repl, int64_t frame, int64_t last) {
    int64_t frames = 0;
    Progress progress;
    PetriStatus status = petri_history_goto(repl->history, frame < last ? frame : last);
    progress_start(&progress, repl->terminal && progress_possible(), frame - last);
    while (status == PETRI_OK && petri_frame_number(repl->session) < frame) {
        status = petri_history_goto(repl->history, last + ++frames);
        progress_update(&progress, frames);
    }
    progress_erase(&progress);
    return status;
}

static bool go_to(Repl *repl, int64_t frame) {
    PetriHistoryInfo history;
    repl_refresh(repl);
    repl->failed = false;
    repl_busy(repl);
    petri_history_info(repl->history, &history, sizeof history);
    PetriStatus status = seek_frame(repl, frame, history.last);
    bool stopped = repl_idle(repl);
    repl->incomplete = stopped;
    if (stopped)
        repl_fail(repl, "interrupted");
    else if (status == PETRI_INVALID && frame < history.first)
        repl_fail(repl, "cannot go to frame %" PRId64 ": the history starts at frame %" PRId64 "%s%s", frame,
                  history.first, !history.reason ? "" : ": ", !history.reason ? "" : history.reason);
    else if (status == PETRI_INVALID)
        repl_fail(repl, "cannot go to that frame");
    else
        repl_status(repl, status);
    if (status == PETRI_OK || stopped)
        repl_show_frame(repl);
    return status == PETRI_OK;
}

static bool run_step(Repl *repl, const char *rest) {
    int64_t count = 1;
    return argument_count(repl, rest, 1, &count) && step_frames(repl, &(StepRequest){.count = count});
}

static bool run_run(Repl *repl, const char *rest) {
    double seconds = 0;
    if (rest[0] == '\0')
        return step_frames(repl, &(StepRequest){.count = repl->limit, .limited = true});
    if (!argument_number(repl, rest, &seconds))
        return false;
    if (seconds < 0)
        return repl_fail(repl, "not a time: '%s'; use seconds or a time code such as 1:30", rest);
    PetriFrame frame;
    petri_frame(repl->session, &frame, sizeof frame);
    double frames = ceil(seconds * frame.fps - 1e-9);
    bool limited = frames > (double)repl->limit;
    return step_frames(repl, &(StepRequest){.count = limited ? repl->limit : (int64_t)frames, .limited = limited});
}

static bool run_until(Repl *repl, const char *rest) {
    SCOPED_STRING expression = memory_strdup(rest);
    int64_t limit = repl->limit;
    if (!argument_limit(repl, expression, &limit))
        return false;
    if (expression[0] == '\0')
        return repl_fail(repl, ".until needs an expression");
    PetriEvaluation result; // unused: this only checks the expression
    return repl_status(repl, petri_evaluate(repl->session, expression, PETRI_NUL_TERMINATED, &result, sizeof result,
                                            NULL, NULL)) &&
           step_frames(repl, &(StepRequest){.count = limit, .until = expression});
}

static bool run_back(Repl *repl, const char *rest) {
    PetriHistoryInfo history;
    petri_history_info(repl->history, &history, sizeof history);
    int64_t count = 1, ago = petri_frame_number(repl->session) - history.first;
    if (!argument_count(repl, rest, 1, &count))
        return false;
    if (count <= ago)
        return go_to(repl, petri_frame_number(repl->session) - count);
    SCOPED_TEXT start = {0}; // the reason why the history does not start earlier
    text_add_format(&start, !history.reason ? "this is the start" : "the history starts here (%s)", history.reason);
    if (ago > 0)
        repl_note(repl, "went back only %" PRId64 " frame%s: %s", ago, ago == 1 ? "" : "s", start.bytes);
    else
        repl_fail(repl, "cannot go back: %s", start.bytes);
    return ago > 0 && go_to(repl, history.first);
}

static bool run_go(Repl *repl, const char *rest) {
    int64_t frame = -1;
    return argument_count(repl, rest, -1, &frame) && go_to(repl, frame);
}

static bool run_reset(Repl *repl, const char *rest) {
    (void)rest;
    if (!repl_status(repl, petri_history_reset(repl->history)))
        return false;
    repl_show_frame(repl);
    return true;
}

const ReplCommand STEP_COMMANDS[] = {
    {".step", "[N]", NULL, "compute N frames (default: 1)", run_step, COMPLETE_LANGUAGE},
    {".run", "[T]", NULL, "compute frames for T seconds of script time, or until Ctrl-C", run_run, COMPLETE_LANGUAGE},
    {".until", "EXPR [--limit N]", "an expression", "compute frames until EXPR is true, at most N", run_until,
     COMPLETE_LANGUAGE},
    {".back", "[N]", NULL, "go back N frames (default: 1), at most to the start", run_back, COMPLETE_LANGUAGE},
    {".goto", "FRAME", "the number of a frame", "go to a frame, back or forward; -1: before frame 0", run_go,
     COMPLETE_LANGUAGE},
    {".reset", "", NULL, "go back to the start of the session", run_reset, COMPLETE_LANGUAGE},
    {0},
};
