// sphere_impostor.h: balls drawn as discs.
//
// Seen from a camera, a ball is the disc that its outline bounds, and where a ray through the disc meets the ball is
// known: a fragment shader finds place and normal by itself. A disc of 64 corners has 62 triangles, a ball 2048, most
// of which are smaller than the blocks of pixels in which surfaces are shaded. The shader tells the ball's depth, too,
// once for all samples of a pixel, where there is something to compare it with.
#ifndef PETRI_GL_SPHERE_IMPOSTOR_H
#define PETRI_GL_SPHERE_IMPOSTOR_H

#include "gl/scene.h"

typedef struct SphereImpostor {
    Matrix place; // of a disc of radius 1 towards z; its third column is of length 1, towards the camera
    double middle[3];
    double radius; // of the ball
    double near;   // radius / distance from the camera; 0 without perspective
} SphereImpostor;

// The disc of a ball of radius 1 that is placed so; false if it is no ball there, or too near or too far to be seen
// whole.
bool sphere_impostor(const Eye *eye, const Matrix *view, const Matrix *place, SphereImpostor *disc);

#endif
