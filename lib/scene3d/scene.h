// scene.h: 3-D scenes (`!canvas3d`, spec canvas3d.md). The nodes are read into groups, lights, cameras and instances of
// models, and each camera's view is rendered on the GPU.
#pragma once

#include "base/diag.h"
#include "base/file_access.h"
#include "gl/gl.h"
#include "scene3d/matrix.h"

enum { SCENE_TEXTURES = 6, SCENE_MAX_INSTANCES = 200000, SCENE_MAX_MODELS = 2000, SCENE_MAX_LIGHTS = 4000 };

// A light, stored as the four vectors that the shader reads. LIGHT_BALL is a point light with a radius.
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
    float position[3]; // for a line light: position of its start
    float radius;      // for a ball or line light: radius; for a spot light: cosine of the outer half angle
    float direction[3];
    float length; // for a line light: length; for a spot light: cosine of the inner half angle
    float falloff[4];
} SceneLight;

// The properties that determine the triangles of a model.
typedef struct SceneModel {
    uint64_t source; // for a `!model`: hash of its file's name and version, or of its vectors;
                     // for a solid: hash of its members; for other kinds: 0
    double snap;
    uint32_t segments;
    uint8_t kind; // NodeKind
    uint8_t uv_map;
    uint8_t remap;
    bool flat;
    bool invert;
    bool repair;
    bool disc;            // for a sphere: drawn as a disc that faces the camera (sphere_impostor.h)
    const DrawNode *node; // one of the nodes that have this model
} SceneModel;

// Texture maps of a surface, and how they are sampled.
typedef struct SceneTextures {
    Str ids[SCENE_TEXTURES]; // ids of pictures: colour, metal, roughness, ao, emissive, transparency; empty: none
    bool border;
    bool repeat[2];
    float border_color[4];
} SceneTextures;

// Surface parameters of an instance, in the GPU's layout.
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
    uint32_t textures; // index in the scene's textures; 0: none
} SceneMaterial;

typedef struct SceneInstance {
    Matrix matrix;
    const SceneMaterial *material;
    uint32_t model; // index in the scene's models
} SceneInstance;

typedef struct SceneGroup SceneGroup;
struct SceneGroup {
    const SceneGroup *parent; // NULL: the top group
    const DrawNode *program;  // the node, if it has shaders of the script; NULL: standard programs
    GraphicsState3D state;
    SceneLight *lights; // lights of this group only, not of its parents
    uint32_t light_count;
    uint32_t light_capacity;
    SceneInstance *instances;
    uint32_t instance_count;
    uint32_t instance_capacity;
};

typedef struct SceneCamera {
    const DrawNode *node;
    Str id;
    bool secondary; // true if the view is rendered as a separate picture
    GraphicsState3D state;
    double position[3];
    double focus[3];
    double up[3];
    int width; // size of the picture in pixels
    int height;
} SceneCamera;

typedef struct Scene {
    Arena *arena;
    const DrawNode *node; // the `!canvas3d`
    const FileAccess *reach;
    DiagSink *diags;
    SceneGroup **groups; // in drawing order
    uint32_t group_count;
    uint32_t group_capacity;
    SceneCamera *cameras; // the first camera is the default camera of the `!canvas3d`
    uint32_t camera_count;
    uint32_t camera_capacity;
    SceneModel *models;
    uint32_t model_count;
    uint32_t model_capacity;
    SceneTextures *textures; // entry 0 has no textures
    uint32_t texture_count;
    uint32_t texture_capacity;
    uint32_t instance_count;
    uint32_t light_count;
    uint32_t shown; // index of the camera that renders the node's picture
    double width;   // width of the `!canvas3d` in pixels
    double detail;  // pixels per unit; if below 1, edges are not multisampled
    int bits;       // bits per channel of the window
} Scene;

// Reads a `!canvas3d` of width x height pixels, into the arena.
Scene *scene_read(Arena *arena, const DrawNode *node, int width, int height, int bits, const FileAccess *reach,
                  DiagSink *diags);
// Returns the parameters of a camera's view. Replaces missing values by defaults, and clamps `near` and `far` to their
// limits.
Eye scene_eye(const Scene *scene, const SceneCamera *camera);
// Creates the triangles of a model in the arena. Returns false, after a report, if that is not possible.
struct Mesh;
bool scene_mesh(const Scene *scene, const SceneModel *model, Arena *arena, struct Mesh *mesh);
// Returns the properties that a node gives its model. Reports a number of segments that is too large.
SceneModel scene_model(const Scene *scene, const DrawNode *node);
// Creates the triangles of a model other than a solid, as they are before `flat` and the following attributes change
// them.
bool scene_triangles(const Scene *scene, const SceneModel *model, Arena *arena, struct Mesh *mesh);
bool scene_same_model(const SceneModel *a, const SceneModel *b);
// Copies the lights of a group and its parents to `lights`, and returns the number of copied lights, which is at most
// `max`.
uint32_t scene_lights(const SceneGroup *group, SceneLight *lights, uint32_t max);

// Returns the path of a file that a node names.
const char *scene_path(const Scene *scene, Str name);
// Returns x, limited to low..high. NaN becomes `low`.
static inline double scene_clamp(double x, double low, double high) {
    return x > low ? x < high ? x : high : low;
}
// Reports a problem of a node, unless the scene has no sink.
void scene_report(const Scene *scene, const char *code, const DrawNode *node, const char *problem);
// Reports, as an error, that a camera's view is left out because drawing it would exceed the work limit. The scene must
// have a sink.
void scene_report_missing(const Scene *scene, const DrawNode *node);

// The source of texture maps. `find` returns the current picture with this id. If there is none, the `texture` of the
// result is 0.
typedef struct ScenePictures {
    void *user_data;
    GlImage (*find)(void *user_data, Str id);
} ScenePictures;

// Renders a camera's view and returns the picture, which the caller owns. On failure, reports the problem and returns
// an image with texture 0. The pointer is NULL in builds without OpenGL, in which no caller has a Gl.
extern GlImage (*const scene_draw)(Gl *gl, const Scene *scene, const SceneCamera *camera,
                                   const ScenePictures *pictures);
