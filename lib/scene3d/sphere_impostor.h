// sphere_impostor.h: spheres drawn as discs.
//
// The outline of a sphere, as seen from the camera, is a circle. The sphere is drawn as a disc that fills this circle.
// For each point of the disc, the fragment shader intersects the camera's ray with the sphere. This gives the position
// and normal of the sphere's surface at this point. A disc of 64 corners has 62 triangles. A sphere of 64 segments has
// 2048, and most of them are smaller than the blocks of pixels that GPUs shade. If earlier draws have written depth,
// the shader also writes the sphere's depth, once for all samples of a pixel.
#pragma once

#include "scene3d/scene.h"

typedef struct SphereImpostor {
    Matrix place; // transform of a disc of radius 1 facing z; the third column has length 1 and points to the camera
    double middle[3];
    double radius; // radius of the sphere
    double near;   // radius divided by the distance from the camera to the centre; 0 without perspective
} SphereImpostor;

// Computes the disc for a sphere of radius 1 that is transformed by `place`. Returns false if the transformed sphere is
// an ellipsoid or mirrored, is clipped by the near or far plane, or almost touches the camera.
bool sphere_impostor(const Eye *eye, const Matrix *view, const Matrix *place, SphereImpostor *disc);
