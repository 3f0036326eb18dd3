// scene_draw.c: renders a camera's view of a scene; see scene.h.
//
// Instances are drawn in the order of draw_order.h, and a program is chosen only if group or variant change. If the
// script's program of a group fails, the standard program replaces it. Afterwards, reset_state restores what other
// users of the context expect.
#include "gl/shader_sources.h"
#include "scene3d/gpu_cache.h"
#include "scene3d/scene_cost.h"
#include "scene3d/scene_program.h"
#include "scene3d/sphere_impostor.h"

#include <math.h>
#include <string.h>

enum { BLOCK_LIGHTS = 255 }; // number of lights that fit into the guaranteed size of a uniform block

// The state of rendering a camera's view.
typedef struct Drawing {
    Gl *gl;
    GpuCache *store;
    const Scene *scene;
    const SceneCamera *camera;
    const ScenePictures *pictures;
    Eye eye;
    Matrix view;
    Matrix projection;
    DrawOrder order;
    SceneTarget *target;         // buffers of the picture
    GlImage backs;               // result of draw_backs for the current group; its `texture` is 0 if there is none
    GroupView group;             // for programs of the script
    bool own;                    // true if the current group is drawn with a program of the script
    bool many;                   // true if the group's lights are in a texture, false if in a uniform block
    double ambient[3];           // sum of the group's ambient lights
    GLint ends[LIGHT_KINDS - 1]; // index after the last light of each kind except ambient (sort_lights)
} Drawing;

static void make_record(const SceneInstance *instance, SceneRecord *record) {
    double cofactors[9];
    matrix_cofactors(&instance->matrix, cofactors);
    // Scales the cofactors so that they do not overflow when they are converted to floats. The scale does not matter,
    // because the shader normalises the transformed normals.
    double max = 1e-300;
    for (int k = 0; k < 9; k++)
        max = fmax(max, fabs(cofactors[k]));
    for (int k = 0; k < 9; k++)
        record->cofactors[k] = (float)(cofactors[k] / max);
    for (int k = 0; k < 16; k++)
        record->matrix[k] = (float)instance->matrix.m[k];
}

// Fills the record of a disc. Instead of cofactors, it holds parameters of the sphere.
static void make_disc_record(const Drawing *drawing, const SceneInstance *instance, SceneRecord *record) {
    SphereImpostor disc;
    sphere_impostor(&drawing->eye, &drawing->view, &instance->matrix, &disc);
    double ball[9] = {disc.middle[0], disc.middle[1], disc.middle[2], disc.radius, disc.near};
    for (int k = 0; k < 9; k++)
        record->cofactors[k] = (float)ball[k];
    for (int k = 0; k < 16; k++)
        record->matrix[k] = (float)disc.place.m[k];
}

static void send_records(const Drawing *drawing) {
    const DrawOrder *order = &drawing->order;
    SceneRecord *records = arena_alloc_array(drawing->scene->arena, order->count, sizeof *records);
    for (uint32_t d = 0; d < order->draw_count; d++) {
        const SceneDraw *draw = &order->draws[d];
        for (uint32_t i = draw->first; i < draw->first + draw->count; i++) {
            if (draw->disc)
                make_disc_record(drawing, order->instances[i], &records[i]);
            else
                make_record(order->instances[i], &records[i]);
            records[i].surface = order->instances[i]->material->surface;
        }
    }
    glBindBuffer(GL_ARRAY_BUFFER, drawing->store->instances);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(order->count * sizeof *records), records, GL_STREAM_DRAW);
}

static void set_vector(GLuint program, const char *name, const double x[3]) {
    glUniform3f(glGetUniformLocation(program, name), (float)x[0], (float)x[1], (float)x[2]);
}

static void set_number(GLuint program, const char *name, double x) {
    glUniform1f(glGetUniformLocation(program, name), (float)x);
}

static void set_integer(GLuint program, const char *name, int x) {
    glUniform1i(glGetUniformLocation(program, name), x);
}

