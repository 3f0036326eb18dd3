// link.c: the command `petri link`, which prints a link that contains a script.
#include "base/source.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "cli/script.h"
#include "link/html.h"
#include "petri-inspect.h"

#include <string.h>
#include <unistd.h>

// Options that no other command has.
typedef struct Own {
    int64_t frame;    // frame number; -1: not given
    const char *html; // file; NULL: not given
    const char *page; // URL of the page; NULL: not given
} Own;

// Adds a change for each `NAME=VALUE` of -D. read_definition has already rejected definitions without `=`.
static void read_definitions(Linked *linked, const TextList *definitions) {
    linked->changes = memory_calloc((definitions->count + 1) * sizeof *linked->changes);
    for (size_t i = 0; i < definitions->count; i++) {
        const char *name = definitions->items[i], *equals = strchr(name, '=');
        if (equals) {
            linked->changes[linked->change_count++] =
                (LinkedChange){-1, i, memory_strndup(name, (size_t)(equals - name)), memory_strdup(equals + 1)};
        }
    }
}

static bool read_script(Text *text, const char *name) {
    static const size_t max_bytes = (size_t)4 << 20;
    bool read = script_read(text, name, max_bytes);
    if (!read && !script_is_stdin(name))
        script_suggest(name);
    return read;
}

static int print_link(const Linked *linked, const char *page) {
    SCOPED_TEXT link = {0};
    text_add_c(&link, !page ? "" : page);
    if (!link_pack(&link, linked, LINK_MAX_LENGTH))
        return STATUS_FAILED;
    text_add_c(&link, "\n");
    if (!page && isatty(STDERR_FILENO))
        message("append this text to the playground's URL, as --page does, or run it with 'petri run'");
    return output_text(link.bytes, link.len, STATUS_DONE);
}

static int make_link(const CommandContext *context, Options *options, LinkSession *link_session) {
    const Own *own = options->own;
    Linked *linked = &link_session->linked;
    if (!link_possible() || !read_script(&linked->text, options->script))
        return STATUS_FAILED;
    const char *name = options->script;
    linked->name = memory_strdup(script_is_stdin(name) ? "script.fl" : name + path_directory(str_from(name)).len);
    read_definitions(linked, &options->definitions);
    if (own->html)
        link_session->folder = memory_folder(name);
    // Without --frame, computes one frame, so that errors are found before the link is sent.
    linked->frame = own->frame < 0 ? 0 : own->frame;
    texts_free(&options->definitions);
    int status = link_session_run(link_session, context, options);
    if (link_session_print_files(
            link_session,
            own->html ? "cannot add files outside the script's folder: " : "cannot link a script that reads files: ",
            own->html ? "; move them into the folder" : "; move their contents into the script, or use --html"))
        return STATUS_FAILED;
    if (status != OPTIONS_READ)
        return status;
    linked->digest = own->frame < 0 && !own->html ? NULL : link_session_digest(link_session, PETRI_PRINT_DIGEST);
    return own->html ? html_write(link_session, own->page, own->html) : print_link(linked, own->page);
}

static int link_run(const CommandContext *context, Options *options) {
    LinkSession link_session = {0};
    int status = make_link(context, options, &link_session);
    link_session_close(&link_session);
    return status;
}

// clang-format off
static const OptionSpec ROWS[] = {
    OWN("frame", 0, "N", WHOLE(0, 1000000), frame, "also store the frame number N and the digest of that frame's state")
    OWN("html", 0, "FILE", option_text, html, "write a page to FILE that contains the script, its files and the engine, and runs without a network")
    OWN("page", 0, "ADDRESS", option_text, page, "print a whole URL, with the playground at ADDRESS (default: print only the part from '#')")
    DEFINE_OPTION THREADS_OPTION LIMIT_OPTIONS QUIET_OPTION COLOUR_OPTION NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable LINK_OPTIONS = {ROWS, sizeof(Own), &(const Own){.frame = -1}};

const Command LINK_COMMAND = {
    .name = "link",
    .operands = "SCRIPT.fl",
    .summary = "print a link, or write a page, that contains a script",
    .details =
        "Prints a link that contains the compressed script, its parameters (-D) and, with --frame, a frame number and\n"
        "the digest of the state. 'petri run LINK' and the playground run it to that frame and verify that the state "
        "is\n"
        "bit-identical. The data follows the '#', so browsers do not send it to any server. Scripts that read files,\n"
        "modules or images cannot be linked, nor scripts of more than 100000 characters when compressed.\n"
        "--html writes a page instead, which also contains the engine and the files below the script's folder that "
        "the\n"
        "script reads up to frame N. Browsers run it without a network, also from a local disk.",
    .examples = "  petri link dish.fl                              only the fragment, from '#'\n"
                "  petri link dish.fl -D DROPS=50 --frame 240      frame 240 with 50 drops\n"
                "  petri link dish.fl --page http://127.0.0.1/     a link to a playground\n"
                "  petri link dish.fl --html dish.html             a page that runs without a network\n",
    .missing_operand = "no script given",
    .options = &LINK_OPTIONS,
    .parts = (const Command *const[]){&RUN_LINK_COMMAND, &VIEW_LINK_COMMAND, NULL},
    .run = link_run,
};
