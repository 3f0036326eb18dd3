// open.c: `petri run LINK` and `petri render LINK`, which run the script of a link and verify its frame, and `petri
// view LINK`, which shows it.
#include "base/file.h"
#include "base/spec.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "cli/script.h"
#include "link/link_session.h"
#include "petri-draw.h"
#include "petri-inspect.h"
#include "view/options.h"
#include "view/still.h"
#include "view/terminal_picture.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <unistd.h>

// Options that no other command has.
typedef struct Own {
    const char *output; // output file
} Own;

static bool read_link(Linked *linked, const char *operand) {
    static const size_t max_bytes = (size_t)1 << 20;
    SCOPED_TEXT link = {0};
    if (!script_is_stdin(operand)) {
        text_add_c(&link, operand);
    } else if (!text_read(&link, STDIN_FILENO, max_bytes)) {
        message("cannot read standard input: %s", strerror(errno));
        return false;
    }
    return link_read(linked, &link);
}

static int save_picture(LinkSession *link_session, const char *file) {
    PetriSession *session = link_session->frames.session;
    PetriPictureOptions wanted = {0};
    petri_picture_options_init(&wanted, sizeof wanted);
    PetriPicture *picture = NULL;
    if (!link_session->painter)
        link_session->painter = painter_open_tested(&link_shader_tester);
    bool saved = link_session->painter && petri_picture(session, &wanted, &picture) == PETRI_OK &&
                 petri_picture_render(picture, link_session->painter) == PETRI_OK && !shader_test_interrupted() &&
                 petri_picture_save(picture, link_session->painter, file) == PETRI_OK;
    if (picture)
        petri_picture_report(session, picture);
    petri_picture_free(&picture);
    return saved ? STATUS_DONE : STATUS_FAILED;
}

// Shows the picture if standard output is a terminal.
static int show_picture(PetriSession *session, PetriPainter *painter, const Options *options) {
    const Own *own = options->own;
    bool wanted = !own->output && options->verbosity > LOG_QUIET && isatty(STDOUT_FILENO) &&
                  terminal_picture_possible() && progress_possible() && petri_has_picture(session);
    if (!wanted)
        return STATUS_DONE;
    enum { LINES_BELOW = 6 }; // terminal rows reserved for the digest and messages
    Output output;
    output_start(&output, STDOUT_FILENO);
    PetriStatus status = still_show(session, painter, !options->monochrome, LINES_BELOW, output_write, &output);
    return output_finish(&output, status == PETRI_OK ? STATUS_DONE : STATUS_FAILED);
}

static int write_script(const CommandContext *context, const Linked *linked, const char *file) {
    if (strcmp(file, "-") == 0)
        return output_text(linked->text.bytes, linked->text.len, STATUS_DONE);
    if (!output_file(file, text_str(&linked->text)))
        return STATUS_FAILED;
    SCOPED_TEXT changes = {0};
    for (size_t i = 0; i < linked->change_count; i++) {
        const LinkedChange *change = &linked->changes[i];
        text_add_format(&changes, i == 0 ? " %s=%s" : ", %s=%s", change->name, change->value);
        if (change->frame >= 0)
            text_add_format(&changes, " after frame %" PRId64, change->frame);
    }
    if (changes.len > 0)
        message("the link also sets%s; these settings are not in %s", changes.bytes, file);
    hint_pictures(context, file);
    return STATUS_DONE;
}

static bool is_script(const char *file) {
    return strcmp(file, "-") == 0 || str_ends_with(str_from(file), STR(".fl"));
}

static bool check_output(const char *file) {
    bool good = !file || is_script(file) || petri_picture_can_save(file);
    if (!good)
        message("unknown output format: '%s'; use .fl for the script, or .png, .svg or .pdf for the picture", file);
    return good;
}

// Reports whether the digest of the state equals the digest in the link. Without --output, also prints the digest to
// standard output, like `petri run --print digest`. For links of petri 0.2, uses the hash instead. Returns the exit
// status.
static int compare_state(const LinkSession *link_session, const Options *options) {
    const Linked *linked = &link_session->linked;
    SCOPED_TEXT text = {0};
    const char *expected = linked->digest ? linked->digest : linked->hash;
    unsigned section = linked->hash && !linked->digest ? PETRI_PRINT_HASH : PETRI_PRINT_DIGEST;
    petri_print(link_session->frames.session, section, text_collect, &text);
    int status = !((const Own *)options->own)->output ? output_text(text.bytes, text.len, STATUS_DONE) : STATUS_DONE;
    SCOPED_STRING digest = link_session_digest(link_session, section);
    if (!expected) {
        message("%s: no state to compare: the link has no digest; 'petri link --frame N' adds one", linked->name);
        return status;
    }
    bool same = strcmp(digest, expected) == 0;
    SCOPED_TEXT rules = {0};
    text_add_c(&rules, "");
    if (strcmp(linked->spec, SPEC_VERSION) != 0)
        text_add_format(&rules, ", by the rules of version %s of the specification", linked->spec);
    message(same ? "%s: frame %" PRId64 ": state matches the link exactly%s"
                 : "%s: frame %" PRId64
                   ": state differs from the link, probably because another version of petri made the link%s",
            linked->name, linked->frame, rules.bytes);
    return same ? status : STATUS_FAILED;
}

