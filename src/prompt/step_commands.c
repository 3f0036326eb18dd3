// step_commands.c: commands that move forward and back by frames, and their output.
#include "petri-inspect.h"
#include "prompt/prompt.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// A request to compute frames. Computing ends after `count` frames, when `until` or a `.break` is true, or on Ctrl-C.
typedef struct StepRequest {
    int64_t count;
    Expression *until; // NULL: none
    bool limited;      // true if `count` is the limit that --limit sets; a note then reports that the limit was reached
} StepRequest;

// Appends `EXPR = value` for each watched expression.
static void add_watched(Prompt *prompt, Text *text) {
    for (size_t i = 0; i < prompt->watched.count; i++) {
        PetriEvaluation result;
        SCOPED_TEXT value = {0};
        PetriStatus status = expression_evaluate(prompt, &prompt->watched.items[i], &result, &value);
        text_add_format(text, "%s = ", prompt->watched.items[i].typed);
        text_add(text, (Str){status == PETRI_OK ? value.bytes : "?", status == PETRI_OK ? value.len : 1});
        text_add_c(text, "\n");
    }
}

// Appends the frame's text. Returns true if other lines follow its `@` line.
static bool format_frame(Prompt *prompt, Text *text) {
    petri_print(prompt->session, PETRI_PRINT_LOG, text_collect, text);
    add_watched(prompt, text);
    return memchr(text->bytes, '\n', text->len) != text->bytes + text->len - 1;
}

// Writes the current frame's `@` line, its log and the watched expressions.
static void show_frame(Prompt *prompt) {
    SCOPED_TEXT text = {0};
    if (petri_frame_number(prompt->session) < 0) {
        prompt_note(prompt, "this is before the first frame");
        return;
    }
    petri_preview(prompt->session); // recomputes the log if a change of settings has discarded it
    format_frame(prompt, &text);
    output_write(prompt->output, text.bytes, text.len);
}

static void show_progress(Prompt *prompt, int64_t done, int64_t total) {
    if (prompt->host->show_progress)
        prompt->host->show_progress(prompt, done, total);
}

// Writes the frame if it is the last frame or has a log or watched expressions. Returns true if it was written.
static bool show_step(Prompt *prompt, bool last) {
    SCOPED_TEXT text = {0};
    bool shown = format_frame(prompt, &text) || last;
    if (shown) {
        show_progress(prompt, 0, 0);
        output_write(prompt->output, text.bytes, text.len);
        if (prompt->live)
            output_flush(prompt->output);
    }
    return shown;
}

static StepOutcome step_once(Prompt *prompt, const StepRequest *request, size_t *number) {
    StepOutcome outcome = STEP_RUNNING;
    PetriStatus status = breaks_remember(prompt, request->until);
    if (status == PETRI_OK)
        status = prompt->host->step ? prompt->host->step(prompt) : petri_history_step(prompt->history);
    if (status == PETRI_OK)
        status = breaks_test(prompt, request->until, &outcome, number);
    if (status != PETRI_OK && status != PETRI_INTERRUPTED) {
        prompt_status(prompt, status);
        return STEP_ABORTED;
    }
    return outcome;
}

static void report_outcome(Prompt *prompt, const StepRequest *request, int64_t frames, StepOutcome outcome) {
    prompt->incomplete = prompt->host->interrupted(prompt);
    if (prompt->incomplete)
        prompt_fail(prompt, "interrupted after %" PRId64 " frame%s", frames, frames == 1 ? "" : "s");
    else if (outcome == STEP_RUNNING && request->until)
        prompt_fail(prompt, "the condition was not true within %" PRId64 " frame%s; --limit sets this maximum", frames,
                    frames == 1 ? "" : "s");
    else if (outcome == STEP_RUNNING && request->limited)
        prompt_note(prompt, "stopped after %" PRId64 " frames; --limit sets this maximum", frames);
}

static void refresh(Prompt *prompt) {
    if (prompt->host->before_frames)
        prompt->host->before_frames(prompt);
    prompt->failed = false; // a failed reload is not a failure of the step, because the old script continues
}

