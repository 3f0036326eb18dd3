// fuzz_image.c: fuzzes images. The input is an image file, which is drawn.
#include "fuzz.h"
#include "petri-draw.h"

enum { SIDE = 32 };

FUZZ_HARNESS(image) {
    static uint32_t pixels[SIDE * SIDE];
    static PetriSession *session;
    static PetriPicture *picture;
    PetriPictureOptions options = petri_default_picture_options();
    fuzz_put("image", data, size);
    if (!session) {
        session = fuzz_open(NULL);
        fuzz_load(session, "!window size=32\n    !canvas\n        !image filename='image' size=32\n");
        if (petri_step(session) != PETRI_OK || petri_picture(session, &options, &picture) != PETRI_OK)
            fuzz_fail("cannot make a picture");
    }
    fuzz_watch(session);
    PetriPainter *painter = petri_painter_open();
    petri_picture_draw(picture, painter, pixels, SIDE, SIDE, SIDE * sizeof *pixels);
    petri_painter_close(&painter);
    fuzz_end_watch();
    return 0;
}
