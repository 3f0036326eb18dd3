// scene_store.c: see scene_store.h.
#include "gl/scene_store.h"

#include "base/heap.h"
#include "gl/scene_mesh.h"

#include <string.h>

enum { KEEP_FOR = 30 }; // scenes after the last that had a model

struct SceneKept {
    SceneKept *next;
    SceneModel model;
    SceneShape shape;
    uint64_t used;
};

GlStore *gl_store(Gl *gl) {
    if (gl->store)
        return gl->store;
    GlStore *store = gl->store = heap_zeroed(1, sizeof *store);
    if (!store)
        return NULL;
    glGenBuffers(1, &store->instances);
    glGenBuffers(1, &store->light_block);
    glGenTextures(1, &store->light_texture);
    glBindTexture(GL_TEXTURE_2D, store->light_texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return store;
}

static void free_kept(bool lost, SceneKept *kept) {
    if (!lost) {
        glDeleteVertexArrays(1, &kept->shape.array);
        glDeleteBuffers(1, &kept->shape.corners);
        glDeleteBuffers(1, &kept->shape.indices);
    }
    heap_give(kept);
}

static void free_target(Gl *gl, SceneTarget *target) {
    meter_give(gl->meter, target->charged);
    if (!gl->lost) {
        glDeleteFramebuffers(1, &target->framebuffer);
        glDeleteRenderbuffers(1, &target->color);
        glDeleteRenderbuffers(1, &target->depth);
    }
    *target = (SceneTarget){.framebuffer = 0};
}

void gl_store_close(Gl *gl) {
    GlStore *store = gl->store;
    if (!store)
        return;
    for (SceneKept *kept = store->kept, *next; kept; kept = next) {
        next = kept->next;
        free_kept(gl->lost, kept);
    }
    for (int i = 0; i < SCENE_TARGETS; i++)
        free_target(gl, &store->targets[i]);
    if (!gl->lost) {
        glDeleteBuffers(1, &store->instances);
        glDeleteBuffers(1, &store->light_block);
        glDeleteTextures(1, &store->light_texture);
    }
    heap_give(store);
    gl->store = NULL;
}

static void forget_old(GlStore *store) {
    for (SceneKept **at = &store->kept; *at;) {
        SceneKept *kept = *at;
        if (kept->used + KEEP_FOR < store->now) {
            *at = kept->next;
            free_kept(false, kept);
        } else {
            at = &kept->next;
        }
    }
}

static void send(SceneShape *shape, const Mesh *mesh) {
    glGenVertexArrays(1, &shape->array);
    glGenBuffers(1, &shape->corners);
    glGenBuffers(1, &shape->indices);
    glBindVertexArray(shape->array);
    glBindBuffer(GL_ARRAY_BUFFER, shape->corners);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(mesh->vertex_count * sizeof(MeshVertex)), mesh->vertices,
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, shape->indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(mesh->index_count * sizeof(uint32_t)), mesh->indices,
                 GL_STATIC_DRAW);
    static const struct {
        GLint size;
        size_t at;
    } parts[] = {{3, offsetof(MeshVertex, position)}, {3, offsetof(MeshVertex, normal)}, {2, offsetof(MeshVertex, uv)}};
    for (GLuint i = 0; i < 3; i++) {
        glVertexAttribPointer(i, parts[i].size, GL_FLOAT, GL_FALSE, sizeof(MeshVertex), (const void *)parts[i].at);
        glEnableVertexAttribArray(i);
    }
    for (GLuint i = 3; i < 13; i++) {
        glEnableVertexAttribArray(i);
        glVertexAttribDivisor(i, 1);
    }
    shape->index_count = (GLsizei)mesh->index_count;
}

const SceneShape *gl_store_shape(GlStore *store, const Scene *scene, const SceneModel *model) {
    for (SceneKept *kept = store->kept; kept; kept = kept->next)
        if (scene_same_model(&kept->model, model)) {
            kept->used = store->now;
            if (kept->shape.array || kept->model.kind != KIND_MODEL)
                return &kept->shape;
            break; // what is wrong is reported in each scene
        }
    ArenaMark mark = arena_mark(scene->arena);
    Mesh mesh;
    SceneKept *kept = heap_zeroed(1, sizeof *kept);
    if (!kept)
        arena_exhausted(scene->arena);
    *kept = (SceneKept){.next = store->kept, .model = *model, .used = store->now};
    store->kept = kept; // from here on it is freed with the store
    forget_old(store);
    if (scene_mesh(scene, model, scene->arena, &mesh)) {
        send(&kept->shape, &mesh);
        mesh_box_of(&mesh, kept->shape.box.low, kept->shape.box.high);
        kept->shape.box.triangles = mesh.index_count / 3;
    }
    arena_rewind(scene->arena, mark);
    return &kept->shape;
}

