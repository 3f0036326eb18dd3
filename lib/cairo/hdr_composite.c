// hdr_composite.c: see hdr_composite.h.
#include "cairo/hdr_composite.h"

#include "picture/blend.h"

#include <math.h>

// A source to composite onto the target, and its coverage.
typedef struct Stamp {
    cairo_pattern_t *cover;  // group with the coverage; composite_stamp destroys it
    cairo_pattern_t *colors; // group with the colours; composite_stamp destroys it; NULL: use another field
    const FloatImage *image; // if `colors` is NULL: image with the colours, at x, y of the target; NULL: use `shade`
    int x;
    int y;
    const HdrPaint *shade; // if `colors` and `image` are NULL: computes the colours; NULL: use `color`
    float color[4];
    CompositeMode mode;
} Stamp;

// The pixels of a group and their position on the target.
typedef struct Pixels {
    const unsigned char *at;
    int width;
    int height;
    int stride;
    int x;
    int y;
} Pixels;

static Pixels pixels_of(cairo_pattern_t *group) {
    cairo_surface_t *surface;
    double x, y;
    if (!group || cairo_pattern_get_surface(group, &surface) != CAIRO_STATUS_SUCCESS ||
        cairo_surface_get_type(surface) != CAIRO_SURFACE_TYPE_IMAGE)
        return (Pixels){0};
    cairo_surface_flush(surface);
    cairo_surface_get_device_offset(surface, &x, &y);
    return (Pixels){cairo_image_surface_get_data(surface),
                    cairo_image_surface_get_width(surface),
                    cairo_image_surface_get_height(surface),
                    cairo_image_surface_get_stride(surface),
                    (int)-x,
                    (int)-y};
}

static const unsigned char *row_of(const Pixels *pixels, int y) {
    return pixels->at + (ptrdiff_t)(y - pixels->y) * pixels->stride;
}

// Returns the source's colour at pixel x, y of the target.
static inline void find_color(const Stamp *stamp, const Pixels *colors, int x, int y, float color[4]) {
    const float *from = stamp->color;
    if (stamp->shade) {
        hdr_paint_at(stamp->shade, x + 0.5, y + 0.5, color);
        return;
    }
    if (stamp->image) {
        const FloatImage *image = stamp->image;
        static const float nothing[4];
        int column = x - stamp->x, row = y - stamp->y;
        bool inside = column >= 0 && row >= 0 && column < image->width && row < image->height;
        from = inside ? image->pixels + 4 * ((size_t)row * (size_t)image->width + (size_t)column) : nothing;
    }
    for (unsigned k = 0; k < 4; k++)
        color[k] = from[k];
    if (!colors->at || stamp->image)
        return;
    uint32_t pixel = ((const uint32_t *)(const void *)row_of(colors, y))[x - colors->x];
    for (unsigned k = 0; k < 4; k++)
        color[k] = (float)(pixel >> (k < 3 ? 16 - 8 * k : 24) & 255) / 255;
}

// Composites a colour, whose channels are multiplied by k, over d.
static inline void composite_over(float d[4], const float s[4], float k) {
    const float source[4] = {k * s[0], k * s[1], k * s[2], k * s[3]};
    for (int c = 0; c < 4; c++)
        d[c] = blend_OVER(source[c], d[c], source[3], d[3]);
}

// Composites each covered pixel s of the source onto the target d: d becomes k B(s, d) + (1 - k) d. k is the coverage.
static void composite_stamp(Canvas *canvas, Stamp *stamp) {
    FloatImage *wide = &canvas->hdr_target;
    Pixels cover = pixels_of(stamp->cover), colors = pixels_of(stamp->colors);
    int first = cover.y > wide->y ? cover.y : wide->y, left = cover.x > wide->x ? cover.x : wide->x;
    int bottom = wide->y + wide->height, edge = wide->x + wide->width;
    int last = cover.y + cover.height < bottom ? cover.y + cover.height : bottom;
    int right = cover.x + cover.width < edge ? cover.x + cover.width : edge;
    bool good = cover.at && (!stamp->colors || colors.at) && right > left && last > first &&
                draw_charge(canvas, NULL, 2.0 * (right - left) * (last - first), draw_omitted);
    for (int y = first; good && y < last; y++) {
        const unsigned char *row = row_of(&cover, y);
        for (int x = left; x < right; x++) {
            float k = (float)row[x - cover.x] / 255;
            if (k == 0)
                continue;
            size_t at = (size_t)(y - wide->y) * (size_t)wide->width + (size_t)(x - wide->x);
            float *d = wide->pixels + 4 * at, s[4], mixed[4];
            find_color(stamp, &colors, x, y, s);
            if (stamp->mode == COMPOSITE_OVER) {
                composite_over(d, s, k);
                continue;
            }
            blend_colors(stamp->mode, s, d, mixed);
            for (int c = 0; c < 4; c++)
                d[c] = k * mixed[c] + (1 - k) * d[c];
        }
    }
    cairo_pattern_destroy(stamp->cover);
    if (stamp->colors)
        cairo_pattern_destroy(stamp->colors);
}

