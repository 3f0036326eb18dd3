// petri-draw.h: the C interface of libpetri-draw, which draws the frames of a libpetri session. It requires Cairo,
// Pango and libjpeg; libpetri does not. The rules of petri.h apply.
//
// petri_picture captures the last frame as a picture. A picture is independent of the session, so another thread can
// draw it while the session is stepped. A painter draws pictures to pixels and files, and caches fonts and images from
// one picture to the next. Only one thread at a time may use a picture or a painter. They may be freed in any order.
#ifndef PETRI_DRAW_H
#define PETRI_DRAW_H

#include "petri.h"

#ifdef __cplusplus
extern "C" {
#endif

// A copy of the visible contents of a frame. Created by petri_picture, freed by petri_picture_free.
typedef struct PetriPicture PetriPicture;

// Draws pictures. Created by petri_painter_open, freed by petri_painter_close.
typedef struct PetriPainter PetriPainter;

// When to use the automatic picture, which shows the particle systems directly.
typedef enum PetriAutomatic {
    PETRI_AUTO_IF_NEEDED, // if the frame has particle systems, but no window with a canvas
    PETRI_AUTO_ALWAYS,
    PETRI_AUTO_NEVER,
} PetriAutomatic;

enum { PETRI_FIRST_WINDOW = -1, PETRI_ALL_WINDOWS = -2 }; // special values of PetriPictureOptions.window

// Options of a picture. Start with petri_default_picture_options.
typedef struct PetriPictureOptions {
    size_t size; // sizeof(PetriPictureOptions)
    // Size in pixels. The drawing is scaled to fit and centred. If width and height are 0 (the default), the picture
    // has the size that the script sets.
    int width;
    int height;
    double scale; // if width and height are 0: pixels per unit of the script's size. Default 1
    // Number of the window or `!offscreen`. PETRI_FIRST_WINDOW (the default): the first with something to draw; a
    // warning names the next window. PETRI_ALL_WINDOWS: the first, without a warning, because the host draws the others
    // as well (petri_picture_select).
    int window;
    PetriAutomatic automatic; // default PETRI_AUTO_IF_NEEDED
    // Resolution of effects and 3-D scenes, relative to the picture: greater than 0, at most 1 (the default). Smaller
    // values are faster, for previews. Ignored by pictures that need history (petri_needs_history) and by custom
    // shaders.
    double detail;
} PetriPictureOptions;

// Writes the default options to the first `size` bytes of `options`. Use petri_default_picture_options instead.
PETRI_API void petri_picture_options_init(PetriPictureOptions *options, size_t size);

// Returns the default options.
static inline PetriPictureOptions petri_default_picture_options(void) {
    PetriPictureOptions options;
    petri_picture_options_init(&options, sizeof options);
    return options;
}

// Maximum width and height of a picture in pixels.
enum { PETRI_MAX_PICTURE_SIDE = 16384 };

// Returns true if a picture of the last frame shows all particles at their positions. In frame 0, systems have not
// stored anything yet, and a script can read stored positions only in the next frame. A script that draws stored
// positions therefore draws nothing useful before frame 2. Hosts should show their first picture in the first frame for
// which this returns true, at the latest in frame 2.
PETRI_API bool petri_picture_ready(PetriSession *session, const PetriPictureOptions *options);

// Returns the number of the first window or `!offscreen` of the last frame whose attribute `id` is this text or symbol.
// Returns -1 if there is none.
PETRI_API int petri_find_window(PetriSession *session, const char *id);

// Returns true if pictures of the last frame depend on those of earlier frames or are read by sample()
// (petri_samples_pictures), or are saved by a `!record` node. The
// host must then render the pictures of all frames with one painter, in order, even of frames that it does not show
// (petri_picture_render).
PETRI_API bool petri_needs_history(PetriSession *session);

// Returns true if the picture of the last frame must be rendered even by a host that shows only a later frame: it
// depends on pictures of earlier frames, sample() reads it, or a `!record` node saves it. Returns false if it only
// refers to pictures of the same frame. The host may then skip it, although petri_needs_history returns true, unless
// the next frame must be rendered: a reference of that frame can show a picture of this one.
PETRI_API bool petri_must_render(PetriSession *session);

// If the automatic picture is used, extends its visible region to include the particles of the last frame.
// petri_picture does this automatically. A host that does not create a picture of every frame should call this function
// for the other frames, starting with frame 0. A picture then does not depend on which frames were drawn before.
// petri_load and petri_reset reset the region.
PETRI_API void petri_picture_follow(PetriSession *session, const PetriPictureOptions *options);

// Creates a picture of the last frame. The caller frees it with petri_picture_free. On failure *picture is NULL.
// Returns PETRI_INVALID, with a diagnostic, if there is nothing to draw or the size is not valid. Returns PETRI_INVALID
// without a diagnostic if the options were not initialised.
PETRI_API PetriStatus petri_picture(PetriSession *session, const PetriPictureOptions *options, PetriPicture **picture);

// Frees a picture and sets the handle to NULL. NULL handles are ignored.
PETRI_API void petri_picture_free(PetriPicture **picture);

// Sets *width and *height to the size of a picture in pixels.
PETRI_API void petri_picture_size(const PetriPicture *picture, int *width, int *height);

// Returns the title of the picture's window, or "". Valid as long as the picture.
PETRI_API const char *petri_picture_title(const PetriPicture *picture);

// Returns the number of a `!window` of the picture's frame that has something to draw: the first whose number is
// greater than `after`. To find all windows, start with -1. Returns -1 if there is none, as for automatic pictures.
PETRI_API int petri_picture_next_window(const PetriPicture *picture, int after);

// Returns the number of the window that the picture shows. An automatic picture has the size of this window. Returns -1
// if there is no window.
PETRI_API int petri_picture_window(const PetriPicture *picture);

// Returns the attribute `id` of the window with this number, or "". Valid as long as the picture.
PETRI_API const char *petri_picture_window_id(const PetriPicture *picture, int window);

// Lets the picture show another `!window` of its frame, with its own size and title. A painter that has rendered the
// picture does not render it again, so the history of the frames does not change. Returns PETRI_INVALID, with a
// diagnostic (petri_picture_report), if there is no such window or its size is not valid. On failure nothing changes.
PETRI_API PetriStatus petri_picture_select(PetriPicture *picture, int window);

// Returns the number of the frame that the picture shows.
PETRI_API int64_t petri_picture_frame(const PetriPicture *picture);

// Returns the result of petri_needs_history for the picture's frame; false for automatic pictures.
PETRI_API bool petri_picture_needs_history(const PetriPicture *picture);

// Creates a painter. The caller frees it with petri_painter_close. Returns NULL if out of memory.
PETRI_API PetriPainter *petri_painter_open(void);

// Frees a painter and sets the handle to NULL. NULL handles are ignored.
PETRI_API void petri_painter_close(PetriPainter **painter);

// Lets the scripts of a session call measure_text(), and sample(), which reads the picture that the painter has
// rendered of the previous frame. If `painter` is NULL, these functions have no effect, as in sessions that are not
// drawn. The painter must be used by the thread of the session, and must not be closed before the session, or before
// another painter replaces it. Returns PETRI_INVALID if `session` is NULL.
PETRI_API PetriStatus petri_painter_serve(PetriPainter *painter, PetriSession *session);

// Returns true if the script has called sample() since petri_painter_serve. Pictures then need history
// (petri_needs_history), and each must be rendered by the painter of petri_painter_serve before the next frame
// (petri_picture_render).
PETRI_API bool petri_samples_pictures(PetriSession *session);

// Why a shader program cannot be used.
typedef struct PetriShaderProblem {
    size_t size;     // number of bytes of the struct; do not change it
    bool failed;     // true if the driver crashed or exceeded a limit, false if it rejected the program
    bool in_vertex;  // true if the message is about the vertex shader, false: the fragment shader or both
    char text[1024]; // the driver's message, or what failed
} PetriShaderProblem;

// Tests a shader program of a script in another process, because drivers may crash on a hostile shader, or take
// unlimited time or memory. Returns true if the program can be compiled; otherwise fills *problem.
typedef bool PetriShaderTest(void *user_data, const char *vertex, const char *fragment, PetriShaderProblem *problem);

// Lets a painter test the shader programs of scripts before it compiles them. The painter calls `test` once for each
// program, on the thread that draws, and passes `user_data` to it. NULL: programs are not tested, the default.
PETRI_API void petri_painter_test_shaders(PetriPainter *painter, PetriShaderTest *test, void *user_data);

enum { PETRI_SHADER_TRY_PIXELS = 256 }; // number of pixels that petri_shader_try draws

// Compiles a shader program and draws some pixels with it, in a separate OpenGL context. For the process that a
// PetriShaderTest starts. If the driver rejects the program, or there is no OpenGL, fills *problem and returns false.
// Also returns false if an argument is NULL.
PETRI_API bool petri_shader_try(const char *vertex, const char *fragment, PetriShaderProblem *problem, size_t size);

// Renders all canvases and effects of a picture's frame. Does nothing if this is the picture that the painter rendered
// last. Functions that draw or save a picture also render it. Call this function only for frames that are not drawn or
// saved, but are needed as history. Returns PETRI_UNSUPPORTED without Cairo, and PETRI_INVALID, with a diagnostic, if
// the picture cannot be rendered.
PETRI_API PetriStatus petri_picture_render(PetriPicture *picture, PetriPainter *painter);

// A picture that a `!record` node saves.
typedef struct PetriRecord {
    const char *file; // file name, including the script's folder
    bool denied; // true if the script may not write the file (PetriOptions.write_folders); this was already reported
    int width;   // in pixels
    int height;
    const uint32_t *pixels; // rows without gaps, in the format of petri_picture_draw
    bool keep_alpha;        // false: treat the pixels as opaque
    const char *codec;      // codec of a video; "": not specified
    const char *pixfmt;     // pixel format of a video; "": not specified
    double max_seconds;     // maximum duration of a video in seconds; NaN: unlimited
    double crf;             // constant rate factor of a video; NaN: not specified
    const char *preset;     // preset of a video's encoder; "": not specified
    const char *profile;    // profile of a video's encoder; "": not specified
} PetriRecord;

// Stores the data of record number `index` in *record. `picture` must be the picture that the painter rendered last
// (petri_picture_render). Creates missing folders of the record's file. Returns false past the last record. The record
// is valid until the painter renders another picture or the picture is freed.
PETRI_API bool petri_picture_record(PetriPicture *picture, PetriPainter *painter, size_t index, PetriRecord *record,
                                    size_t size);

// Writes the file of a record that is an image: .png, .jpg, .svg or .pdf. Returns the same statuses as
// petri_picture_save. Also returns PETRI_INVALID if there is no such record, or if the record is denied.
PETRI_API PetriStatus petri_record_save(PetriPicture *picture, PetriPainter *painter, size_t index);

// Draws a picture to memory, scaled to fit into width x height pixels, and centred. Each pixel has 32 bits: alpha in
// the highest byte, then red, green and blue, premultiplied by alpha. Rows start `stride` bytes apart, a multiple of 4.
// Pixels of a window are opaque; those of an `!offscreen` may be transparent. Returns PETRI_UNSUPPORTED without Cairo,
// and PETRI_INVALID, with a diagnostic, if the picture cannot be drawn. On failure the pixels are cleared.
PETRI_API PetriStatus petri_picture_draw(PetriPicture *picture, PetriPainter *painter, uint32_t *pixels, int width,
                                         int height, size_t stride);

// A panel of text that a host draws over a picture. Functions take the size of a label, sizeof(PetriLabel). Lengths and
// positions are multiplied by the `scale` that is passed to the drawing function. Colours are red, green, blue and
// alpha from 0 to 1.
typedef struct PetriLabel {
    const char *text; // UTF-8; newlines separate lines
    double x;         // left edge of the panel
    double y;         // top edge of the panel
    double width;
    double height;
    double size;          // font size; the font is monospaced
    double line_height;   // distance between lines
    double padding;       // distance from the edges of the panel to the text
    double background[4]; // colour of the panel
    double foreground[4]; // colour of the text
    double accent[4];     // colour of a stripe at the left edge
} PetriLabel;

// Draws labels over opaque pixels, in the format of petri_picture_draw. `scale` is the number of pixels per unit of the
// labels. Returns PETRI_UNSUPPORTED without Cairo.
PETRI_API PetriStatus petri_painter_draw_labels(PetriPainter *painter, const PetriLabel *labels, size_t count,
                                                size_t size, double scale, uint32_t *pixels, int width, int height,
                                                size_t stride);

// Lets a painter draw with the host's OpenGL ES 3 context, so that petri_painter_present can show pictures without
// reading them back from the GPU. Uses the EGL context that is current in the calling thread. It must be current
// whenever the painter is used, and must not be used for anything else. Returns PETRI_UNSUPPORTED if there is no such
// context or no OpenGL in this build, and PETRI_INVALID if the painter has already rendered a picture. On
// failure the painter is unchanged.
PETRI_API PetriStatus petri_painter_use_gl(PetriPainter *painter);

// Draws a picture (NULL: black) and labels to the window of the painter's context, which has width x height pixels. The
// host then swaps the buffers. Returns PETRI_INVALID without petri_painter_use_gl. Otherwise returns the status of
// petri_picture_draw; on failure the window is black except for the labels.
PETRI_API PetriStatus petri_painter_present(PetriPainter *painter, PetriPicture *picture, const PetriLabel *labels,
                                            size_t count, size_t size, double scale, int width, int height);

// Returns how many pictures the painter has read back from the GPU.
PETRI_API uint64_t petri_painter_readback_count(const PetriPainter *painter);

// A display list (petri_picture_display_list) describes a picture as an array of numbers, for hosts that draw it
// themselves. It starts with the width and height of the picture, in the units of all other lengths, and a number that
// is 1 if the list has PETRI_DRAW_NOISE or PETRI_DRAW_FILTER, otherwise 0. Commands follow. Each command is a kind
// PETRI_DRAW_NAME, then its operands. petri-display-list.inc lists commands, path elements and filters by name, with
// their operands in order. A PETRI_PAINT is a command that sets the paint for the following commands.
//
// Operands are:
// - NUMBER(name), FLAG(name): one number; a flag is 0 or 1. Angles are in turns.
// - ALPHA(name): one number from 0 to 1, by which the alpha of a paint is multiplied, and that of images drawn with it
// - WORD(name, "first, second"): one number, which selects one of the words, from 0
// - PAIR(name): two numbers, x and y or width and height
// - NUMBERS(name, count): `count` numbers
// - COLOUR(name): red, green, blue and alpha from 0 to 1, not premultiplied
// - MATRIX(name): six numbers n0 to n5: x' = n0 x + n2 y + n4, y' = n1 x + n3 y + n5
// - STOPS(name): the stops of a gradient: their count, then an offset and a colour for each
// - LIST(name), STRING(name), PATH(name), FILTER(name), EFFECT(name), COMMANDS(name): a length, then that many numbers.
//   Those of a string are code points. Those of a path are path elements (PETRI_PATH_NAME), those of a filter or path
//   effect are its kind (PETRI_FILTER_NAME, PETRI_EFFECT_NAME), with their operands.
// - PIXELS(name): a width, a height and a number for each pixel, as in petri_picture_draw
// - PAINT(name): a PETRI_PAINT
// - INPUT(name): the filter or effect that provides the input of another, without its length
// - INPUTS(name): the number of effects, then each of them
//
// The composite modes, from 0, are modulate, clear, src, dst, over, dst_over, in, dst_in, out, dst_out, atop, dst_atop,
// xor, add, multiply, screen, overlay, darken, lighten, color_dodge, color_burn, hard_light, soft_light, difference,
// exclusion, hue, saturation, color and luminosity.
enum {
#define PETRI_COMMAND(name, operands, text) PETRI_DRAW_##name,
#include "petri-display-list.inc"
};
enum {
#define PETRI_PATH_ELEMENT(name, operands, text) PETRI_PATH_##name,
#include "petri-display-list.inc"
};
enum {
#define PETRI_FILTER_KIND(name, operands, text) PETRI_FILTER_##name,
#include "petri-display-list.inc"
};
enum {
#define PETRI_EFFECT_KIND(name, operands, text) PETRI_EFFECT_##name,
#include "petri-display-list.inc"
};

// Sets *numbers to the display list of a picture, and *count to its length. Works without Cairo. For a window, it
// contains the first canvas. Valid as long as the picture. Sets *numbers to NULL and returns PETRI_OUT_OF_MEMORY if out
// of memory.
PETRI_API PetriStatus petri_picture_display_list(PetriPicture *picture, const double **numbers, size_t *count);

// Returns true if the display list describes the picture completely: it needs no effects, no images of other nodes and
// no history.
PETRI_API bool petri_picture_is_display_list(const PetriPicture *picture);

// Fills pixels with the noise of a PETRI_DRAW_NOISE command, for hosts that draw display lists. `matrix` maps pixels to
// the coordinates of the list. Pixels are rows without gaps, in the format of petri_picture_draw. Returns PETRI_INVALID
// if an argument is NULL, a side is less than 1, or there are more than 2^26 pixels.
PETRI_API PetriStatus petri_noise_draw(const double operands[8], const double matrix[6], uint32_t *pixels, int width,
                                       int height);

// What a filter needs.
typedef struct PetriFilterNeeds {
    double margin;   // distance in pixels by which the drawing must extend beyond the pixels that are shown
    bool everywhere; // true if the filter changes transparent pixels
} PetriFilterNeeds;

// Stores what a filter, the operand of PETRI_DRAW_FILTER, needs. `matrix` maps the coordinates of the list to pixels.
// Returns PETRI_INVALID if an argument is NULL or the numbers are not a filter.
PETRI_API PetriStatus petri_filter_measure(const double *filter, size_t count, const double matrix[6],
                                           PetriFilterNeeds *needs, size_t size);

// Fills pixels with the paint that the commands set. Returns false on failure.
typedef bool PetriPaintCallback(void *user_data, const double *commands, size_t count, uint32_t *pixels);

// Applies a filter to a drawing. `pixels` has the drawing, and receives the result. For filters of the kind
// PETRI_FILTER_PAINT, calls `paint` with `pixels`. Returns PETRI_INVALID, with the content of `pixels` undefined, if an
// argument is NULL, the numbers are not a filter, `paint` returned false, or the size is not one that petri_noise_draw
// accepts. Returns PETRI_OUT_OF_MEMORY, with the content of `pixels` undefined, if out of memory.
PETRI_API PetriStatus petri_filter_draw(const double *filter, size_t count, const double matrix[6], uint32_t *pixels,
                                        int width, int height, PetriPaintCallback *paint, void *user_data);

// Functions of a host that draws canvases itself, for builds without Cairo. petri computes effects from the results.
typedef struct PetriCanvasBackend {
    size_t size; // sizeof(PetriCanvasBackend)
    // Draws a display list, scaled to fit and centred, into cleared pixels: rows without gaps, in the format of
    // petri_picture_draw. Returns false on failure.
    bool (*draw)(void *user_data, const double *numbers, size_t count, int width, int height, uint32_t *pixels);
    // Returns the pixels of an image file in the same format, valid until the next call, or NULL if there is no such
    // image. If `image` itself is NULL, there are no images.
    const uint32_t *(*image)(void *user_data, const char *file, int *width, int *height);
    void *user_data; // passed to the functions
    // Returns the width of a text, in units of the font size, for measure_text() of scripts. `family` is a list of
    // names, separated by commas. `weight`, `width` and `slant` are as in PETRI_DRAW_TEXT. Returns NaN if there are no
    // fonts. If `measure` itself is NULL, texts cannot be measured.
    double (*measure)(void *user_data, const char *text, const char *family, double weight, int width, int slant);
} PetriCanvasBackend;

// Sets the functions that a painter draws canvases with. Copies the struct. Returns PETRI_UNSUPPORTED in a build with
// Cairo, and PETRI_INVALID if the painter has already rendered a picture.
PETRI_API PetriStatus petri_painter_use_backend(PetriPainter *painter, const PetriCanvasBackend *backend);

// Returns true if petri_picture_save supports the suffix of a file name: .png, .svg or .pdf.
PETRI_API bool petri_picture_can_save(const char *file);

// Writes a picture to a file in the format of its suffix. The file is replaced atomically. With the same library
// versions, the same picture gives an identical PNG file. Returns PETRI_UNSUPPORTED without Cairo, and PETRI_INVALID,
// with a diagnostic, if the suffix is not supported or the file cannot be written.
PETRI_API PetriStatus petri_picture_save(PetriPicture *picture, PetriPainter *painter, const char *file);

// Like petri_picture_save, but passes the bytes of the file to a function. `suffix` selects the format, such as ".png".
// Also returns PETRI_INVALID if `write` returned false.
PETRI_API PetriStatus petri_picture_encode(PetriPicture *picture, PetriPainter *painter, const char *suffix,
                                           PetriWriteCallback *write, void *user_data);

// Writes how many triangles the solids, distance fields and `!model` nodes of the last frame's 3-D scenes have: a line
// with the sum, then one line for each different model, with its position in the script and its problems. Writes
// nothing if there are none. Returns PETRI_INVALID if no frame has been computed or if `write` returned false, and
// PETRI_LIMIT_EXCEEDED, with a diagnostic, if the script's limits do not suffice.
PETRI_API PetriStatus petri_print_meshes(PetriSession *session, PetriWriteCallback *write, void *user_data);

// Returns true if a shader was left out of the picture because it is invalid, crashed the driver or exceeded a limit,
// or if a whole 3-D scene was left out because it exceeded the work limit.
PETRI_API bool petri_picture_lacks_shader(const PetriPicture *picture);

// Reports the diagnostics of drawing and saving a picture to the session's on_diagnostic, each once per load. Must be
// called by the thread that uses the session, while no other thread uses the picture.
PETRI_API void petri_picture_report(PetriSession *session, PetriPicture *picture);

#ifdef __cplusplus
}
#endif

#endif
