// fuzz_draw.c: fuzzes drawing. The input is a script. Each frame is drawn as its nodes specify, and as an automatic
// picture.
#include "fuzz.h"
#include "petri-draw.h"

enum { SIDE = 64 };

static void draw_picture(PetriSession *session, PetriPainter *painter, PetriAutomatic automatic) {
    static uint32_t pixels[SIDE * SIDE];
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    options.automatic = automatic;
    if (petri_picture(session, &options, &picture) != PETRI_OK)
        return;
    petri_picture_draw(picture, painter, pixels, SIDE, SIDE, SIDE * sizeof *pixels);
    petri_picture_report(session, picture);
    PetriRecord record;
    for (size_t i = 0; petri_picture_record(picture, painter, i, &record); i++)
        fuzz_sink(NULL, record.file, 1);
    petri_picture_free(&picture);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static PetriPainter *painter; // reused for all inputs, because finding fonts takes long
    painter = painter ? painter : petri_painter_open();
    // A path is drawn in one call of Cairo, which cannot be interrupted. A call takes up to a few seconds (MAX_WORK in
    // lib/draw/cairo_paint.c), and longer with sanitizers.
    fuzz_interrupt_limit = 600;
    PetriSession *session = fuzz_open(NULL);
    if (petri_load_text(session, fuzz_file("fuzz.fl"), (const char *)data, size) == PETRI_OK)
        for (int i = 0; i < 2 && petri_step(session) == PETRI_OK; i++)
            draw_picture(session, painter, i ? PETRI_AUTO_ALWAYS : PETRI_AUTO_IF_NEEDED);
    fuzz_close(&session);
    return 0;
}
