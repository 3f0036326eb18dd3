// gpu_cache.h: what is kept on the GPU from scene to scene: triangles of models, buffers, targets.
#ifndef PETRI_GL_GPU_CACHE_H
#define PETRI_GL_GPU_CACHE_H

#include "gl/draw_order.h"
#include "gl/internal.h"

typedef struct SceneShape {
    GLuint array; // vertex array with the corners: attributes 0 to 2; 0: there is nothing to draw
    GLuint corners;
    GLuint indices;
    GLsizei index_count;
    SceneBox box;
} SceneShape;

// A depth buffer, and colours with several samples a pixel if there are such.
typedef struct SceneTarget {
    GLuint framebuffer;
    GLuint color; // 0: one sample a pixel, drawn to the picture itself
    GLuint depth;
    int width;
    int height;
    int samples;
    GlFormat format;
    bool extra;    // of a picture that is made in the midst of another
    uint64_t used; // when, in scenes
    size_t charged;
} SceneTarget;

enum { SCENE_TARGETS = 8 };

typedef struct CachedModel CachedModel;

struct GpuCache {
    CachedModel *models; // models
    uint64_t now;        // scenes drawn so far
    SceneTarget targets[SCENE_TARGETS];
    GLuint instances; // buffer
    GLuint light_block;
    GLuint light_texture;
};

// NULL if memory is used up.
GpuCache *gpu_cache(Gl *gl);
// The triangles of a model: made when they are first needed, kept while scenes have them.
const SceneShape *gpu_cache_shape(GpuCache *store, const Scene *scene, const SceneModel *model);
// NULL if the GPU cannot do that.
SceneTarget *gpu_cache_target(Gl *gl, int width, int height, int samples, GlFormat format, bool extra);
// Sets the attributes of instances of the shape that is bound to those at a number in the buffer.
void gpu_cache_bind_instances(const GpuCache *store, const SceneShape *shape, uint32_t first);

// What the vertex shader has of an instance.
typedef struct SceneRecord {
    float matrix[16];
    float cofactors[9];
    SceneSurface surface;
} SceneRecord;

#endif
