// sheets.c: see sheets.h.
#include "draw/sheets.h"

#include "base/heap.h"
#include "draw/blend.h"
#include "maths/maths.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct SheetMemory {
    SheetMemory *next;
    SheetMemory **link; // to this one
    size_t bytes;
    float pixels[];
};

static SheetMemory *memory_of(const Sheet *sheet) {
    return (SheetMemory *)(void *)((char *)sheet->pixels - offsetof(SheetMemory, pixels));
}

static size_t count_of(const Sheet *sheet) {
    return sheet->pixels ? (size_t)sheet->width * (size_t)sheet->height : 0;
}

Sheet sheet_new(Canvas *canvas, int width, int height) {
    size_t bytes = sizeof(SheetMemory) + (size_t)width * (size_t)height * 4 * sizeof(float);
    SheetMemory *memory = draw_take(canvas, bytes) ? heap_zeroed(1, bytes) : NULL;
    if (!memory)
        return (Sheet){.width = width, .height = height};
    memory->bytes = bytes;
    memory->next = canvas->sheets;
    memory->link = &canvas->sheets;
    if (memory->next)
        memory->next->link = &memory->next;
    canvas->sheets = memory;
    return (Sheet){.width = width, .height = height, .pixels = memory->pixels};
}

void sheet_free(Canvas *canvas, Sheet *sheet) {
    if (!sheet->pixels)
        return;
    SheetMemory *memory = memory_of(sheet);
    *memory->link = memory->next;
    if (memory->next)
        memory->next->link = memory->link;
    draw_give(canvas, memory->bytes);
    heap_give(memory);
    sheet->pixels = NULL;
}

void sheets_free_all(Canvas *canvas) {
    while (canvas->sheets)
        sheet_free(canvas, &(Sheet){.pixels = canvas->sheets->pixels});
}

Sheet sheet_copy(Canvas *canvas, const Sheet *sheet) {
    Sheet out = *sheet;
    if (sheet->pixels)
        out = sheet_new(canvas, sheet->width, sheet->height);
    if (out.pixels)
        memcpy(out.pixels, sheet->pixels, count_of(sheet) * 4 * sizeof(float));
    return out;
}

