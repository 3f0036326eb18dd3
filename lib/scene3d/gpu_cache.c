// gpu_cache.c: see gpu_cache.h.
//
// All memory on the GPU is charged to the painter's budget. If it refuses a target, all others are freed before petri
// tries again. A model is freed when MAX_IDLE_SCENES scenes have not used it. After the context was lost, nothing is
// deleted.
#include "scene3d/gpu_cache.h"

#include "base/heap.h"
#include "scene3d/mesh.h"

#include <string.h>

enum { MAX_IDLE_SCENES = 30 }; // a model is freed after more than this number of scenes that do not use it

struct CachedModel {
    CachedModel *next;
    SceneModel model;
    SceneShape shape;
    uint64_t used;
    size_t charged;
    bool refused; // true if the mesh would have exceeded the memory or work limit
};

static void free_model(const Gl *gl, CachedModel *model_entry) {
    budget_release(gl->budget, model_entry->charged);
    if (!gl->lost) {
        glDeleteVertexArrays(1, &model_entry->shape.array);
        glDeleteBuffers(1, &model_entry->shape.corners);
        glDeleteBuffers(1, &model_entry->shape.indices);
    }
    heap_free(model_entry);
}

static void free_target(Gl *gl, SceneTarget *target) {
    budget_release(gl->budget, target->charged);
    if (!gl->lost) {
        glDeleteFramebuffers(1, &target->framebuffer);
        glDeleteRenderbuffers(1, &target->color);
        glDeleteRenderbuffers(1, &target->depth);
    }
    *target = (SceneTarget){.framebuffer = 0};
}

static void close_cache(Gl *gl) {
    GpuCache *store = gl->cache;
    for (CachedModel *model_entry = store->models, *next; model_entry; model_entry = next) {
        next = model_entry->next;
        free_model(gl, model_entry);
    }
    for (int i = 0; i < SCENE_TARGETS; i++)
        free_target(gl, &store->targets[i]);
    if (!gl->lost) {
        glDeleteBuffers(1, &store->instances);
        glDeleteBuffers(1, &store->light_block);
        glDeleteBuffers(1, &store->group_block);
        glDeleteTextures(1, &store->light_texture);
    }
    heap_free(store);
    gl->cache = NULL;
    gl->close_scenes = NULL;
}

