// link_session.c: see link_session.h.
//
// A link can be from a stranger. So its script can read only files below the given folder, and all others seem to be
// missing. Its work is limited. A change after frame -1 is a definition, because it is made before the first frame.
#include "link/link_session.h"

#include "base/file.h"
#include "base/file_access.h"
#include "cli/link_work.h"
#include "cli/script.h"
#include "link/image_files.h"
#include "petri-inspect.h"

#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Returns the file below the script's folder that has this name; NULL if there is none.
static const LinkedFile *read_file(LinkSession *link_session, const char *name) {
    static const size_t max_bytes = (size_t)64 << 20;
    for (size_t i = 0; i < link_session->file_count; i++)
        if (strcmp(link_session->files[i].name, name) == 0)
            return &link_session->files[i];
    int folder = open(link_session->folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    SCOPED_STRING path = memory_strdup(name);
    Text bytes = {0};
    if (folder < 0 ||
        text_read_regular(&bytes, file_open_below(folder, path, O_RDONLY | O_NONBLOCK, 0, false), max_bytes)) {
        text_free(&bytes);
        return NULL;
    }
    link_session->files =
        memory_realloc(link_session->files, (link_session->file_count + 1) * sizeof *link_session->files);
    LinkedFile *file = &link_session->files[link_session->file_count++];
    *file = (LinkedFile){memory_strdup(name), bytes};
    return file;
}

// Provides the files below the script's folder, if the session may read them. Otherwise, records the name and returns
// NULL, so the file appears to be missing. Folders, which `glob` reads, are not recorded and appear empty.
static const char *provide_file(void *host, const char *name, size_t *length) {
    LinkSession *link_session = host;
    if (str_ends_with(str_from(name), STR("/")))
        return NULL;
    if (link_session->folder && name[0] != '/' && strncmp(name, "../", 3) != 0) {
        const LinkedFile *file = read_file(link_session, name);
        *length = file ? file->bytes.len : 0;
        return !file ? NULL : file->bytes.len == 0 ? "" : file->bytes.bytes;
    }
    if (!texts_contain(&link_session->requested_files, name))
        texts_add(&link_session->requested_files, name);
    *length = 0;
    return NULL;
}

ShaderTester link_shader_tester = {.pending_signal = frames_signal};

static void request_image(void *link_session, const char *name) {
    size_t length;
    (void)provide_file(link_session, name, &length);
}

// Draws the last frame into a single pixel, because image files are requested only when they are drawn. A build that
// cannot draw requests those of the display list.
static void draw_last_frame(LinkSession *link_session) {
    PetriSession *session = link_session->frames.session;
    PetriPictureOptions options = {0};
    petri_picture_options_init(&options, sizeof options);
    PetriPicture *picture = NULL;
    PetriPainter *painter = painter_open_tested(&link_shader_tester);
    if (painter && petri_has_picture(session) && petri_picture(session, &options, &picture) == PETRI_OK) {
        uint32_t pixel;
        if (petri_picture_draw(picture, painter, &pixel, 1, 1, sizeof pixel) == PETRI_UNSUPPORTED)
            image_files_find(picture, request_image, link_session);
        else
            petri_picture_report(session, picture);
    }
    petri_picture_free(&picture);
    petri_painter_close(&painter);
}

bool link_change_parameters(const Linked *linked, PetriSession *session, int64_t frame) {
    size_t first = 0;
    for (size_t end = linked->change_count; first < end;) { // binary search for the first change after this frame
        size_t middle = first + (end - first) / 2;
        if (linked->changes[middle].frame < frame)
            first = middle + 1;
        else
            end = middle;
    }
    for (size_t i = first; i < linked->change_count && linked->changes[i].frame == frame; i++) {
        const LinkedChange *change = &linked->changes[i];
        if (petri_set_parameter(session, change->name, change->value) != PETRI_OK) {
            message("the link sets %s to %s after frame %d, but the script does not accept it", change->name,
                    change->value, (int)frame);
            return false;
        }
    }
    return true;
}

void link_define_parameters(const Linked *linked, TextList *definitions) {
    for (size_t i = 0; i < linked->change_count; i++) {
        if (linked->changes[i].frame < 0) {
            SCOPED_TEXT definition = {0};
            text_add_format(&definition, "%s=%s", linked->changes[i].name, linked->changes[i].value);
            texts_add(definitions, definition.bytes);
        }
    }
}

// Renders the current frame if it is before the frame of the link and later pictures depend on it.
static void render_if_needed(LinkSession *link_session) {
    PetriSession *session = link_session->frames.session;
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    petri_picture_follow(session, &options);
    if (petri_frame_number(session) >= link_session->linked.frame || !petri_needs_history(session) ||
        petri_picture(session, &options, &picture) != PETRI_OK)
        return;
    if (!link_session->painter)
        link_session->painter = painter_open_tested(&link_shader_tester);
    petri_picture_render(picture, link_session->painter);
    petri_picture_report(session, picture);
    petri_picture_free(&picture);
}

// Returns true, after a message, if the link has exceeded its limit of work before its last frame.
static bool exceeds_limit(LinkSession *link_session) {
    Frames *frames = &link_session->frames;
    const Linked *linked = &link_session->linked;
    uint64_t work = petri_work(frames->session), limit = link_work_limit(options_work_limit(frames->options));
    int64_t number = petri_frame_number(frames->session);
    if (work <= limit || number >= linked->frame)
        return false;
    double needed = (double)work * (double)(linked->frame + 1) / (double)(number + 1);
    progress_erase(&frames->progress);
    message("%s: stopped after frame %" PRId64 ": the link exceeded its limit of %" PRIu64
            " units of work; --work %.0fG or more would allow it",
            linked->name, number, limit, ceil(needed / (double)link_work_limit(1) / 0x1p30));
    return true;
}

static int make_frames(LinkSession *link_session) {
    Frames *frames = &link_session->frames;
    frames_begin(frames);
    bool going = true;
    while (going && frames_due(frames)) {
        going = frames_step(frames) &&
                link_change_parameters(&link_session->linked, frames->session, petri_frame_number(frames->session));
        if (going)
            render_if_needed(link_session);
        going = going && !exceeds_limit(link_session);
    }
    frames_end(frames, going);
    if (frames_signal() != 0)
        return STATUS_SIGNAL + frames_signal();
    if (!going)
        return STATUS_FAILED;
    draw_last_frame(link_session);
    return OPTIONS_READ;
}

int link_session_run(LinkSession *link_session, const CommandContext *host, Options *options) {
    const Linked *linked = &link_session->linked;
    link_define_parameters(linked, &options->definitions);
    options->read = provide_file;
    options->unsaved_host = link_session;
    options->frames = linked->frame + 1;
    options->spec = linked->digest || linked->hash ? linked->spec : NULL; // NULL: a new link, or no frame to compare
    int status = frames_open(&link_session->frames, host, options);
    if (status != OPTIONS_READ)
        return status;
    if (petri_load_text(link_session->frames.session, linked->name, linked->text.bytes, linked->text.len) != PETRI_OK)
        return link_session->frames.invalid_definition ? STATUS_USAGE : STATUS_FAILED;
    return make_frames(link_session);
}

char *link_session_digest(const LinkSession *link_session, unsigned section) {
    SCOPED_TEXT text = {0};
    bool printed = petri_print(link_session->frames.session, section, text_collect, &text) == PETRI_OK;
    const char *last = printed && text.len > 0 ? strrchr(text.bytes, ' ') : NULL;
    return last ? memory_strndup(last + 1, strcspn(last + 1, "\n")) : memory_strdup("");
}

bool link_session_print_files(const LinkSession *link_session, const char *prefix, const char *suffix) {
    SCOPED_TEXT names = {0};
    for (size_t i = 0; i < link_session->requested_files.count; i++)
        text_add_format(&names, "%s%s", i == 0 ? "" : ", ", link_session->requested_files.items[i]);
    if (names.len > 0)
        message("%s%s%s", prefix, names.bytes, suffix);
    return names.len > 0;
}

void link_session_close(LinkSession *link_session) {
    petri_painter_close(&link_session->painter);
    petri_close(&link_session->frames.session);
    link_free(&link_session->linked);
    texts_free(&link_session->requested_files);
    for (size_t i = 0; i < link_session->file_count; i++) {
        free(link_session->files[i].name);
        text_free(&link_session->files[i].bytes);
    }
    free(link_session->files);
    free(link_session->folder);
}