static void set_matrix(GLuint program, const char *name, const Matrix *matrix) {
    float m[16];
    for (int i = 0; i < 16; i++)
        m[i] = (float)matrix->m[i];
    glUniformMatrix4fv(glGetUniformLocation(program, name), 1, GL_FALSE, m);
}

static void set_camera(const Drawing *drawing, GLuint program) {
    const GraphicsState3D *state = &drawing->camera->state;
    const Eye *eye = &drawing->eye;
    double ahead[3];
    for (int k = 0; k < 3; k++)
        ahead[k] = eye->position[k] - eye->focus[k];
    vector_normalise(ahead);
    set_matrix(program, "view", &drawing->view);
    set_matrix(program, "projection", &drawing->projection);
    set_vector(program, "eye", eye->position);
    set_vector(program, "ahead", ahead);
    set_integer(program, "orthographic", state->orthographic);
    set_integer(program, "monochrome", state->monochrome);
    set_number(program, "fog_min", state->fog_min);
    set_number(program, "fog_max", state->fog_max);
    set_number(program, "fog_curve", state->fog_curve);
    set_vector(program, "fog_color", state->fog_color);
    set_vector(program, "tint", state->tint);
}

static void send_light_texture(const Drawing *drawing, const SceneLight *lights, uint32_t count) {
    enum { ROW = 256 };
    GLsizei rows = (GLsizei)((count + ROW - 1) / ROW);
    glActiveTexture(GL_TEXTURE0 + SCENE_TEXTURES);
    glBindTexture(GL_TEXTURE_2D, drawing->store->light_texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 4 * ROW, rows, 0, GL_RGBA, GL_FLOAT, NULL);
    for (GLsizei row = 0; row < rows; row++) {
        uint32_t here = count - (uint32_t)row * ROW < ROW ? count - (uint32_t)row * ROW : ROW;
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, row, (GLsizei)(4 * here), 1, GL_RGBA, GL_FLOAT, lights + row * ROW);
    }
    glActiveTexture(GL_TEXTURE0);
}

// Stores the sum of the ambient lights in `drawing`. Sorts the remaining lights by kind into `sorted`, and returns the
// number of these.
static uint32_t sort_lights(Drawing *drawing, const SceneLight *all, uint32_t count, SceneLight *sorted) {
    uint32_t sorted_count = 0;
    memset(drawing->ambient, 0, sizeof drawing->ambient);
    for (int kind = LIGHT_AMBIENT; kind < LIGHT_KINDS; kind++) {
        for (uint32_t i = 0; i < count; i++) {
            if (all[i].kind != (float)kind)
                continue;
            if (kind > LIGHT_AMBIENT)
                sorted[sorted_count++] = all[i];
            for (int k = 0; kind == LIGHT_AMBIENT && k < 3; k++)
                drawing->ambient[k] += all[i].color[k];
        }
        if (kind > LIGHT_AMBIENT)
            drawing->ends[kind - 1] = (GLint)sorted_count;
    }
    return sorted_count;
}

static void send_lights(Drawing *drawing, const SceneGroup *group) {
    SceneLight *all = arena_alloc_array(drawing->scene->arena, SCENE_MAX_LIGHTS, sizeof *all);
    SceneLight *lights = arena_alloc_array(drawing->scene->arena, SCENE_MAX_LIGHTS, sizeof *lights);
    uint32_t count = sort_lights(drawing, all, scene_lights(group, all, SCENE_MAX_LIGHTS), lights);
    drawing->many = count > BLOCK_LIGHTS;
    if (drawing->many) {
        send_light_texture(drawing, lights, count);
        return;
    }
    glBindBuffer(GL_UNIFORM_BUFFER, drawing->store->light_block);
    glBufferData(GL_UNIFORM_BUFFER, BLOCK_LIGHTS * sizeof *lights, NULL, GL_STREAM_DRAW);
    glBufferSubData(GL_UNIFORM_BUFFER, 0, (GLsizeiptr)(count * sizeof *lights), lights);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, drawing->store->light_block);
}

