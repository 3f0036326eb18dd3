// overlay.c: see overlay.h.
#include "view/overlay.h"

// Sizes in units of text; a letter of the fixed-width font is about this part of its size wide.
enum { TEXT_SIZE = 13, LINE = 19, MARGIN = 12, PADDING = 10, MOST_LABELS = 4 };
static const double LETTER = 0.602;

static const PetriLabel WRONG = {.back = {0.16, 0.03, 0.04, 0.92},
                                 .front = {1, 0.93, 0.91, 1},
                                 .edge = {0.94, 0.27, 0.23, 1}},
                        CAREFUL = {.back = {0.14, 0.1, 0.02, 0.92},
                                   .front = {1, 0.95, 0.8, 1},
                                   .edge = {1, 0.75, 0.2, 1}},
                        USUAL = {.back = {0.05, 0.07, 0.1, 0.82}, .front = {0.92, 0.94, 0.96, 1}},
                        NEWS = {.back = {0.05, 0.07, 0.1, 0.82}, .front = {0.7, 0.88, 1, 1}};

typedef struct Layout {
    double room; // across
    PetriLabel labels[MOST_LABELS];
    char texts[MOST_LABELS][sizeof(Overlay)]; // as they fit
    size_t count;
} Layout;

// Lays a text out, if there is one; NULL: there is none. A full panel is as wide as there is room, others as their
// text. Where it is put is still to be said.
static PetriLabel *lay_out(Layout *layout, const PetriLabel *look, const char *text, bool full) {
    if (text[0] == '\0') {
        return NULL;
    }
    char *fitting = layout->texts[layout->count];
    PetriLabel *label = &layout->labels[layout->count++];
    overlay_fit(fitting, sizeof layout->texts[0], text, (int)((layout->room - 2 * PADDING) / (TEXT_SIZE * LETTER)));
    *label = *look;
    label->text = fitting;
    label->size = TEXT_SIZE;
    label->line_height = LINE;
    label->padding = PADDING;
    label->width = full ? layout->room : overlay_columns(fitting) * TEXT_SIZE * LETTER + 2 * PADDING;
    label->height = overlay_lines(fitting) * LINE + 2 * PADDING - (LINE - TEXT_SIZE);
    label->x = label->y = MARGIN;
    return label;
}

// What is wrong at the top, the mark at its right, the status at the bottom left, a notice at the bottom right, above
// the status if there is no room beside it.
static void lay_all_out(Layout *layout, const Overlay *overlay, double scale, int width, int height) {
    double across = width / scale, bottom = height / scale - MARGIN;
    layout->room = across - 2 * MARGIN;
    layout->count = 0;
    lay_out(layout, overlay->mild ? &CAREFUL : &WRONG, overlay->trouble, true);
    PetriLabel *mark = lay_out(layout, &CAREFUL, overlay->mark, false);
    if (mark != NULL) {
        mark->x = across - MARGIN - mark->width;
    }
    PetriLabel *status = lay_out(layout, &USUAL, overlay->status, false);
    if (status != NULL) {
        status->y = bottom - status->height;
    }
    PetriLabel *notice = lay_out(layout, &NEWS, overlay->notice, false);
    if (notice != NULL) {
        bool beside = status == NULL || status->width + MARGIN + notice->width <= layout->room;
        notice->x = across - MARGIN - notice->width;
        notice->y = (beside ? bottom : status->y - MARGIN) - notice->height;
    }
}

void overlay_draw(PetriPainter *painter, const Overlay *overlay, double scale, uint32_t *pixels, int width,
                  int height) {
    Layout layout;
    lay_all_out(&layout, overlay, scale, width, height);
    petri_painter_labels(painter, layout.labels, layout.count, scale, pixels, width, height,
                         (size_t)width * sizeof *pixels);
}

PetriStatus overlay_show(PetriPainter *painter, PetriPicture *picture, const Overlay *overlay, double scale, int width,
                         int height) {
    Layout layout;
    lay_all_out(&layout, overlay, scale, width, height);
    return petri_painter_show(painter, picture, layout.labels, layout.count, scale, width, height);
}
