// serve.c: gives the scripts of a session access to fonts and to the pictures that a painter has rendered.
#include "builtin/pictures.h"
#include "draw/painter.h"
#include "gl/functions.h"
#include "session/draw_access.h"

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

// A BuiltinPictures.find. `user_data` is the painter.
static bool find_picture(void *user_data, Str id, BuiltinPicture *picture) {
    PetriPainter *painter = user_data;
    if (painter->made == 0 || painter->made_frame != petri_frame_number(painter->served) - 1)
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
        painter->pictures = (BuiltinPictures){.measure = draw_measure_text, .find = find_picture, .user_data = painter};
    }
    session_set_pictures(session, painter ? &painter->pictures : NULL);
    return PETRI_OK;
}

bool petri_samples_pictures(PetriSession *session) {
    return session && session_draw_access(session).samples;
}
