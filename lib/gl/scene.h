// scene.h: `!canvas3d` (spec canvas3d.md): its nodes read into groups, lights, cameras and instances of models, which
// the GPU then draws once for each camera.
#ifndef PETRI_GL_SCENE_H
#define PETRI_GL_SCENE_H

#include "base/diag.h"
#include "base/file_access.h"
#include "gl/gl.h"
#include "gl/scene_matrix.h"

enum { SCENE_TEXTURES = 6, SCENE_MAX_INSTANCES = 200000, SCENE_MAX_MODELS = 2000, SCENE_MAX_LIGHTS = 4000 };

// As the shader has it: four vectors. A ball is a point with a radius.
typedef enum LightKind {
    LIGHT_AMBIENT,
    LIGHT_DIRECTIONAL,
    LIGHT_SPOT,
    LIGHT_POINT,
    LIGHT_BALL,
    LIGHT_LINE,
    LIGHT_KINDS
} LightKind;
typedef struct SceneLight {
    float color[3];
    float kind;
    float position[3]; // of a line: its start
    float radius;      // of a spot: cosine of the outer half angle
    float direction[3];
    float length; // of a line; of a spot: cosine of the inner half angle
    float falloff[4];
} SceneLight;

// The triangles of an instance: what they are made from.
typedef struct SceneModel {
    uint64_t source; // hash of the file's name and version, or of the vectors; 0: none
    double snap;
    uint32_t segments;
    uint8_t kind; // NodeKind
    uint8_t uv_map;
    uint8_t remap;
    bool flat;
    bool invert;
    bool disc;            // of a sphere: its outline alone, seen from the camera (sphere_impostor.h)
    const DrawNode *node; // one that has it
} SceneModel;

// Pictures over a surface, and how they are read.
typedef struct SceneTextures {
    Str ids[SCENE_TEXTURES]; // of color, metal, roughness, ao, emissive, transparency; empty: none
    bool border;
    bool repeat[2];
    float border_color[4];
} SceneTextures;

// What the GPU is given of each instance.
typedef struct SceneSurface {
    float albedo[3];
    float transparency;
    float emissive[3];
    float translucency;
    float ior;
    float metal;
    float roughness;
    float ao;
} SceneSurface;

typedef struct SceneMaterial {
    SceneSurface surface;
    uint32_t textures; // number of the scene's; 0: none
} SceneMaterial;

typedef struct SceneInstance {
    Matrix matrix;
    const SceneMaterial *material;
    uint32_t model;
} SceneInstance;

typedef struct SceneGroup SceneGroup;
struct SceneGroup {
    const SceneGroup *parent; // or NULL
    GraphicsState3D state;
    SceneLight *lights; // its own
    uint32_t light_count;
    uint32_t light_capacity;
    SceneInstance *instances;
    uint32_t instance_count;
    uint32_t instance_capacity;
};

typedef struct SceneCamera {
    const DrawNode *node;
    Str id;
    bool secondary;
    GraphicsState3D state;
    double position[3];
    double focus[3];
    double up[3];
    int width;
    int height;
} SceneCamera;

typedef struct Scene {
    Arena *arena;
    const DrawNode *node; // the `!canvas3d`
    const FileAccess *reach;
    DiagSink *faults;
    SceneGroup **groups; // in the order in which they are drawn
    uint32_t group_count;
    uint32_t group_capacity;
    SceneCamera *cameras; // the first is the scene's own
    uint32_t camera_count;
    uint32_t camera_capacity;
    SceneModel *models;
    uint32_t model_count;
    uint32_t model_capacity;
    SceneTextures *textures; // number 0 has none
    uint32_t texture_count;
    uint32_t texture_capacity;
    uint32_t instance_count;
    uint32_t light_count;
    uint32_t shown; // the camera whose picture is the node's
    double width;   // of the node
    double detail;  // pixels per unit; below 1 edges are not multisampled
    int bits;       // of the window
} Scene;

// Reads a `!canvas3d` that is width x height pixels large. All is in the arena.
Scene *scene_read(Arena *arena, const DrawNode *node, int width, int height, int bits, const FileAccess *reach,
                  DiagSink *faults);
// What a camera sees: near, far and the like in the limits that they have.
Eye scene_eye(const Scene *scene, const SceneCamera *camera);
// The triangles of a model, in the arena; none, after a report, if they cannot be made.
struct Mesh;
bool scene_mesh(const Scene *scene, const SceneModel *model, Arena *arena, struct Mesh *mesh);
// What the triangles of a `!model` are made from: a hash, never 0.
uint64_t scene_model_hash(const Scene *scene, const DrawNode *node);
bool scene_same_model(const SceneModel *a, const SceneModel *b);
// The lights that shine in a group, up to `most`; how many.
uint32_t scene_lights(const SceneGroup *group, SceneLight *lights, uint32_t max);

// Reports what is wrong with a node.
void scene_report(const Scene *scene, const char *code, const DrawNode *node, const char *problem);

// Where textures come from: the picture of an id as it is known now, texture 0 for none.
typedef struct ScenePictures {
    void *user_data;
    GlImage (*find)(void *host, Str id);
} ScenePictures;

// Draws what a camera sees. The picture is the caller's; texture 0, after a report, if it cannot be.
GlImage gl_scene(Gl *gl, const Scene *scene, const SceneCamera *camera, const ScenePictures *pictures);

#endif
