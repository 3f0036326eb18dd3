// filters.c: what is drawn through a filter (spec canvas.md 6): drawn on a transparent sheet, which is then changed.
#include "draw/sheets.h"

#include "draw/light.h"

#include <math.h>

enum { MOST_SHEET = 1 << 26 };       // pixels
static const double FARTHEST = 2000; // that something is moved, pixels

// Where filters are applied.
typedef struct Room {
    Canvas *canvas;
    cairo_matrix_t matrix; // of what is drawn
    double x;              // of the sheets on the target
    double y;
    const Sheet *drawn;
} Room;

static double scale_in(const cairo_matrix_t *m, int axis) {
    return axis ? sqrt(m->xy * m->xy + m->yy * m->yy) : sqrt(m->xx * m->xx + m->yx * m->yx);
}

static void report_widest(Canvas *canvas, const ListFilter *filter, const double radius[2]) {
    if (fmax(radius[0], radius[1]) > SHEET_WIDEST)
        draw_fault_at(canvas, &filter->place, DIAG_WARNING, "blur-limit",
                      "!%s: a radius of more than %d pixels counts as one of so many",
                      filter->kind == FILTER_BLUR ? "blur" : "shadow", SHEET_WIDEST);
}

static Sheet apply(const Room *room, uint32_t number);

// A new sheet with the paint everywhere.
static Sheet paint_all(const Room *room, const ListPaint *paint) {
    Canvas *canvas = room->canvas;
    if (canvas->wide.pixels && paint->source == LIST_NONE) {
        Sheet plain = sheet_new(canvas, room->drawn->width, room->drawn->height);
        sheet_fill(&plain, paint->color);
        return plain;
    }
    cairo_surface_t *surface = draw_begin_apart(canvas, room->drawn->width, room->drawn->height, room->x, room->y);
    Sheet sheet = {0};
    if (!surface)
        return sheet;
    cairo_set_matrix(canvas->cr, &room->matrix);
    draw_set_source(canvas, paint);
    cairo_paint(canvas->cr);
    sheet = sheet_take(canvas, surface);
    draw_end_apart(canvas);
    return sheet;
}

static Sheet cast_shadow(const Room *room, const ListFilter *filter, Sheet drawn, const double sigma[2], double dx,
                         double dy) {
    Canvas *canvas = room->canvas;
    Sheet shadow = sheet_copy(canvas, &drawn);
    sheet_shade(&shadow, filter->color);
    sheet_blur(canvas, &shadow, sigma);
    sheet_move(canvas, &shadow, dx, dy);
    if (!filter->only)
        sheet_lay_over(&shadow, &drawn);
    sheet_free(canvas, &drawn);
    return shadow;
}

// A new sheet.
static Sheet apply(const Room *room, uint32_t number) {
    Canvas *canvas = room->canvas;
    if (number == LIST_NONE)
        return sheet_copy(canvas, room->drawn);
    const List *list = canvas->list;
    const ListFilter *filter = &list->filters.at[number];
    const double *numbers = filter->numbers == LIST_NONE ? NULL : list->numbers.at + filter->numbers;
    double dx = filter->offset[0], dy = filter->offset[1];
    double radius[2] = {filter->radius[0] * scale_in(&room->matrix, 0), filter->radius[1] * scale_in(&room->matrix, 1)};
    cairo_matrix_transform_distance(&room->matrix, &dx, &dy);
    if (filter->kind == FILTER_PAINT)
        return paint_all(room, &list->paints.at[filter->paint]);
    Sheet sheet = apply(room, filter->inputs[0]), other;
    switch (filter->kind) {
    case FILTER_BLUR:
        report_widest(canvas, filter, radius);
        sheet_blur(canvas, &sheet, radius);
        break;
    case FILTER_SHADOW:
        report_widest(canvas, filter, radius);
        return cast_shadow(room, filter, sheet, radius, dx, dy);
    case FILTER_OFFSET:
        sheet_move(canvas, &sheet, dx, dy);
        break;
    case FILTER_DILATE:
    case FILTER_ERODE:
        sheet_spread(canvas, &sheet, radius, filter->kind == FILTER_ERODE);
        break;
    case FILTER_MATRIX:
        sheet_recolor(&sheet, numbers);
        break;
    case FILTER_BLEND:
        other = apply(room, filter->inputs[1]);
        sheet_combine(&sheet, &other, numbers, (CompositeMode)filter->mode);
        if (!other.pixels)
            sheet_free(canvas, &sheet);
        sheet_free(canvas, &other);
        break;
    default:
        break;
    }
    return sheet;
}

// What a filter asks for.
typedef struct Needs {
    double margin;   // how far beyond what is seen things may lie that are seen through it, and its traces
    double work;     // for each pixel
    bool everywhere; // it changes what is transparent
} Needs;

