// scene_program.c: see scene_program.h.
//
// Inputs and uniforms have the names that they have in Flitter. A program of a script can take any time. So a draw is
// divided into bands of rows, which are waited for one by one, and stops when the remaining time is used.
#include "scene3d/scene_program.h"

#include "base/clock.h"
#include "gl/shader.h"
#include "gl/shader_sources.h"
#include "gl/uniforms.h"

#include <math.h>
#include <string.h>

enum { FIRST_UNIT = SCENE_TEXTURES + 2, MAX_UNITS = 16, BLOCK_BINDING = 1 };

static const char *const texture_names[SCENE_TEXTURES] = {"albedo_texture", "metal_texture",    "roughness_texture",
                                                          "ao_texture",     "emissive_texture", "transparency_texture"};
static const char *const flag_names[SCENE_TEXTURES] = {"use_albedo_texture",    "use_metal_texture",
                                                       "use_roughness_texture", "use_ao_texture",
                                                       "use_emissive_texture",  "use_transparency_texture"};

// Converts a light to the 16 numbers that programs read: colour and type, position and cosine of the inner half angle,
// direction and cosine of the outer half angle (or radius), falloff.
static void convert_light(const SceneLight *light, float out[16]) {
    static const float types[LIGHT_KINDS] = {[LIGHT_AMBIENT] = 1, [LIGHT_DIRECTIONAL] = 2, [LIGHT_POINT] = 3,
                                             [LIGHT_BALL] = 3,    [LIGHT_SPOT] = 4,        [LIGHT_LINE] = 5};
    int kind = (int)light->kind;
    for (int k = 0; k < 3; k++) {
        out[k] = light->color[k];
        out[4 + k] = light->position[k];
        out[8 + k] = light->direction[k] * (kind == LIGHT_LINE ? light->length : 1);
    }
    out[3] = types[kind];
    out[7] = kind == LIGHT_SPOT ? light->length : 0;
    out[11] = light->radius;
    memcpy(out + 12, light->falloff, sizeof light->falloff);
}

// Fills the buffer of the uniform block `lights_data`, and returns the number of lights that fit. Other blocks of the
// program, except that of the standard fragment shader, share the buffer, because drawing fails if a block has none.
static uint32_t send_blocks(const GroupView *view, const SceneGroup *group, GLuint program) {
    enum { LIGHT_BYTES = 64 };
    Arena *arena = view->scene->arena;
    GLuint lights_block = glGetUniformBlockIndex(program, "lights_data"),
           own_block = glGetUniformBlockIndex(program, "Lights");
    GLint count = 0, size = 0, max = LIGHT_BYTES, room = 0;
    glGetProgramiv(program, GL_ACTIVE_UNIFORM_BLOCKS, &count);
    for (GLuint i = 0; i < (GLuint)count; i++) {
        if (i == own_block)
            continue;
        glGetActiveUniformBlockiv(program, i, GL_UNIFORM_BLOCK_DATA_SIZE, &size);
        glUniformBlockBinding(program, i, BLOCK_BINDING);
        max = size > max ? size : max;
        room = i == lights_block ? size / LIGHT_BYTES : room;
    }
    SceneLight *lights = arena_alloc_array(arena, SCENE_MAX_LIGHTS, sizeof *lights);
    uint32_t number = scene_lights(group, lights, room < SCENE_MAX_LIGHTS ? (uint32_t)room : SCENE_MAX_LIGHTS);
    float *bytes = arena_alloc_array(arena, (size_t)max, 1);
    memset(bytes, 0, (size_t)max);
    for (uint32_t i = 0; i < number && i < (uint32_t)room; i++)
        convert_light(&lights[i], bytes + (size_t)16 * i);
    glBindBuffer(GL_UNIFORM_BUFFER, view->gl->cache->group_block);
    glBufferData(GL_UNIFORM_BUFFER, max, bytes, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, BLOCK_BINDING, view->gl->cache->group_block);
    return room == 0 ? 0 : number;
}

// Binds the picture whose id is the value of the attribute `name`.
static void set_picture(const GroupView *view, const DrawNode *node, const char *name, GLint at, GLint unit) {
    const AttrValue *attr = gl_custom_attr(node, name);
    GlImage image = {0};
    if (attr && attr->count == 0)
        image = view->pictures->find(view->pictures->user_data, attr->as.text);
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_2D, image.texture ? image.texture : view->gl->nothing);
    glActiveTexture(GL_TEXTURE0);
    glUniform1i(at, unit);
}

static bool is_texture_name(const char *name) {
    for (int i = 0; i < SCENE_TEXTURES; i++)
        if (strcmp(name, texture_names[i]) == 0)
            return true;
    return false;
}

