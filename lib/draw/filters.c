// filters.c: what is drawn through a filter (spec canvas.md 6): drawn on a transparent sheet, which is then changed.
#include "draw/draw.h"

#include "maths/maths.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double WIDEST = 256; // standard deviation, pixels
enum { MOST_SHEET = 1 << 26 };    // pixels

// r, g, b, a of each pixel, multiplied by alpha, 0 to 255.
typedef struct Sheet {
    int width;
    int height;
    float *pixels; // to be freed; NULL: memory is used up, and so it is with what is made of it
} Sheet;

static Sheet sheet_new(const Sheet *like) {
    size_t count = (size_t)like->width * (size_t)like->height;
    return (Sheet){like->width, like->height, like->pixels ? calloc(count, 4 * sizeof(float)) : NULL};
}

static float *pixel_of(const Sheet *sheet, int x, int y) {
    return sheet->pixels + 4 * ((size_t)y * (size_t)sheet->width + (size_t)x);
}

// The weights of whole distances from 0 on; returns how many.
static int make_weights(double sigma, float *weights) {
    int reach = (int)ceil(3 * sigma);
    double sum = 0;
    for (int i = 0; i <= reach; i++)
        sum += (i ? 2 : 1) * maths_exp(-0.5 * i * i / (sigma * sigma));
    for (int i = 0; i <= reach; i++)
        weights[i] = (float)(maths_exp(-0.5 * i * i / (sigma * sigma)) / sum);
    return reach;
}

// Blurs one row or column of `count` pixels that are `step` floats apart.
static void blur_row(const float *from, float *to, int count, size_t step, const float *weights, int reach) {
    for (int i = 0; i < count; i++) {
        float sum[4] = {0, 0, 0, 0};
        int first = i - reach < 0 ? 0 : i - reach, last = i + reach >= count ? count - 1 : i + reach;
        for (int j = first; j <= last; j++)
            for (int k = 0; k < 4; k++)
                sum[k] += weights[abs(i - j)] * from[(size_t)j * step + (size_t)k];
        memcpy(to + (size_t)i * step, sum, sizeof sum);
    }
}

static Sheet blur(Sheet sheet, const double sigma[2]) {
    float weights[3 * 256 + 2];
    for (int axis = 0; axis < 2; axis++) {
        if (!(sigma[axis] > 0.05))
            continue;
        Sheet out = sheet_new(&sheet);
        int reach = make_weights(fmin(sigma[axis], WIDEST), weights);
        int rows = !out.pixels ? 0 : axis ? sheet.width : sheet.height;
        for (int i = 0; i < rows; i++) {
            size_t start =
                (size_t)(axis ? pixel_of(&sheet, i, 0) - sheet.pixels : pixel_of(&sheet, 0, i) - sheet.pixels);
            blur_row(sheet.pixels + start, out.pixels + start, axis ? sheet.height : sheet.width,
                     axis ? 4 * (size_t)sheet.width : 4, weights, reach);
        }
        free(sheet.pixels);
        sheet = out;
    }
    return sheet;
}

// What is on the canvas's target is moved by whole pixels.
static Sheet move(Sheet sheet, double dx, double dy) {
    Sheet out = sheet_new(&sheet);
    int x0 = (int)fmin(fmax(rint(dx), -sheet.width), sheet.width);
    int y0 = (int)fmin(fmax(rint(dy), -sheet.height), sheet.height);
    int first = x0 > 0 ? x0 : 0, last = x0 > 0 ? sheet.width : sheet.width + x0;
    for (int y = 0; out.pixels && y < sheet.height; y++)
        if (y - y0 >= 0 && y - y0 < sheet.height && last > first)
            memcpy(pixel_of(&out, first, y), pixel_of(&sheet, first - x0, y - y0),
                   (size_t)(last - first) * 4 * sizeof(float));
    free(sheet.pixels);
    return out;
}

static double scale_in(const cairo_matrix_t *m, int axis) {
    return axis ? sqrt(m->xy * m->xy + m->yy * m->yy) : sqrt(m->xx * m->xx + m->yx * m->yx);
}

static Sheet copy(const Sheet *sheet) {
    Sheet out = sheet_new(sheet);
    if (out.pixels)
        memcpy(out.pixels, sheet->pixels, (size_t)sheet->width * (size_t)sheet->height * 4 * sizeof(float));
    return out;
}

static void shade(Sheet *sheet, const double color[4]) {
    size_t count = sheet->pixels ? (size_t)sheet->width * (size_t)sheet->height : 0;
    for (size_t i = 0; i < count; i++) {
        float *pixel = sheet->pixels + 4 * i, alpha = pixel[3] * (float)color[3];
        for (int k = 0; k < 3; k++)
            pixel[k] = alpha * (float)color[k];
        pixel[3] = alpha;
    }
}

static void lay_over(Sheet *below, const Sheet *above) {
    size_t count = below->pixels ? (size_t)below->width * (size_t)below->height : 0;
    for (size_t i = 0; i < 4 * count; i++)
        below->pixels[i] = above->pixels[i] + below->pixels[i] * (1 - above->pixels[i | 3] / 255);
}

