// pictures.c: the size of texts and the colours of rendered pictures (spec builtins.md B14).
#include "builtin/pictures.h"

#include "builtin/family.h"

#include <math.h>

// Work units: for each text, for each byte of a text, for a font, and for each point of a picture.
enum { TEXT_WORK = 1000, BYTE_WORK = 50, FONT_WORK = 150000, POINT_WORK = 4 };

static Str text_or_none(BuiltinContext *context, Value v) {
    return is_absent(v) ? STR("") : value_text(context->arena, context->symbols, v);
}

Value builtin_measure_text(BuiltinContext *context, const Value *args, uint32_t count) {
    double width = 0;
    bool loaded = false;
    if (!context->pictures)
        return builtin_error(context, "measure_text", "not supported: only render and view have fonts");
    BuiltinText text = {.text = text_or_none(context, args[0]),
                        .family = text_or_none(context, args[1]),
                        .size = NAN,
                        .weight = text_or_none(context, args[3]),
                        .width = text_or_none(context, args[4]),
                        .slant = text_or_none(context, args[5])};
    if (!is_absent(args[2]) && args[2].len > 0) {
        if (!is_numeric_of(args[2], 1) || !(args[2].as.number >= 0) || isinf(args[2].as.number))
            return builtin_error(context, "measure_text", "size should be a number that is not negative");
        text.size = args[2].as.number;
    }
    arena_charge(context->arena, TEXT_WORK + (uint64_t)BYTE_WORK * text.text.len);
    const char *problem = context->pictures->measure(context->pictures->user_data, &text, &width, &loaded);
    arena_charge(context->arena, loaded ? FONT_WORK : 0);
    return problem ? builtin_error(context, "measure_text", "%s", problem) : value_number(width);
}

// Returns the index of the pixel at a coordinate from 0 to 1. Returns -1 if it is outside. As in the reference, the
// product is rounded toward 0, so coordinates between -1/size and 0 are inside.
static int pixel_index(double coordinate, int size) {
    double at = trunc(coordinate * size);
    return at >= 0 && at < size ? (int)at : -1;
}

static void read_pixel(const BuiltinPicture *picture, int x, int y, double *color) {
    size_t at = (size_t)y * (size_t)picture->width + (size_t)x;
    for (unsigned k = 0; k < 4; k++) {
        unsigned shift = k < 3 ? 16 - 8 * k : 24;
        color[k] = picture->linear ? (double)picture->linear[4 * at + k]
                                   : (double)(float)((float)(picture->bytes[at] >> shift & 255) / 255.0f);
    }
}

Value builtin_sample(BuiltinContext *context, const Value *args, uint32_t count) {
    Value other = value_or(args[2], VALUE_NULL);
    BuiltinPicture picture;
    if (!context->pictures)
        return other;
    context->pictures->samples = true;
    Str id = value_text(context->arena, context->symbols, args[0]);
    Value coord = args[1];
    if (coord.kind != VALUE_NUMBERS || !context->pictures->find(context->pictures->user_data, id, &picture))
        return other;
    uint32_t points = coord.len / 2;
    if (points == 0)
        return VALUE_NULL;
    const double *at = value_numbers(&coord);
    if (points > VALUE_MAX_LEN / 4)
        return builtin_too_long(context, "sample");
    double *colors = arena_alloc_array(context->arena, (size_t)points * 4, sizeof *colors);
    for (uint32_t i = 0; i < points; i++) {
        arena_charge_chunk(context->arena, i, POINT_WORK);
        int x = pixel_index(at[2 * i], picture.width), y = pixel_index(at[2 * i + 1], picture.height);
        bool inside = x >= 0 && y >= 0;
        if (!inside && points == 1)
            return other;
        if (inside)
            read_pixel(&picture, x, picture.height - 1 - y, colors + 4 * (size_t)i);
        for (uint32_t k = 0; k < 4 && !inside; k++)
            colors[4 * (size_t)i + k] = is_numeric_of(other, 4) ? value_numbers(&other)[k] : 0;
    }
    return builtin_numbers(context->arena, colors, points * 4);
}
