// link.c: `petri link`: a script as a link that opens it in a browser.
#include "base/source.h"
#include "cli/output.h"
#include "cli/script.h"
#include "link/link_session.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

// A change for each `NAME=VALUE` of -D, which options_open has looked at.
static void read_definitions(Linked *linked, const TextList *definitions) {
    linked->changes = memory_calloc((definitions->count + 1) * sizeof *linked->changes);
    for (size_t i = 0; i < definitions->count; i++) {
        const char *name = definitions->items[i], *equals = strchr(name, '=');
        if (equals) {
            linked->changes[linked->change_count++] =
                (LinkedChange){-1, memory_strndup(name, (size_t)(equals - name)), memory_strdup(equals + 1)};
        }
    }
}

static bool read_script(ByteBuffer *text, const char *name) {
    static const size_t most_bytes = (size_t)4 << 20;
    byte_buffer_add(text, "", 0);
    bool is_stdin = script_is_stdin(name);
    if (is_stdin ? byte_buffer_read(text, STDIN_FILENO, most_bytes) : byte_buffer_read_file(text, name))
        return true;
    message("cannot read '%s': %s", script_display_name(name), strerror(errno));
    script_suggest(name);
    return false;
}

static int print_link(const Linked *linked, const char *page) {
    SCOPED_BYTE_BUFFER link = {0};
    byte_buffer_add_text(&link, !page ? "" : page);
    if (!link_pack(&link, linked))
        return STATUS_FAILED;
    byte_buffer_add_text(&link, "\n");
    if (!page && isatty(STDERR_FILENO))
        message("this goes behind the address of the page, which --page gives; 'petri open' takes it as it is");
    return output_text(link.data, link.length, STATUS_DONE);
}

static int make_link(const CommandContext *context, Options *options, LinkSession *link_session) {
    Linked *linked = &link_session->linked;
    if (!link_possible() || !read_script(&linked->text, options->script))
        return STATUS_FAILED;
    const char *name = options->script;
    linked->name = memory_strdup(script_is_stdin(name) ? "script.fl" : name + path_directory(str_from(name)).len);
    read_definitions(linked, &options->definitions);
    // One frame in any case: what is wrong with the script is better known before it is sent.
    linked->frame = options->frame < 0 ? 0 : options->frame;
    texts_free(&options->definitions);
    int status = link_session_run(link_session, context, options);
    if (link_session_print_files(link_session, "a link holds one script and no files, and this one asks for ",
                                 "; put what it takes of them into the script"))
        return STATUS_FAILED;
    if (status != OPTIONS_READ)
        return status;
    linked->hash = options->frame < 0 ? NULL : link_session_hash(link_session);
    return print_link(linked, options->page);
}

static int link_run(const CommandContext *context, Options *options) {
    LinkSession link_session = {0};
    int status = make_link(context, options, &link_session);
    link_session_close(&link_session);
    return status;
}

const Command LINK_COMMAND = {
    .name = "link",
    .operands = "SCRIPT.fl",
    .summary = "print a link that opens a script in a browser, or by petri open",
    .details =
        "Prints a link that holds the script, compressed, the parameters that -D sets and, with --frame, a frame and\n"
        "the hash of its state: who opens it sees that frame and learns whether it is the same to the last bit. All\n"
        "of it is behind the '#', which browsers send to nobody. A script that takes files, modules or images has no\n"
        "link, nor has one of more than 100000 characters, compressed.",
    .examples = "  petri link dish.fl                              what comes behind the address of the page\n"
                "  petri link dish.fl -D DROPS=50 --frame 240      frame 240 of 50 drops\n"
                "  petri link dish.fl --page http://127.0.0.1/     with the address of the page\n",
    .missing_operand = "no script was given",
    .options = FOR_LINK,
    .run = link_run,
};
