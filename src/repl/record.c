// record.c: `.record`, which writes the frames as a golden (expected output) for `petri test` (spec cli.md 3.4).
//
// NAME.golden needs a script NAME.fl beside it. If NAME.fl is not the loaded script, `.record` creates it: a copy of
// the loaded script, followed by the statements typed at the prompt. NAME.fl must be in the folder of the loaded
// script, because file names in a script are relative to the script's folder. Frames are recorded only if a run from
// frame 0 with one script and fixed settings reproduces them.
#include "base/file.h"
#include "base/os.h"
#include "cli/memory.h"
#include "petri-inspect.h"
#include "petri-live.h"
#include "repl/repl.h"

#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Returns true if both paths lead to the same file or folder.
static bool same_path(const char *a, const char *b) {
    char resolved[2][PATH_MAX];
    return realpath(a, resolved[0]) && realpath(b, resolved[1]) && strcmp(resolved[0], resolved[1]) == 0;
}

static bool same_folder(const char *a, const char *b) {
    SCOPED_STRING first = memory_folder(a);
    SCOPED_STRING second = memory_folder(b);
    return same_path(first, second);
}

static bool can_record(Repl *repl, const char *script) {
    int64_t now = petri_frame_number(repl->session);
    PetriHistoryInfo history;
    petri_history_info(repl->history, &history, sizeof history);
    if (now < 0)
        return repl_fail(repl, "no frames to record; run .step first");
    if (history.first != -1) {
        return repl_fail(repl, "a golden must start at frame 0, but the history starts at frame %" PRId64 "%s%s",
                         history.first, !history.reason ? "" : ": ", !history.reason ? "" : history.reason);
    }
    for (int64_t i = 1; i <= now; i++)
        if (petri_history_config(repl->history, i) != petri_history_config(repl->history, i - 1))
            return repl_fail(
                repl, "cannot record changes made at the prompt (frame %" PRId64 "); run .reset and step again", i - 1);
    if (petri_history_config(repl->history, 0) != petri_config_revision(repl->session))
        return repl_fail(repl, "cannot record: settings changed after these frames; run .reset and step again");
    if (repl->rates_changed)
        return repl_fail(repl, "cannot record frames after .tempo or .fps; to start again, run .load FILE");
    if (petri_resolution(repl->session) > 0)
        return repl_fail(repl,
                         "cannot record frames with .resolution; run '.resolution off' and .reset, and step again");
    if (repl->loaded && !same_folder(repl->script, script))
        return repl_fail(repl,
                         "the golden must be in the folder of '%s', because its file names are relative to that folder",
                         repl->script);
    return true;
}

// Writes the script that the golden needs: the loaded script with the typed statements appended. Does nothing if `path`
// already is this script. Returns false after a message.
static bool write_script(Repl *repl, const char *path) {
    const char *kept = petri_prompt_statement(repl->session, 0);
    if (!kept && repl->loaded && same_path(repl->script, path))
        return true;
    if (access(path, F_OK) == 0)
        return repl_fail(repl, "'%s' already exists and is another script; choose another name", path);
    SCOPED_TEXT text = {0};
    text_add(&text, (Str){repl->script_text.len == 0 ? "" : repl->script_text.bytes,
                          repl->loaded ? repl->script_text.len : 0});
    if (text.len > 0 && text.bytes[text.len - 1] != '\n')
        text_add_c(&text, "\n");
    for (size_t i = 0; (kept = petri_prompt_statement(repl->session, i)); i++) {
        text_add_c(&text, kept);
        text_add_c(&text, "\n");
    }
    const char *problem = file_replace(path, text_str(&text), 0);
    bool done = !problem || repl_fail(repl, "cannot write '%s': %s", path, problem);
    return done;
}

// Adds the golden's first line, which contains the options. Fails if a definition contains blanks, because blanks
// separate options.
static bool add_options(Repl *repl, Text *text, int64_t frames, int64_t every) {
    text_add_format(text, "# run --frames %" PRId64, frames);
    if (every > 1)
        text_add_format(text, " --every %" PRId64, every);
    text_add_format(text, " --print state,log");
    if (repl->options->fps_given)
        text_add_format(text, " --fps %.17g", repl->options->fps);
    for (size_t i = 0; i < repl->definitions.count; i++) {
        if (strpbrk(repl->definitions.items[i], " \t\n"))
            return repl_fail(repl, "cannot record the definition '%s': it contains blanks", repl->definitions.items[i]);
        text_add_format(text, " -D %s", repl->definitions.items[i]);
    }
    text_add_format(text, "\n");
    return true;
}

// Recomputes frames 0 to `last` and collects the text of every `every`-th frame.
static PetriStatus collect_output(Repl *repl, Text *text, int64_t last, int64_t every) {
    PetriStatus status = PETRI_OK;
    for (int64_t i = 0; i <= last && status == PETRI_OK; i++) {
        status = petri_history_goto(repl->history, i);
        if (status == PETRI_OK && i % every == 0)
            status = petri_print(repl->session, PETRI_PRINT_STATE | PETRI_PRINT_LOG, text_collect, text);
    }
    return status;
}

static bool write_golden(Repl *repl, const char *golden, const char *script, int64_t every) {
    int64_t last = petri_frame_number(repl->session);
    SCOPED_TEXT text = {0};
    bool good = can_record(repl, script) && add_options(repl, &text, last + 1, every) && write_script(repl, script);
    if (good) {
        repl_busy(repl);
        PetriStatus status = collect_output(repl, &text, last, every);
        bool stopped = repl_idle(repl);
        if (status != PETRI_OK) {
            petri_history_goto(repl->history, last);
            good = repl_status(repl, stopped ? PETRI_INTERRUPTED : status);
        }
    }
    const char *problem = good ? file_replace(golden, text_str(&text), 0) : NULL;
    if (problem)
        good = repl_fail(repl, "cannot write '%s': %s", golden, problem);
    if (good)
        repl_note(repl, "frames 0 to %" PRId64 " written to %s", last, golden);
    return good;
}

static bool run_record(Repl *repl, const char *rest) {
    SCOPED_STRING name = memory_strdup(rest);
    int64_t every = 1;
    argument_last_count(name, &every);
    size_t length = strlen(name);
    static const char *const suffixes[] = {".golden", ".fl"};
    for (int i = 0; i < 2; i++) {
        size_t cut = strlen(suffixes[i]);
        if (length > cut && strcmp(name + length - cut, suffixes[i]) == 0) {
            length -= cut;
            break;
        }
    }
    SCOPED_TEXT golden = {0}, script = {0};
    text_add_format(&golden, "%.*s.golden", (int)length, name);
    text_add_format(&script, "%.*s.fl", (int)length, name);
    return write_golden(repl, golden.bytes, script.bytes, every);
}

static bool run_archive(Repl *repl, const char *rest) {
    if (repl->options->replayed)
        return repl_fail(repl, "cannot write an archive while an archive is replayed");
    if (repl->archiving.archive && !archiving_end(&repl->archiving))
        repl->failed = true;
    if (!archiving_start(&repl->archiving, rest, repl->options, "repl", repl->session)) {
        repl->failed = true;
        return false;
    }
    repl_note(repl, "all later frames are written to %s", rest);
    return true;
}

const ReplCommand RECORD_COMMANDS[] = {
    {".archive", "FILE", "a file", "write an archive of all later frames, for petri archive verify", run_archive,
     COMPLETE_FILES},
    {".record", "FILE [K]", "a file", "write every K-th frame (default: 1) as a golden for petri test", run_record,
     COMPLETE_FILES},
    {0},
};
