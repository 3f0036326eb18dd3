// scene_cover.h: estimates how many pixels of a picture a model covers, and how many of them nearer models hide.
#pragma once

#include "scene3d/draw_order.h"

// The image of a model's box. Places have the range -1 to 1 within the picture. Depths are coordinates z before the
// division by w, which grow with the distance from the camera.
typedef struct Footprint {
    double corners[8][2]; // undefined if is_around; bit k of the index is set if the corner has the upper coordinate k
    double depths[8];     // depths of the corners
    double low[2];        // bounds of the corners, clipped to the picture
    double high[2];
    double near;    // the least depth
    bool is_around; // true if the box is partly behind the camera, so that its image has no bounds
} Footprint;

// Returns the image of a box. `clip` is the product of projection, view and the instance's matrix.
Footprint footprint_of(const Matrix *clip, const SceneBox *box);
// Returns how many times the triangles that face one way cover the picture. At most the part `room` of the picture,
// from 0 to 1, is available to them. If `is_convex` is true, no pixel is covered more than once.
double footprint_pictures(const Footprint *print, const SceneBox *box, double room, bool is_convex);
// Returns the sum of the lengths of all triangles along the axes of the box, in widths of the picture.
double footprint_lengths(const Footprint *print, const SceneBox *box);

// The parts of a picture that opaque models hide: for each cell of a grid, the depth from which on it is hidden.
enum { HIDDEN_CELLS = 64 };
typedef struct HiddenCells {
    double depths[HIDDEN_CELLS][HIDDEN_CELLS];
} HiddenCells;

// A convex polygon within which a model hides everything from a depth on.
typedef struct HidingFace {
    double corners[8][2];
    int count; // number of corners
    double depth;
} HidingFace;

void hidden_clear(HiddenCells *hidden);
// Adds the cells that lie completely within the convex hull of a face.
void hidden_add(HiddenCells *hidden, const HidingFace *face);
// Returns the part of the picture, from 0 to 1, that the bounds of a footprint cover and where nothing hides a model at
// this depth. NULL: nothing is hidden.
double hidden_room(const HiddenCells *hidden, const Footprint *print, double depth);
// Fills *face for a model with the shape of its box, or of the ball in its box. Returns false if it is partly behind
// the camera.
bool hiding_face_of_box(const Footprint *print, HidingFace *face);
bool hiding_face_of_ball(const Matrix *clip, const SceneBox *box, HidingFace *face);