static bool step_frames(Prompt *prompt, const StepRequest *request) {
    StepOutcome outcome = STEP_RUNNING;
    int64_t frames = 0;
    size_t number = 0;
    refresh(prompt);
    prompt_busy(prompt);
    bool shown = true;
    while (frames < request->count && outcome == STEP_RUNNING && !prompt->host->interrupted(prompt) &&
           prompt->output->error == 0) {
        int64_t before = petri_frame_number(prompt->session);
        outcome = step_once(prompt, request, &number);
        if (petri_frame_number(prompt->session) == before)
            break;
        frames++;
        shown = show_step(prompt, frames == request->count || outcome != STEP_RUNNING);
        show_progress(prompt, frames, request->count);
    }
    show_progress(prompt, 0, 0);
    prompt_idle(prompt);
    if (!shown)
        show_step(prompt, true);
    if (outcome == STEP_STOPPED)
        breaks_note(prompt, number);
    report_outcome(prompt, request, frames, outcome);
    if (prompt->host->after_frames)
        prompt->host->after_frames(prompt);
    return !prompt->failed;
}

// Goes to a frame. Within the history, goes there directly. Beyond its end, computes frame by frame and shows a
// progress line. `last` is the last frame of the history.
static PetriStatus seek_frame(Prompt *prompt, int64_t frame, int64_t last) {
    int64_t frames = 0;
    PetriStatus status = prompt_go_to(prompt, frame < last ? frame : last);
    while (status == PETRI_OK && petri_frame_number(prompt->session) < frame) {
        status = prompt_go_to(prompt, last + ++frames);
        show_progress(prompt, frames, frame - last);
    }
    show_progress(prompt, 0, 0);
    return status;
}

// Like seek_frame. If a watched expression depends on the frame before, goes there first.
static PetriStatus seek_with_memory(Prompt *prompt, int64_t frame, const PetriHistoryInfo *history) {
    bool uses_previous = false;
    PetriStatus status = PETRI_OK;
    for (size_t i = 0; i < prompt->watched.count; i++)
        uses_previous = uses_previous || expression_uses_previous(&prompt->watched.items[i]);
    if (uses_previous && frame > history->first && frame - 1 <= history->last) {
        status = prompt_go_to(prompt, frame - 1);
        if (status == PETRI_OK)
            status = breaks_remember_all(prompt, &prompt->watched);
    }
    return status == PETRI_OK ? seek_frame(prompt, frame, history->last) : status;
}

static bool go_to(Prompt *prompt, int64_t frame) {
    refresh(prompt);
    prompt_busy(prompt);
    PetriHistoryInfo history = prompt_timeline(prompt);
    PetriStatus status = seek_with_memory(prompt, frame, &history);
    bool stopped = prompt_idle(prompt);
    prompt->incomplete = stopped;
    if (stopped)
        prompt_fail(prompt, "interrupted");
    else if (status == PETRI_INVALID && frame < history.first)
        prompt_fail(prompt, "cannot go to frame %" PRId64 ": the history starts at frame %" PRId64 "%s%s", frame,
                    history.first, !history.reason ? "" : ": ", !history.reason ? "" : history.reason);
    else if (status == PETRI_INVALID)
        prompt_fail(prompt, "cannot go to that frame");
    else
        prompt_status(prompt, status);
    if (status == PETRI_OK || stopped)
        show_frame(prompt);
    return status == PETRI_OK;
}

static bool run_step(Prompt *prompt, const char *rest) {
    int64_t count = 1;
    return argument_count(prompt, rest, 1, &count) && step_frames(prompt, &(StepRequest){.count = count});
}

static bool run_run(Prompt *prompt, const char *rest) {
    double seconds = 0;
    if (rest[0] == '\0')
        return step_frames(prompt, &(StepRequest){.count = prompt->limit, .limited = true});
    if (!argument_number(prompt, rest, &seconds))
        return false;
    if (seconds < 0)
        return prompt_fail(prompt, "not a time: '%s'; use seconds or a time code such as 1:30", rest);
    PetriFrame frame;
    petri_frame(prompt->session, &frame, sizeof frame);
    double frames = ceil(seconds * frame.fps - 1e-9);
    bool limited = frames > (double)prompt->limit;
    return step_frames(prompt, &(StepRequest){.count = limited ? prompt->limit : (int64_t)frames, .limited = limited});
}

static bool run_until(Prompt *prompt, const char *rest) {
    SCOPED_STRING expression = memory_strdup(rest);
    int64_t limit = prompt->limit;
    if (!argument_limit(prompt, expression, &limit))
        return false;
    if (expression[0] == '\0')
        return prompt_fail(prompt, ".until needs an expression");
    Expression until;
    if (!expression_parse(prompt, expression, &until))
        return false;
    bool done = step_frames(prompt, &(StepRequest){.count = limit, .until = &until});
    expression_free(&until);
    return done;
}

