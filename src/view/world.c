// world.c: see world.h.
#include "view/world.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/parameters.h"
#include "cli/script.h"

enum { MOST_LOG = 1 << 16, MOST_TROUBLE = 4000, MOST_WARNINGS = 3500 };

static void log_text(World *world, const char *text) {
    if (!world->mute) {
        fputs(text, stderr);
    } else if (world->log.length < MOST_LOG) {
        bytes_add_text(&world->log, text);
    }
}

static void warnings_add(Warnings *warnings, const PetriDiagnostic *diagnostic) {
    warnings->count += diagnostic->level == PETRI_NOTE ? 0 : 1;
    if (warnings->text.length < MOST_WARNINGS) {
        bytes_add_text(&warnings->text, diagnostic->rendered);
    }
}

static void warnings_forget(Warnings *warnings) {
    bytes_free(&warnings->text);
    *warnings = (Warnings){0};
}

static void on_diagnostic(void *context, const PetriDiagnostic *diagnostic) {
    World *world = context;
    world->wrong_definition = world->wrong_definition || is_wrong_definition(diagnostic);
    if (diagnostic->level != PETRI_NOTE) { // notes belong to the diagnostic before them
        world->shown = diagnostic->level == PETRI_ERROR || world->options->verbosity > LOG_QUIET;
    }
    if (world->shown) {
        log_text(world, diagnostic->rendered);
        warnings_add(&world->warnings, diagnostic);
    }
    if (diagnostic->level == PETRI_ERROR && world->trouble.length < MOST_TROUBLE) {
        bytes_add_text(&world->trouble, diagnostic->rendered);
    }
}

static void forget_trouble(World *world) {
    bytes_free(&world->trouble);
}

static void cut_trouble(World *world, size_t length) {
    if (world->trouble.length > length) {
        world->trouble.length = length;
        world->trouble.data[length] = '\0';
    }
}

const char *world_trouble(const World *world) {
    return world->trouble.length > 0 ? world->trouble.data : "";
}

// Puts a line before what is wrong, if anything is.
static void head_trouble(World *world, const char *line) {
    Bytes whole = {0};
    bytes_format(&whole, "%s\n%s", line, world_trouble(world));
    bytes_free(&world->trouble);
    world->trouble = whole;
}

// The script, and what it includes and imports as far as that is known.
static void watch_sources(World *world) {
    const char *source;
    watch_file(world->watch, world->options->script);
    for (size_t i = 0; (source = petri_source(world->session, i)) != NULL; i++) {
        watch_file(world->watch, source);
    }
}

static int load_first(World *world) {
    PetriStatus status = script_load(world->session, world->options->script);
    if (status != PETRI_OK) {
        return world->wrong_definition ? STATUS_USAGE : STATUS_FAILED;
    }
    state_file_restore(&world->state, world->session, world->options->state_file);
    return OPTIONS_READ;
}

int world_open(World *world, const Host *host, const Options *options) {
    world->options = options;
    int status = options_open(options, host, on_diagnostic, world, &world->session);
    if (status != OPTIONS_READ) {
        return status;
    }
    world->watch = watch_new();
    world->painter = petri_painter_open();
    watch_sources(world);
    if (world->painter == NULL) {
        message("out of memory");
        return STATUS_FAILED;
    }
    status = load_first(world);
    forget_trouble(world);
    return status;
}

void world_close(World *world) {
    if (!recording_end(&world->recording, false)) {
        message("%s", world->recording.trouble);
        world->failed = true;
    }
    recording_free(&world->recording);
    petri_picture_free(&world->picture);
    petri_painter_close(&world->painter);
    history_free(&world->history);
    petri_close(&world->session);
    watch_free(world->watch);
    bytes_free(&world->log);
    bytes_free(&world->trouble);
    warnings_forget(&world->warnings);
}

bool world_drawn(World *world, PetriStatus status) {
    if (status == PETRI_MEMORY && !world->lacking) {
        log_text(world, "petri: out of memory: a picture could not be drawn\n");
        world->lacking = world->failed = true;
    }
    return status == PETRI_OK;
}

// Files that the script's `!record` nodes name.
static void record(World *world) {
    if (world->waits) {
        return;
    }
    world->recording.fps = petri_frame(world->session).fps;
    if (petri_picture_looks_back(world->picture) && !recording_add(&world->recording, world->picture, world->painter)) {
        world->failed = true;
    }
    petri_picture_tell(world->session, world->picture);
}

// Of an early frame, unless there is a picture that can stay for so long, only the size is wanted.
static void take_picture(World *world) {
    PetriPictureOptions options = petri_default_picture_options();
    options.automatic = world->options->automatic ? PETRI_AUTO_ALWAYS : PETRI_AUTO_IF_NEEDED;
    world->early = !petri_picture_ready(world->session, &options);
    if (world->early && world->picture != NULL) {
        return;
    }
    world->unseen = world->early;
    petri_picture_free(&world->picture);
    PetriStatus status = petri_picture(world->session, &options, &world->picture);
    if (world_drawn(world, status) && !world->early) {
        record(world);
    }
}

void world_begin(World *world) {
    world->waits = false;
    if (world->picture != NULL && !world->early) {
        record(world);
    }
}

