// petri-draw.h: the public interface of libpetri-draw, which draws what the frames of a libpetri session show. It takes
// Cairo, Pango and libjpeg; libpetri does without it. The rules of petri.h hold here, too.
//
// petri_picture copies what the last frame shows: the tree of a `!window` or `!offscreen`, or the data of the
// automatic picture. The copy is independent of the session, so it can be drawn by another thread while the session
// steps on. A painter keeps fonts and images between pictures. A picture and a painter are each used by one thread at a
// time; a painter outlives nothing and may be closed before or after its pictures.
#ifndef PETRI_DRAW_H
#define PETRI_DRAW_H

#include "petri.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct PetriPicture PetriPicture;
typedef struct PetriPainter PetriPainter;

// The automatic picture shows the particle systems themselves.
typedef enum PetriAutomatic {
    PETRI_AUTO_IF_NEEDED, // where the script has physics but no window with a canvas
    PETRI_AUTO_ALWAYS,
    PETRI_AUTO_NEVER,
} PetriAutomatic;

typedef struct PetriPictureOptions {
    size_t size; // of the struct that the host was compiled with: petri_default_picture_options sets it
    int width;   // in pixels; 0, 0: what the script says. Otherwise the drawing is scaled to fit, and centred
    int height;
    double scale; // pixels for each unit of the script's size. Default 1
    int window;   // which of the frame's windows, from 0; -1 (the default): the first that has something to draw
    PetriAutomatic automatic;
    double detail; // pixels for each unit with which effects and scenes are drawn, above 0 to 1 (the default). Less is
                   // faster and coarser, for previews; pictures that look back and scripts' own shaders ignore it
} PetriPictureOptions;

// Writes the defaults of the first `size` bytes of options.
PETRI_API void petri_picture_options_init(PetriPictureOptions *options, size_t size);
static inline PetriPictureOptions petri_default_picture_options(void) {
    PetriPictureOptions options;
    petri_picture_options_init(&options, sizeof options);
    return options;
}

enum { PETRI_MAX_PICTURE_SIDE = 16384 }; // the largest width and height of a picture

// Whether the picture of the last frame shows particles where they are. A system stores nothing in frame 0, and what it
// stores is seen by the frame after; so a script that draws what its systems have stored finds nothing in frames 0 and
// 1, and hosts show pictures from frame 2 on. True in frame 0 of a script without systems, of automatic pictures and of
// a state that was restored, and in each frame from 2 on, whatever systems do then.
PETRI_API bool petri_picture_ready(PetriSession *session, const PetriPictureOptions *options);
// Whether the pictures of the last frame depend on those of the frames before, or are written by a `!record` once for
// each name: pictures of all frames must then be made by one painter, in their order, even of those that nobody looks
// at (petri_picture_render).
PETRI_API bool petri_needs_history(PetriSession *session);

// Extends what the automatic picture shows of space, if it is the picture of the last frame, so that it has that
// frame's particles. petri_picture does it by itself; if it is not called for all frames, call this for the others,
// after each step from frame 0: then a picture of frame N does not depend on which frames were drawn before. petri_load
// and petri_reset forget it.
PETRI_API void petri_picture_follow(PetriSession *session, const PetriPictureOptions *options);

// The picture of the last frame in *picture, for the caller to free. PETRI_INVALID (with a diagnostic) if nothing is
// loaded or there is nothing to draw, if the size makes no sense or the options were not initialised;
// PETRI_OUT_OF_MEMORY. *picture is then NULL.
PETRI_API PetriStatus petri_picture(PetriSession *session, const PetriPictureOptions *options, PetriPicture **picture);
// Frees a picture and sets the handle to NULL. NULL is fine.
PETRI_API void petri_picture_free(PetriPicture **picture);
// Its size in pixels.
PETRI_API void petri_picture_size(const PetriPicture *picture, int *width, int *height);
// The title of its window, or "". Valid as long as the picture.
PETRI_API const char *petri_picture_title(const PetriPicture *picture);
// The number of the frame that it shows.
PETRI_API int64_t petri_picture_frame(const PetriPicture *picture);
// What petri_needs_history said of its frame.
PETRI_API bool petri_picture_needs_history(const PetriPicture *picture);

