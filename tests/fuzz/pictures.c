// pictures.c: see pictures.h.
#include "pictures.h"

enum { SIDE = 32 };

PetriSession *pictures_open(const char *script, size_t length) {
    PetriOptions options = fuzz_options();
    options.work_limit = 1 << 22; // about 40 ms without sanitizers
    // A path is drawn in one call of Cairo, which cannot be interrupted. A call takes up to a few seconds (MAX_WORK in
    // lib/cairo/shape.c), and longer with sanitizers.
    fuzz_interrupt_limit = 600;
    PetriSession *session = fuzz_open(&options);
    if (petri_load_text(session, fuzz_file("fuzz.fl"), script, length) != PETRI_OK || petri_step(session) != PETRI_OK)
        fuzz_close(&session);
    return session;
}

static void draw_picture(PetriSession *session, PetriPainter *painter, PetriAutomatic automatic) {
    static uint32_t pixels[SIDE * SIDE];
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    const double *numbers;
    size_t count;
    options.automatic = automatic;
    if (petri_picture(session, &options, &picture) != PETRI_OK)
        return;
    petri_picture_draw(picture, painter, pixels, SIDE, SIDE, SIDE * sizeof *pixels);
    petri_picture_report(session, picture);
    PetriRecord record;
    for (size_t i = 0; petri_picture_record(picture, painter, i, &record, sizeof record); i++)
        fuzz_sink(NULL, record.file, 1);
    if (petri_picture_display_list(picture, &numbers, &count) == PETRI_OK)
        fuzz_sink(NULL, (const char *)numbers, count * sizeof *numbers);
    petri_picture_free(&picture);
}

void pictures_draw(PetriPainter *painter, const char *script, size_t length, bool automatic) {
    PetriSession *session = pictures_open(script, length);
    if (!session)
        return;
    draw_picture(session, painter, PETRI_AUTO_IF_NEEDED);
    if (petri_step(session) == PETRI_OK)
        draw_picture(session, painter, automatic ? PETRI_AUTO_ALWAYS : PETRI_AUTO_IF_NEEDED);
    fuzz_close(&session);
}
