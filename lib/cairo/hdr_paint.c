// hdr_paint.c: see hdr_paint.h.
#include "cairo/hdr_paint.h"

#include "maths/maths.h"
#include "picture/blend.h"

#include <math.h>

// Returns true if this file can compute the paint. The depth of blends is limited by display_list_build_source.
static bool is_supported(const double *at) {
    DisplayRow row;
    display_list_read(at, &row);
    switch (row.kind) {
    case PETRI_DRAW_SOLID:
    case PETRI_DRAW_RADIAL:
        return true;
    case PETRI_DRAW_LINEAR:
        return row.LINEAR.start[0] != row.LINEAR.end[0] || row.LINEAR.start[1] != row.LINEAR.end[1];
    case PETRI_DRAW_BLEND:
        return is_supported(row.BLEND.first) && is_supported(row.BLEND.second);
    default:
        return false;
    }
}

bool hdr_paint_from_source(Canvas *canvas, const double *source, double alpha, HdrPaint *shade) {
    DisplayRow row;
    display_list_read(source, &row);
    *shade = (HdrPaint){.source = source, .alpha = (float)alpha};
    cairo_get_matrix(canvas->cr, &shade->to_units);
    if (row.kind == PETRI_DRAW_PATTERN) {
        const DisplayMatrix *m = row.PATTERN.matrix;
        cairo_matrix_t own = {m->xx, m->yx, m->xy, m->yy, m->x0, m->y0};
        DrawImage image = draw_image_at(canvas, source, &row.PATTERN.file);
        cairo_matrix_multiply(&shade->to_units, &own, &shade->to_units);
        shade->repeats = true;
        if (!draw_find_pixels(canvas, &image, &shade->texture, &shade->file))
            return false;
    } else if (!is_supported(source)) {
        return false;
    }
    return cairo_matrix_invert(&shade->to_units) == CAIRO_STATUS_SUCCESS;
}

// Interpolates between gradient stops. Colours are not premultiplied during interpolation.
static void find_stop(DisplayStops all, double at, float color[4]) {
    const DisplayStop *stops = all.at;
    uint32_t next = 0, last = all.count - 1;
    while (next <= last && stops[next].offset <= at)
        next++;
    const DisplayStop *to = &stops[next < last ? next : last], *from = next > 0 ? &stops[next - 1] : to;
    double way = to->offset - from->offset, fraction = way > 0 ? (at - from->offset) / way : 0;
    fraction = fraction < 1 ? fraction : 1;
    for (int k = 0; k < 4; k++)
        color[k] = (float)(from->color[k] + fraction * (to->color[k] - from->color[k]));
    for (int k = 0; k < 3; k++)
        color[k] *= color[3];
}

static void find_source(const double *at, double x, double y, float color[4]) {
    DisplayRow row;
    display_list_read(at, &row);
    switch (row.kind) {
    case PETRI_DRAW_LINEAR: {
        const double *start = row.LINEAR.start, *end = row.LINEAR.end, dx = end[0] - start[0], dy = end[1] - start[1];
        find_stop(row.LINEAR.stops, ((x - start[0]) * dx + (y - start[1]) * dy) / (dx * dx + dy * dy), color);
        break;
    }
    case PETRI_DRAW_RADIAL: {
        const DisplayMatrix *m = row.RADIAL.matrix;
        double size = m->xx * m->yy - m->xy * m->yx, u = x - m->x0, v = y - m->y0;
        find_stop(row.RADIAL.stops, maths_hypot((m->yy * u - m->xy * v) / size, (m->xx * v - m->yx * u) / size), color);
        break;
    }
    case PETRI_DRAW_SOLID:
        color[3] = (float)fmin(fmax(row.SOLID.colour[3], 0), 1);
        for (int k = 0; k < 3; k++)
            color[k] = (float)row.SOLID.colour[k] * color[3];
        break;
    case PETRI_DRAW_BLEND: {
        float second[4], fraction = (float)row.BLEND.ratio;
        find_source(row.BLEND.first, x, y, color);
        find_source(row.BLEND.second, x, y, second);
        if (row.BLEND.ratio < 0)
            blend_colors((CompositeMode)(int)row.BLEND.mode, second, color, color);
        for (int k = 0; k < 4 && row.BLEND.ratio >= 0; k++)
            color[k] += fraction * (second[k] - color[k]);
        break;
    }
    default: // is_supported returns false
        break;
    }
}

static int pixel_index(const HdrPaint *shade, double at, int size) {
    const double EDGE_BIAS =
        1.0 / 65536; // a point on the edge between two pixels belongs to the second, despite rounding errors
    at += EDGE_BIAS;
    at -= shade->repeats ? floor(at / size) * size : 0;
    return at >= 1 ? at < size ? (int)at : size - 1 : 0;
}

static void find_bytes(uint32_t pixel, bool straight, float color[4]) {
    color[3] = (float)(pixel >> 24) / 255;
    for (unsigned k = 0; k < 3; k++) {
        unsigned c = pixel >> (16 - 8 * k) & 255;
        color[k] = straight ? texture_decode(texture_unpremultiply(c, pixel >> 24)) * color[3] : texture_decode(c);
    }
}

// Reads the nearest pixel. Colours of files are unpremultiplied before they are decoded; colours of rendered pictures
// are not.
static void find_pixel(const HdrPaint *shade, double x, double y, float color[4]) {
    const Texture *texture = shade->texture;
    if (texture) {
        size_t at = (size_t)pixel_index(shade, y, texture->height) * (size_t)texture->width +
                    (size_t)pixel_index(shade, x, texture->width);
        if (!texture->linear)
            find_bytes(texture->bytes[at], false, color);
        for (size_t k = 0; k < 4 && texture->linear; k++)
            color[k] = texture->linear[4 * at + k];
        return;
    }
    const unsigned char *row = cairo_image_surface_get_data(shade->file) +
                               (size_t)pixel_index(shade, y, cairo_image_surface_get_height(shade->file)) *
                                   (size_t)cairo_image_surface_get_stride(shade->file);
    uint32_t pixel =
        ((const uint32_t *)(const void *)row)[pixel_index(shade, x, cairo_image_surface_get_width(shade->file))];
    if (cairo_image_surface_get_format(shade->file) != CAIRO_FORMAT_ARGB32)
        pixel |= 0xff000000u;
    find_bytes(pixel, true, color);
}

void hdr_paint_at(const HdrPaint *shade, double x, double y, float color[4]) {
    cairo_matrix_transform_point(&shade->to_units, &x, &y);
    if (shade->texture || shade->file)
        find_pixel(shade, x, y, color);
    else
        find_source(shade->source, x, y, color);
    for (int k = 0; k < 4; k++)
        color[k] *= shade->alpha;
}
