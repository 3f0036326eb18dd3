// overlay.c: see overlay.h.
#include "view/overlay.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/bytes.h"
#include "petri-draw.h"

// Sizes in units of text; a letter of the fixed-width font is about this part of its size wide.
enum { TEXT_SIZE = 13, LINE = 19, MARGIN = 12, PADDING = 10, STRIPE = 4, CORNER = 6 };
static const double LETTER = 0.602;

struct OverlayPainter {
    PetriSession *session;
    PetriPainter *painter;
    Overlay drawn;
    double scale;
    uint32_t *pixels; // of what is drawn
    int width;
    int height;
    bool any; // … and not all of it is clear
};

OverlayPainter *overlay_painter_new(void) {
    OverlayPainter *painter = memory_zeroed(sizeof *painter);
    PetriOptions options = petri_default_options();
    options.threads = 1;
    painter->session = petri_open(&options);
    painter->painter = petri_painter_open();
    if (painter->session == NULL || painter->painter == NULL) {
        overlay_painter_free(painter);
        return NULL;
    }
    return painter;
}

void overlay_painter_free(OverlayPainter *painter) {
    if (painter == NULL) {
        return;
    }
    petri_close(&painter->session);
    petri_painter_close(&painter->painter);
    free(painter->pixels);
    free(painter);
}

// One line as a string of the language.
static void add_string(Bytes *script, const char *line, size_t length) {
    bytes_add_text(script, "'");
    for (size_t i = 0; i < length; i++) {
        if (line[i] == '\'' || line[i] == '\\') {
            bytes_add_text(script, "\\");
        }
        bytes_add(script, &line[i], 1);
    }
    bytes_add_text(script, "'");
}

typedef struct Panel {
    char text[sizeof(Overlay)]; // as it fits
    double width;
    double height;
} Panel;

// Lays a text out; a full panel is as wide as there is room, others as their text.
static void lay_out(Panel *panel, const char *text, double room, bool full) {
    int columns = (int)((room - 2 * PADDING) / (TEXT_SIZE * LETTER));
    overlay_fit(panel->text, sizeof panel->text, text, columns);
    double width = overlay_columns(panel->text) * TEXT_SIZE * LETTER + 2 * PADDING;
    panel->width = full ? room : width;
    panel->height = overlay_lines(panel->text) * LINE + 2 * PADDING - (LINE - TEXT_SIZE);
}

typedef struct Look {
    const char *back;  // colours, as the language has them
    const char *front; // of the text
    const char *edge;  // of a stripe at the left; NULL: none
} Look;

static void add_rect(Bytes *script, double x, double y, double width, double height, const char *colour) {
    bytes_format(script, "            !rect point=%.2f;%.2f size=%.2f;%.2f radius=%d color=%s fill=true\n", x, y, width,
                 height, width > CORNER * 2 ? CORNER : 0, colour);
}

static void add_panel(Bytes *script, const Panel *panel, double x, double y, const Look *look) {
    add_rect(script, x, y, panel->width, panel->height, look->back);
    if (look->edge != NULL) {
        add_rect(script, x, y, STRIPE, panel->height, look->edge);
    }
    double base = y + PADDING + TEXT_SIZE * 0.8;
    for (const char *line = panel->text; line != NULL; base += LINE) {
        const char *end = strchr(line, '\n');
        bytes_format(script, "            !text point=%.2f;%.2f color=%s center=false text=", x + PADDING, base,
                     look->front);
        add_string(script, line, end == NULL ? strlen(line) : (size_t)(end - line));
        bytes_add_text(script, "\n");
        line = end == NULL ? NULL : end + 1;
    }
}

