// gpu_cache.h: GPU resources that are kept between scenes: triangles of models, buffers and render targets.
#pragma once

#include "gl/context.h"
#include "scene3d/draw_order.h"

typedef struct SceneShape {
    GLuint array; // vertex array whose attributes 0 to 2 describe the corners; 0: nothing to draw
    GLuint corners;
    GLuint indices;
    GLsizei index_count;
    SceneBox box;
} SceneShape;

// A depth buffer and, with multisampling, a colour buffer.
typedef struct SceneTarget {
    GLuint framebuffer;
    GLuint color; // multisampled colour buffer; 0: no multisampling, the colours are drawn directly to the picture
    GLuint depth;
    int width;
    int height;
    int samples;
    GlFormat format;
    bool extra;    // true if the target is for a picture that is rendered while another picture is being rendered
    uint64_t used; // value of GpuCache.now when the target was last used
    size_t charged;
} SceneTarget;

enum { SCENE_TARGETS = 8 };

typedef struct CachedModel CachedModel;

struct GpuCache {
    CachedModel *models;
    uint64_t now; // number of scenes drawn so far
    SceneTarget targets[SCENE_TARGETS];
    GLuint instances;     // buffer of SceneRecords
    GLuint light_block;   // uniform buffer with the lights of a group
    GLuint group_block;   // uniform buffer of programs that scripts give to groups
    GLuint light_texture; // texture of the lights of a group, if these do not fit into light_block
};

// Returns the cache, which the first call creates. Returns NULL if out of memory.
GpuCache *gpu_cache(Gl *gl);
// Returns the triangles of a model. The triangles are created when they are first needed, and kept as long as scenes
// use them.
const SceneShape *gpu_cache_shape(const Gl *gl, const Scene *scene, const SceneModel *model);
// Returns a target with these properties, from the cache or new. Returns NULL if out of memory.
SceneTarget *gpu_cache_target(Gl *gl, int width, int height, int samples, GlFormat format, bool extra);
// Binds the vertex array of the shape. The attributes of its instances are read from the instance buffer, starting at
// record `first`.
void gpu_cache_bind_instances(const GpuCache *store, const SceneShape *shape, uint32_t first);

// One record of the instance buffer: the attributes that the vertex shader reads for an instance.
typedef struct SceneRecord {
    float matrix[16];
    float cofactors[9];
    SceneSurface surface;
} SceneRecord;