GpuCache *gpu_cache(Gl *gl) {
    if (gl->cache)
        return gl->cache;
    GpuCache *store = gl->cache = heap_calloc(1, sizeof *store);
    if (!store)
        return NULL;
    gl->close_scenes = close_cache;
    glGenBuffers(1, &store->instances);
    glGenBuffers(1, &store->light_block);
    glGenBuffers(1, &store->group_block);
    glGenTextures(1, &store->light_texture);
    glBindTexture(GL_TEXTURE_2D, store->light_texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return store;
}

static void evict_old_models(const Gl *gl) {
    GpuCache *store = gl->cache;
    for (CachedModel **at = &store->models; *at;) {
        CachedModel *model_entry = *at;
        if (model_entry->used + MAX_IDLE_SCENES < store->now) {
            *at = model_entry->next;
            free_model(gl, model_entry);
        } else {
            at = &model_entry->next;
        }
    }
}

static void upload_mesh(SceneShape *shape, const Mesh *mesh) {
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

// Arguments of build_mesh, which is called through arena_protect.
typedef struct MeshBuild {
    const Scene *scene;
    const SceneModel *model;
    Arena arena; // holds the mesh until it is uploaded; charged to the painter's budget
    Mesh mesh;
    bool done;
} MeshBuild;

static void build_mesh(void *context) {
    MeshBuild *build = context;
    build->done = scene_mesh(build->scene, build->model, &build->arena, &build->mesh);
}

// Stores the mesh of an entry on the GPU.
static void store_mesh(const Gl *gl, CachedModel *model_entry, const Mesh *mesh) {
    size_t bytes = mesh->vertex_count * sizeof(MeshVertex) + mesh->index_count * sizeof(uint32_t);
    model_entry->refused = !budget_reserve(gl->budget, bytes);
    if (model_entry->refused)
        return;
    model_entry->charged = bytes;
    upload_mesh(&model_entry->shape, mesh);
    SceneBox *box = &model_entry->shape.box;
    mesh_bounds(mesh, box->low, box->high);
    mesh_measure(mesh, box->low, box->high, box->layers, box->lengths);
    box->triangles = mesh->index_count / 3;
}

// Builds the mesh of an entry. If that exceeds a limit, marks the entry as refused.
static void make_shape(const Gl *gl, CachedModel *model_entry, const Scene *scene) {
    MeshBuild build = {.scene = scene, .model = &model_entry->model};
    arena_init(&build.arena, "mesh", SIZE_MAX);
    build.arena.budget = gl->budget;
    Arena *arenas[] = {&build.arena, scene->arena, scene->diags->arena};
    ArenaOutcome end = arena_protect(arenas, 3, build_mesh, &build);
    if (end == ARENA_OK && build.done)
        store_mesh(gl, model_entry, &build.mesh);
    arena_free(&build.arena);
    if (end == ARENA_OUT_OF_MEMORY)
        arena_exhausted(scene->arena);
    model_entry->refused = model_entry->refused || end != ARENA_OK;
    if (end == ARENA_WORK_LIMIT) {
        gl->budget->work = gl->budget->work_limit; // it is work_limit + 1 after the limit was exceeded
        scene_report(scene, "drawing-limit", model_entry->model.node,
                     "drawing exceeded the work limit (--work): the model is left out");
    }
}

const SceneShape *gpu_cache_shape(const Gl *gl, const Scene *scene, const SceneModel *model) {
    GpuCache *store = gl->cache;
    for (CachedModel *model_entry = store->models; model_entry; model_entry = model_entry->next)
        if (scene_same_model(&model_entry->model, model)) {
            bool is_tried = model_entry->used == store->now;
            model_entry->used = store->now;
            if (model_entry->shape.array || is_tried ||
                (model_entry->model.kind != KIND_MODEL && !model_entry->refused))
                return &model_entry->shape;
            break; // creates the model again, so that the problem is reported in each scene
        }
    CachedModel *model_entry = heap_calloc(1, sizeof *model_entry);
    if (!model_entry)
        arena_exhausted(scene->arena);
    *model_entry = (CachedModel){.next = store->models, .model = *model, .used = store->now};
    store->models = model_entry; // from now on, the cache owns the entry
    evict_old_models(gl);
    make_shape(gl, model_entry, scene);
    return &model_entry->shape;
}

void gpu_cache_bind_instances(const GpuCache *store, const SceneShape *shape, uint32_t first) {
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

// Returns the largest number of samples, from 2 to `wanted`, that the GPU supports for this format. Returns 0 if there
// is none.
static int samples_for(int wanted, GLenum format) {
    GLint count = 0, list[16] = {0};
    glGetInternalformativ(GL_RENDERBUFFER, format, GL_NUM_SAMPLE_COUNTS, 1, &count);
    glGetInternalformativ(GL_RENDERBUFFER, format, GL_SAMPLES, count < 16 ? count : 16, list);
    for (int i = 0; i < count && i < 16; i++) // OpenGL lists the numbers in descending order
        if (list[i] <= wanted && list[i] >= 2)
            return list[i];
    return 0;
}

static bool make_target(SceneTarget *target) {
    static const GLenum inner[] = {[GL_FORMAT_SRGB8] = GL_SRGB8_ALPHA8,
                                   [GL_FORMAT_RGBA8] = GL_RGBA8,
                                   [GL_FORMAT_RGBA16F] = GL_RGBA16F,
                                   [GL_FORMAT_RGBA32F] = GL_RGBA32F};
    const double MAX_BYTES = 2e9;
    int samples = target->samples;
    while (samples > 1 && 12.0 * target->width * target->height * samples > MAX_BYTES)
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

// Charges a target to the budget. If the budget refuses, frees all other targets and tries again.
static bool charge_target(Gl *gl, SceneTarget *target) {
    size_t pixel = 4 + (target->samples > 0 ? gl_pixel_size(target->format) : 0); // depth, and colour if multisampled
    size_t bytes =
        (size_t)target->width * (size_t)target->height * pixel * (size_t)(target->samples > 0 ? target->samples : 1);
    bool known = gl_is_refused(gl), fits = budget_reserve(gl->budget, bytes);
    for (int i = 0; !fits && i < SCENE_TARGETS; i++)
        if (&gl->cache->targets[i] != target)
            free_target(gl, &gl->cache->targets[i]);
    if (!fits && (fits = budget_reserve(gl->budget, bytes)))
        gl->budget->memory_refused = known;
    target->charged = fits ? bytes : 0;
    return fits;
}

SceneTarget *gpu_cache_target(Gl *gl, int width, int height, int samples, GlFormat format, bool extra) {
    GpuCache *store = gl->cache;
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
    if (charge_target(gl, oldest) && make_target(oldest))
        return oldest;
    free_target(gl, oldest);
    return NULL;
}
