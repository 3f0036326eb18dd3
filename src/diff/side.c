// side.c: sides that are computed in this process: scripts and state files.
#include "base/file.h"
#include "cli/archive.h"
#include "cli/script.h"
#include "cli/subprocess.h"
#include "diff/diff.h"
#include "petri-inspect.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Shows each diagnostic only once, because the sides often run the same script.
static void on_diagnostic(void *context, const PetriDiagnostic *diagnostic) {
    Side *side = context;
    bool shown = diagnostic->level == PETRI_ERROR || side->options->verbosity > LOG_QUIET;
    if (!shown || texts_contain(side->reported, diagnostic->rendered))
        return;
    texts_add(side->reported, diagnostic->rendered);
    fputs(diagnostic->rendered, stderr);
}

static bool open_session(Side *side) {
    return options_open(side->options, side->host, on_diagnostic, side, &side->session) == OPTIONS_READ;
}

static void read_clock(Side *side) {
    PetriFrame frame;
    petri_frame(side->session, &frame, sizeof frame);
    side->frame = frame.number;
    side->time = frame.time;
}

static void print_session(Side *side, Text *text) {
    petri_print(side->session, PETRI_PRINT_STATE, text_collect, text);
}

static void close_session(Side *side) {
    petri_close(&side->session);
}

// --- scripts

static bool next_frame(Side *side) {
    if (side->computed == side->frames)
        return false;
    PetriStatus status = petri_step(side->session);
    if (status != PETRI_OK) {
        message("%s: frame %" PRId64 ": %s", side->label.bytes, petri_frame_number(side->session) + 1,
                petri_status_text(status));
        side->failed = true;
        return false;
    }
    side->computed++;
    read_clock(side);
    return true;
}

static const SideKind SCRIPT_SIDE = {.next = next_frame, .print = print_session, .close = close_session};

static bool open_script(Side *side) {
    side->kind = &SCRIPT_SIDE;
    return open_session(side) && script_load(side->session, side->source) == PETRI_OK;
}

// Opens a script as it is in git.
static bool open_committed(Side *side) {
    Options options = *side->options;
    side->kind = &SCRIPT_SIDE;
    options.unsaved = committed_read;
    options.unsaved_host = side;
    return options_open(&options, side->host, on_diagnostic, side, &side->session) == OPTIONS_READ &&
           committed_load(side);
}

// --- archives

// Compares archived frames by computing them.
static bool next_archived(Side *side) {
    PetriArchiveInfo info;
    bool more =
        petri_archive_info(side->archive, &info, sizeof info) && petri_frame_number(side->session) < info.last_frame;
    bool found = more && next_frame(side);
    side->failed = archive_report_problem(side->archive, side->source) || side->failed;
    return found && !side->failed;
}

static void close_archive(Side *side) {
    petri_close(&side->session);
    petri_archive_close(&side->archive);
}

static const SideKind ARCHIVE_SIDE = {.next = next_archived, .print = print_session, .close = close_archive};

static bool open_archive(Side *side) {
    Options options = *side->options;
    side->kind = &ARCHIVE_SIDE;
    side->archive = replay_archive(&options, side->source);
    if (archive_report_problem(side->archive, side->source))
        return false;
    options.replayed = side->archive;
    options.definitions = (TextList){0};
    bool replays = options_open(&options, side->host, on_diagnostic, side, &side->session) == OPTIONS_READ &&
                   petri_archive_replay(side->archive, side->session, -1) == PETRI_OK;
    archive_report_problem(side->archive, side->source);
    return replays;
}

// --- state files

static bool next_state(Side *side) {
    if (side->computed > 0)
        return false;
    side->computed = 1;
    read_clock(side);
    side->time = NAN; // a state file has no time
    return true;
}

static const SideKind STATE_SIDE = {.next = next_state, .print = print_session, .close = close_session};

static bool is_state_file(const char *source) {
    static const char head[] = "petri-state ";
    char start[sizeof head] = "";
    FILE *file = fopen(source, "r");
    size_t length = file ? fread(start, 1, sizeof head - 1, file) : 0;
    if (file)
        fclose(file);
    return length == sizeof head - 1 && strcmp(start, head) == 0;
}

static bool open_state(Side *side) {
    side->kind = &STATE_SIDE;
    return open_session(side) && petri_load_text(side->session, "empty", "", 0) == PETRI_OK &&
           petri_restore(side->session, side->source) == PETRI_OK;
}

// --- all sides

bool side_is_golden(const char *source) {
    return source && str_ends_with(str_from(source), STR(".golden"));
}

bool side_open(Side *side) {
    if (side_is_golden(side->source))
        return printed_open_golden(side);
    if (!side->with && committed_is(side->source))
        return open_committed(side);
    if (!script_is_stdin(side->source) && is_state_file(side->source))
        return open_state(side);
    if (!side->with && !script_is_stdin(side->source) && petri_archive_is(side->source))
        return open_archive(side);
    return side->with ? printed_open_process(side) : open_script(side);
}

void side_close(Side *side) {
    if (side->kind)
        side->kind->close(side);
    committed_free(side);
    text_free(&side->label);
    text_free(&side->current);
    text_free(&side->ahead);
}

// --- the prompt of another process

static char *read_answer(int file) {
    Text text = {0};
    lseek(file, 0, SEEK_SET);
    if (!text_read(&text, file, SIZE_MAX))
        text_free(&text);
    return text.bytes;
}

char *side_ask(const Side *side, int64_t frame, const char *command) {
    SCOPED_TEXT input = {0};
    TextList words = {0};
    char *answer = NULL;
    const char *const first[] = {side->with, "repl"};
    for (size_t i = 0; i < sizeof first / sizeof first[0]; i++)
        texts_add(&words, first[i]);
    for (size_t i = 0; i < side->options->definitions.count; i++) {
        texts_add(&words, "-D");
        texts_add(&words, side->options->definitions.items[i]);
    }
    if (side->options->fps_given)
        texts_add_format(&words, "--fps=%.17g", side->options->fps);
    texts_add(&words, side->source);
    text_add_format(&input, ".step %" PRId64 "\n%s\n", frame + 1, command);
    int files[] = {subprocess_temporary_file(), subprocess_temporary_file(), -1};
    bool ready = files[0] >= 0 && files[1] >= 0 && write(files[0], input.bytes, input.len) == (ssize_t)input.len &&
                 lseek(files[0], 0, SEEK_SET) == 0;
    pid_t pid = ready ? subprocess_spawn(side->with, (const char *const *)words.items, files, 3, false) : -1;
    if (pid > 0) {
        subprocess_wait_for(pid);
        answer = read_answer(files[1]);
    }
    for (int i = 0; i < 2; i++)
        if (files[i] >= 0)
            close(files[i]);
    texts_free(&words);
    return answer;
}
