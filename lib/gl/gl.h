// gl.h: OpenGL ES 3 in a separate context or in a window's context: pictures on the GPU, and shader programs.
//
// A Gl belongs to one painter. After gl_enter, the context of the Gl is current in the calling thread, which may then
// call the other functions. Until this thread calls gl_leave, gl_enter blocks in all other threads, even for another
// Gl. Files that need more of OpenGL include <epoxy/gl.h> and call it directly. Machines without a GPU use Mesa's
// llvmpipe. Shaders are also valid in WebGL 2.
#pragma once

#include "base/diag.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Gl Gl;

// Opens a separate context. If OpenGL ES 3 is not available, sets *problem to the reason and returns NULL. If out of
// memory, sets *problem to NULL and returns NULL.
Gl *gl_open(const char **problem);
// Like gl_open, but adopts the context that is current in this thread. The host owns the context, and must make it
// current whenever the Gl is used.
Gl *gl_adopt(const char **problem);
// Charges the GPU memory of pictures and scenes to this budget from now on. The budget must outlive the Gl. If the
// budget refuses memory, allocations fail as if the GPU were out of memory, and `memory_refused` is set.
void gl_charge(Gl *gl, Budget *budget);
// As PetriShaderProblem and PetriShaderTest in petri-draw.h.
typedef struct GlShaderProblem {
    bool failed;
    bool in_vertex;
    char text[1024];
} GlShaderProblem;
typedef bool GlShaderTest(void *user_data, const char *vertex, const char *fragment, GlShaderProblem *problem);
// Lets the Gl test the programs of scripts before it compiles them. NULL: no tests.
void gl_test_shaders(Gl *gl, GlShaderTest *test, void *user_data);
void gl_close(Gl *gl); // ignores NULL; must not be called between gl_enter and gl_leave
// Returns false, with the reason in *problem, if the context cannot be used, for example because it was lost.
bool gl_enter(Gl *gl, const char **problem);
void gl_leave(Gl *gl);
// Returns the time that the programs of scripts have taken since gl_enter, in units of work.
uint64_t gl_shader_work(const Gl *gl);

typedef enum GlFormat { GL_FORMAT_SRGB8, GL_FORMAT_RGBA8, GL_FORMAT_RGBA16F, GL_FORMAT_RGBA32F } GlFormat;

// A picture on the GPU: four premultiplied channels, bottom row first. Shaders read and write linear light, whatever
// the format.
typedef struct GlImage {
    unsigned texture; // 0: none
    int width;
    int height;
    GlFormat format;
} GlImage;

// Returns the format for this number of bits per channel: 8, 16 or 32. If the GPU does not support it, returns a format
// with fewer bits.
GlFormat gl_format(const Gl *gl, int bits);
// Returns an image with undefined content. Freed images are reused for images of the same size and format. The
// `texture` of the result is 0 if the GPU is out of memory.
GlImage gl_image_new(Gl *gl, int width, int height, GlFormat format);
void gl_image_free(Gl *gl, GlImage image);
// Upload pixels, top row first. gl_upload_bytes takes ARGB32 in sRGB, gl_upload_linear r, g, b, a in linear light.
void gl_upload_bytes(Gl *gl, GlImage image, const uint32_t *pixels);
void gl_upload_linear(Gl *gl, GlImage image, const float *pixels);
// Download pixels in the same two forms as the functions above. Return false on an OpenGL error.
bool gl_read_bytes(Gl *gl, GlImage image, uint32_t *pixels);
bool gl_read_linear(Gl *gl, GlImage image, float *pixels);
uint64_t gl_readback_count(const Gl *gl); // number of downloads so far

// Makes the image the target of drawing, with the whole image as viewport. The image is not cleared.
void gl_target(Gl *gl, GlImage image);

// An error of a shader program.
typedef struct GlShaderError {
    Str text;       // the compiler's message
    bool failed;    // true if the compiler crashed or exceeded a limit
    bool in_vertex; // true if the error is in the vertex shader, false if it is in the fragment shader or in linking
} GlShaderError;

// Returns the program linked from two shaders. Programs are cached by their source, including those that do not
// compile. If the program does not compile or link, stores the error in *error and returns 0; the text of the error is
// in the arena. Shader sources must begin with the version line.
unsigned gl_program(Gl *gl, Arena *arena, Str vertex, Str fragment, GlShaderError *error);
// Like gl_program, for a program that a script contains: tests it first.
unsigned gl_own_program(Gl *gl, Arena *arena, Str vertex, Str fragment, GlShaderError *error);
// Compiles a program and draws GL_TRY_SIDE² pixels with it in a separate context. If it does not compile, or without
// OpenGL, fills *problem and returns false.
enum { GL_TRY_SIDE = 16 };
bool gl_try_program(const char *vertex, const char *fragment, GlShaderProblem *problem);
// The version and precision lines of a shader. Scripts write ${HEADER} instead of these lines.
extern const char gl_header[];
// Vertex shader for a triangle strip that covers the target. Its output `vec2 coord` is 0;0 at the bottom left and 1;1
// at the top right.
extern const char gl_quad[];
// Draws over the whole target with a program. Its vertex shader must be gl_quad or have the same inputs as gl_quad.
void gl_draw_quad(Gl *gl, unsigned program);
// Like gl_draw_quad, for a target of width x height pixels and a program that may be slow. Draws one band of rows after
// the other. Returns the seconds of processor time that this took, estimated from above. Stops, and returns infinity,
// once it has taken more than `seconds`. Sets *needed to the estimated seconds for the whole target.
double gl_draw_quad_within(Gl *gl, unsigned program, int width, int height, double seconds, double *needed);

// The following functions draw on the window of an adopted context. Boxes are in pixels from the window's bottom left.
// They return false if the GPU is out of memory. Temporary data is allocated from the arena.
typedef struct GlBox {
    double x, y, width, height;
} GlBox;
// Draws a picture into a box of a window of width x height pixels. The part of the window outside the box becomes
// black. Colours are encoded with a table: thresholds[b] is the smallest linear value that is encoded as a byte larger
// than b. If `opaque`, the picture is composited over black. Otherwise colours are unpremultiplied, encoded and
// premultiplied again.
bool gl_present_image(Gl *gl, Arena *arena, GlImage image, const GlBox *box, int width, int height,
                      const float thresholds[256], bool opaque);
// Draws premultiplied ARGB32 pixels, top row first; x, y is the bottom left corner. If `over`, composites the pixels
// over the window's content; otherwise, they replace it.
bool gl_present_pixels(Gl *gl, Arena *arena, const uint32_t *pixels, int x, int y, int width, int height, bool over);
