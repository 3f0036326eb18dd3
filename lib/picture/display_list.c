// display_list.c: arrays, matrices, strings and notes of display lists, and the reader; see display_list.h.
#include "picture/display_list_write.h"

#include <math.h>

void *display_list_grow(Arena *arena, void *items, uint32_t count, uint32_t *capacity, uint32_t more, size_t size) {
    enum { MIN_SIZE = 16 };
    if (more <= *capacity - count)
        return items;
    if (more > UINT32_MAX / 4 - count)
        arena_exhausted(arena);
    uint32_t wanted = *capacity ? 2 * *capacity : MIN_SIZE;
    wanted = wanted < count + more ? count + more : wanted;
    void *grown = arena_grow(arena, items, *capacity * size, wanted * size);
    *capacity = wanted;
    return grown;
}

DisplayMatrix display_matrix_multiply(DisplayMatrix m, DisplayMatrix a) {
    return (DisplayMatrix){.xx = m.xx * a.xx + m.xy * a.yx,
                           .yx = m.yx * a.xx + m.yy * a.yx,
                           .xy = m.xx * a.xy + m.xy * a.yy,
                           .yy = m.yx * a.xy + m.yy * a.yy,
                           .x0 = m.xx * a.x0 + m.xy * a.y0 + m.x0,
                           .y0 = m.yx * a.x0 + m.yy * a.y0 + m.y0};
}

bool display_matrix_is_invertible(const DisplayMatrix *m) {
    double determinant = m->xx * m->yy - m->xy * m->yx;
    return isfinite(determinant) && determinant != 0 && isfinite(m->x0) && isfinite(m->y0);
}

void display_list_begin(DisplayList *list, double width, double height) {
    display_list_add(list, (const double[DISPLAY_HEADER]){width, height, false}, DISPLAY_HEADER);
}

void display_list_add_string(DisplayList *list, Str text) {
    uint32_t start = display_list_open(list);
    for (size_t at = 0; at < text.len;)
        display_list_add_number(list, utf8_next(text, &at));
    display_list_close(list, start);
}

// Adds the pixels of a picture. NULL means an empty picture.
void display_list_add_pixels(DisplayList *list, Texture *texture) {
    if (!texture) {
        display_list_add(list, (const double[]){0, 0}, 2);
        return;
    }
    uint32_t *row = arena_alloc_array(list->arena, (size_t)texture->width, sizeof *row);
    display_list_add(list, (const double[]){texture->width, texture->height}, 2);
    for (int y = 0; y < texture->height; y++) {
        if (list->linear)
            texture_linear_row(texture, y, row);
        else
            texture_row(texture, y, false, row);
        double *to = DISPLAY_ADD(list->arena, list->numbers, (uint32_t)texture->width);
        for (int x = 0; x < texture->width; x++)
            to[x] = row[x];
    }
}

void display_list_add_note(DisplayList *list, Origin place, Str id) {
    *DISPLAY_ADD(list->arena, list->notes, 1) = (DisplayNote){list->numbers.count, place, id};
}

DisplayNote display_list_note(const DisplayList *list, const double *at) {
    uint32_t low = 0, high = list->notes.count, wanted = (uint32_t)(at - list->numbers.at);
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (list->notes.at[middle].at < wanted)
            low = middle + 1;
        else
            high = middle;
    }
    return low < list->notes.count && list->notes.at[low].at == wanted ? list->notes.at[low]
                                                                       : (DisplayNote){.at = wanted};
}

static const double *take(DisplayReader *reader, size_t count) {
    static const double zeros[20] = {0};
    if (reader->left < count) {
        reader->failed = true;
        return zeros;
    }
    reader->at += count;
    reader->left -= count;
    return reader->at - count;
}

// Returns a length, which is 0 if it is not valid.
static uint32_t take_length(DisplayReader *reader) {
    double length = *take(reader, 1);
    bool valid = length >= 0 && length <= INT32_MAX;
    reader->failed |= !valid;
    return valid ? (uint32_t)length : 0;
}