static int open_link(const CommandContext *context, Options *options, LinkSession *link_session) {
    const Own *own = options->own;
    Linked *linked = &link_session->linked;
    if (!check_output(own->output))
        return STATUS_USAGE;
    if (!link_possible() || !read_link(linked, options->script))
        return STATUS_FAILED;
    const char *file = own->output;
    int wrote = file && is_script(file) ? write_script(context, linked, file) : STATUS_DONE;
    int status = link_session_run(link_session, context, options);
    link_session_print_files(link_session, "the script reads ", ", but links contain no files");
    if (status != OPTIONS_READ)
        return status == STATUS_USAGE ? STATUS_FAILED : status;
    if (file && !is_script(file))
        wrote = save_picture(link_session, file);
    if (linked->frame >= 0) {
        int shown = show_picture(link_session->frames.session, link_session->painter, options);
        wrote = shown != STATUS_DONE ? shown : wrote;
    }
    status = linked->frame < 0 ? STATUS_DONE : compare_state(link_session, options);
    return wrote != STATUS_DONE ? wrote : status;
}

static int run_link(const CommandContext *context, Options *options) {
    LinkSession link_session = {0};
    int status = open_link(context, options, &link_session);
    link_session_close(&link_session);
    return status;
}

// clang-format off
static const OptionSpec ROWS[] = {
    OWN("output", 'o', "FILE", option_text, output, "write the script (FILE.fl, - for standard output) or the picture of the frame (.png, .svg, .pdf)")
    THREADS_OPTION LIMIT_OPTIONS QUIET_OPTION COLOUR_OPTION NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable RUN_LINK_OPTIONS = {ROWS, sizeof(Own), NULL};

const Command RUN_LINK_COMMAND = {
    .name = "run LINK",
    .operands = "",
    .summary = "run a link's script and verify its frame",
    .details =
        "Runs the script in a link (from petri link or the playground) to the frame of the link, with the same\n"
        "changes of parameters, and compares the digest of the state. Exits with 1 if it differs. Prints the digest\n"
        "and, in a terminal, the picture; --output saves the script or the picture instead. The script can neither\n"
        "read nor write files. All frames together may use three times the limit of --work, about half a minute by\n"
        "default.\n"
        "\n"
        "LINK is the whole URL or the part from '#', in quotes. 'petri render LINK' does the same. 'petri view LINK'\n"
        "shows the script from its first frame on, with the options of petri view.",
    .examples = "  petri run 'http://127.0.0.1:8080/#q1bKU...'     verify the frame\n"
                "  petri run '#q1bKU...' -o dish.fl                also save the script\n"
                "  petri render '#q1bKU...' -o dish.png            also save the picture\n"
                "  petri run \"$(petri link dish.fl --frame 99)\"   make a link and run it\n",
    .missing_operand = "no link given (put it in quotes)",
    .second_operand_error = "too many arguments: '%s'; petri run takes one link, in quotes",
    .options = &RUN_LINK_OPTIONS,
    .run = run_link,
};

// A PetriOptions.read_file that provides only the script of the link.
static const char *provide_script(void *host, const char *path, size_t *length) {
    const Linked *linked = host;
    bool is_script = strcmp(path, linked->name) == 0;
    *length = is_script ? linked->text.len : 0;
    return is_script ? linked->text.bytes : NULL;
}

// Makes the changes that follow the session's current frame.
static void change_parameters(void *host, PetriSession *session) {
    link_change_parameters(host, session, petri_frame_number(session));
}

static int view_link(const CommandContext *context, Options *options) {
    Linked linked = {0};
    int status = STATUS_FAILED;
    if (link_possible() && read_link(&linked, options->script)) {
        link_define_parameters(&linked, &options->definitions);
        options->script = linked.name;
        options->read = provide_script;
        options->unsaved_host = &linked;
        options->after_frame = change_parameters;
        status = VIEW_COMMAND.run(context, options);
    }
    link_free(&linked);
    return status;
}

const Command VIEW_LINK_COMMAND = {
    .name = "view LINK",
    .operands = "",
    .live = true,
    .summary = "show a link's script",
    .details =
        "Like petri view, but shows the script in a link, with the same changes of parameters. The script cannot read\n"
        "files.",
    .options = &VIEW_OPTIONS,
    .run = view_link,
};