void gl_store_point(const GlStore *store, const SceneShape *shape, uint32_t first) {
    const size_t size = sizeof(SceneRecord), start = first * size;
    glBindVertexArray(shape->array);
    glBindBuffer(GL_ARRAY_BUFFER, store->instances);
    for (GLuint i = 0; i < 4; i++)
        glVertexAttribPointer(3 + i, 4, GL_FLOAT, GL_FALSE, (GLsizei)size,
                              (const void *)(start + offsetof(SceneRecord, matrix) + 16 * (size_t)i));
    for (GLuint i = 0; i < 3; i++) {
        glVertexAttribPointer(7 + i, 3, GL_FLOAT, GL_FALSE, (GLsizei)size,
                              (const void *)(start + offsetof(SceneRecord, cofactors) + 12 * (size_t)i));
        glVertexAttribPointer(10 + i, 4, GL_FLOAT, GL_FALSE, (GLsizei)size,
                              (const void *)(start + offsetof(SceneRecord, surface) + 16 * (size_t)i));
    }
}

// As many as are wanted and the GPU has for this format; 0 for fewer than 2.
static int samples_for(int wanted, GLenum format) {
    GLint count = 0, list[16] = {0};
    glGetInternalformativ(GL_RENDERBUFFER, format, GL_NUM_SAMPLE_COUNTS, 1, &count);
    glGetInternalformativ(GL_RENDERBUFFER, format, GL_SAMPLES, count < 16 ? count : 16, list);
    for (int i = 0; i < count && i < 16; i++) // from the most
        if (list[i] <= wanted && list[i] >= 2)
            return list[i];
    return 0;
}

static bool make_target(SceneTarget *target) {
    static const GLenum inner[] = {[GL_FORMAT_SRGB8] = GL_SRGB8_ALPHA8,
                                   [GL_FORMAT_RGBA8] = GL_RGBA8,
                                   [GL_FORMAT_RGBA16F] = GL_RGBA16F,
                                   [GL_FORMAT_RGBA32F] = GL_RGBA32F};
    const double MOST_BYTES = 2e9;
    int samples = target->samples;
    while (samples > 1 && 12.0 * target->width * target->height * samples > MOST_BYTES)
        samples /= 2;
    samples = samples_for(samples, inner[target->format]);
    while (glGetError() != GL_NO_ERROR)
        ;
    glGenFramebuffers(1, &target->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    glGenRenderbuffers(1, &target->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, target->depth);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, target->width, target->height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, target->depth);
    if (samples > 0) {
        glGenRenderbuffers(1, &target->color);
        glBindRenderbuffer(GL_RENDERBUFFER, target->color);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, inner[target->format], target->width,
                                         target->height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target->color);
    }
    return glGetError() == GL_NO_ERROR;
}

// Charges a target, if need be in place of all others.
static bool charge(Gl *gl, SceneTarget *target) {
    size_t pixel = 4 + (target->samples > 0 ? gl_pixel_size(target->format) : 0); // depth, and what is resolved
    size_t bytes =
        (size_t)target->width * (size_t)target->height * pixel * (size_t)(target->samples > 0 ? target->samples : 1);
    bool known = gl_is_refused(gl), taken = meter_take(gl->meter, bytes);
    for (int i = 0; !taken && i < SCENE_TARGETS; i++)
        if (&gl->store->targets[i] != target)
            free_target(gl, &gl->store->targets[i]);
    if (!taken && (taken = meter_take(gl->meter, bytes)))
        gl->meter->memory_refused = known;
    target->charged = taken ? bytes : 0;
    return taken;
}

SceneTarget *gl_store_target(Gl *gl, int width, int height, int samples, GlFormat format, bool extra) {
    GlStore *store = gl->store;
    SceneTarget *oldest = &store->targets[0];
    for (int i = 0; i < SCENE_TARGETS; i++) {
        SceneTarget *target = &store->targets[i];
        if (target->framebuffer && target->width == width && target->height == height && target->samples == samples &&
            target->format == format && target->extra == extra) {
            target->used = store->now;
            return target;
        }
        if (target->used < oldest->used)
            oldest = target;
    }
    free_target(gl, oldest);
    *oldest = (SceneTarget){
        .width = width, .height = height, .samples = samples, .format = format, .extra = extra, .used = store->now};
    if (charge(gl, oldest) && make_target(oldest))
        return oldest;
    free_target(gl, oldest);
    return NULL;
}
