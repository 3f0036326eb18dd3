// drawn.h: draws scripts from strings, frame by frame with one painter, and collects their diagnostics.
#pragma once

#include "check.h"
#include "petri-draw.h"

#include <stdlib.h>

enum { MAX_DRAWN = 1920 * 1080, MAX_REPORTED = 20000 };

typedef struct Drawn {
    PetriSession *session;
    PetriPainter *painter;
    int width;
    int height;
    uint32_t *pixels;            // last frame, rows from the top
    char reported[MAX_REPORTED]; // diagnostics except notes, one per line: LINE [CODE] TEXT
    unsigned column;             // column of the last diagnostic
} Drawn;

static inline void drawn_on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    Drawn *drawn = host;
    size_t at = strlen(drawn->reported);
    if (diagnostic->level == PETRI_NOTE)
        return;
    drawn->column = diagnostic->column;
    snprintf(drawn->reported + at, MAX_REPORTED - at, "%u [%s] %s\n", diagnostic->line, diagnostic->code,
             diagnostic->text);
}

static inline void drawn_next(Drawn *drawn) {
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    assert_int_equal(petri_step(drawn->session), PETRI_OK);
    assert_int_equal(petri_picture(drawn->session, &options, &picture), PETRI_OK);
    petri_picture_size(picture, &drawn->width, &drawn->height);
    assert_true(drawn->width * drawn->height <= MAX_DRAWN);
    assert_int_equal(petri_picture_draw(picture, drawn->painter, drawn->pixels, drawn->width, drawn->height,
                                        (size_t)drawn->width * sizeof *drawn->pixels),
                     PETRI_OK);
    petri_picture_report(drawn->session, picture);
    petri_picture_free(&picture);
}

static inline void drawn_close(Drawn *drawn) {
    petri_painter_close(&drawn->painter);
    petri_close(&drawn->session);
    free(drawn->pixels);
    *drawn = (Drawn){0};
}

// Draws `frames` frames and keeps the last one. `memory` is the limit in bytes; 0: default.
static inline void drawn_open_with(Drawn *drawn, const char *script, int frames, size_t memory) {
    PetriOptions options = petri_default_options();
    options.memory_limit = memory > 0 ? memory : options.memory_limit;
    *drawn = (Drawn){.pixels = malloc(MAX_DRAWN * sizeof(uint32_t))};
    options.on_diagnostic = drawn_on_diagnostic;
    options.user_data = drawn;
    drawn->session = petri_open(&options);
    drawn->painter = petri_painter_open();
    assert_true(drawn->session && drawn->painter && drawn->pixels);
    assert_int_equal(petri_load_text(drawn->session, "t.fl", script, strlen(script)), PETRI_OK);
    for (int i = 0; i < frames; i++)
        drawn_next(drawn);
}

static inline void drawn_open(Drawn *drawn, const char *script, int frames) {
    drawn_open_with(drawn, script, frames, 0);
}

// Returns one channel of a pixel: 0 red, 1 green, 2 blue, 3 alpha.
static inline int drawn_byte(const Drawn *drawn, int x, int y, int channel) {
    return drawn->pixels[y * drawn->width + x] >> (channel == 3 ? 24 : 16 - 8 * channel) & 255;
}

// Returns true if shaders can be used on this machine. Otherwise, prints the reason.
static inline bool drawn_can_run(void) {
    Drawn drawn;
    drawn_open(&drawn, "!window size=2;2\n    !vignette\n        !canvas\n", 1);
    bool can = strstr(drawn.reported, "needs-gpu") == NULL;
    if (!can)
        printf("skipped: %s", drawn.reported);
    drawn_close(&drawn);
    return can;
}
