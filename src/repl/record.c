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

bool repl_same_folder(const char *a, const char *b) {
    SCOPED_STRING first = memory_folder(a);
    SCOPED_STRING second = memory_folder(b);
    return same_path(first, second);
}

static bool can_record(Repl *repl, const char *script) {
    int64_t now = petri_frame_number(repl->prompt.session);
    PetriHistoryInfo history;
    petri_history_info(repl->prompt.history, &history, sizeof history);
    if (now < 0)
        return prompt_fail(&repl->prompt, "no frames to record; run .step first");
    if (history.first != -1) {
        return prompt_fail(&repl->prompt,
                           "a golden must start at frame 0, but the history starts at frame %" PRId64 "%s%s",
                           history.first, !history.reason ? "" : ": ", !history.reason ? "" : history.reason);
    }
    const PetriHistory *known = repl->prompt.history;
    for (int64_t i = 0; i <= now; i++)
        if (petri_history_is_moved(known, i) ||
            (i < now && petri_history_config(known, i) != petri_history_config(known, i + 1)))
            return prompt_fail(&repl->prompt,
                               "cannot record changes made at the prompt (frame %" PRId64
                               "); run .reset and step again, "
                               "or keep the session: .record NAME.session",
                               i);
    if (petri_history_config(repl->prompt.history, 0) != petri_config_revision(repl->prompt.session))
        return prompt_fail(&repl->prompt,
                           "cannot record: settings changed after these frames; run .reset and step again");
    if (repl->prompt.rates_changed)
        return prompt_fail(&repl->prompt, "cannot record frames after .tempo or .fps; to start again, run .load FILE");
    if (petri_resolution(repl->prompt.session) > 0)
        return prompt_fail(&repl->prompt,
                           "cannot record frames with .resolution; run '.resolution off' and .reset, and step again");
    if (repl->loaded && !repl_same_folder(repl->script, script))
        return prompt_fail(
            &repl->prompt,
            "the golden must be in the folder of '%s', because its file names are relative to that folder",
            repl->script);
    return true;
}

// Writes the script that the golden needs: the loaded script with the typed statements appended. Does nothing if `path`
// already is this script. Returns false after a message.
static bool write_script(Repl *repl, const char *path) {
    const char *kept = petri_prompt_statement(repl->prompt.session, 0);
    if (!kept && repl->loaded && same_path(repl->script, path))
        return true;
    if (access(path, F_OK) == 0)
        return prompt_fail(&repl->prompt, "'%s' already exists and is another script; choose another name", path);
    SCOPED_TEXT text = {0};
    text_add(&text, (Str){repl->script_text.len == 0 ? "" : repl->script_text.bytes,
                          repl->loaded ? repl->script_text.len : 0});
    if (text.len > 0 && text.bytes[text.len - 1] != '\n')
        text_add_c(&text, "\n");
    for (size_t i = 0; (kept = petri_prompt_statement(repl->prompt.session, i)); i++) {
        text_add_c(&text, kept);
        text_add_c(&text, "\n");
    }
    const char *problem = file_replace(path, text_str(&text), 0);
    bool done = !problem || prompt_fail(&repl->prompt, "cannot write '%s': %s", path, problem);
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
    for (size_t i = 0; i < repl->prompt.definitions.count; i++) {
        if (strpbrk(repl->prompt.definitions.items[i], " \t\n"))
            return prompt_fail(&repl->prompt, "cannot record the definition '%s': it contains blanks",
                               repl->prompt.definitions.items[i]);
        text_add_format(text, " -D %s", repl->prompt.definitions.items[i]);
    }
    text_add_format(text, "\n");
    return true;
}

// Recomputes frames 0 to `last` and collects the text of every `every`-th frame.
static PetriStatus collect_output(Repl *repl, Text *text, int64_t last, int64_t every) {
    PetriStatus status = PETRI_OK;
    for (int64_t i = 0; i <= last && status == PETRI_OK; i++) {
        status = petri_history_goto(repl->prompt.history, i);
        if (status == PETRI_OK && i % every == 0)
            status = petri_print(repl->prompt.session, PETRI_PRINT_STATE | PETRI_PRINT_LOG, text_collect, text);
    }
    return status;
}

static bool write_golden(Repl *repl, const char *golden, const char *script, int64_t every) {
    int64_t last = petri_frame_number(repl->prompt.session);
    SCOPED_TEXT text = {0};
    bool good = can_record(repl, script) && add_options(repl, &text, last + 1, every) && write_script(repl, script);
    if (good) {
        prompt_busy(&repl->prompt);
        PetriStatus status = collect_output(repl, &text, last, every);
        bool stopped = prompt_idle(&repl->prompt);
        if (status != PETRI_OK) {
            petri_history_goto(repl->prompt.history, last);
            good = prompt_status(&repl->prompt, stopped ? PETRI_INTERRUPTED : status);
        }
    }
    const char *problem = good ? file_replace(golden, text_str(&text), 0) : NULL;
    if (problem)
        good = prompt_fail(&repl->prompt, "cannot write '%s': %s", golden, problem);
    if (good)
        prompt_note(&repl->prompt, "frames 0 to %" PRId64 " written to %s", last, golden);
    return good;
}

static bool may_write(Prompt *prompt, const char *path, bool replaces) {
    return replaces || access(path, F_OK) != 0 ||
           prompt_fail(prompt, "'%s' already exists; to replace it, run .record --replace %s", path, path);
}

bool repl_run_record(Prompt *prompt, const char *rest) {
    Repl *repl = prompt->user_data;
    static const char option[] = "--replace";
    bool replaces = strncmp(rest, option, strlen(option)) == 0 && rest[strlen(option)] == ' ';
    SCOPED_STRING name = argument_trimmed(rest + (replaces ? strlen(option) : 0));
    if (str_ends_with(str_from(name), STR(TRANSCRIPT_SUFFIX)))
        return may_write(prompt, name, replaces) && repl_record_session(repl, name);
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
    return may_write(prompt, golden.bytes, replaces) && write_golden(repl, golden.bytes, script.bytes, every);
}

bool repl_run_archive(Prompt *prompt, const char *rest) {
    Repl *repl = prompt->user_data;
    if (repl->options->replayed)
        return prompt_fail(prompt, "cannot write an archive while an archive is replayed");
    if (repl->archiving.archive && !archiving_end(&repl->archiving))
        prompt->failed = true;
    if (!archiving_start(&repl->archiving, rest, repl->options, "repl", prompt->session)) {
        prompt->failed = true;
        return false;
    }
    prompt_note(prompt, "all later frames are written to %s", rest);
    return true;
}