// Features of a shader variant. DEEP: discs write depth. BACK: renders the picture `backs` (draw_backs).
enum { TEXTURED = 1, DISC = 2, DEEP = 4, BACK = 8, TRANSLUCENT = 16 };

static void add_variant(Text *text, unsigned variant) {
    static const char *const names[] = {"TEXTURED", "DISC", "DEEP", "BACK", "TRANSLUCENT"};
    for (unsigned i = 0; i < sizeof names / sizeof *names; i++)
        if (variant & 1u << i)
            text_add_format(text, "#define %s\n", names[i]);
}

// Returns the source of the standard fragment shader. `names` is a list of macros, or "".
static Str standard_fragment(const Drawing *drawing, unsigned variant, const char *names) {
    Text fragment = text_new(drawing->scene->arena);
    text_add_c(&fragment, gl_header);
    text_add_c(&fragment, names);
    add_variant(&fragment, variant);
    text_add_format(&fragment, "#define LIGHTS_MAX %d\n", BLOCK_LIGHTS);
    text_add_c(&fragment, drawing->many ? "#define MANY_LIGHTS\n" : "");
    text_add_c(&fragment, gl_source_scene_light);
    text_add_c(&fragment, variant & TEXTURED ? gl_source_scene_texture : "");
    text_add_c(&fragment, variant & TRANSLUCENT ? gl_source_scene_through : "");
    text_add_c(&fragment, gl_source_scene);
    return text_str(&fragment);
}

// Returns a program of petri. Returns 0, after a report, if it does not compile.
static GLuint standard_program(const Drawing *drawing, unsigned variant) {
    const Scene *scene = drawing->scene;
    Text vertex = text_new(scene->arena);
    GlShaderError error;
    text_add_c(&vertex, gl_header);
    add_variant(&vertex, variant);
    text_add_c(&vertex, gl_source_scene_vertex);
    GLuint program =
        gl_program(drawing->gl, scene->arena, text_str(&vertex), standard_fragment(drawing, variant, ""), &error);
    if (!program)
        scene_report(scene, "bad-shader", scene->node, str_to_c(scene->arena, error.text));
    return program;
}

// Returns the program of a variant, with its uniforms set. If the script's program of the current group cannot be used,
// the standard program replaces it. Returns 0, after a report, if there is no program.
static GLuint use_program(Drawing *drawing, uint32_t group, unsigned variant) {
    // Lets the standard fragment shader read the outputs of a group's vertex shader.
    static const char names[] = "#define world world_position\n#define outwards world_normal\n"
                                "#define coord texture_uv\n#define albedo_transparency fragment_albedo\n"
                                "#define emissive_translucency fragment_emissive\n"
                                "#define surface fragment_properties\n";
    GLuint program = 0;
    if (drawing->own)
        program = scene_group_program(&drawing->group, drawing->scene->groups[group],
                                      standard_fragment(drawing, variant & TEXTURED, names));
    drawing->own = program != 0;
    if (program && draw_attr(drawing->scene->groups[group]->program, ATTR_FRAGMENT))
        return program;
    if (!program)
        program = standard_program(drawing, variant);
    if (!program)
        return 0;
    glUseProgram(program);
    set_camera(drawing, program);
    set_vector(program, "ambient", drawing->ambient);
    glUniform1iv(glGetUniformLocation(program, "ends"), LIGHT_KINDS - 1, drawing->ends);
    if (drawing->many)
        set_integer(program, "lights", SCENE_TEXTURES);
    else if (glGetUniformBlockIndex(program, "Lights") != GL_INVALID_INDEX)
        glUniformBlockBinding(program, glGetUniformBlockIndex(program, "Lights"), 0);
    if (variant & TRANSLUCENT && !drawing->own) {
        glActiveTexture(GL_TEXTURE0 + SCENE_TEXTURES + 1);
        glBindTexture(GL_TEXTURE_2D, drawing->backs.texture);
        glActiveTexture(GL_TEXTURE0);
        set_integer(program, "backs", SCENE_TEXTURES + 1);
    }
    return program;
}