// A painter, which lives until petri_painter_close, or NULL if memory is used up.
PETRI_API PetriPainter *petri_painter_open(void);
PETRI_API void petri_painter_close(PetriPainter **painter);

// Makes the pictures of all nodes of the frame, canvases and effects, unless this painter has just done so. Drawing and
// saving do it by themselves. PETRI_OK, PETRI_UNSUPPORTED without Cairo, PETRI_OUT_OF_MEMORY, PETRI_INVALID with a
// diagnostic.
PETRI_API PetriStatus petri_picture_render(PetriPicture *picture, PetriPainter *painter);

// What a `!record` node writes.
typedef struct PetriRecord {
    const char *file; // with the script's folder before it
    bool denied; // the script may not write there, which was told (PetriOptions.write_folders); else its folders are
                 // made
    int width;
    int height;
    const uint32_t *pixels; // rows without gaps, as petri_picture_draw has them; alpha counts only with `keep_alpha`
    bool keep_alpha;
    const char *codec;  // of a film; "" if not told
    const char *pixfmt; // likewise
    double max_seconds; // seconds of film; nan: none
} PetriRecord;

// The number `index` of the records of the picture that the painter has made last (petri_picture_render). False beyond
// the last. Valid until the painter makes another picture.
PETRI_API bool petri_picture_record(PetriPicture *picture, PetriPainter *painter, size_t index, PetriRecord *record);
// Writes its file, a picture: .png, .jpg, .svg or .pdf. PETRI_OK and failures as petri_picture_save has them;
// PETRI_INVALID, too, beyond the last and for one that is refused.
PETRI_API PetriStatus petri_record_save(PetriPicture *picture, PetriPainter *painter, size_t index);

// Draws into width x height pixels, rows `stride` bytes apart (a multiple of 4): 32 bits each, alpha in the highest
// byte, then red, green, blue, multiplied by alpha. The picture is scaled to fit and centred. A window's pixels are
// opaque, those of `!offscreen` may be not. PETRI_UNSUPPORTED without Cairo, PETRI_INVALID if it could not be drawn,
// PETRI_OUT_OF_MEMORY; the pixels are then cleared.
PETRI_API PetriStatus petri_picture_draw(PetriPicture *picture, PetriPainter *painter, uint32_t *pixels, int width,
                                         int height, size_t stride);
// A panel with lines of text, for a host that has something to say over a picture. Colours are red, green, blue and
// alpha from 0 to 1.
typedef struct PetriLabel {
    const char *text; // UTF-8; lines end in newlines
    double x;         // of the panel's corner at the top left
    double y;
    double width;
    double height;
    double size; // of letters; the font is one of fixed width
    double line_height;
    double padding; // between the panel's edges and the text
    double background[4];
    double foreground[4]; // of the text
    double accent[4];     // of a stripe at the left
} PetriLabel;
// Draws labels over opaque pixels; `scale` is the number of pixels for each of their units. PETRI_UNSUPPORTED without
// Cairo, PETRI_OUT_OF_MEMORY.
PETRI_API PetriStatus petri_painter_draw_labels(PetriPainter *painter, const PetriLabel *labels, size_t count,
                                                double scale, uint32_t *pixels, int width, int height, size_t stride);
