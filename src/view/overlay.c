// overlay.c: implementation of overlay.h.
#include "view/overlay.h"

// Sizes in units of text, which the argument `scale` of overlay_draw converts to pixels. CHARACTER_WIDTH is the width
// of a fixed-width character relative to TEXT_SIZE.
enum { TEXT_SIZE = 13, LINE = 19, MARGIN = 12, PADDING = 10, MAX_LABELS = 4 };
static const double CHARACTER_WIDTH = 0.602;

static const PetriLabel ERROR_STYLE = {.background = {0.16, 0.03, 0.04, 0.92},
                                       .foreground = {1, 0.93, 0.91, 1},
                                       .accent = {0.94, 0.27, 0.23, 1}},
                        WARNING_STYLE = {.background = {0.14, 0.1, 0.02, 0.92},
                                         .foreground = {1, 0.95, 0.8, 1},
                                         .accent = {1, 0.75, 0.2, 1}},
                        STATUS_STYLE = {.background = {0.05, 0.07, 0.1, 0.82}, .foreground = {0.92, 0.94, 0.96, 1}},
                        NOTICE_STYLE = {.background = {0.05, 0.07, 0.1, 0.82}, .foreground = {0.7, 0.88, 1, 1}};

typedef struct Layout {
    double room; // width available for labels, in units of text
    PetriLabel labels[MAX_LABELS + MAX_SLIDERS * LABELS_PER_SLIDER];
    char texts[MAX_LABELS][sizeof(Overlay)]; // wrapped texts
    size_t count;
} Layout;

// Adds a label and wraps its text. Returns NULL if the text is empty. A `full` label is as wide as possible; other
// labels are as wide as their text. The caller moves the label to its position.
static PetriLabel *layout_label(Layout *layout, const PetriLabel *style, const char *text, bool full) {
    if (text[0] == '\0')
        return NULL;
    char *fitting = layout->texts[layout->count];
    PetriLabel *label = &layout->labels[layout->count++];
    overlay_fit(fitting, sizeof layout->texts[0], text,
                (int)((layout->room - 2 * PADDING) / (TEXT_SIZE * CHARACTER_WIDTH)));
    *label = *style;
    label->text = fitting;
    label->size = TEXT_SIZE;
    label->line_height = LINE;
    label->padding = PADDING;
    label->width = full ? layout->room : overlay_columns(fitting) * TEXT_SIZE * CHARACTER_WIDTH + 2 * PADDING;
    label->height = overlay_lines(fitting) * LINE + 2 * PADDING - (LINE - TEXT_SIZE);
    label->x = label->y = MARGIN;
    return label;
}

// Places the errors at the top, the mark at the top right, the status at the bottom left, and the notice at the bottom
// right. If there is not enough space, the notice is above the status.
static void layout_labels(Layout *layout, const Overlay *overlay, double scale, int width, int height) {
    double across = width / scale, bottom = height / scale - MARGIN;
    layout->room = across - 2 * MARGIN;
    layout->count = 0;
    // Errors and the list of warnings are at the same place as the sliders, which are hidden meanwhile.
    layout_label(layout, overlay->is_warning ? &WARNING_STYLE : &ERROR_STYLE, overlay->error_text, true);
    PetriLabel *mark = layout_label(layout, &WARNING_STYLE, overlay->mark, false);
    if (mark)
        mark->x = across - MARGIN - mark->width;
    PetriLabel *status = layout_label(layout, &STATUS_STYLE, overlay->status, false);
    if (status)
        status->y = bottom - status->height;
    PetriLabel *notice = layout_label(layout, &NOTICE_STYLE, overlay->notice, false);
    if (notice) {
        bool beside = !status || status->width + MARGIN + notice->width <= layout->room;
        notice->x = across - MARGIN - notice->width;
        notice->y = (beside ? bottom : status->y - MARGIN) - notice->height;
    }
    if (overlay->error_text[0] == '\0')
        layout->count += sliders_layout(&overlay->sliders, layout->labels + layout->count);
}

void overlay_draw(PetriPainter *painter, const Overlay *overlay, double scale, uint32_t *pixels, int width,
                  int height) {
    Layout layout;
    layout_labels(&layout, overlay, scale, width, height);
    petri_painter_draw_labels(painter, layout.labels, layout.count, sizeof layout.labels[0], scale, pixels, width,
                              height, (size_t)width * sizeof *pixels);
}

PetriStatus overlay_show(PetriPainter *painter, PetriPicture *picture, const Overlay *overlay, double scale, int width,
                         int height) {
    Layout layout;
    layout_labels(&layout, overlay, scale, width, height);
    return petri_painter_present(painter, picture, layout.labels, layout.count, sizeof layout.labels[0], scale, width,
                                 height);
}
