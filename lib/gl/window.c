// window.c: draws pictures on the window of an adopted context, without downloading them; see gl.h.
#include "gl/context.h"
#include "gl/shader_sources.h"

static const uint32_t ONE = 1;

// On the first call, creates gl->curve, the texture of the encoding table.
static void init_curve(Gl *gl, const float thresholds[256]) {
    if (gl->curve)
        return;
    glGenTextures(1, &gl->curve);
    glBindTexture(GL_TEXTURE_2D, gl->curve);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, 256, 1, 0, GL_RED, GL_FLOAT, thresholds);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

// Returns one of petri's own programs, which always compile.
static GLuint get_program(Gl *gl, Arena *arena, const char *text) {
    GlShaderError error;
    Text source = text_new(arena);
    text_add_c(&source, gl_header);
    text_add_c(&source, text);
    GLuint program = gl_program(gl, arena, str_from(gl_quad), text_str(&source), &error);
    glUseProgram(program);
    return program;
}

static void use_texture(GLuint program, const char *name, GLint unit, GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_2D, texture);
    glUniform1i(glGetUniformLocation(program, name), unit);
}

bool gl_present_image(Gl *gl, Arena *arena, GlImage image, const GlBox *box, int width, int height,
                      const float thresholds[256], bool opaque) {
    glActiveTexture(GL_TEXTURE0);
    init_curve(gl, thresholds);
    GLuint program = get_program(gl, arena, gl_source_show);
    use_texture(program, "picture", 0, image.texture);
    use_texture(program, "curve", 1, gl->curve);
    glUniform4f(glGetUniformLocation(program, "box"), (float)box->x, (float)box->y, (float)box->width,
                (float)box->height);
    glUniform1i(glGetUniformLocation(program, "opaque"), opaque || image.format == GL_FORMAT_SRGB8);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    glDisable(GL_DITHER);
    gl_draw_quad(gl, program);
    return glGetError() == GL_NO_ERROR;
}

bool gl_present_pixels(Gl *gl, Arena *arena, const uint32_t *pixels, int x, int y, int width, int height, bool over) {
    Budget *budget = gl->budget;
    gl->budget = NULL; // the window's pixels are not charged to the script
    GlImage image = gl_image_new(gl, width, height, GL_FORMAT_RGBA8);
    gl_image_free(gl, image); // nothing reuses the image before this function returns
    gl->budget = budget;
    if (!image.texture)
        return false;
    // The position of alpha depends on the byte order of the machine.
    Str text =
        str_format(arena,
                   "uniform sampler2D picture;\nuniform ivec2 corner;\nout vec4 color;\nvoid main() {\n"
                   "    ivec2 p = ivec2(gl_FragCoord.xy) - corner;\n"
                   "    color = texelFetch(picture, ivec2(p.x, textureSize(picture, 0).y - 1 - p.y), 0).%s;\n%s}\n",
                   *(const unsigned char *)&ONE ? "bgra" : "gbar", over ? "" : "    color.a = 1.0;\n");
    GLuint program = get_program(gl, arena, str_to_c(arena, text));
    use_texture(program, "picture", 0, image.texture);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    glUniform2i(glGetUniformLocation(program, "corner"), x, y);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(x, y, width, height);
    glDisable(GL_DITHER);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    (over ? glEnable : glDisable)(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glBindVertexArray(gl->strip);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl_after_draw(gl);
    glDisable(GL_BLEND);
    return glGetError() == GL_NO_ERROR;
}
