// script_pictures.c: gives the scripts of a session access to fonts and to the pictures that a painter has rendered.
#include "builtin/pictures.h"
#include "gl/functions.h"
#include "picture/painter.h"
#include "session/draw_access.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Copies the picture from the GPU if necessary. Returns false if the memory limit does not allow this.
static bool download(PetriPainter *painter, Texture *texture) {
    const char *problem;
    if (texture->bytes || texture->linear)
        return true;
    if (!painter->gl || !gl_call.enter(painter->gl, &problem))
        return false;
    bool good = texture_download(painter->gl, texture);
    gl_call.leave(painter->gl);
    return good;
}

// Reads a word or, for the weight, a number. An empty word leaves the default in *value.
static bool read_word(AttrType type, Str word, double *value) {
    int found;
    char text[32], *end;
    if (word.len == 0)
        return true;
    if (schema_find_word(type, word, &found)) {
        *value = found;
        return true;
    }
    if (type != TYPE_WEIGHT || word.len >= sizeof text)
        return false;
    memcpy(text, word.bytes, word.len);
    text[word.len] = 0;
    *value = strtod(text, &end);
    return *end == 0 && *value >= 0 && *value <= 1000;
}

// Reads the style of a text. Returns NULL, or the reason if an argument is not valid.
static const char *read_style(const BuiltinText *text, TextStyle *out) {
    const double default_size = 20;
    double weight = 400, width = 4, slant = SLANT_UPRIGHT;
    Str list =
        text->family.len > 0 ? text->family : str_from(schema_row(KIND_CANVAS, ATTR_FONT_FAMILY)->default_value.string);
    if (!read_word(TYPE_WEIGHT, text->weight, &weight))
        return "weight should be 0 to 1000, or a word such as :bold";
    if (!read_word(TYPE_FONT_WIDTH, text->width, &width))
        return "width should be a word such as :condensed";
    if (!read_word(TYPE_SLANT, text->slant, &slant))
        return "slant should be :upright, :oblique or :italic";
    if (text->text.len > MAX_TEXT_LENGTH || list.len >= sizeof out->family)
        return "text longer than 10000 bytes, or family longer than 999";
    *out = (TextStyle){.size = isnan(text->size) ? default_size : text->size,
                       .weight = weight,
                       .width = (int)width,
                       .slant = (int)slant};
    memcpy(out->family, list.bytes, list.len);
    return out->size > MAX_FONT_SIZE ? "size should be at most 4000" : NULL;
}

// A BuiltinPictures.measure. `user_data` is the painter.
static const char *measure_text(void *user_data, const BuiltinText *text, double *width, bool *loaded) {
    PetriPainter *painter = user_data;
    TextStyle style;
    const char *problem = read_style(text, &style);
    if (problem)
        return problem;
    return painter->backend->measure_text ? painter->backend->measure_text(painter, text->text, &style, width, loaded)
                                          : "not supported: there are no fonts";
}

// A BuiltinPictures.find. `user_data` is the painter.
static bool find_picture(void *user_data, Str id, BuiltinPicture *picture) {
    PetriPainter *painter = user_data;
    if (painter->rendered == 0 || painter->rendered_frame != petri_frame_number(painter->served) - 1)
        return false;
    Texture *texture = render_graph_find(painter->render_graph, id);
    if (id.len == 0 || !texture || !download(painter, texture))
        return false;
    *picture = (BuiltinPicture){.width = texture->width, .height = texture->height};
    if (texture->linear)
        picture->linear = texture->linear;
    else
        picture->bytes = texture->bytes;
    return true;
}

PetriStatus petri_painter_serve(PetriPainter *painter, PetriSession *session) {
    if (!session)
        return PETRI_INVALID;
    if (painter) {
        painter->served = session;
        painter->pictures = (BuiltinPictures){.measure = measure_text, .find = find_picture, .user_data = painter};
    }
    session_set_pictures(session, painter ? &painter->pictures : NULL);
    return PETRI_OK;
}

bool petri_samples_pictures(PetriSession *session) {
    return session && session_draw_access(session).samples;
}