static void set_textures(const Drawing *drawing, GLuint program, const SceneTextures *textures) {
    static const char *const names[SCENE_TEXTURES] = {"color_texture", "metal_texture",    "roughness_texture",
                                                      "ao_texture",    "emissive_texture", "transparency_texture"};
    int bits = 0;
    for (int i = 0; i < SCENE_TEXTURES; i++) {
        GlImage image = {0};
        if (textures->ids[i].len > 0)
            image = drawing->pictures->find(drawing->pictures->user_data, textures->ids[i]);
        bits |= image.texture ? 1 << i : 0;
        glActiveTexture(GL_TEXTURE0 + (GLenum)i);
        glBindTexture(GL_TEXTURE_2D, image.texture ? image.texture : drawing->gl->nothing);
        set_integer(program, names[i], i);
    }
    glActiveTexture(GL_TEXTURE0);
    if (drawing->own)
        scene_group_set_textures(program, bits);
    set_integer(program, "textured", bits);
    set_integer(program, "bordered", textures->border);
    glUniform2i(glGetUniformLocation(program, "repeated"), textures->repeat[0], textures->repeat[1]);
    glUniform4fv(glGetUniformLocation(program, "border"), 1, textures->border_color);
}

static void set_blending(const GraphicsState3D *state, bool transparent, bool translucent) {
    static const struct {
        GLenum equation;
        GLenum source;
        GLenum target;
    } modes[] = {
#define MIX3D(id, text, equation, source, destination) [MIX3D_##id] = {equation, source, destination},
#include "schema/composite_list.h"
    };
    bool sorts = state->depth_sort && state->depth_test;
    // Opaque surfaces replace the colours behind them, so they need no blending.
    (sorts && !transparent && state->composite == MIX3D_OVER ? glDisable : glEnable)(GL_BLEND);
    glBlendEquation(modes[state->composite].equation);
    glBlendFunc(modes[state->composite].source, modes[state->composite].target);
    (state->depth_test ? glEnable : glDisable)(GL_DEPTH_TEST);
    glDepthMask(state->depth_test && (!transparent || translucent));
    (state->face_cull ? glEnable : glDisable)(GL_CULL_FACE);
    glCullFace(state->cull_face == FACE_FRONT ? GL_FRONT : GL_BACK);
}

