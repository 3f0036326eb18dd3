// fmt.c: the command `petri fmt`, which formats scripts.
#include "base/file.h"
#include "cli/option_groups.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/script.h"
#include "fmt/layout.h"
#include "petri.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Options that no other command has.
typedef struct Own {
    bool only_checks; // write nothing
} Own;

typedef struct Formatting {
    PetriSession *session;
    bool only_checks;
    size_t changed; // scripts that were changed; with --check: scripts that would be changed
    size_t failed;  // scripts that could not be formatted
} Formatting;

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    (void)host;
    if (diagnostic->level == PETRI_ERROR)
        fputs(diagnostic->rendered, stderr);
}

static bool format_text(Formatting *formatting, const char *name, const Text *original, Text *out) {
    SCOPED_TEXT copy = {0};
    text_add(&copy, text_str(original));
    Str text = layout_normalise(&copy);
    const char *shown = script_display_name(name);
    // petri_load_text reports errors in the script.
    if (petri_load_text(formatting->session, shown, text.bytes, text.len) != PETRI_OK)
        return false;
    bool done = layout_text(formatting->session, text, out);
    Str formatted = text_str(out);
    if (!done || (!str_equal(formatted, text) && !layout_same(formatting->session, shown, text, formatted))) {
        message("cannot format %s: its compiled code would change; please report this bug in petri", shown);
        return false;
    }
    return true;
}

// Writes a script that was read from standard input, even if formatting has not changed it.
static int write_stdout(const Text *out) {
    return output_text(out->bytes, out->len, STATUS_DONE);
}

static void format_script(Formatting *formatting, const char *name) {
    SCOPED_TEXT text = {0};
    SCOPED_TEXT out = {0};
    if (!script_read(&text, name, SCRIPT_MAX_BYTES) || !format_text(formatting, name, &text, &out)) {
        formatting->failed++;
        // Writes the script unchanged: an editor may replace its text with the output, which must not lose the script.
        if (script_is_stdin(name) && !formatting->only_checks)
            write_stdout(&text);
        return;
    }
    bool changed = text.len != out.len || memcmp(text.bytes, out.bytes, out.len) != 0, good = true;
    if (formatting->only_checks) {
        if (changed)
            message("%s is not formatted", script_display_name(name));
    } else if (script_is_stdin(name)) {
        good = write_stdout(&out) == STATUS_DONE;
    } else if (changed) {
        good = output_file(name, text_str(&out));
    }
    formatting->failed += !good;
    formatting->changed += changed && good;
}

static int fmt_run(const CommandContext *host, Options *options) {
    const Own *own = options->own;
    Formatting formatting = {.only_checks = own->only_checks};
    if (options->scripts.count == 0) {
        if (options->unreadable.count == 0)
            message("no script found: no file is named *.fl");
        return STATUS_FAILED;
    }
    options->unsimplified = true;
    options->threads = 1;
    int status = options_open(options, host, on_diagnostic, NULL, &formatting.session);
    if (status != OPTIONS_READ)
        return status;
    for (size_t i = 0; i < options->scripts.count; i++)
        format_script(&formatting, options->scripts.items[i].path);
    petri_close(&formatting.session);
    size_t count = options->scripts.count;
    if (count > 1 || !script_is_stdin(options->scripts.items[0].path)) {
        size_t unchanged = count - formatting.changed - formatting.failed;
        SCOPED_TEXT failures = {0};
        text_add_c(&failures, "");
        if (formatting.failed > 0)
            text_add_format(&failures, ", %zu failed", formatting.failed);
        message("%zu file%s: %zu %s, %zu unchanged%s", count, count == 1 ? "" : "s", formatting.changed,
                formatting.only_checks ? "unformatted" : "formatted", unchanged, failures.bytes);
    }
    bool good =
        formatting.failed == 0 && options->unreadable.count == 0 && !(formatting.only_checks && formatting.changed > 0);
    return good ? STATUS_DONE : STATUS_FAILED;
}

// clang-format off
static const OptionSpec ROWS[] = {
    OWN("check", 0, NULL, option_flag, only_checks, "list unformatted scripts without changing them; exit with 1 if there are any")
    NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable FMT_OPTIONS = {ROWS, sizeof(Own), NULL};

const Command FMT_COMMAND = {
    .name = "fmt",
    .operands = "PATH...",
    .summary = "format scripts",
    .details = "Formats scripts in place, or all *.fl files below a folder: four spaces per level, spacing by\n"
               "precedence, aligned comments. Line breaks and comments are kept. A file is replaced only if its\n"
               "compiled code is unchanged; scripts with errors are not changed. With - it reads standard input and\n"
               "writes standard output.",
    .examples = "  petri fmt dish.fl\n"
                "  petri fmt --check .                             exit with 1 if any script is unformatted, for CI\n",
    .missing_operand = "no script or folder given",
    .options = &FMT_OPTIONS,
    .accepts_many = true,
    .run = fmt_run,
};
