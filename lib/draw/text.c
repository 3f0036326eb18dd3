// text.c: text, laid out by Pango.
//
// Letters are not fitted to the grid of pixels: they look the same whatever the transform and the desktop's settings.
#include "draw/draw.h"

#include <math.h>
#include <string.h>
#include <strings.h>

enum { LONGEST_TEXT = 10000 };           // bytes
static const double LARGEST_FONT = 4000; // pixels

bool draw_text_open(PetriPainter *painter) {
    painter->fonts = pango_cairo_font_map_new();
    if (!painter->fonts)
        return false;
    painter->text_context = pango_font_map_create_context(painter->fonts);
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    pango_cairo_context_set_font_options(painter->text_context, options);
    cairo_font_options_destroy(options);
    pango_context_set_round_glyph_positions(painter->text_context, FALSE);
    painter->layout = pango_layout_new(painter->text_context);
    pango_layout_set_single_paragraph_mode(painter->layout, TRUE);
    return true;
}

void draw_text_close(PetriPainter *painter) {
    if (painter->layout)
        g_object_unref(painter->layout);
    if (painter->text_context)
        g_object_unref(painter->text_context);
    if (painter->fonts)
        g_object_unref(painter->fonts);
}

// Names that stand for whatever the machine has.
static bool is_generic(const char *name) {
    static const char *const names[] = {"sans",      "sans-serif", "serif",   "mono",
                                        "monospace", "cursive",    "fantasy", "system-ui"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (!strcasecmp(name, names[i]))
            return true;
    return false;
}

static bool is_installed(PetriPainter *painter, const char *name) {
    PangoFontFamily **families;
    int count;
    bool found = is_generic(name);
    pango_font_map_list_families(painter->fonts, &families, &count);
    for (int i = 0; i < count && !found; i++)
        found = !strcasecmp(name, pango_font_family_get_name(families[i]));
    g_free(families);
    return found;
}

// Reports a list of names none of which is there.
static void check_family(Canvas *canvas, const char *list) {
    char name[128];
    for (const char *at = list;;) {
        at += strspn(at, " ,");
        if (!*at)
            break;
        size_t length = strcspn(at, ","), trimmed = length;
        while (trimmed > 0 && at[trimmed - 1] == ' ')
            trimmed--;
        if (trimmed < sizeof name) {
            memcpy(name, at, trimmed);
            name[trimmed] = 0;
            if (is_installed(canvas->painter, name))
                return;
        }
        at += length;
    }
    draw_fault(canvas, DIAG_WARNING, "unknown-font",
               "!font: there is no font '%.100s' on this machine; another takes its place", list);
}

static void set_font(Canvas *canvas, const Look *look) {
    static const PangoStyle styles[] = {PANGO_STYLE_NORMAL, PANGO_STYLE_OBLIQUE, PANGO_STYLE_ITALIC};
    PetriPainter *painter = canvas->painter;
    const Look *last = &painter->font;
    if (painter->family == look->family && last->font_size == look->font_size && last->weight == look->weight &&
        last->slant == look->slant)
        return;
    if (painter->family != look->family)
        check_family(canvas, look->family);
    PangoFontDescription *font = pango_font_description_new();
    pango_font_description_set_family(font, look->family);
    pango_font_description_set_absolute_size(font, look->font_size * PANGO_SCALE);
    pango_font_description_set_weight(font, (PangoWeight)look->weight);
    pango_font_description_set_style(font, styles[look->slant]);
    pango_layout_set_font_description(painter->layout, font);
    pango_font_description_free(font);
    painter->family = look->family;
    painter->font = *look;
}

// The size on the target decides what the font library can do.
static bool has_drawable_size(Canvas *canvas, const Look *look) {
    double pixels = look->font_size * draw_scale_of(canvas->cr);
    if (pixels > LARGEST_FONT || look->font_size > LARGEST_FONT)
        draw_fault(canvas, DIAG_WARNING, "bad-font-size", "!text: letters of more than %g pixels are not drawn",
                   LARGEST_FONT);
    return pixels > 0.1 && look->font_size > 0.001 && pixels <= LARGEST_FONT && look->font_size <= LARGEST_FONT;
}

// Where the base line of the layout begins.
static void place(PangoLayout *layout, bool center, double point[2]) {
    PangoRectangle ink;
    double baseline = pango_layout_get_baseline(layout) / (double)PANGO_SCALE;
    if (!center) {
        point[1] -= baseline;
        return;
    }
    pango_layout_get_extents(layout, &ink, NULL);
    point[0] -= (ink.x + ink.width / 2.0) / PANGO_SCALE;
    point[1] -= (ink.y + ink.height / 2.0) / PANGO_SCALE;
}

static void add_letters(Canvas *canvas, const double point[2]) {
    double x = point[0], y = point[1];
    draw_tame(canvas, &x, &y);
    cairo_move_to(canvas->cr, x, y);
    pango_cairo_layout_path(canvas->cr, canvas->painter->layout);
}

static void draw_letters(Canvas *canvas, const DrawNode *node, const Look *look, const double point[2]) {
    bool fill = draw_flag(node, ATTR_FILL), stroke = draw_flag(node, ATTR_STROKE);
    if (!fill && !stroke) {
        add_letters(canvas, point);
        return;
    }
    KeptPath kept = draw_keep_path(canvas);
    add_letters(canvas, point);
    if (fill)
        draw_fill(canvas, look);
    if (stroke)
        draw_stroke(canvas, look);
    draw_put_back_path(canvas, kept);
}

void draw_text(Canvas *canvas, const DrawNode *node, const Look *look) {
    const AttrValue *text = draw_attr(node, ATTR_TEXT);
    double point[2];
    draw_pair(node, ATTR_POINT, point);
    if (!text || text->as.text.len == 0 || !has_drawable_size(canvas, look))
        return;
    if (text->as.text.len > LONGEST_TEXT) {
        draw_fault(canvas, DIAG_WARNING, "long-text", "!text: texts of more than %d bytes are not drawn", LONGEST_TEXT);
        return;
    }
    PangoLayout *layout = canvas->painter->layout;
    set_font(canvas, look);
    pango_cairo_update_layout(canvas->cr, layout);
    pango_layout_set_text(layout, text->as.text.bytes, (int)text->as.text.len);
    place(layout, draw_flag(node, ATTR_CENTER), point);
    draw_letters(canvas, node, look, point);
}
