// live_script.c: see live_script.h.
//
// The text of errors describes the current state: a load that succeeds removes it, and a completed frame removes what
// it has added. A reload, a new value of a parameter and a step back take time, so they resynchronise the clock.
#include "view/live_script.h"

#include "cli/parameters.h"
#include "cli/script.h"
#include "petri-inspect.h"
#include "petri-live.h"
#include "render/window_option.h"
#include "view/options.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_LOG = 1 << 16, MAX_ERROR_TEXT = 4000, MAX_WARNINGS = 3500 };

static void log_text(LiveScript *live, const char *text) {
    if (!live->hold_messages)
        fputs(text, stderr);
    else if (live->log.len < MAX_LOG)
        text_add_c(&live->log, text);
}

static void warnings_add(Warnings *warnings, const PetriDiagnostic *diagnostic) {
    warnings->count += diagnostic->level == PETRI_NOTE ? 0 : 1;
    if (warnings->text.len < MAX_WARNINGS)
        text_add_c(&warnings->text, diagnostic->rendered);
}

static void warnings_clear(Warnings *warnings) {
    text_free(&warnings->text);
    *warnings = (Warnings){0};
}

static void on_diagnostic(void *context, const PetriDiagnostic *diagnostic) {
    LiveScript *live = context;
    live->invalid_definition = live->invalid_definition || is_invalid_definition(diagnostic);
    if (diagnostic->level != PETRI_NOTE) // a note belongs to the diagnostic before it
        live->shown = diagnostic->level == PETRI_ERROR || live->options->verbosity > LOG_QUIET;
    if (live->shown) {
        log_text(live, diagnostic->rendered);
        warnings_add(&live->warnings, diagnostic);
    }
    if (diagnostic->level == PETRI_ERROR && live->error_text.len < MAX_ERROR_TEXT)
        text_add_c(&live->error_text, diagnostic->rendered);
}

static void clear_error_text(LiveScript *live) {
    text_free(&live->error_text);
}

static void truncate_error_text(LiveScript *live, size_t length) {
    if (live->error_text.len > length) {
        live->error_text.len = length;
        live->error_text.bytes[length] = '\0';
    }
}

const char *live_script_error_text(const LiveScript *live) {
    return live->error_text.len > 0 ? live->error_text.bytes : "";
}

// Inserts a line at the start of the error text.
static void prefix_error_text(LiveScript *live, const char *line) {
    Text whole = {0};
    text_add_format(&whole, "%s\n%s", line, live_script_error_text(live));
    text_free(&live->error_text);
    live->error_text = whole;
}

static bool is_outdated(const LiveScript *live) {
    return live->state == LIVE_OUTDATED || live->state == LIVE_OUTDATED_HALTED;
}

bool live_script_halted(const LiveScript *live) {
    return live->state == LIVE_HALTED || live->state == LIVE_OUTDATED_HALTED;
}

static void resume(LiveScript *live) {
    live->state = is_outdated(live) ? LIVE_OUTDATED : LIVE_RUNNING;
}

// Watches the script and all files that it has included or imported so far.
static void watch_sources(LiveScript *live) {
    const char *source;
    if (live->options->replayed)
        return; // its files do not change
    file_watch_add(live->watch, live->options->script);
    for (size_t i = 0; (source = petri_source_file(live->session, i)); i++)
        file_watch_add(live->watch, source);
}

static int load_initial(LiveScript *live) {
    PetriStatus status = options_load(live->options, live->session);
    if (status != PETRI_OK)
        return live->invalid_definition ? STATUS_USAGE : STATUS_FAILED;
    state_file_restore(&live->state_file, live->session, live->options->state_file);
    return OPTIONS_READ;
}

int live_script_open(LiveScript *live, const CommandContext *host, const Options *options) {
    live->options = options;
    live->detail = 1;
    int status = options_open(options, host, on_diagnostic, live, &live->session);
    if (status != OPTIONS_READ)
        return status;
    if (!archiving_begin(&live->archiving, options, "view", live->session))
        return STATUS_FAILED;
    live->watch = file_watch_new();
    live->painter = painter_open_tested(&live->tester);
    watch_sources(live);
    if (!live->painter) {
        message("out of memory");
        return STATUS_FAILED;
    }
    petri_painter_serve(live->painter, live->session);
    status = load_initial(live);
    clear_error_text(live);
    return status;
}

void live_script_close(LiveScript *live) {
    if (!recording_end(&live->recording, false)) {
        message("%s", live->recording.error_text);
        live->failed = true;
    }
    recording_free(&live->recording);
    petri_picture_free(&live->picture);
    petri_picture_free(&live->last_complete);
    petri_history_free(live->history);
    archiving_end(&live->archiving);
    petri_close(&live->session);
    petri_painter_close(&live->painter);
    file_watch_free(live->watch);
    text_free(&live->log);
    text_free(&live->error_text);
    warnings_clear(&live->warnings);
}

bool live_script_check_drawn(LiveScript *live, PetriStatus status) {
    if (status == PETRI_OUT_OF_MEMORY && !live->memory_reported) {
        log_text(live, "petri: out of memory: a picture could not be drawn\n");
        live->memory_reported = live->failed = true;
    }
    return status == PETRI_OK;
}

