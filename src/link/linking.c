// linking.c: see linking.h.
#include "link/linking.h"

#include <stdlib.h>
#include <string.h>

#include "cli/script.h"

// There is no file: a link has one script. Folders, for `glob`, are empty.
static const char *note_file(void *host, const char *name, size_t *length) {
    Linking *linking = host;
    if (!texts_hold(&linking->wanted, name) && !str_ends_with(str_from(name), STR("/"))) {
        texts_add(&linking->wanted, name);
    }
    *length = 0;
    return NULL;
}

// Images are asked for when they are drawn.
static void draw(PetriSession *session) {
    PetriPictureOptions options = {0};
    petri_picture_options_init(&options, sizeof options);
    PetriPicture *picture = NULL;
    PetriPainter *painter = petri_painter_open();
    if (painter != NULL && petri_drawable(session) && petri_picture(session, &options, &picture) == PETRI_OK) {
        uint32_t pixel;
        petri_picture_draw(picture, painter, &pixel, 1, 1, sizeof pixel);
        petri_picture_tell(session, picture);
    }
    petri_picture_free(&picture);
    petri_painter_close(&painter);
}

static bool set_parameters(const Linking *linking, int64_t frame) {
    for (size_t i = 0; i < linking->linked.change_count; i++) {
        const LinkedChange *change = &linking->linked.changes[i];
        if (change->frame == frame && frame >= 0 &&
            petri_set_parameter(linking->frames.session, change->name, change->value) != PETRI_OK) {
            message("the link sets %s to %s after frame %d, which the script does not take", change->name,
                    change->value, (int)frame);
            return false;
        }
    }
    return true;
}

// The pictures of frames before the last, on which later ones may depend.
static void follow(Linking *linking) {
    PetriSession *session = linking->frames.session;
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    if (petri_frame(session).number >= linking->linked.frame || !petri_looks_back(session) ||
        petri_picture(session, &options, &picture) != PETRI_OK) {
        return;
    }
    if (linking->painter == NULL) {
        linking->painter = petri_painter_open();
    }
    petri_picture_make(picture, linking->painter);
    petri_picture_tell(session, picture);
    petri_picture_free(&picture);
}

static int make_frames(Linking *linking) {
    Frames *frames = &linking->frames;
    frames_begin(frames);
    bool going = true;
    while (going && frames_due(frames)) {
        going = frames_step(frames) && set_parameters(linking, petri_frame(frames->session).number);
        if (going) {
            follow(linking);
        }
    }
    frames_end(frames, going);
    if (frames_signal() != 0) {
        return STATUS_SIGNAL + frames_signal();
    }
    if (!going) {
        return STATUS_FAILED;
    }
    draw(frames->session);
    return OPTIONS_READ;
}

int linking_run(Linking *linking, const Host *host, Options *options) {
    const Linked *linked = &linking->linked;
    for (size_t i = 0; i < linked->change_count; i++) {
        if (linked->changes[i].frame < 0) {
            SCOPED_BYTES definition = {0};
            bytes_format(&definition, "%s=%s", linked->changes[i].name, linked->changes[i].value);
            texts_add(&options->definitions, definition.data);
        }
    }
    options->read = note_file;
    options->unsaved_host = linking;
    options->frames = linked->frame + 1;
    int status = frames_open(&linking->frames, host, options);
    if (status != OPTIONS_READ) {
        return status;
    }
    if (petri_load_text(linking->frames.session, linked->name, linked->text.data, linked->text.length) != PETRI_OK) {
        return linking->frames.wrong_definition ? STATUS_USAGE : STATUS_FAILED;
    }
    return make_frames(linking);
}

char *linking_hash(const Linking *linking) {
    enum { DIGITS = 64 };
    SCOPED_BYTES text = {0};
    bool printed = petri_print(linking->frames.session, PETRI_PRINT_HASH, bytes_collect, &text) == PETRI_OK;
    if (!printed || text.length < DIGITS + 1) {
        return memory_text("");
    }
    return memory_copied(text.data + text.length - DIGITS - 1, DIGITS);
}

bool linking_tell(const Linking *linking, const char *before, const char *behind) {
    SCOPED_BYTES names = {0};
    for (size_t i = 0; i < linking->wanted.count; i++) {
        bytes_format(&names, "%s%s", i == 0 ? "" : ", ", linking->wanted.items[i]);
    }
    if (names.length > 0) {
        message("%s%s%s", before, names.data, behind);
    }
    return names.length > 0;
}

void linking_close(Linking *linking) {
    petri_painter_close(&linking->painter);
    petri_close(&linking->frames.session);
    link_free(&linking->linked);
    texts_free(&linking->wanted);
}