// Gives back `drawn`.
static Sheet apply(const List *list, uint32_t number, const cairo_matrix_t *m, Sheet drawn) {
    const ListFilter *filter = &list->filters.at[number];
    double dx = filter->offset[0], dy = filter->offset[1];
    double sigma[2] = {filter->radius[0] * scale_in(m, 0), filter->radius[1] * scale_in(m, 1)};
    cairo_matrix_transform_distance(m, &dx, &dy);
    if (filter->input != LIST_NONE)
        drawn = apply(list, filter->input, m, drawn);
    if (filter->kind == FILTER_BLUR)
        return blur(drawn, sigma);
    if (filter->kind == FILTER_OFFSET)
        return move(drawn, dx, dy);
    Sheet shadow = copy(&drawn);
    shade(&shadow, filter->color);
    shadow = move(blur(shadow, sigma), dx, dy);
    if (!filter->only)
        lay_over(&shadow, &drawn);
    free(drawn.pixels);
    return shadow;
}

// How far beyond what is seen things may lie that are seen through the filter.
static double margin_of(const List *list, uint32_t number, const cairo_matrix_t *m) {
    double margin = 2;
    for (; number != LIST_NONE; number = list->filters.at[number].input) {
        const ListFilter *filter = &list->filters.at[number];
        double dx = filter->offset[0], dy = filter->offset[1];
        cairo_matrix_transform_distance(m, &dx, &dy);
        margin += fmin(fmax(fabs(dx), fabs(dy)), 2000);
        margin += 3 * fmin(fmax(filter->radius[0] * scale_in(m, 0), filter->radius[1] * scale_in(m, 1)), WIDEST);
    }
    return ceil(margin);
}

static Sheet take_pixels(cairo_surface_t *surface, int width, int height) {
    cairo_surface_flush(surface);
    const uint32_t *from = (const uint32_t *)(const void *)cairo_image_surface_get_data(surface);
    Sheet sheet = {width, height, from ? malloc((size_t)width * (size_t)height * 4 * sizeof(float)) : NULL};
    for (size_t i = 0; sheet.pixels && i < (size_t)width * (size_t)height; i++)
        for (unsigned k = 0; k < 4; k++)
            sheet.pixels[4 * i + k] = (float)(from[i] >> (k < 3 ? 16 - 8 * k : 24) & 255);
    return sheet;
}

static void put_pixels(cairo_surface_t *surface, const Sheet *sheet) {
    uint32_t *to = (uint32_t *)(void *)cairo_image_surface_get_data(surface);
    for (size_t i = 0; to && sheet->pixels && i < (size_t)sheet->width * (size_t)sheet->height; i++) {
        uint32_t pixel = 0;
        for (unsigned k = 0; k < 4; k++)
            pixel |= (uint32_t)lrintf(fminf(fmaxf(sheet->pixels[4 * i + k], 0), 255)) << (k < 3 ? 16 - 8 * k : 24);
        to[i] = pixel;
    }
    cairo_surface_mark_dirty(surface);
}

// Draws the command by itself on a surface whose top left corner is at x, y of the target.
static void draw_apart(Canvas *canvas, const ListCommand *command, const ListPaint *paint, cairo_surface_t *surface,
                       double x, double y) {
    cairo_matrix_t matrix;
    cairo_t *target = canvas->cr;
    cairo_get_matrix(target, &matrix);
    cairo_surface_set_device_offset(surface, -x, -y);
    canvas->cr = cairo_create(surface);
    cairo_set_tolerance(canvas->cr, cairo_get_tolerance(target));
    cairo_set_matrix(canvas->cr, &matrix);
    ListPaint plain = *paint;
    plain.filter = LIST_NONE;
    plain.composite = COMPOSITE_OVER;
    canvas->path_of = NULL;
    draw_plainly(canvas, command, &plain);
    cairo_destroy(canvas->cr);
    canvas->cr = target;
    draw_forget_path(canvas);
}

void draw_filtered(Canvas *canvas, const ListCommand *command, const ListPaint *paint) {
    cairo_t *cr = canvas->cr;
    cairo_matrix_t matrix;
    double x1, y1, x2, y2;
    cairo_get_matrix(cr, &matrix);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_clip_extents(cr, &x1, &y1, &x2, &y2);
    cairo_restore(cr);
    double margin = margin_of(canvas->list, paint->filter, &matrix), x = floor(x1) - margin, y = floor(y1) - margin;
    double width = ceil(x2) + margin - x, height = ceil(y2) + margin - y;
    if (x2 <= x1 || y2 <= y1 || width * height > MOST_SHEET)
        return;
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, (int)width, (int)height);
    draw_apart(canvas, command, paint, surface, x, y);
    Sheet sheet = apply(canvas->list, paint->filter, &matrix, take_pixels(surface, (int)width, (int)height));
    put_pixels(surface, &sheet);
    bool lost = !sheet.pixels;
    free(sheet.pixels);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_set_source_surface(cr, surface, 0, 0); // it knows where it lies
    cairo_set_operator(cr, draw_operator(paint->composite));
    cairo_paint(cr);
    cairo_restore(cr);
    cairo_surface_destroy(surface);
    if (lost)
        arena_exhausted(&canvas->painter->arena);
}
