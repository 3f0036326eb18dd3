// gpu_cache.h: GPU resources that are kept between scenes: triangles of models, buffers and render targets.
#ifndef PETRI_GL_GPU_CACHE_H
#define PETRI_GL_GPU_CACHE_H

#include "gl/draw_order.h"
#include "gl/internal.h"

typedef struct SceneShape {
    GLuint array; // vertex array with the corners in attributes 0 to 2; 0: nothing to draw
    GLuint corners;
    GLuint indices;
    GLsizei index_count;
    SceneBox box;
} SceneShape;

// A depth buffer and, with multisampling, a colour buffer.
typedef struct SceneTarget {
    GLuint framebuffer;
    GLuint color; // 0: not multisampled; draws directly to the picture
    GLuint depth;
    int width;
    int height;
    int samples;
    GlFormat format;
    bool extra;    // for a picture that is rendered while another one is being rendered
    uint64_t used; // GpuCache.now when it was last used
    size_t charged;
} SceneTarget;

enum { SCENE_TARGETS = 8 };

typedef struct CachedModel CachedModel;

struct GpuCache {
    Budget *budget; // that of Gl; charged for the meshes
    CachedModel *models;
    uint64_t now; // number of scenes drawn so far
    SceneTarget targets[SCENE_TARGETS];
    GLuint instances;     // buffer of SceneRecords
    GLuint light_block;   // uniform buffer
    GLuint light_texture; // for groups with more lights than fit into the buffer
};

// Returns the cache, which the first call creates. Returns NULL if out of memory.
GpuCache *gpu_cache(Gl *gl);
// Returns the triangles of a model. They are created when first needed, and kept as long as scenes use them.
const SceneShape *gpu_cache_shape(GpuCache *store, const Scene *scene, const SceneModel *model);
// Returns a target with these properties, from the cache or new. Returns NULL if out of memory.
SceneTarget *gpu_cache_target(Gl *gl, int width, int height, int samples, GlFormat format, bool extra);
// Binds the shape, with instance attributes that start at record `first` of the instance buffer.
void gpu_cache_bind_instances(const GpuCache *store, const SceneShape *shape, uint32_t first);

// The vertex shader's attributes of an instance.
typedef struct SceneRecord {
    float matrix[16];
    float cofactors[9];
    SceneSurface surface;
} SceneRecord;

#endif