bool world_step(World *world) {
    size_t before = world->trouble.length;
    PetriStatus status = world->remembers ? history_step(&world->history, world->session) : petri_step(world->session);
    PetriFrame frame = petri_frame(world->session);
    if (status != PETRI_OK) {
        char line[100];
        snprintf(line, sizeof line, "stopped in frame %" PRId64 "%s", frame.number,
                 status == PETRI_MEMORY ? ": out of memory" : "");
        log_text(world, "petri: ");
        log_text(world, line);
        log_text(world, "\n");
        head_trouble(world, line);
        world->halted = true;
        return false;
    }
    watch_sources(world); // modules are imported by frames
    take_picture(world);
    world->frames += world->early ? 0 : 1;
    cut_trouble(world, before); // faults of a frame that went on are told on standard error, as in a run
    if (world->options->verbosity >= LOG_DEBUG) {
        char line[200];
        snprintf(line, sizeof line, "petri: frame %" PRId64 ": script %.3f ms, physics %.3f ms, %" PRIu64 " steps\n",
                 frame.number, frame.evaluation_seconds * 1e3, frame.physics_seconds * 1e3, frame.physics_steps);
        log_text(world, line);
    }
    return true;
}

// After an attempt to load: what it said counts if it went well, what was said before if not.
static void choose_warnings(World *world, Warnings *before, bool loaded) {
    if (loaded) {
        warnings_forget(before);
    } else {
        warnings_forget(&world->warnings);
        world->warnings = *before;
    }
}

bool world_reload(World *world) {
    if (!watch_changed(world->watch)) {
        return false;
    }
    Warnings before = world->warnings;
    world->warnings = (Warnings){0};
    forget_trouble(world);
    bool loaded = petri_reload(world->session, world->options->script) == PETRI_OK;
    choose_warnings(world, &before, loaded);
    if (loaded) {
        world->halted = world->broken = false;
        watch_sources(world);
        forget_trouble(world); // of a load that went well, errors are only warnings to the eye
    } else {
        world->broken = true;
        head_trouble(world, "The script was changed but cannot be loaded. The last good version is running.");
    }
    petri_hold(world->session);
    return true;
}

bool world_set_parameter(World *world, const char *name, const char *value) {
    size_t before = world->trouble.length;
    Warnings known = world->warnings;
    world->warnings = (Warnings){0};
    bool done = petri_set_parameter(world->session, name, value) == PETRI_OK;
    choose_warnings(world, &known, done);
    if (done) {
        world->halted = false;
        cut_trouble(world, world->broken ? before : 0);
    }
    petri_hold(world->session);
    return done;
}

bool world_remember(World *world) {
    world->history.live = world->options->realtime;
    world->remembers = history_start(&world->history, world->session, NULL);
    if (!world->remembers) {
        message("out of memory");
    }
    return world->remembers;
}

bool world_go_back(World *world, int64_t count, Bytes *why) {
    int64_t now = petri_frame(world->session).number, first = world->history.first + 1;
    if (now <= first) {
        bytes_format(why, "there is nothing to go back to: %s",
                     world->history.why == NULL ? "this is the start" : world->history.why);
        return false;
    }
    PetriStatus status = history_goto(&world->history, world->session, count < now - first ? now - count : first, why);
    if (status == PETRI_OK) {
        world->halted = false;
        take_picture(world);
    } else if (why->length == 0) {
        bytes_add_text(why, petri_status_text(status));
    }
    petri_hold(world->session);
    return status == PETRI_OK;
}

void world_reset(World *world) {
    petri_clear(world->session);
    if (world->remembers) {
        history_start(&world->history, world->session, NULL);
    }
    world->halted = false;
    if (!world->broken) {
        forget_trouble(world);
    }
}

// The script's name without folders and suffix.
static void base_name(const char *script, char *name, size_t size) {
    const char *slash = strrchr(script, '/');
    snprintf(name, size, "%s", slash == NULL ? script : slash + 1);
    char *dot = strrchr(name, '.');
    if (dot != NULL && dot != name) {
        *dot = '\0';
    }
}

bool world_screenshot(World *world, char *name, size_t size) {
    char base[200];
    if (world->picture == NULL || world->unseen) {
        snprintf(name, size, "a picture, for there is none");
        return false;
    }
    base_name(world->options->script, base, sizeof base);
    int64_t frame = petri_picture_frame(world->picture);
    snprintf(name, size, "%s-%05" PRId64 ".png", base, frame);
    for (int i = 2; access(name, F_OK) == 0; i++) {
        snprintf(name, size, "%s-%05" PRId64 "-%d.png", base, frame, i);
    }
    bool saved = petri_picture_save(world->picture, world->painter, name) == PETRI_OK;
    petri_picture_tell(world->session, world->picture);
    return saved;
}

void world_save(World *world, bool at_once) {
    const char *news = state_file_save(&world->state, world->session, at_once);
    if (news != NULL) {
        log_text(world, "petri: ");
        log_text(world, news);
        log_text(world, "\n");
    }
}

void world_unmute(World *world) {
    world->mute = false;
    if (world->log.length > 0) {
        fputs(world->log.data, stderr);
    }
    bytes_free(&world->log);
}

void warnings_mark(const Warnings *warnings, char *text, size_t size) {
    text[0] = '\0';
    if (warnings->count > 0) {
        snprintf(text, size, "%d warning%s: w", warnings->count, warnings->count == 1 ? "" : "s");
    }
}

void warnings_list(const Warnings *warnings, char *text, size_t size) {
    if (warnings->count == 0) {
        snprintf(text, size, "No warnings. w hides this.");
        return;
    }
    snprintf(text, size, "%d warning%s. w hides this.\n%s%s", warnings->count, warnings->count == 1 ? "" : "s",
             warnings->text.data, warnings->text.length < MOST_WARNINGS ? "" : "… more are on standard error.");
}