// Renders the frame for the files of `!record` nodes, and reports drawing diagnostics.
static void record_frame(LiveScript *live) {
    if (live->awaits_display)
        return;
    PetriFrame frame;
    petri_frame(live->session, &frame, sizeof frame);
    live->recording.fps = frame.fps;
    if (petri_picture_needs_history(live->picture) && !recording_add(&live->recording, live->picture, live->painter))
        live->failed = true;
    petri_picture_report(live->session, live->picture);
}

static PetriPictureOptions picture_options(const LiveScript *live) {
    const ViewOptions *own = view_options(live->options);
    PetriPictureOptions options = petri_default_picture_options();
    options.automatic = own->automatic ? PETRI_AUTO_ALWAYS : PETRI_AUTO_IF_NEEDED;
    options.window =
        window_option(live->session, own->window, live->all_windows ? PETRI_ALL_WINDOWS : PETRI_FIRST_WINDOW);
    return options;
}

// Frees the picture, or stores it for later if it is complete.
static void retire_picture(LiveScript *live) {
    if (live->picture_state == PICTURE_COMPLETE) {
        petri_picture_free(&live->last_complete);
        live->last_complete = live->picture;
        live->picture = NULL;
    }
    petri_picture_free(&live->picture);
}

PetriPicture *live_script_draw(LiveScript *live) {
    if (live->picture_state <= PICTURE_HIDDEN)
        return NULL;
    PetriStatus status = petri_picture_render(live->picture, live->painter);
    bool complete = status == PETRI_OK && !petri_picture_lacks_shader(live->picture);
    live->picture_state = complete ? PICTURE_COMPLETE : PICTURE_VISIBLE;
    live_script_check_drawn(live, status);
    size_t before = live->error_text.len;
    petri_picture_report(live->session, live->picture);
    if (!complete && live->last_complete && before == 0 && live->error_text.len > 0)
        prefix_error_text(live, "a shader or scene failed, showing the last complete picture");
    return complete || !live->last_complete ? live->picture : live->last_complete;
}

// Makes the picture of the last frame. Until particles are at their positions, a previous picture is retained; if there
// is none, the new picture is made only for its size.
static void update_picture(LiveScript *live) {
    PetriPictureOptions options = picture_options(live);
    options.detail = live->detail;
    live->before_first_picture = !petri_picture_ready(live->session, &options);
    if (live->before_first_picture && live->picture)
        return;
    retire_picture(live);
    PetriStatus status = petri_picture(live->session, &options, &live->picture);
    live->picture_state = !live->picture ? PICTURE_NONE : live->before_first_picture ? PICTURE_HIDDEN : PICTURE_VISIBLE;
    if (live_script_check_drawn(live, status) && !live->before_first_picture)
        record_frame(live);
}

void live_script_set_detail(LiveScript *live, double detail) {
    bool changed = detail != live->detail;
    live->detail = detail;
    // A picture that depends on earlier frames is always in full detail, and must not be made twice.
    if (changed && live->picture && !live->before_first_picture && !petri_picture_needs_history(live->picture))
        update_picture(live);
}

void live_script_begin(LiveScript *live) {
    live->awaits_display = false;
    if (live->picture && !live->before_first_picture)
        record_frame(live);
}

bool live_script_step(LiveScript *live) {
    size_t before = live->error_text.len;
    PetriStatus status =
        view_options(live->options)->listen ? petri_history_step(live->history) : petri_step(live->session);
    PetriFrame frame;
    petri_frame(live->session, &frame, sizeof frame);
    if (status != PETRI_OK) {
        char line[100];
        snprintf(line, sizeof line, "stopped in frame %" PRId64 "%s", frame.number,
                 status == PETRI_OUT_OF_MEMORY ? ": out of memory" : "");
        log_text(live, "petri: ");
        log_text(live, line);
        log_text(live, "\n");
        prefix_error_text(live, line);
        live->state = is_outdated(live) ? LIVE_OUTDATED_HALTED : LIVE_HALTED;
        return false;
    }
    if (live->options->after_frame)
        live->options->after_frame(live->options->unsaved_host, live->session);
    archiving_check(&live->archiving);
    watch_sources(live); // the frame may have imported modules
    update_picture(live);
    live->frames += live->before_first_picture ? 0 : 1;
    // If a frame completes, its errors are reported on standard error only, as in petri run.
    truncate_error_text(live, before);
    if (live->options->verbosity >= LOG_DEBUG) {
        char line[200];
        snprintf(line, sizeof line, "petri: frame %" PRId64 ": script %.3f ms, physics %.3f ms, %" PRIu64 " steps\n",
                 frame.number, frame.evaluation_seconds * 1e3, frame.physics_seconds * 1e3, frame.physics_steps);
        log_text(live, line);
    }
    return true;
}

// Keeps the new warnings if the load succeeded, else restores the previous warnings (`before`).
static void choose_warnings(LiveScript *live, Warnings *before, bool loaded) {
    if (loaded) {
        warnings_clear(before);
    } else {
        warnings_clear(&live->warnings);
        live->warnings = *before;
    }
}

