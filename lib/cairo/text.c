// text.c: text layout with Pango.
//
// Glyphs are not hinted, so they look the same under every transform and desktop setting.
#include "base/hash_index.h"
#include "base/heap.h"
#include "cairo/canvas.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MAX_FONTS = 5000 }; // maximum number of fonts that a painter loads to measure texts

// Creates the fonts on first use, not earlier, because Pango then starts a background thread that loads the list of
// fonts. A process that exits while the thread runs would free data that the thread still reads.
TextContext *draw_text_context(PetriPainter *painter) {
    TextContext *text_context = painter->text_context;
    if (text_context)
        return text_context;
    text_context = heap_calloc(1, sizeof *text_context);
    PangoFontMap *fonts = text_context ? pango_cairo_font_map_new() : NULL;
    if (!fonts) {
        heap_free(text_context);
        return NULL;
    }
    painter->text_context = text_context;
    text_context->fonts = fonts;
    text_context->context = pango_font_map_create_context(text_context->fonts);
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    pango_cairo_context_set_font_options(text_context->context, options);
    cairo_font_options_destroy(options);
    pango_context_set_round_glyph_positions(text_context->context, FALSE);
    text_context->layout = pango_layout_new(text_context->context);
    pango_layout_set_single_paragraph_mode(text_context->layout, TRUE);
    return text_context;
}

void draw_text_close(PetriPainter *painter) {
    TextContext *text_context = painter->text_context;
    if (!text_context)
        return;
    g_object_unref(text_context->layout);
    g_object_unref(text_context->context);
    g_object_unref(text_context->fonts);
    heap_free(text_context);
}

// Returns true for generic family names, which every machine maps to some font.
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
    pango_font_map_list_families(painter->text_context->fonts, &families, &count);
    for (int i = 0; i < count && !found; i++)
        found = !strcasecmp(name, pango_font_family_get_name(families[i]));
    g_free(families);
    return found;
}

// Returns a metric-compatible substitute if this is a common font that many machines lack, else NULL.
static const char *find_substitute(const char *name) {
    static const char *const pairs[][2] = {{"Helvetica", "Liberation Sans"},
                                           {"Arial", "Liberation Sans"},
                                           {"Georgia", "Gelasio"},
                                           {"Menlo", "DejaVu Sans Mono"}};
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++)
        if (!strcasecmp(name, pairs[i][0]))
            return pairs[i][1];
    return NULL;
}

// Returns the family to request from Pango for a list of family names. Finds the first name that is installed or has an
// installed substitute. If this name has an installed substitute, returns the substitute; otherwise, returns the whole
// list, from which Pango chooses. If no name is found, returns the list and sets *known to false.
static const char *find_family(PetriPainter *painter, const char *list, bool *known) {
    char name[128];
    *known = true;
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
            const char *other = find_substitute(name);
            if (other && is_installed(painter, other))
                return other;
            if (is_installed(painter, name))
                return list;
        }
        at += length;
    }
    *known = false;
    return list;
}

static PangoStretch stretch_of(int width) {
    return (PangoStretch)((int)PANGO_STRETCH_ULTRA_CONDENSED + width);
}

static bool same_font(const TextFont *a, const TextFont *b) {
    return a->family && strcmp(a->family, b->family) == 0 && a->size == b->size && a->weight == b->weight &&
           a->width == b->width && a->slant == b->slant;
}

// Disables ligatures, kerning and fallback fonts.
static void disable_ligatures(PangoLayout *layout) {
    PangoAttrList *attributes = pango_attr_list_new();
    pango_attr_list_insert(attributes, pango_attr_font_features_new("kern=0, liga=0, clig=0, calt=0"));
    pango_attr_list_insert(attributes, pango_attr_fallback_new(FALSE));
    pango_layout_set_attributes(layout, attributes);
    pango_attr_list_unref(attributes);
}

static void use_font(TextContext *text_context, const TextFont *text, const char *family) {
    static const PangoStyle styles[] = {PANGO_STYLE_NORMAL, PANGO_STYLE_OBLIQUE, PANGO_STYLE_ITALIC};
    PangoFontDescription *font = pango_font_description_new();
    pango_font_description_set_family(font, family);
    pango_font_description_set_absolute_size(font, text->size * PANGO_SCALE);
    pango_font_description_set_weight(font, (PangoWeight)fmax(text->weight, 1));
    pango_font_description_set_stretch(font, stretch_of(text->width));
    pango_font_description_set_style(font, styles[text->slant]);
    pango_layout_set_font_description(text_context->layout, font);
    pango_font_description_free(font);
    disable_ligatures(text_context->layout);
}