// A host whose window has OpenGL ES 3 shows pictures there without reading them back from the graphics card. The
// painter draws with the context of EGL that is current in this thread, which has to be current whenever the painter is
// used and is for nothing else. PETRI_UNSUPPORTED if there is none, or no OpenGL in this build; PETRI_INVALID if the
// painter has made pictures already; PETRI_OUT_OF_MEMORY. The painter is then as it was.
PETRI_API PetriStatus petri_painter_use_gl(PetriPainter *painter);
// Draws a picture (NULL: black) and labels, with their scale, on that context's window, width x height pixels large:
// what petri_picture_draw and petri_painter_draw_labels draw. The host then swaps the buffers. PETRI_INVALID, too,
// without petri_painter_use_gl; what petri_picture_draw says of the picture, which is black then.
PETRI_API PetriStatus petri_painter_present(PetriPainter *painter, PetriPicture *picture, const PetriLabel *labels,
                                            size_t count, double scale, int width, int height);
// How many pictures the painter has read back from the graphics card.
PETRI_API uint64_t petri_painter_readback_count(const PetriPainter *painter);
// What petri_picture_display_list writes: width and height, and then, one after the other, a kind and what belongs to
// it. Colours are red, green, blue, alpha from 0 to 1, not multiplied; angles are in turns. Texts are a length and so
// many code points; paths a length and so many numbers: pieces (PETRI_PIECE_…) and what belongs to them.
enum {
    PETRI_DRAW_MATRIX,       // x' = n0 x + n2 y + n4, y' = n1 x + n3 y + n5, in the picture's units; until the next one
    PETRI_DRAW_COLOR,        // paints come from here on in this colour,
    PETRI_DRAW_LINEAR,       // … from x, y to x, y: alpha, count, and for each stop an offset and a colour
    PETRI_DRAW_RADIAL,       // … as a matrix makes of the unit circle: the matrix, alpha, count, stops
    PETRI_DRAW_STROKE_STYLE, // width (0: a pixel), join, cap, composite (numbers of petri's words), smooth edges,
                             // number of dashes, their offset, dashes
    PETRI_DRAW_PATH,         // fill, stroke, rule (0 winding, 1 even-odd, 2, 3 the same inside out), path
    PETRI_DRAW_TEXT,         // fill, stroke, x, y, size, weight, width, slant, centred, family, text
    PETRI_DRAW_IMAGE,        // x, y, width, height, fit (0 own size, 1 stretched, 2 inside, 3 filling), file
    PETRI_DRAW_CLIP,         // what is outside is kept instead, even-odd, path
    PETRI_DRAW_SAVE,         // the clip
    PETRI_DRAW_RESTORE,      // it; matrix and paint are written anew
    PETRI_DRAW_LAYER,        // what follows is drawn on a layer, which is laid over with
    PETRI_DRAW_LAYER_END,    // this alpha
    PETRI_DRAW_UNSUPPORTED,  // text: what is left out here, for it takes pixels of its own
    PETRI_DRAW_PARTICLES, // the automatic picture: count, and for each system dimensions, charged, middle x, y, z and
                          // half the width of what is shown; count of particles, for each x, y, z, radius, shade,
                          // anchor; count of links, for each two particles; count of barriers, for each point, normal;
                          // count of the scale's lines, for each x, y, x, y: right and up from the lower left corner
                          // of the system's panel, whose shorter side is 540
    PETRI_DRAW_PIXELS,    // a picture of another node, for a PetriCanvasBackend: x, y, width, height, fit, and the
                          // picture: its width and height, and each pixel, as petri_picture_draw has them
    PETRI_DRAW_PATTERN,   // paints come from here on from a picture that is repeated, on which a matrix acts: the
                          // matrix, alpha, the picture likewise, or 0, 0 and a file
    PETRI_DRAW_FILTER,    // what is drawn from here on up to the next PETRI_DRAW_STROKE_STYLE goes through a filter: a
                          // kind (PETRI_FILTER_…) and what belongs to it. Filters in it are written likewise
    PETRI_DRAW_BLEND, // paints come from here on from two: a ratio of the second, or -1 and a composite of the second
                      // on the first; alpha, two paints
    PETRI_DRAW_NOISE, // … from noise: frequencies, sides of its tiles, seed, octaves, type (0 fractal, 1 turbulence,
                      // 2 improved), alpha
};
enum { // move x, y; line x, y; curves with one and two control points; arcs that begin a figure or go on with it: x, y,
       // radii, start, sweep clockwise; an arc to a point: radii, rotation, large, clockwise, x, y; close
    PETRI_PATH_MOVE,
    PETRI_PATH_LINE,
    PETRI_PATH_QUADRATIC,
    PETRI_PATH_CUBIC,
    PETRI_PATH_ARC,
    PETRI_PATH_ARC_ON,
    PETRI_PATH_ARC_TO,
    PETRI_PATH_CLOSE,
};
// What comes after the kinds of filters (lengths in the units of the matrix in force, both ways): blur, dilate, erode
// two radii, a filter; shadow two radii, offset, colour, without what casts it, a filter; offset two lengths, a filter;
// matrix four rows of five numbers, a filter; paint a paint, up to its PETRI_DRAW_STROKE_STYLE; blend a composite or -1
// and four factors (of the product, of the second, of the first, and what is added), two filters; drawn nothing.
enum {
    PETRI_FILTER_BLUR,
    PETRI_FILTER_SHADOW,
    PETRI_FILTER_OFFSET,
    PETRI_FILTER_DILATE,
    PETRI_FILTER_ERODE,
    PETRI_FILTER_COLOUR_MATRIX,
    PETRI_FILTER_PAINT,
    PETRI_FILTER_BLEND,
    PETRI_FILTER_SOURCE
};
// The picture as numbers, for hosts that draw by themselves; it takes no Cairo. Of a window it is the first canvas.
// Valid as long as the picture. PETRI_OUT_OF_MEMORY.
PETRI_API PetriStatus petri_picture_display_list(PetriPicture *picture, const double **numbers, size_t *count);
// Whether these are all of it: neither programs nor pictures of other nodes are needed.
PETRI_API bool petri_picture_is_display_list(const PetriPicture *picture);
// What a host does that draws by itself where petri is built without Cairo; petri makes all other pictures of them.
typedef struct PetriCanvasBackend {
    // Draws what petri_picture_display_list writes, scaled to fit and centred, into cleared pixels, rows without gaps,
    // as petri_picture_draw has them. False if it cannot.
    bool (*draw)(void *user_data, const double *numbers, size_t count, int width, int height, uint32_t *pixels);
    // The pixels of an image, likewise, which stay until the next call; NULL: there is none.
    const uint32_t *(*image)(void *user_data, const char *file, int *width, int *height);
    void *user_data;
} PetriCanvasBackend;
// Lets a painter that has made nothing yet draw canvases by these functions. PETRI_UNSUPPORTED in a build with Cairo,
// which draws them.
PETRI_API PetriStatus petri_painter_use_backend(PetriPainter *painter, const PetriCanvasBackend *backend);
// Whether petri_picture_save knows the name's suffix: .png, .svg or .pdf.
PETRI_API bool petri_picture_can_save(const char *file);
// Writes a file as a whole: the old bytes or the new ones are there, never a part. The same picture gives the
// same PNG with the same libraries. PETRI_INVALID if the suffix is unknown or the file cannot be written.
PETRI_API PetriStatus petri_picture_save(PetriPicture *picture, PetriPainter *painter, const char *file);
// Gives the bytes of such a file, of the kind that the suffix tells, to a function. PETRI_INVALID, too, if that says
// stop.
PETRI_API PetriStatus petri_picture_encode(PetriPicture *picture, PetriPainter *painter, const char *suffix,
                                           PetriWriteCallback *write, void *user_data);
// Gives what drawing and saving found wrong to the session's diagnostic callback, each thing once per load. To be
// called by the thread that uses the session, when no other uses the picture.
PETRI_API void petri_picture_report(PetriSession *session, PetriPicture *picture);

#ifdef __cplusplus
}
#endif

#endif
