// overlay.c: see overlay.h.
#include "overlay.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bytes.h"
#include "petri.h"

// Sizes in units of text; a letter of the fixed-width font is about this part of its size wide.
enum { TEXT_SIZE = 13, LINE = 19, MARGIN = 12, PADDING = 10, STRIPE = 4 };
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

// Length of the UTF-8 character at the start of a text, 0 if there is none.
static size_t character_length(const unsigned char *text) {
    size_t length = text[0] < 0x80                      ? 1
                    : text[0] >= 0xC2 && text[0] < 0xE0 ? 2
                    : text[0] >= 0xE0 && text[0] < 0xF0 ? 3
                                                        : 4;
    if (text[0] == 0 || text[0] > 0xF4 || (text[0] >= 0x80 && text[0] < 0xC2)) {
        return 0;
    }
    for (size_t i = 1; i < length; i++) {
        if ((text[i] & 0xC0) != 0x80) {
            return 0;
        }
    }
    bool surrogate = text[0] == 0xED && text[1] >= 0xA0,
         overlong = (text[0] == 0xE0 && text[1] < 0xA0) || (text[0] == 0xF0 && text[1] < 0x90),
         beyond = text[0] == 0xF4 && text[1] >= 0x90;
    return surrogate || overlong || beyond ? 0 : length;
}

// Past an escape sequence such as those that colour messages.
static const char *skip_escape(const char *text) {
    if (text[1] != '[') {
        return text + 1;
    }
    text += 2;
    text += strspn(text, "0123456789;:?<=>!\"#$%&'()*+,-./ ");
    return *text == '\0' ? text : text + 1;
}

static bool is_control(const char *text, size_t length) {
    unsigned char first = (unsigned char)text[0];
    return (length == 1 && (first < ' ' || first == 127)) || (first == 0xC2 && (unsigned char)text[1] < 0xA0);
}

bool overlay_set(char *text, size_t size, const char *from) {
    char clean[sizeof(Overlay)];
    size_t used = 0;
    size = size < sizeof clean ? size : sizeof clean;
    while (*from != '\0') {
        size_t length = character_length((const unsigned char *)from);
        if (*from == '\033') {
            from = skip_escape(from);
            continue;
        }
        bool blank = *from == '\t', kept = length > 0 && (*from == '\n' || !is_control(from, length));
        if (used + (length > 1 ? length : 1) >= size) {
            break;
        }
        if (blank || length == 0) {
            clean[used++] = blank ? ' ' : '?';
        } else if (kept) {
            memcpy(clean + used, from, length);
            used += length;
        }
        from += length > 0 ? length : 1;
    }
    while (used > 0 && clean[used - 1] == '\n') {
        used--;
    }
    clean[used] = '\0';
    bool changed = strcmp(text, clean) != 0;
    memcpy(text, clean, used + 1);
    return changed;
}

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

static int count_lines(const char *text) {
    int lines = *text == '\0' ? 0 : 1;
    for (; *text != '\0'; text++) {
        lines += *text == '\n';
    }
    return lines;
}

// Characters of a line, up to its end.
static int line_length(const char *text) {
    int length = 0;
    for (; *text != '\0' && *text != '\n'; text++) {
        length += ((unsigned char)*text & 0xC0) != 0x80;
    }
    return length;
}

static int longest_line(const char *text) {
    int longest = 0;
    for (const char *line = text; line != NULL; line = strchr(line, '\n'), line += line != NULL) {
        int length = line_length(line);
        longest = length > longest ? length : longest;
    }
    return longest;
}

// One line as a string of the language, cut off after so many characters.
static void add_string(Bytes *script, const char *line, int most) {
    bool cut = line_length(line) > most;
    bytes_add(script, "'", 1);
    for (int count = 0; *line != '\0' && *line != '\n'; line++) {
        count += ((unsigned char)*line & 0xC0) != 0x80;
        if (cut && count >= most) {
            break;
        }
        if (*line == '\'' || *line == '\\') {
            bytes_add(script, "\\", 1);
        }
        bytes_add(script, line, 1);
    }
    bytes_format(script, "%s'", cut ? "…" : "");
}

