// link.c: `petri link`: a script as a link that opens it in a browser.
#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "base/source.h"
#include "cli/output.h"
#include "cli/script.h"
#include "link/linking.h"

// A change for each `NAME=VALUE` of -D, which options_open has looked at.
static void take_definitions(Linked *linked, const TextList *definitions) {
    linked->changes = memory_zeroed((definitions->count + 1) * sizeof *linked->changes);
    for (size_t i = 0; i < definitions->count; i++) {
        const char *name = definitions->items[i], *equals = strchr(name, '=');
        if (equals != NULL) {
            linked->changes[linked->change_count++] =
                (LinkedChange){-1, memory_copied(name, (size_t)(equals - name)), memory_text(equals + 1)};
        }
    }
}

static bool read_script(Bytes *text, const char *name) {
    static const size_t most_bytes = (size_t)4 << 20;
    bytes_add(text, "", 0);
    bool is_stdin = script_is_stdin(name);
    if (is_stdin ? bytes_read(text, STDIN_FILENO, most_bytes) : bytes_read_file(text, name)) {
        return true;
    }
    message("cannot read '%s': %s", script_shown(name), strerror(errno));
    script_suggest(name);
    return false;
}

static int print_link(const Linked *linked, const char *page) {
    SCOPED_BYTES link = {0};
    bytes_add_text(&link, page == NULL ? "" : page);
    if (!link_pack(&link, linked)) {
        return STATUS_FAILED;
    }
    bytes_add_text(&link, "\n");
    if (page == NULL && isatty(STDERR_FILENO)) {
        message("this goes behind the address of the page, which --page gives; 'petri open' takes it as it is");
    }
    return output_text(link.data, link.length, STATUS_DONE);
}

static int make_link(const Host *host, Options *options, Linking *linking) {
    Linked *linked = &linking->linked;
    if (!link_possible() || !read_script(&linked->text, options->script)) {
        return STATUS_FAILED;
    }
    const char *name = options->script;
    linked->name = memory_text(script_is_stdin(name) ? "script.fl" : name + path_directory(str_from(name)).len);
    take_definitions(linked, &options->definitions);
    // One frame in any case: what is wrong with the script is better known before it is sent.
    linked->frame = options->frame < 0 ? 0 : options->frame;
    texts_free(&options->definitions);
    int status = linking_run(linking, host, options);
    if (linking_tell(linking, "a link holds one script and no files, and this one asks for ",
                     "; put what it takes of them into the script")) {
        return STATUS_FAILED;
    }
    if (status != OPTIONS_READ) {
        return status;
    }
    linked->hash = options->frame < 0 ? NULL : linking_hash(linking);
    return print_link(linked, options->page);
}

static int link_run(const Host *host, Options *options) {
    Linking linking = {0};
    int status = make_link(host, options, &linking);
    linking_close(&linking);
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
    .needed = "no script was given",
    .options = FOR_LINK,
    .run = link_run,
};