// Goes back to the last frame, from `min` on, in which `until` or a break is true. If there is none, goes to `min`, or
// stays if there is an `until`.
static bool go_back(Prompt *prompt, Expression *until, int64_t min) {
    int64_t now = petri_frame_number(prompt->session);
    BreakSearch search = {.until = until};
    prompt_busy(prompt);
    PetriStatus status = breaks_search(prompt, &search, min < 0 ? 0 : min);
    bool stopped = prompt_idle(prompt);
    bool found = status == PETRI_OK && search.found != INT64_MIN;
    if (!found && (status != PETRI_OK || until)) {
        prompt_go_to(prompt, now);
        return !stopped && status != PETRI_OK
                   ? prompt_status(prompt, status)
                   : prompt_fail(prompt, "%s", stopped ? "interrupted" : "the condition was true in no earlier frame");
    }
    bool done = go_to(prompt, found ? search.found : min);
    if (done && found && search.outcome == STEP_STOPPED)
        breaks_note(prompt, search.number);
    return done;
}

static bool back_until(Prompt *prompt, const char *text) {
    Expression until;
    if (text[0] == '\0')
        return prompt_fail(prompt, ".back until needs an expression");
    if (!expression_parse(prompt, text, &until))
        return false;
    bool done = go_back(prompt, &until, prompt_timeline(prompt).first);
    expression_free(&until);
    return done;
}

// Goes back to a frame, or to a break after it.
static bool jump_back(Prompt *prompt, int64_t frame) {
    return prompt->breaks.count > 0 ? go_back(prompt, NULL, frame) : go_to(prompt, frame);
}

static bool run_back(Prompt *prompt, const char *rest) {
    static const char until[] = "until";
    if (strncmp(rest, until, strlen(until)) == 0 && strchr(" \t", rest[strlen(until)])) {
        SCOPED_STRING expression = argument_trimmed(rest + strlen(until));
        return back_until(prompt, expression);
    }
    PetriHistoryInfo history = prompt_timeline(prompt);
    int64_t count = 1, ago = petri_frame_number(prompt->session) - history.first;
    if (!argument_count(prompt, rest, 1, &count))
        return false;
    if (count <= ago)
        return jump_back(prompt, petri_frame_number(prompt->session) - count);
    SCOPED_TEXT start = {0}; // the reason why the history does not start earlier
    text_add_format(&start, !history.reason ? "this is the start" : "the history starts here (%s)", history.reason);
    if (ago > 0)
        prompt_note(prompt, "went back only %" PRId64 " frame%s: %s", ago, ago == 1 ? "" : "s", start.bytes);
    else
        prompt_fail(prompt, "cannot go back: %s", start.bytes);
    return ago > 0 && jump_back(prompt, history.first);
}

static bool run_go(Prompt *prompt, const char *rest) {
    int64_t frame = -1;
    return argument_count(prompt, rest, -1, &frame) && go_to(prompt, frame);
}

static bool run_reset(Prompt *prompt, const char *rest) {
    (void)rest;
    if (prompt->host->go_to)
        return go_to(prompt, prompt_timeline(prompt).first);
    if (!prompt_status(prompt, petri_history_reset(prompt->history)))
        return false;
    show_frame(prompt);
    return true;
}

const PromptCommand STEP_COMMANDS[] = {
    {".step", "[N]", NULL, "compute N frames (default: 1)", run_step, COMPLETE_LANGUAGE},
    {".run", "[T]", NULL, "compute frames for T seconds of script time, or until Ctrl-C", run_run, COMPLETE_LANGUAGE},
    {".until", "EXPR [--limit N]", "an expression", "compute frames until EXPR is true, at most N", run_until,
     COMPLETE_LANGUAGE},
    {".back", "[N | until EXPR]", NULL, "go back N frames (default: 1), or to the last frame in which EXPR was true",
     run_back, COMPLETE_LANGUAGE},
    {".goto", "FRAME", "the number of a frame", "go to a frame, back or forward; -1: before frame 0", run_go,
     COMPLETE_LANGUAGE},
    {".reset", "", NULL, "go back to the start of the session", run_reset, COMPLETE_LANGUAGE},
    {0},
};