Sheet sheet_take(Canvas *canvas, cairo_surface_t *surface) {
    cairo_surface_flush(surface);
    const uint32_t *from = (const uint32_t *)(const void *)cairo_image_surface_get_data(surface);
    Sheet sheet = {0};
    if (from)
        sheet = sheet_new(canvas, cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
    for (size_t i = 0; i < count_of(&sheet); i++)
        for (unsigned k = 0; k < 4; k++)
            sheet.pixels[4 * i + k] = (float)(from[i] >> (k < 3 ? 16 - 8 * k : 24) & 255) / 255;
    return sheet;
}

void sheet_put(const Sheet *sheet, cairo_surface_t *surface) {
    uint32_t *to = (uint32_t *)(void *)cairo_image_surface_get_data(surface);
    for (size_t i = 0; to && i < count_of(sheet); i++) {
        uint32_t pixel = 0;
        for (unsigned k = 0; k < 4; k++)
            pixel |= (uint32_t)lrintf(255 * fminf(fmaxf(sheet->pixels[4 * i + k], 0), 1)) << (k < 3 ? 16 - 8 * k : 24);
        to[i] = pixel;
    }
    cairo_surface_mark_dirty(surface);
}

// How a row or column of pixels becomes another.
enum { REACH_MOST = 24 };
static const double WIDEST_EXACT = 8; // standard deviation, pixels

typedef struct Lines {
    void (*change)(const struct Lines *how, float *line, float *other, int count);
    int reach;
    bool least;
    int cell; // pixels that are taken together
    float weights[REACH_MOST + 1];
} Lines;

// Changes all rows or all columns.
static void change_lines(Canvas *canvas, Sheet *sheet, int axis, const Lines *how) {
    int count = axis ? sheet->height : sheet->width, lines = axis ? sheet->width : sheet->height;
    size_t step = axis ? 4 * (size_t)sheet->width : 4, between = axis ? 4 : 4 * (size_t)sheet->width;
    if (!sheet->pixels)
        return;
    Sheet room = sheet_new(canvas, count + 2 * how->reach + 8, 2);
    if (!room.pixels) {
        sheet_free(canvas, sheet);
        return;
    }
    float *line = room.pixels, *other = line + 4 * (size_t)room.width;
    for (int i = 0; i < lines; i++) {
        float *at = sheet->pixels + (size_t)i * between;
        for (int k = 0; k < count; k++)
            memcpy(line + 4 * (size_t)k, at + (size_t)k * step, 4 * sizeof(float));
        how->change(how, line, other, count);
        for (int k = 0; k < count; k++)
            memcpy(at + (size_t)k * step, line + 4 * (size_t)k, 4 * sizeof(float));
    }
    sheet_free(canvas, &room);
}

// What neighbours up to a reach give, with their weights; there is nothing beyond the ends.
static void weigh_at(const Lines *how, const float *from, int count, int at, float *to) {
    float sum[4] = {0, 0, 0, 0};
    int first = at - how->reach < 0 ? 0 : at - how->reach,
        last = at + how->reach >= count ? count - 1 : at + how->reach;
    for (int j = first; j <= last; j++)
        for (int k = 0; k < 4; k++)
            sum[k] += how->weights[abs(at - j)] * from[4 * j + k];
    memcpy(to, sum, sizeof sum);
}

static void weigh(const Lines *how, float *line, float *other, int count) {
    memcpy(other, line, (size_t)count * 4 * sizeof(float));
    for (int i = 0; i < count; i++)
        weigh_at(how, other, count, i, line + 4 * (size_t)i);
}

// The same for a wide reach: cells of several pixels are weighed, and pixels lie between the middles of cells.
static void weigh_cells(const Lines *how, float *line, float *other, int count) {
    int cell = how->cell, cells = (count + cell - 1) / cell;
    float *weighed = other + 4 * (size_t)cells + 4; // of cells from -1 on
    memset(other, 0, (size_t)cells * 4 * sizeof(float));
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 4; k++)
            other[4 * (i / cell) + k] += line[4 * i + k] / (float)cell;
    for (int i = -1; i <= cells; i++)
        weigh_at(how, other, cells, i, weighed + 4 * (ptrdiff_t)i);
    for (int i = 0; i < count; i++) {
        double at = (i - (cell - 1) / 2.0) / cell;
        int low = (int)floor(at);
        float share = (float)(at - low);
        for (int k = 0; k < 4; k++)
            line[4 * i + k] = (1 - share) * weighed[4 * low + k] + share * weighed[4 * (low + 1) + k];
    }
}

// The greatest or least within reach: of more and more pixels, then of two such runs.
static void find_extremes(const Lines *how, float *line, float *other, int count) {
    int reach = how->reach, all = count + 2 * reach, run = 1, wanted = 2 * reach + 1;
    memset(other, 0, (size_t)all * 4 * sizeof(float));
    memcpy(other + 4 * (size_t)reach, line, (size_t)count * 4 * sizeof(float));
    for (; 2 * run <= wanted; run *= 2)
        for (int i = 0; i + run < all; i++)
            for (int k = 0; k < 4; k++) {
                float a = other[4 * i + k], b = other[4 * (i + run) + k];
                other[4 * i + k] = how->least == (a < b) ? a : b;
            }
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 4; k++) {
            float a = other[4 * i + k], b = other[4 * (i + wanted - run) + k];
            line[4 * i + k] = how->least == (a < b) ? a : b;
        }
}

// Averages of cells and lines between them are blurs, too: of (cell² − 1)/12 and twice that, as variances add up.
static void set_weights(Lines *how, double sigma) {
    double sum = 0, cell = sigma > WIDEST_EXACT ? floor(sigma / 4) : 1;
    how->cell = (int)cell;
    how->change = how->cell > 1 ? weigh_cells : weigh;
    sigma = sqrt(sigma * sigma - (cell * cell - 1) / 4) / cell;
    how->reach = (int)ceil(3 * sigma);
    for (int i = 0; i <= how->reach; i++)
        sum += (i ? 2 : 1) * maths_exp(-0.5 * i * i / (sigma * sigma));
    for (int i = 0; i <= how->reach; i++)
        how->weights[i] = (float)(maths_exp(-0.5 * i * i / (sigma * sigma)) / sum);
}

