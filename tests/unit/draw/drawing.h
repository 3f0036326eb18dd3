// drawing.h: pictures of scripts, for tests of single pixels.
#pragma once

#include "petri-draw.h"
#include "player.h"

// Returns a picture of the first frame.
static inline PetriPicture *picture_of(Player *player, const char *script, double detail) {
    PetriPictureOptions options = petri_default_picture_options();
    options.detail = detail;
    PetriPicture *picture = NULL;
    player_run(player, script, 1);
    assert_int_equal(petri_picture(player->session, &options, &picture), PETRI_OK);
    return picture;
}

// Draws a picture. Skips the test if this build cannot draw.
static inline void draw(PetriPicture *picture, PetriPainter *painter, uint32_t *pixels, int width, int height) {
    PetriStatus status = petri_picture_draw(picture, painter, pixels, width, height, (size_t)width * sizeof *pixels);
    if (status == PETRI_UNSUPPORTED) {
        petri_picture_free(&picture);
        petri_painter_close(&painter);
        skip();
    }
    assert_int_equal(status, PETRI_OK);
}

// Draws the first frame of a script. Skips the test if this build cannot draw.
static inline void draw_script(Player *player, const char *script, uint32_t *pixels, int width, int height) {
    PetriPicture *picture = picture_of(player, script, 1);
    PetriPainter *painter = petri_painter_open();
    draw(picture, painter, pixels, width, height);
    petri_picture_report(player->session, picture);
    petri_painter_close(&painter);
    petri_picture_free(&picture);
}