static DisplayNumbers take_list(DisplayReader *reader) {
    uint32_t count = take_length(reader);
    return (DisplayNumbers){take(reader, count), count};
}

static DisplayStops take_stops(DisplayReader *reader) {
    uint32_t count = take_length(reader);
    return (DisplayStops){(const DisplayStop *)(const void *)take(reader, 5 * (size_t)count), count};
}

static const double *take_paint(DisplayReader *reader) {
    DisplayRow row;
    const double *start = reader->at;
    take(reader, (size_t)(display_list_read(start, &row) - start));
    return start;
}

#define ROW(name, operands)                                                                                            \
    static inline void read_##name(DisplayReader *reader, name##Operands *o) {                                         \
        (void)reader, (void)o;                                                                                         \
        operands                                                                                                       \
    }
#define NUMBER(name) o->name = *take(reader, 1);
#define NUMBERS(name, count) o->name = take(reader, count);
#define MATRIX(name) o->name = (const DisplayMatrix *)(const void *)take(reader, 6);
#define COLOUR(name) o->name = take(reader, 4);
#define STOPS(name) o->name = take_stops(reader);
#define LIST(name) o->name = take_list(reader);
#define STRING(name) o->name.points = take_list(reader);
#define PIXELS(name) o->name = (take(reader, 2), NULL); /* lists for this reader have no pixels */
#define PAINT(name) o->name = take_paint(reader);
#include "picture/display_list_macros.h"

const double *display_list_read(const double *at, DisplayRow *row) {
    DisplayReader reader = {.at = at + 1, .left = SIZE_MAX};
    row->MATRIX.at = at;
    switch (row->kind = (int)*at) {
#define COMMAND(name)                                                                                                  \
    case PETRI_DRAW_##name:                                                                                            \
        read_##name(&reader, &row->name);                                                                              \
        break;
#include "picture/display_list_macros.h"
    }
    return reader.at;
}

void display_list_read_filter(DisplayReader *reader, DisplayRow *filter) {
    double kind = *take(reader, 1);
    switch (filter->kind = kind >= 0 && kind < 100 ? (int)kind : -1) {
#define FILTER_KIND(name)                                                                                              \
    case PETRI_FILTER_##name:                                                                                          \
        read_FILTER_##name(reader, &filter->FILTER_##name);                                                            \
        break;
#include "picture/display_list_macros.h"
    default:
        reader->failed = true;
    }
}

void display_list_read_effect(DisplayReader *reader, DisplayRow *effect) {
    switch (effect->kind = (int)*take(reader, 1)) {
#define EFFECT_KIND(name)                                                                                              \
    case PETRI_EFFECT_##name:                                                                                          \
        read_EFFECT_##name(reader, &effect->EFFECT_##name);                                                            \
        break;
#include "picture/display_list_macros.h"
    }
}

bool display_list_set_paint(const DisplayRow *row, DisplayPaint *paint) {
    switch (row->kind) {
#define PETRI_PAINT(name, operands, text) case PETRI_DRAW_##name:
#include "petri-display-list.inc"
        paint->source = row->COLOR.at;
        return true;
    case PETRI_DRAW_STROKE_STYLE:
        *paint = (DisplayPaint){.source = paint->source, .style = row->STROKE_STYLE};
        return true;
    case PETRI_DRAW_FILTER:
        paint->filter = row->FILTER.filter;
        return true;
    case PETRI_DRAW_EFFECT:
        paint->effect = row->EFFECT.effect;
        return true;
    default:
        return false;
    }
}

double display_paint_alpha(const DisplayPaint *paint) {
    DisplayRow row;
    display_list_read(paint->source, &row);
    return fmin(fmax(row.kind == PETRI_DRAW_COLOR ? row.COLOR.colour[3] : row.SOLID.alpha, 0), 1);
}