// Sets the font of a drawing. A family that is not installed is reported unless it is the default.
static void set_font(Canvas *canvas, const TextFont *text) {
    TextContext *text_context = canvas->painter->text_context;
    bool known;
    if (same_font(&text_context->font, text))
        return;
    // Finds the family before Pango objects are allocated, because the report can abort the drawing.
    const char *family = find_family(canvas->painter, text->family, &known);
    if (!known && strcmp(text->family, schema_row(KIND_CANVAS, ATTR_FONT_FAMILY)->default_value.string) != 0)
        draw_report(canvas, NULL, DIAG_WARNING, "unknown-font", "!font: font '%.100s' is not installed; using another",
                    text->family);
    use_font(text_context, text, family);
    text_context->font = *text;
}

// Returns true if the text is neither too large for the font library nor too small to see.
static bool has_drawable_size(Canvas *canvas, double size) {
    double pixels = size * draw_scale_of(canvas->cr);
    if (pixels > MAX_FONT_SIZE || size > MAX_FONT_SIZE)
        draw_report(canvas, NULL, DIAG_WARNING, "bad-font-size", "!text: text larger than %d pixels is not drawn",
                    MAX_FONT_SIZE);
    return pixels > 0.1 && size > 0.001 && pixels <= MAX_FONT_SIZE && size <= MAX_FONT_SIZE;
}

// Converts `point` to the top left corner of the layout. On entry, it is the centre of the text if `center` is true,
// else the start of the baseline.
static void position_layout(PangoLayout *layout, bool center, double point[2]) {
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

bool draw_set_text_path(Canvas *canvas, const TEXTOperands *text, const DisplayPaint *paint) {
    Str string = draw_string(canvas, &text->text);
    if (text->weight <= 0 || !has_drawable_size(canvas, text->size))
        return false;
    if (string.len > MAX_TEXT_LENGTH) {
        draw_report(canvas, NULL, DIAG_WARNING, "text-too-long", "!text: text longer than %d bytes is not drawn",
                    MAX_TEXT_LENGTH);
        return false;
    }
    // The estimated area per byte of text is a third of the square of the font size.
    if (!draw_charge_box(canvas, paint, text->size, text->size / 3, (double)string.len))
        return false;
    TextContext *text_context = draw_text_context(canvas->painter);
    if (!text_context)
        arena_exhausted(&canvas->painter->arena);
    PangoLayout *layout = text_context->layout;
    double point[2] = {text->point[0], text->point[1]};
    set_font(canvas, &(TextFont){.family = draw_string(canvas, &text->family).bytes,
                                 .size = text->size,
                                 .weight = text->weight,
                                 .width = (int)text->width,
                                 .slant = (int)text->slant});
    pango_layout_set_text(layout, string.bytes, (int)string.len);
    position_layout(layout, text->centred != 0, point);
    draw_forget_path(canvas);
    draw_clamp_point(canvas, &point[0], &point[1]);
    cairo_move_to(canvas->cr, point[0], point[1]);
    pango_cairo_layout_path(canvas->cr, layout);
    return true;
}

// Returns true if the font was measured recently. Otherwise, adds it to the recent fonts and counts it.
static bool is_recent_font(TextContext *text_context, uint64_t hash) {
    for (uint32_t i = 0; i < RECENT_FONTS; i++)
        if (text_context->recent_fonts[i] == hash)
            return true;
    text_context->recent_fonts[text_context->font_count++ % RECENT_FONTS] = hash;
    return false;
}

const char *draw_measure_text(PetriPainter *painter, Str text, const TextStyle *style, double *width, bool *loaded) {
    TextContext *text_context = draw_text_context(painter);
    if (!text_context)
        return "out of memory";
    const double face[] = {style->weight, style->width, style->slant};
    *loaded = !is_recent_font(text_context,
                              hash_bytes(hash_bytes(0, style->family, strlen(style->family)), face, sizeof face));
    if (text_context->font_count > MAX_FONTS)
        return "a run can measure text in at most 5000 fonts"; // the font library keeps each in memory
    bool known;
    // Advances are proportional to the size. A fixed size is more precise than a small one.
    const double measured_size = 1000;
    use_font(text_context,
             &(TextFont){.size = measured_size, .weight = style->weight, .width = style->width, .slant = style->slant},
             find_family(painter, style->family, &known));
    text_context->font.family = NULL; // the next text that is drawn sets its own font
    PangoRectangle logical;
    pango_layout_set_text(text_context->layout, text.bytes, (int)text.len);
    pango_layout_get_extents(text_context->layout, NULL, &logical);
    *width = logical.width / (double)PANGO_SCALE * (style->size / measured_size);
    return NULL;
}