static void add_needs(const List *list, uint32_t number, const cairo_matrix_t *m, Needs *needs) {
    if (number == LIST_NONE)
        return;
    const ListFilter *filter = &list->filters.at[number];
    const double *numbers = filter->numbers == LIST_NONE ? NULL : list->numbers.at + filter->numbers;
    double dx = filter->offset[0], dy = filter->offset[1];
    double radius = fmax(filter->radius[0] * scale_in(m, 0), filter->radius[1] * scale_in(m, 1));
    bool blurs = filter->kind == FILTER_BLUR || filter->kind == FILTER_SHADOW;
    cairo_matrix_transform_distance(m, &dx, &dy);
    needs->margin += fmin(fmax(fabs(dx), fabs(dy)), FARTHEST);
    needs->margin += blurs ? 3 * fmin(radius, SHEET_WIDEST) : fmin(radius, FARTHEST);
    needs->work += blurs ? 20 + 4 * fmin(radius, 16) : 20;
    needs->everywhere |= filter->kind == FILTER_PAINT || (filter->kind == FILTER_MATRIX && numbers[19] != 0) ||
                         (filter->kind == FILTER_BLEND && numbers && numbers[3] != 0);
    add_needs(list, filter->inputs[0], m, needs);
    add_needs(list, filter->inputs[1], m, needs);
}

typedef struct Box {
    double x;
    double y;
    double width;
    double height;
} Box;

// What of the target the sheet covers: where the figure is, if that is known, and where one can see.
static bool find_box(Canvas *canvas, const ListCommand *command, const ListPaint *paint, const Needs *needs, Box *box) {
    cairo_t *cr = canvas->cr;
    double seen[4], figure[4], margin = ceil(needs->margin + 2);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_clip_extents(cr, &seen[0], &seen[1], &seen[2], &seen[3]);
    cairo_restore(cr);
    if (seen[2] <= seen[0] || seen[3] <= seen[1])
        return false;
    bool known = command->kind == LIST_DRAW && !needs->everywhere;
    if (known) {
        draw_set_path(canvas, command);
        known = draw_find_box(canvas, command, paint, figure);
    }
    for (int k = 0; k < 2; k++) {
        double low = known ? fmax(seen[k], figure[k]) : seen[k];
        double high = known ? fmin(seen[2 + k], figure[2 + k]) : seen[2 + k];
        // What lies outside may come in, and what is inside may go as far.
        if (known && (figure[k] - margin >= seen[2 + k] || figure[2 + k] + margin <= seen[k]))
            return false;
        low = known ? fmax(seen[k] - margin, figure[k] - margin) : low - margin;
        high = known ? fmin(seen[2 + k] + margin, figure[2 + k] + margin) : high + margin;
        *(k ? &box->y : &box->x) = floor(low);
        *(k ? &box->height : &box->width) = ceil(high) - floor(low);
    }
    return box->width >= 1 && box->height >= 1;
}

// May the picture go through the filter? If not, it is told.
static bool may_filter(Canvas *canvas, const ListFilter *filter, const Box *box, const Needs *needs) {
    double pixels = box->width * box->height, work = pixels <= MOST_SHEET ? pixels * needs->work : INFINITY;
    return draw_spend(canvas, &filter->place, work, "what comes here is drawn without a filter");
}

// The command drawn by itself, as a sheet.
static Sheet draw_apart(Canvas *canvas, const ListCommand *command, const ListPaint *paint, const Box *box) {
    cairo_matrix_t matrix;
    cairo_get_matrix(canvas->cr, &matrix);
    cairo_surface_t *surface = draw_begin_apart(canvas, (int)box->width, (int)box->height, box->x, box->y);
    Sheet sheet = {0};
    if (!surface)
        return sheet;
    cairo_set_matrix(canvas->cr, &matrix);
    ListPaint plain = *paint;
    plain.filter = LIST_NONE;
    plain.composite = COMPOSITE_OVER;
    if (canvas->outer_wide.pixels) {
        sheet = canvas->wide = sheet_new(canvas, (int)box->width, (int)box->height);
        canvas->wide.x = (int)box->x;
        canvas->wide.y = (int)box->y;
    }
    if (!canvas->outer_wide.pixels || sheet.pixels)
        draw_plainly(canvas, command, &plain);
    if (!canvas->outer_wide.pixels)
        sheet = sheet_take(canvas, surface);
    draw_end_apart(canvas);
    return sheet;
}

// Lays what came out over the target.
static void lay(Canvas *canvas, const Sheet *sheet, const Box *box, int composite) {
    cairo_t *cr = canvas->cr;
    if (canvas->wide.pixels) {
        light_lay(canvas, sheet, box->x, box->y, composite);
        return;
    }
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, sheet->width, sheet->height);
    sheet_put(sheet, surface);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_set_source_surface(cr, surface, box->x, box->y);
    cairo_set_operator(cr, draw_operator(composite));
    cairo_paint(cr);
    cairo_restore(cr);
    cairo_surface_destroy(surface);
}

void draw_filtered(Canvas *canvas, const ListCommand *command, const ListPaint *paint) {
    Room room = {.canvas = canvas};
    Needs needs = {0};
    Box box;
    cairo_get_matrix(canvas->cr, &room.matrix);
    add_needs(canvas->list, paint->filter, &room.matrix, &needs);
    if (!find_box(canvas, command, paint, &needs, &box))
        return;
    const ListFilter *filter = &canvas->list->filters.at[paint->filter];
    Sheet result = {0};
    if (may_filter(canvas, filter, &box, &needs)) {
        Sheet drawn = draw_apart(canvas, command, paint, &box);
        room.x = box.x;
        room.y = box.y;
        room.drawn = &drawn;
        if (drawn.pixels)
            result = apply(&room, paint->filter);
        sheet_free(canvas, &drawn);
        draw_lacks(canvas, &filter->place, "a filter", result.pixels == NULL);
    }
    if (result.pixels)
        lay(canvas, &result, &box, paint->composite);
    else
        draw_plainly(canvas, command, paint);
    sheet_free(canvas, &result);
}
