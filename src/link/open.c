// open.c: `petri open`: the frame that a link shows, and whether it is the same here.
#include "base/file.h"
#include "cli/output.h"
#include "cli/script.h"
#include "link/link_session.h"
#include "petri-draw.h"
#include "view/still.h"
#include "view/terminal_picture.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <unistd.h>

static bool read_link(Linked *linked, const char *operand) {
    static const size_t most_bytes = (size_t)1 << 20;
    SCOPED_BYTE_BUFFER link = {0};
    if (!script_is_stdin(operand)) {
        byte_buffer_add_text(&link, operand);
    } else if (!byte_buffer_read(&link, STDIN_FILENO, most_bytes)) {
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
        link_session->painter = petri_painter_open();
    bool saved = link_session->painter && petri_picture(session, &wanted, &picture) == PETRI_OK &&
                 petri_picture_save(picture, link_session->painter, file) == PETRI_OK;
    if (picture)
        petri_picture_report(session, picture);
    petri_picture_free(&picture);
    return saved ? STATUS_DONE : STATUS_FAILED;
}

// Shows the picture to who sits at the terminal; output is not redirected then.
static int show_picture(PetriSession *session, PetriPainter *painter, const Options *options) {
    bool wanted = !options->output && options->verbosity > LOG_QUIET && isatty(STDOUT_FILENO) &&
                  terminal_picture_possible() && progress_possible() && petri_has_picture(session);
    if (!wanted)
        return STATUS_DONE;
    enum { LINES_BELOW = 6 }; // rows for the hash and what it tells
    Output output;
    output_start(&output, STDOUT_FILENO);
    PetriStatus status = still_show(session, painter, !options->monochrome, LINES_BELOW, output_write, &output);
    return output_finish(&output, status == PETRI_OK ? STATUS_DONE : STATUS_FAILED);
}

static int write_script(const CommandContext *context, const Linked *linked, const char *file) {
    if (strcmp(file, "-") == 0)
        return output_text(linked->text.data, linked->text.length, STATUS_DONE);
    const char *problem = file_replace(file, (Str){linked->text.data, linked->text.length}, 0);
    if (problem) {
        message("cannot write %s: %s", file, problem);
        return STATUS_FAILED;
    }
    SCOPED_BYTE_BUFFER changes = {0};
    for (size_t i = 0; i < linked->change_count; i++) {
        const LinkedChange *change = &linked->changes[i];
        byte_buffer_format(&changes, i == 0 ? " %s=%s" : ", %s=%s", change->name, change->value);
        if (change->frame >= 0)
            byte_buffer_format(&changes, " after frame %" PRId64, change->frame);
    }
    if (changes.length > 0)
        message("the link also has%s, which is not in %s", changes.data, file);
    hint_pictures(context, file);
    return STATUS_DONE;
}

static bool is_script(const char *file) {
    return strcmp(file, "-") == 0 || str_ends_with(str_from(file), STR(".fl"));
}

static bool check_output(const char *file) {
    bool good = !file || is_script(file) || petri_picture_can_save(file);
    if (!good)
        message("'%s' should end in .fl, for the script, or in .png, .svg or .pdf, for the picture", file);
    return good;
}

// Tells whether the frame is that of the link; without --output its hash goes to standard output, as petri run prints
// it.
static int compare_state(const LinkSession *link_session, const Options *options) {
    const Linked *linked = &link_session->linked;
    SCOPED_BYTE_BUFFER text = {0};
    petri_print(link_session->frames.session, PETRI_PRINT_HASH, byte_buffer_collect, &text);
    int status = !options->output ? output_text(text.data, text.length, STATUS_DONE) : STATUS_DONE;
    SCOPED_TEXT hash = link_session_hash(link_session);
    if (!linked->hash) {
        message("%s: the link tells of no state to compare with", linked->name);
        return status;
    }
    bool same = strcmp(hash, linked->hash) == 0;
    message(same ? "%s: frame %" PRId64 " has the same state as where the link was made, to the last bit"
                 : "%s: the state of frame %" PRId64 " is not that where the link was made; it was made by another "
                   "version of petri, perhaps",
            linked->name, linked->frame);
    return same ? status : STATUS_FAILED;
}

static int open_link(const CommandContext *context, Options *options, LinkSession *link_session) {
    Linked *linked = &link_session->linked;
    if (!check_output(options->output))
        return STATUS_USAGE;
    if (!link_possible() || !read_link(linked, options->script))
        return STATUS_FAILED;
    const char *file = options->output;
    int wrote = file && is_script(file) ? write_script(context, linked, file) : STATUS_DONE;
    int status = link_session_run(link_session, context, options);
    link_session_print_files(link_session, "the script asks for ", ", and links hold no files");
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

static int open_run(const CommandContext *context, Options *options) {
    LinkSession link_session = {0};
    int status = open_link(context, options, &link_session);
    link_session_close(&link_session);
    return status;
}

const Command OPEN_COMMAND = {
    .name = "open",
    .operands = "LINK",
    .summary = "run what a link holds to its frame, and tell whether the state is the same",
    .details =
        "Runs the script that is in a link, of petri link or of the page in a browser, to the frame that the link\n"
        "names, with the parameters as they were changed, and tells whether the state has the same hash: the exit\n"
        "status is 1 if not. The hash goes to standard output, at a terminal below the picture of the frame; with\n"
        "--output a file gets the script (FILE.fl, or - for standard output) or the picture. The script neither\n"
        "reads nor writes files.\n"
        "\n"
        "LINK is the whole address, or what begins with '#', in quotes because of that; - is standard input.",
    .examples = "  petri open 'http://127.0.0.1:8080/#q1bKU...'    is the frame the same here?\n"
                "  petri open '#q1bKU...' -o dish.fl               the script, too\n"
                "  petri open '#q1bKU...' -o dish.png              the picture, too\n"
                "  petri link dish.fl --frame 99 | petri open -    there and back\n",
    .missing_operand = "no link was given (what begins with '#' needs quotes)",
    .second_operand_error = "one link is opened at a time; '%s' is too many (a link needs quotes)",
    .options = FOR_OPEN,
    .run = open_run,
};