typedef struct Panel {
    const char *text;
    double x; // left and top edge
    double y;
    double width;
    const char *back;  // colours, as the language has them
    const char *front; // of the text
    const char *edge;  // of a stripe at the left; NULL: none
} Panel;

static double panel_height(const char *text) {
    return count_lines(text) * LINE + 2 * PADDING - (LINE - TEXT_SIZE) / 2.0;
}

static double panel_width(const char *text, double most) {
    double width = longest_line(text) * TEXT_SIZE * LETTER + 2 * PADDING;
    return width < most ? width : most;
}

static void add_panel(Bytes *script, const Panel *panel) {
    double height = panel_height(panel->text);
    int most = (int)((panel->width - 2 * PADDING) / (TEXT_SIZE * LETTER) + 0.5);
    bytes_format(script, "            !rect point=%.2f;%.2f size=%.2f;%.2f radius=6 color=%s fill=true\n", panel->x,
                 panel->y, panel->width, height, panel->back);
    if (panel->edge != NULL) {
        bytes_format(script, "            !rect point=%.2f;%.2f size=%d;%.2f radius=2 color=%s fill=true\n", panel->x,
                     panel->y, STRIPE, height, panel->edge);
    }
    double y = panel->y + PADDING + TEXT_SIZE * 0.85;
    for (const char *line = panel->text; line != NULL; line = strchr(line, '\n'), line += line != NULL, y += LINE) {
        bytes_format(script, "            !text center=false text=");
        add_string(script, line, most < 1 ? 1 : most);
        bytes_format(script, " point=%.2f;%.2f color=%s\n", panel->x + PADDING, y, panel->front);
    }
}

// The whole overlay as a script.
static void write_scene(Bytes *script, const Overlay *overlay, double scale, int width, int height) {
    double across = width / scale, down = height / scale, most = across - 2 * MARGIN;
    bytes_format(script,
                 "!offscreen size=%d;%d\n    !canvas\n        !group scale=%.6f\n"
                 "          !font family='monospace' size=%d\n",
                 width, height, scale, TEXT_SIZE);
    if (overlay->trouble[0] != '\0') {
        add_panel(script, &(Panel){overlay->trouble, MARGIN, MARGIN, most, "0.16;0.03;0.04;0.92", "1;0.93;0.91",
                                   "0.94;0.27;0.23"});
    }
    if (overlay->notice[0] != '\0') {
        double notice = panel_width(overlay->notice, most);
        add_panel(script,
                  &(Panel){overlay->notice, across - MARGIN - notice, down - MARGIN - panel_height(overlay->notice),
                           notice, "0.05;0.07;0.1;0.8", "0.75;0.9;1", NULL});
    }
    if (overlay->status[0] != '\0') {
        add_panel(script, &(Panel){overlay->status, MARGIN, down - MARGIN - panel_height(overlay->status),
                                   panel_width(overlay->status, most), "0.05;0.07;0.1;0.8", "0.92;0.94;0.96", NULL});
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
    Bytes script = {0};
    painter->any = overlay->status[0] != '\0' || overlay->notice[0] != '\0' || overlay->trouble[0] != '\0';
    if (painter->any) {
        write_scene(&script, overlay, scale, painter->width, painter->height);
        painter->any = draw_scene(painter, &script);
    }
    bytes_free(&script);
    painter->drawn = *overlay;
    painter->scale = scale;
}

static bool same_texts(const Overlay *a, const Overlay *b) {
    return strcmp(a->status, b->status) == 0 && strcmp(a->notice, b->notice) == 0 &&
           strcmp(a->trouble, b->trouble) == 0;
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
