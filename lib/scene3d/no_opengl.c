// no_opengl.c: replaces scene_draw.c in builds without OpenGL.
#include "scene3d/scene.h"

GlImage (*const scene_draw)(Gl *gl, const Scene *scene, const SceneCamera *camera,
                            const ScenePictures *pictures) = NULL;