// Returns a group that contains the current source within the clip. If the content is CAIRO_CONTENT_ALPHA, the group
// contains the coverage of the clip instead.
static cairo_pattern_t *make_group(cairo_t *cr, cairo_content_t content, double alpha) {
    cairo_pattern_t *source = cairo_pattern_reference(cairo_get_source(cr));
    cairo_push_group_with_content(cr, content);
    if (content == CAIRO_CONTENT_ALPHA)
        cairo_set_source_rgba(cr, 0, 0, 0, 1);
    else
        cairo_reset_clip(cr); // the coverage already contains the clip
    cairo_set_operator(cr, CAIRO_OPERATOR_OVER);
    if (content != CAIRO_CONTENT_ALPHA)
        cairo_set_source(cr, source);
    cairo_paint_with_alpha(cr, alpha);
    cairo_pattern_destroy(source);
    return cairo_pop_group(cr);
}

void hdr_draw_path(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint) {
    cairo_t *cr = canvas->cr;
    Stamp stamp = {.mode = (CompositeMode)(int)paint->style.mode};
    float alpha = (float)display_paint_alpha(paint);
    bool plain = display_paint_is_plain(paint);
    HdrPaint shade;
    if (!plain && hdr_paint_from_source(canvas, paint->source, alpha, &shade))
        stamp.shade = &shade;
    else
        draw_set_source(canvas, paint); // set before groups are created, because setting it can abort the drawing
    cairo_save(cr);
    draw_clip_to_box(canvas, shape, paint);
    if (!plain && !stamp.shade)
        stamp.colors = make_group(cr, CAIRO_CONTENT_COLOR_ALPHA, 1);
    DisplayRow row;
    display_list_read(paint->source, &row);
    for (int k = 0; plain && k < 3; k++)
        stamp.color[k] = (float)row.COLOR.colour[k] * alpha;
    stamp.color[3] = alpha;
    stamp.cover = draw_make_mask(canvas, shape, paint);
    composite_stamp(canvas, &stamp);
    cairo_restore(cr);
}

void hdr_draw_image(Canvas *canvas, const DisplayPaint *paint, const HdrPaint *image) {
    Stamp stamp = {.shade = image, .mode = (CompositeMode)(int)paint->style.mode};
    stamp.cover = make_group(canvas->cr, CAIRO_CONTENT_ALPHA, 1);
    composite_stamp(canvas, &stamp);
}

void hdr_composite(Canvas *canvas, const FloatImage *image, double x, double y, int composite) {
    Stamp stamp = {.image = image, .x = (int)x, .y = (int)y, .mode = (CompositeMode)composite};
    stamp.cover = make_group(canvas->cr, CAIRO_CONTENT_ALPHA, 1);
    composite_stamp(canvas, &stamp);
}

FloatImage hdr_begin_layer(Canvas *canvas) {
    FloatImage below = canvas->hdr_target, layer = float_image_new(&canvas->pool, below.width, below.height);
    layer.x = below.x;
    layer.y = below.y;
    if (layer.pixels)
        canvas->hdr_target = layer;
    return below;
}

void hdr_end_layer(Canvas *canvas, FloatImage below, double alpha) {
    for (size_t i = 0; i < 4 * (size_t)below.width * (size_t)below.height; i += 4)
        composite_over(below.pixels + i, canvas->hdr_target.pixels + i, (float)alpha);
    float_image_free(&canvas->pool, &canvas->hdr_target);
    canvas->hdr_target = below;
}