static void clear_target(const SceneCamera *camera) {
    const GraphicsState3D *state = &camera->state;
    float color[4] = {0, 0, 0, 0};
    if (state->fog_max > state->fog_min) {
        const double *fog = state->fog_color;
        double grey = 0.299 * fog[0] + 0.587 * fog[1] + 0.114 * fog[2];
        for (int k = 0; k < 3; k++)
            color[k] = (float)((state->monochrome ? grey : fog[k]) * state->tint[k]);
        color[3] = 1;
    }
    glDepthMask(GL_TRUE);
    glDisable(GL_SCISSOR_TEST);
    glClearColor(color[0], color[1], color[2], color[3]);
    glClearDepthf(1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

// Returns false if a program of the script takes too long.
static bool draw_shape(Drawing *drawing, const SceneDraw *draw, GLuint program) {
    const Scene *scene = drawing->scene;
    SceneModel model = scene->models[draw->model];
    model.segments = draw->segments;
    model.disc = draw->disc;
    const SceneShape *shape = gpu_cache_shape(drawing->gl, scene, &model);
    if (draw->textures > 0 || drawing->own)
        set_textures(drawing, program, &scene->textures[draw->textures]);
    gpu_cache_bind_instances(drawing->store, shape, draw->first);
    if (drawing->own)
        return scene_group_draw(&drawing->group, scene->groups[draw->group]->program, shape, draw->count);
    glDrawElementsInstanced(GL_TRIANGLES, shape->index_count, GL_UNSIGNED_INT, NULL, (GLsizei)draw->count);
    return true;
}

// Renders the back faces of translucent bodies to drawing->backs (spec 5.6). A pixel holds the light that enters
// through the face, and the distance of the face. Processes the draws from `first`, the first translucent draw, to the
// end of the group. Returns false on failure.
static bool draw_backs(Drawing *drawing, uint32_t first) {
    const DrawOrder *order = &drawing->order;
    GlFormat format = drawing->gl->floats ? GL_FORMAT_RGBA32F : GL_FORMAT_RGBA16F;
    int width = drawing->target->width, height = drawing->target->height;
    SceneTarget *extra = gpu_cache_target(drawing->gl, width, height, 0, format, true);
    drawing->backs = extra ? gl_image_new(drawing->gl, width, height, format) : (GlImage){0};
    if (!drawing->backs.texture)
        return false;
    gl_after_draw(drawing->gl);
    glBindFramebuffer(GL_FRAMEBUFFER, extra->framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, drawing->backs.texture, 0);
    set_blending(&(GraphicsState3D){.depth_sort = true, .depth_test = true, .face_cull = true, .cull_face = FACE_FRONT},
                 false, false);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (uint32_t i = first; i < order->draw_count && order->draws[i].group == order->draws[first].group; i++) {
        const SceneDraw *draw = &order->draws[i];
        GLuint program =
            draw->translucent ? use_program(drawing, draw->group, BACK | (draw->textures > 0 ? TEXTURED : 0u)) : 0;
        if (program)
            draw_shape(drawing, draw, program);
    }
    gl_after_draw(drawing->gl);
    glBindFramebuffer(GL_FRAMEBUFFER, drawing->target->framebuffer);
    return true;
}

static bool draw_all(Drawing *drawing) {
    const Scene *scene = drawing->scene;
    uint32_t group = UINT32_MAX;
    GLuint program = 0;
    unsigned current = UINT32_MAX;
    for (uint32_t i = 0; i < drawing->order.draw_count; i++) {
        const SceneDraw *draw = &drawing->order.draws[i];
        unsigned variant = (draw->textures > 0 ? TEXTURED : 0u) | (draw->disc ? DISC : 0u) |
                           (draw->disc && draw->deep ? DEEP : 0u) | (draw->translucent ? TRANSLUCENT : 0u);
        if (draw->group != group) {
            group = draw->group;
            gl_image_free(drawing->gl, drawing->backs);
            drawing->backs = (GlImage){0};
            ArenaMark mark = arena_mark(scene->arena);
            send_lights(drawing, scene->groups[group]);
            arena_rewind(scene->arena, mark);
            current = UINT32_MAX;
            drawing->own = scene->groups[group]->program;
        }
        if (drawing->own && variant != current)
            program = use_program(drawing, group, current = variant);
        if (draw->translucent && !drawing->backs.texture && !drawing->own) {
            if (!draw_backs(drawing, i))
                return false;
            current = UINT32_MAX;
        }
        if (variant != current) {
            current = variant;
            program = use_program(drawing, group, variant);
        }
        if (!program)
            return true;
        set_blending(&scene->groups[group]->state, draw->transparent, draw->translucent);
        if (!draw_shape(drawing, draw, program))
            return false;
    }
    return true;
}

static void reset_state(void) {
    glDisable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDepthMask(GL_TRUE);
}

// Returns the number of samples per pixel that the script requests; 0: no multisampling.
static int samples_of(const Scene *scene, const SceneCamera *camera) {
    double samples = scene->detail < 1 ? 0 : fmin(camera->state.samples, 64);
    return samples >= 2 ? (int)samples : 0;
}

static bool draw_to_image(Drawing *drawing, GlImage image) {
    Gl *gl = drawing->gl;
    const SceneCamera *camera = drawing->camera;
    SceneTarget *target = gpu_cache_target(drawing->gl, image.width, image.height, samples_of(drawing->scene, camera),
                                           image.format, false);
    if (!target)
        return false;
    drawing->target = target;
    Matrix projected = matrix_product(&drawing->projection, &drawing->view);
    drawing->group = (GroupView){.gl = gl,
                                 .scene = drawing->scene,
                                 .camera = camera,
                                 .eye = &drawing->eye,
                                 .projected = &projected,
                                 .pictures = drawing->pictures,
                                 .width = image.width,
                                 .height = image.height,
                                 .rows = 2};
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    if (!target->color)
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, image.texture, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return false;
    glViewport(0, 0, image.width, image.height);
    clear_target(camera);
    bool good = draw_all(drawing);
    gl_after_draw(gl);
    reset_state();
    gl_image_free(gl, drawing->backs);
    if (target->color) {
        gl_target(gl, image);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffer);
        glBlitFramebuffer(0, 0, image.width, image.height, 0, 0, image.width, image.height, GL_COLOR_BUFFER_BIT,
                          GL_NEAREST);
        gl_after_draw(gl);
        glBindFramebuffer(GL_FRAMEBUFFER, gl->framebuffer);
    }
    return good && glGetError() == GL_NO_ERROR;
}

static int bits_of(const Scene *scene, const SceneCamera *camera) {
    double bits = camera->state.colorbits;
    return bits == 8 || bits == 16 || bits == 32 ? (int)bits : scene->bits;
}

// Charges the estimated time of drawing. If that would exceed the limit, reports it and returns false.
static bool charge_view(const Drawing *drawing, const SceneBox *boxes, int width, int height) {
    enum { NEGLIGIBLE = 16 }; // a rough estimate suffices below this fraction of the remaining work
    Budget *budget = drawing->gl->budget;
    if (!budget)
        return true;
    double left = (double)(budget->work_limit - budget->work) * BUDGET_UNIT_TIME;
    SceneView view = {.scene = drawing->scene,
                      .order = &drawing->order,
                      .boxes = boxes,
                      .clip = matrix_product(&drawing->projection, &drawing->view),
                      .width = width,
                      .height = height,
                      .samples = samples_of(drawing->scene, drawing->camera)};
    double cost = scene_cost(&view, left / NEGLIGIBLE);
    if (budget_charge_time(budget, cost))
        return true;
    scene_report_missing(drawing->scene, drawing->camera->node);
    return false;
}

static GlImage draw_view(Gl *gl, const Scene *scene, const SceneCamera *camera, const ScenePictures *pictures) {
    GlImage none = {0};
    int width = (int)fmax(1, floor(camera->width * scene->detail + 0.5));
    int height = (int)fmax(1, floor(camera->height * scene->detail + 0.5));
    Drawing drawing = {.gl = gl, .store = gpu_cache(gl), .scene = scene, .camera = camera, .pictures = pictures};
    if (!drawing.store)
        arena_exhausted(scene->arena);
    drawing.store->now++;
    drawing.eye = scene_eye(scene, camera);
    drawing.view = matrix_view(&drawing.eye);
    drawing.projection = matrix_projection(&drawing.eye);
    SceneBox *boxes = arena_alloc_array(scene->arena, scene->model_count, sizeof *boxes);
    for (uint32_t i = 0; i < scene->model_count && !gl_is_refused(gl); i++)
        boxes[i] = gpu_cache_shape(gl, scene, &scene->models[i])->box;
    if (gl_is_refused(gl))
        return none; // make_view reports the refusal
    drawing.order = draw_order(scene, &drawing.eye, &drawing.view, &drawing.projection, width, boxes);
    if (drawing.order.cut)
        scene_report(scene, "too-many-triangles", scene->node,
                     "a picture can show at most 50 million triangles; the others are left out");
    if (!charge_view(&drawing, boxes, width, height))
        return none;
    while (glGetError() != GL_NO_ERROR)
        ;
    send_records(&drawing);
    GlImage image = gl_image_new(gl, width, height, gl_format(gl, bits_of(scene, camera)));
    if (image.texture && draw_to_image(&drawing, image))
        return image;
    if (!gl_is_refused(gl) && !isinf(gl->shader_seconds))
        scene_report(scene, "bad-size", scene->node, "the GPU is out of memory for a picture of this size");
    gl_image_free(gl, image);
    return none;
}

GlImage (*const scene_draw)(Gl *gl, const Scene *scene, const SceneCamera *camera,
                            const ScenePictures *pictures) = draw_view;