void sheet_blur(Canvas *canvas, Sheet *sheet, const double sigma[2]) {
    for (int axis = 0; axis < 2; axis++) {
        Lines how;
        if (!(sigma[axis] > 0.05))
            continue;
        set_weights(&how, fmin(sigma[axis], SHEET_WIDEST));
        change_lines(canvas, sheet, axis, &how);
    }
}

void sheet_spread(Canvas *canvas, Sheet *sheet, const double radius[2], bool least) {
    for (int axis = 0; axis < 2; axis++) {
        double most = axis ? sheet->height : sheet->width;
        Lines how = {.change = find_extremes, .least = least, .reach = (int)fmin(rint(radius[axis]), most)};
        if (how.reach > 0)
            change_lines(canvas, sheet, axis, &how);
    }
}

void sheet_move(Canvas *canvas, Sheet *sheet, double dx, double dy) {
    if (!sheet->pixels)
        return;
    Sheet out = sheet_new(canvas, sheet->width, sheet->height);
    int x0 = (int)fmin(fmax(rint(dx), -sheet->width), sheet->width);
    int y0 = (int)fmin(fmax(rint(dy), -sheet->height), sheet->height);
    int first = x0 > 0 ? x0 : 0, last = x0 > 0 ? sheet->width : sheet->width + x0;
    for (int y = 0; out.pixels && y < sheet->height; y++)
        if (y - y0 >= 0 && y - y0 < sheet->height && last > first)
            memcpy(out.pixels + 4 * ((size_t)y * (size_t)out.width + (size_t)first),
                   sheet->pixels + 4 * ((size_t)(y - y0) * (size_t)out.width + (size_t)(first - x0)),
                   (size_t)(last - first) * 4 * sizeof(float));
    sheet_free(canvas, sheet);
    *sheet = out;
}

void sheet_shade(Sheet *sheet, const double color[4]) {
    for (size_t i = 0; i < count_of(sheet); i++) {
        float *pixel = sheet->pixels + 4 * i, alpha = pixel[3] * (float)color[3];
        for (int k = 0; k < 3; k++)
            pixel[k] = alpha * (float)color[k];
        pixel[3] = alpha;
    }
}

void sheet_lay_over(Sheet *below, const Sheet *above) {
    for (size_t i = 0; above->pixels && i < 4 * count_of(below); i++)
        below->pixels[i] = above->pixels[i] + below->pixels[i] * (1 - above->pixels[i | 3]);
}

void sheet_fill(Sheet *sheet, const double color[4]) {
    for (size_t i = 0; i < 4 * count_of(sheet); i++)
        sheet->pixels[i] = (float)(i % 4 == 3 ? color[3] : color[3] * color[i % 4]);
}

static float within(float x, float most) {
    return fminf(fmaxf(x, 0), most);
}

void sheet_recolor(Sheet *sheet, const double *matrix) {
    for (size_t i = 0; i < count_of(sheet); i++) {
        float *pixel = sheet->pixels + 4 * i, plain[5], out[4];
        for (int k = 0; k < 4; k++)
            plain[k] = k == 3 ? pixel[3] : pixel[3] > 0 ? pixel[k] / pixel[3] : 0;
        plain[4] = 1;
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 5; k++)
                sum += matrix[5 * row + k] * (double)plain[k];
            out[row] = within((float)sum, 1);
        }
        for (int k = 0; k < 4; k++)
            pixel[k] = k < 3 ? out[k] * out[3] : out[3];
    }
}

void sheet_combine(Sheet *d, const Sheet *s, const double *k, CompositeMode mode) {
    for (size_t i = 0; s->pixels && i < count_of(d); i++) {
        const float *above = s->pixels + 4 * i;
        float *below = d->pixels + 4 * i;
        if (!k)
            blend_colors(mode, above, below, below);
        for (int c = 0; k && c < 4; c++)
            below[c] = (float)(k[0] * (double)(above[c] * below[c]) + k[1] * (double)above[c] +
                               k[2] * (double)below[c] + k[3]);
        below[3] = within(below[3], 1);
        for (int c = 0; c < 3; c++)
            below[c] = within(below[c], below[3]);
    }
}