// The whole overlay as a script: what is wrong at the top, the mark at its right, the status at the bottom left, a
// notice at the bottom right, above the status if there is no room beside it.
static void write_scene(Bytes *script, const Overlay *overlay, double scale, int width, int height) {
    static const Look wrong = {"0.16;0.03;0.04;0.92", "1;0.93;0.91", "0.94;0.27;0.23"},
                      usual = {"0.05;0.07;0.1;0.82", "0.92;0.94;0.96", NULL},
                      news = {"0.05;0.07;0.1;0.82", "0.7;0.88;1", NULL},
                      careful = {"0.14;0.1;0.02;0.92", "1;0.95;0.8", "1;0.75;0.2"};
    Panel status = {.width = 0}, panel;
    double across = width / scale, bottom = height / scale - MARGIN, room = across - 2 * MARGIN;
    bytes_format(script,
                 "!offscreen size=%d;%d\n    !canvas\n        !group scale=%.6f\n"
                 "          !font family='monospace' size=%d\n",
                 width, height, scale, TEXT_SIZE);
    if (overlay->trouble[0] != '\0') {
        lay_out(&panel, overlay->trouble, room, true);
        add_panel(script, &panel, MARGIN, MARGIN, overlay->mild ? &careful : &wrong);
    }
    if (overlay->mark[0] != '\0') {
        lay_out(&panel, overlay->mark, room, false);
        add_panel(script, &panel, across - MARGIN - panel.width, MARGIN, &careful);
    }
    if (overlay->status[0] != '\0') {
        lay_out(&status, overlay->status, room, false);
        add_panel(script, &status, MARGIN, bottom - status.height, &usual);
    }
    if (overlay->notice[0] != '\0') {
        lay_out(&panel, overlay->notice, room, false);
        bool beside = status.width == 0 || status.width + MARGIN + panel.width <= room;
        double y = bottom - panel.height - (beside ? 0 : status.height + MARGIN);
        add_panel(script, &panel, across - MARGIN - panel.width, y, &news);
    }
}

// Draws the script into the painter's own pixels; false if that could not be.
static bool draw_scene(OverlayPainter *painter, const Bytes *script) {
    PetriPictureOptions options = petri_default_picture_options();
    options.automatic = PETRI_AUTO_NEVER;
    PetriPicture *picture = NULL;
    bool drawn = petri_load_text(painter->session, "overlay", script->data, script->length) == PETRI_OK &&
                 petri_step(painter->session) == PETRI_OK &&
                 petri_picture(painter->session, &options, &picture) == PETRI_OK &&
                 petri_picture_draw(picture, painter->painter, painter->pixels, painter->width, painter->height,
                                    (size_t)painter->width * sizeof *painter->pixels) == PETRI_OK;
    petri_picture_free(&picture);
    return drawn;
}

static void use_size(OverlayPainter *painter, int width, int height) {
    if (painter->pixels != NULL && painter->width == width && painter->height == height) {
        return;
    }
    free(painter->pixels);
    painter->pixels = memory_zeroed((size_t)width * (size_t)height * sizeof *painter->pixels);
    painter->width = width;
    painter->height = height;
}

static void redraw(OverlayPainter *painter, const Overlay *overlay, double scale) {
    SCOPED_BYTES script = {0};
    painter->any = overlay->status[0] != '\0' || overlay->notice[0] != '\0' || overlay->trouble[0] != '\0' ||
                   overlay->mark[0] != '\0';
    if (painter->any) {
        write_scene(&script, overlay, scale, painter->width, painter->height);
        painter->any = draw_scene(painter, &script);
    }
    painter->drawn = *overlay;
    painter->scale = scale;
}

static bool same_texts(const Overlay *a, const Overlay *b) {
    return strcmp(a->status, b->status) == 0 && strcmp(a->notice, b->notice) == 0 &&
           strcmp(a->trouble, b->trouble) == 0 && strcmp(a->mark, b->mark) == 0 && a->mild == b->mild;
}

// One colour of `over`, which is multiplied by its alpha, on an opaque one.
static uint32_t blend(uint32_t under, uint32_t over) {
    uint32_t clear = 255 - (over >> 24), result = 0xFF000000;
    for (int shift = 0; shift < 24; shift += 8) {
        uint32_t part = (over >> shift & 255) + ((under >> shift & 255) * clear + 127) / 255;
        result |= (part > 255 ? 255 : part) << shift;
    }
    return result;
}

void overlay_draw(OverlayPainter *painter, const Overlay *overlay, double scale, uint32_t *pixels, int width,
                  int height) {
    bool resized = painter->pixels == NULL || painter->width != width || painter->height != height;
    use_size(painter, width, height);
    if (resized || scale != painter->scale || !same_texts(overlay, &painter->drawn)) {
        redraw(painter, overlay, scale);
    }
    size_t count = painter->any ? (size_t)width * (size_t)height : 0;
    for (size_t i = 0; i < count; i++) {
        if (painter->pixels[i] != 0) {
            pixels[i] = blend(pixels[i], painter->pixels[i]);
        }
    }
}