bool live_script_reload(LiveScript *live) {
    if (!file_watch_changed(live->watch))
        return false;
    Warnings before = live->warnings;
    live->warnings = (Warnings){0};
    clear_error_text(live);
    bool loaded = petri_reload(live->session, live->options->script) == PETRI_OK;
    choose_warnings(live, &before, loaded);
    if (loaded) {
        live->state = LIVE_RUNNING;
        watch_sources(live);
        clear_error_text(live); // after a successful load, errors are listed only with the warnings
    } else {
        live->state = live_script_halted(live) ? LIVE_OUTDATED_HALTED : LIVE_OUTDATED;
        prefix_error_text(live, "reload failed, still running the last good version");
    }
    petri_resync_clock(live->session);
    return true;
}

bool live_script_set_parameter(LiveScript *live, const char *name, const char *value) {
    size_t before = live->error_text.len;
    Warnings known = live->warnings;
    live->warnings = (Warnings){0};
    bool done = petri_set_parameter(live->session, name, value) == PETRI_OK;
    choose_warnings(live, &known, done);
    if (done) {
        resume(live);
        truncate_error_text(live, is_outdated(live) ? before : 0);
    }
    petri_resync_clock(live->session);
    return done;
}

bool live_script_enable_history(LiveScript *live) {
    live->history = petri_history_new(live->session, 0);
    if (!live->history)
        message("out of memory");
    return live->history;
}

bool live_script_go_back(LiveScript *live, int64_t count, Text *why) {
    PetriHistoryInfo history;
    petri_history_info(live->history, &history, sizeof history);
    int64_t now = petri_frame_number(live->session), first = history.first + 1;
    if (now <= first) {
        text_add_format(why, "cannot go back: %s", !history.reason ? "this is the start" : history.reason);
        return false;
    }
    PetriStatus status = petri_history_goto(live->history, count < now - first ? now - count : first);
    if (status == PETRI_OK) {
        resume(live);
        update_picture(live);
    } else {
        text_add_c(why, petri_status_text(status));
    }
    petri_resync_clock(live->session);
    return status == PETRI_OK;
}

void live_script_reset(LiveScript *live) {
    petri_reset(live->session);
    petri_history_start(live->history, NULL);
    resume(live);
    if (!is_outdated(live))
        clear_error_text(live);
}

// Sets `name` to the script's file name without folder and suffix.
static void base_name(const char *script, char *name, size_t size) {
    const char *slash = strrchr(script, '/');
    snprintf(name, size, "%s", !slash ? script : slash + 1);
    char *dot = strrchr(name, '.');
    if (dot && dot != name)
        *dot = '\0';
}

// Writes the last frame's picture to a file in full detail. Returns false if this fails.
static bool save_picture(LiveScript *live, const char *name) {
    PetriPictureOptions options = picture_options(live);
    PetriPicture *full = NULL;
    if (live->detail < 1 && petri_frame_number(live->session) == petri_picture_frame(live->picture))
        petri_picture(live->session, &options, &full);
    PetriPicture *picture = full ? full : live->picture;
    bool saved = petri_picture_save(picture, live->painter, name) == PETRI_OK;
    petri_picture_report(live->session, picture);
    petri_picture_free(&full);
    return saved;
}

bool live_script_screenshot(LiveScript *live, char *name, size_t size) {
    char base[200];
    if (live->picture_state <= PICTURE_HIDDEN) {
        snprintf(name, size, "a picture: nothing has been drawn");
        return false;
    }
    base_name(live->options->script, base, sizeof base);
    int64_t frame = petri_picture_frame(live->picture);
    snprintf(name, size, "%s-%05" PRId64 ".png", base, frame);
    for (int i = 2; access(name, F_OK) == 0; i++)
        snprintf(name, size, "%s-%05" PRId64 "-%d.png", base, frame, i);
    return save_picture(live, name);
}

void live_script_save(LiveScript *live, bool at_once) {
    const char *error = state_file_save(&live->state_file, live->session, at_once);
    if (error) {
        log_text(live, "petri: ");
        log_text(live, error);
        log_text(live, "\n");
    }
}

void live_script_release_messages(LiveScript *live) {
    live->hold_messages = false;
    if (live->log.len > 0)
        fputs(live->log.bytes, stderr);
    text_free(&live->log);
}

void warnings_mark(const Warnings *warnings, char *text, size_t size) {
    text[0] = '\0';
    if (warnings->count > 0)
        snprintf(text, size, "%d warning%s: w", warnings->count, warnings->count == 1 ? "" : "s");
}

void warnings_list(const Warnings *warnings, char *text, size_t size) {
    if (warnings->count == 0) {
        snprintf(text, size, "No warnings. w hides this.");
        return;
    }
    snprintf(text, size, "%d warning%s. w hides this.\n%s%s", warnings->count, warnings->count == 1 ? "" : "s",
             warnings->text.bytes, warnings->text.len < MAX_WARNINGS ? "" : "More warnings are on standard error.");
}
