// noise_point.h: classic OpenSimplex noise at one point; private to lib/builtin.
#pragma once

#include "maths/arrays.h"

#include <stdint.h>

// These functions return the noise at the point c, which has two, three or four coordinates. `permutation` contains the
// numbers 0 to 255.
double noise_point_2(const uint8_t *permutation, const double *c);
double noise_point_3(const uint8_t *permutation, const double *c);
double noise_point_4(const uint8_t *permutation, const double *c);

// Returns the constants with which ArraysIsa.plane_noise computes the same results as noise_point_2.
PlaneNoise noise_plane(void);