// Sets all uniforms: those of the view, the attributes of the node, and others to 0.
static void set_uniforms(const GroupView *view, const SceneGroup *group, GLuint program) {
    const GraphicsState3D *state = &view->camera->state;
    const double facts[] = {state->orthographic, state->monochrome, send_blocks(view, group, program)};
    const double size[] = {view->width, view->height}, none = 0;
    const struct {
        const char *name;
        const double *numbers;
        uint32_t count;
    } given[] = {{"pv_matrix", view->projected->m, 16},
                 {"view_position", view->eye->position, 3},
                 {"view_focus", view->eye->focus, 3},
                 {"orthographic", &facts[0], 1},
                 {"monochrome", &facts[1], 1},
                 {"tint", state->tint, 3},
                 {"fog_min", &state->fog_min, 1},
                 {"fog_max", &state->fog_max, 1},
                 {"fog_curve", &state->fog_curve, 1},
                 {"fog_color", state->fog_color, 3},
                 {"nlights", &facts[2], 1},
                 {"size", size, 2}};
    GLint count = 0, unit = FIRST_UNIT;
    glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; i++) {
        GlUniform uniform = gl_uniform(program, (unsigned)i);
        const char *name = uniform.name;
        if (uniform.type == GL_SAMPLER_2D && !is_texture_name(name) && unit < MAX_UNITS)
            set_picture(view, group->program, name, uniform.at, unit++);
        const AttrValue *attr = gl_custom_attr(group->program, name);
        const double *numbers = attr && attr->count > 0 ? attr->as.list : &none;
        uint32_t length = attr && attr->count > 0 ? attr->count : 1;
        for (size_t k = 0; k < sizeof given / sizeof *given; k++)
            if (strcmp(given[k].name, name) == 0)
                numbers = given[k].numbers, length = given[k].count;
        gl_set_uniform(view->scene->arena, &uniform, numbers, length); // does nothing for samplers
    }
}

GLuint scene_group_program(const GroupView *view, const SceneGroup *group, Str standard) {
    const DrawNode *node = group->program;
    const AttrValue *vertex = draw_attr(node, ATTR_VERTEX), *fragment = draw_attr(node, ATTR_FRAGMENT);
    Arena *arena = view->scene->arena;
    Text texts[2] = {text_new(arena), text_new(arena)};
    GlShaderError error;
    bool good = true;
    if (vertex)
        good = gl_expand_template(&texts[0], vertex->as.text);
    else
        text_add_format(&texts[0], "%s%s", gl_header, gl_source_scene_group_vertex);
    if (fragment)
        good = gl_expand_template(&texts[1], fragment->as.text) && good;
    else
        text_add(&texts[1], standard);
    if (!good)
        return 0; // canvas_read has reported the template
    GLuint program = gl_own_program(view->gl, arena, text_str(&texts[0]), text_str(&texts[1]), &error);
    if (!program) {
        gl_report_shader(view->scene->diags, node, &error);
        return 0;
    }
    glUseProgram(program);
    set_uniforms(view, group, program);
    return program;
}

void scene_group_set_textures(GLuint program, int bits) {
    for (int i = 0; i < SCENE_TEXTURES; i++) {
        glUniform1i(glGetUniformLocation(program, texture_names[i]), i);
        glUniform1i(glGetUniformLocation(program, flag_names[i]), bits >> i & 1);
    }
}

// Draws into rows of the target and waits for the result. Returns how long that took, in seconds.
static double draw_rows(const GroupView *view, int y, int rows, GLsizei indices, uint32_t count) {
    double start = clock_seconds();
    glScissor(0, y, rows > 0 ? view->width : 0, rows);
    glDrawElementsInstanced(GL_TRIANGLES, indices, GL_UNSIGNED_INT, NULL, (GLsizei)count);
    gl_after_draw(view->gl);
    glFinish();
    return clock_seconds() - start;
}

// Estimates how long the vertex shader takes for all vertices, in seconds, from the time that a few of them take.
// Repeats the measurement if the driver may have compiled or the process may have been suspended.
static double vertex_seconds(const GroupView *view, const SceneShape *shape, uint32_t count, double limit) {
    enum { FEW = 3 * 64 };
    static const double COMPILES = 0.01;
    GLsizei few = shape->index_count < FEW ? shape->index_count : FEW;
    double all = (double)shape->index_count * count / few, seconds = INFINITY;
    for (int i = 0; i < 4 && (seconds > COMPILES || seconds * all > limit); i++)
        seconds = fmin(seconds, draw_rows(view, 0, 0, few, 1));
    return seconds * all;
}

bool scene_group_draw(GroupView *view, const DrawNode *node, const SceneShape *shape, uint32_t count) {
    static const double BAND_SECONDS = 0.05, UNEVEN = 8, THREADS = 2;
    Gl *gl = view->gl;
    if (shape->index_count == 0)
        return true;
    const double left = gl_seconds_left(gl), start = clock_seconds(), processor = clock_read(CLOCK_PROCESS_CPUTIME_ID);
    double seconds = 0, needed;
    glEnable(GL_SCISSOR_TEST);
    needed = vertex_seconds(view, shape, count, UNEVEN * left);
    bool good = needed <= UNEVEN * left;
    for (int y = 0, rows; y < view->height && good; y += rows) {
        rows = view->rows < view->height - y ? view->rows : view->height - y;
        double band = draw_rows(view, y, rows, shape->index_count, count), wall = clock_seconds() - start;
        // Pixels may differ in cost, so the bands grow slowly. They have an even number of rows, because pairs of rows
        // share the derivatives of a shader.
        if (band < BAND_SECONDS / 2 && view->rows < view->height)
            view->rows *= 2;
        else if (band > BAND_SECONDS && view->rows > 2)
            view->rows = view->rows / 4 * 2;
        // A GPU takes no processor time; waiting for it counts a quarter.
        seconds = fmax(fmin(clock_read(CLOCK_PROCESS_CPUTIME_ID) - processor, THREADS * wall), wall / 4);
        good = seconds <= left;
        needed = seconds * view->height / (y + rows);
    }
    glDisable(GL_SCISSOR_TEST);
    gl->shader_seconds += good ? seconds : INFINITY;
    if (glGetError() != GL_NO_ERROR)
        scene_report(view->scene, "bad-shader", node, "OpenGL cannot draw with these shaders");
    if (good)
        return true;
    if (gl->budget)
        gl_refuse_passes(gl, needed, 1);
    gl_report_limit(view->scene->diags, node, "the scene");
    return false;
}
