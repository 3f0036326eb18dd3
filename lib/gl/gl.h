// gl.h: OpenGL ES 3, with a context of its own or in that of a window: pictures on the GPU, programs.
//
// A Gl belongs to one painter; between gl_enter and gl_leave it is current in the calling thread, and the other
// functions may be called; other threads wait in gl_enter meanwhile. Files that need more include <epoxy/gl.h> and call
// OpenGL themselves. What Mesa's llvmpipe does here serves machines without a GPU. Shaders are written so that WebGL 2
// takes them, too.
#ifndef PETRI_GL_GL_H
#define PETRI_GL_GL_H

#include "base/diag.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Gl Gl;

// NULL, with the reason, if there is no OpenGL ES 3 here; with none if memory is used up.
Gl *gl_open(const char **problem);
// The same in the context that is current in this thread, which stays the host's: it has to be current whenever the Gl
// is used.
Gl *gl_adopt(const char **problem);
// What pictures and scenes hold on the GPU is charged to this from here on; it outlives the Gl. What it refuses is as
// if the GPU's memory were used up, and it knows that.
void gl_charge(Gl *gl, Budget *meter);
void gl_close(Gl *gl); // NULL is fine; not between enter and leave
// False, with the reason, if the context was lost.
bool gl_enter(Gl *gl, const char **problem);
void gl_leave(Gl *gl);

typedef enum GlFormat { GL_FORMAT_SRGB8, GL_FORMAT_RGBA8, GL_FORMAT_RGBA16F, GL_FORMAT_RGBA32F } GlFormat;

// A picture on the GPU: four channels multiplied by alpha, rows from the bottom. Reading it gives linear light,
// whatever the format, and writing to it takes linear light.
typedef struct GlImage {
    unsigned texture; // 0: none
    int width;
    int height;
    GlFormat format;
} GlImage;

// The format of a picture with so many bits for each channel; 8 bits where the GPU cannot draw to more.
GlFormat gl_format(const Gl *gl, int bits);
int gl_max_size(const Gl *gl); // width and height of a picture
// Images that are given back are used again for others of their size and format: warm frames create none. What is in a
// new one is undefined. `texture` 0 if the GPU's memory is used up.
GlImage gl_image_new(Gl *gl, int width, int height, GlFormat format);
void gl_image_free(Gl *gl, GlImage image);
// From rows that begin at the top: ARGB32 of an sRGB picture, or r, g, b, a in linear light.
void gl_upload_bytes(Gl *gl, GlImage image, const uint32_t *pixels);
void gl_upload_linear(Gl *gl, GlImage image, const float *pixels);
// To rows that begin at the top: ARGB32, encoded; over black if `opaque`, else as Texture rows are (draw/texture.h).
bool gl_read_bytes(Gl *gl, GlImage image, uint32_t *pixels);
bool gl_read_linear(Gl *gl, GlImage image, float *pixels);
uint64_t gl_readback_count(const Gl *gl); // how often that was done

// What is drawn next goes to this image; the viewport is all of it. It is not cleared.
void gl_target(Gl *gl, GlImage image);

// What is wrong with a program.
typedef struct GlShaderError {
    Str text;       // the compiler's words
    bool in_vertex; // shader; else in the other, or in how they fit
} GlShaderError;

// A program of two shaders; kept by its text, so that asking again costs a look-up. 0, with what is wrong (in the
// arena), if it does not compile; that is kept, too. Texts begin with the version line.
unsigned gl_program(Gl *gl, Arena *arena, Str vertex, Str fragment, GlShaderError *fault);
extern const char gl_header[]; // version and precision lines: what ${HEADER} stands for
extern const char gl_quad[];   // vertex shader of a strip over the whole target: out vec2 coord, 0 to 1, v up
// Runs a program that has gl_quad's inputs over the whole target.
void gl_draw_quad(Gl *gl, unsigned program);

// What follows draws on the window of a context that was adopted; boxes are in its pixels, from its bottom left. False
// if the GPU's memory is used up. The arena takes what is needed meanwhile.
typedef struct GlBox {
    double x, y, width, height;
} GlBox;
// The part of a window of that size in which the picture lies, with black around it. Its bytes are those that are
// encoded by the table: from which linear value on a byte is larger than its number. `opaque`: over black; else its
// colours are encoded without their alpha, which then multiplies them.
bool gl_present_image(Gl *gl, Arena *arena, GlImage image, const GlBox *box, int width, int height,
                      const float thresholds[256], bool opaque);
// ARGB32 multiplied by alpha, rows from the top: as they are, or over what is there.
bool gl_present_pixels(Gl *gl, Arena *arena, const uint32_t *pixels, int x, int y, int width, int height, bool over);

#endif
