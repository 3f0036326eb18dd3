// archive.c: see archive.h.
#include "cli/archive.h"

#include "base/source.h"
#include "cli/args.h"
#include "cli/script.h"
#include "petri-edit.h"

#include <math.h>
#include <string.h>

// Adds a word of the command line. Absolute paths are shortened to file names, because an archive must not reveal where
// its author keeps files.
static void add_word(Text *text, const char *word) {
    const char *slash = strchr(word, '/'), *equals = strchr(word, '=');
    bool is_path = slash && (slash == word || (equals && slash == equals + 1));
    size_t prefix = is_path ? (size_t)(slash - word) : strlen(word);
    SCOPED_TEXT whole = {0};
    text_add(&whole, (Str){word, prefix});
    if (is_path)
        text_add_c(&whole, strrchr(word, '/') + 1);
    text_add_char(text, ' ');
    shell_add_word(text, whole.bytes);
}

// Returns the command line. The caller frees it.
static char *describe_command(const Options *options, const char *command) {
    Text words = {0};
    text_add_format(&words, "petri %s", command);
    for (int i = 0; i < options->argc; i++)
        add_word(&words, options->argv[i]);
    return words.bytes;
}

bool archiving_start(Archiving *archiving, const char *file, const Options *options, const char *command,
                     PetriSession *session) {
    SCOPED_STRING words = describe_command(options, command);
    PetriArchiveOptions wanted = petri_archive_default_options();
    wanted.keyframe_every = options->keyframe_every;
    wanted.digest_every = options->digest_every;
    wanted.command = words;
    *archiving = (Archiving){petri_archive_create(session, file, &wanted), memory_strdup(file), false};
    const char *problem = archiving->archive ? petri_archive_problem(archiving->archive) : "out of memory";
    if (!problem)
        return true;
    message("cannot write the archive '%s': %s", file, problem);
    archiving->failed = true; // so that the problem is not reported again
    archiving_end(archiving);
    return false;
}

bool archiving_begin(Archiving *archiving, const Options *options, const char *command, PetriSession *session) {
    return !options->archive || archiving_start(archiving, options->archive, options, command, session);
}

void archiving_check(Archiving *archiving) {
    const char *problem = petri_archive_problem(archiving->archive);
    if (!problem || archiving->failed)
        return;
    archiving->failed = true;
    message("the archive '%s' ends here: %s", archiving->name, problem);
}

bool archiving_end(Archiving *archiving) {
    petri_archive_complete(archiving->archive);
    archiving_check(archiving);
    petri_archive_close(&archiving->archive);
    memory_free_string(&archiving->name);
    archiving->name = NULL;
    return !archiving->failed;
}

// --- replays

bool archive_report_problem(const PetriArchive *archive, const char *file) {
    const char *problem = archive ? petri_archive_problem(archive) : "out of memory";
    if (problem)
        message("cannot read '%s': %s", file, problem);
    return problem;
}

PetriArchive *replay_archive(const Options *options, const char *file) {
    return petri_archive_open(file, options_memory_limit(options) / 2);
}

// Sets the default number of frames: those that are recorded.
static void set_frames(Options *options, const Command *command) {
    PetriArchiveInfo info;
    if (options->from < 0)
        options->from = options->frame;
    if (options->frames < 0 && isnan(options->run_time) && !command->live &&
        petri_archive_info(options->replayed, &info, sizeof info)) {
        int64_t first = options->from > info.first_frame ? options->from : info.first_frame;
        options->frames = info.last_frame < first ? 0 : info.last_frame - first + 1;
    }
}

int replay_open(Options *options, const Command *command) {
    bool replays = option_find(command_options(command), "from", '\0'); // as all commands that replay archives
    if (!replays || !options->script || script_is_stdin(options->script) || !petri_archive_is(options->script)) {
        if (options->from >= 0)
            message("option '--from' needs an archive");
        return options->from >= 0 ? STATUS_USAGE : OPTIONS_READ;
    }
    if (options->definitions.count > 0 || options->archive || options->state_file) {
        message("cannot use '--%s' with an archive", options->archive      ? "archive"
                                                     : options->state_file ? "state"
                                                                           : "define");
        return STATUS_USAGE;
    }
    options->replayed = replay_archive(options, options->script);
    if (archive_report_problem(options->replayed, options->script))
        return STATUS_FAILED;
    set_frames(options, command);
    return archive_report_problem(options->replayed, options->script) ? STATUS_FAILED : OPTIONS_READ;
}

PetriStatus replay_load(const Options *options, PetriSession *session) {
    PetriStatus status = petri_archive_load(options->replayed, session, options->from - 1);
    while (status == PETRI_OK && petri_frame_number(session) < options->from - 1)
        status = petri_step(session);
    if (status != PETRI_OK && !archive_report_problem(options->replayed, options->script))
        message("cannot replay '%s': %s", options->script, petri_status_text(status));
    return status;
}

PetriStatus replay_check(const Options *options, PetriSession *session) {
    PetriArchiveInfo info;
    bool known = petri_archive_info(options->replayed, &info, sizeof info);
    return known ? petri_check(session, info.script) : PETRI_INVALID;
}
