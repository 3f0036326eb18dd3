// automatic.h: the picture of particle systems by themselves, for scripts that do not draw.
//
// Each system gets a panel of its own. One and two dimensions are seen from above (y upwards, as in physics), three in
// perspective from the front, a little to the right and above.
//
// The frame is chosen from the first frame that has particles, and grows about its middle when particles leave it, so
// it depends only on the particles of the frames that auto_frame was called for, and never shrinks. Lines through the
// origin, and a bar with its length, show what moved.
#ifndef PETRI_DRAW_AUTOMATIC_H
#define PETRI_DRAW_AUTOMATIC_H

#include "base/arena.h"
#include "base/str.h"

typedef struct AutoBody {
    double position[3]; // finite
    double velocity[3];
    double radius;
    double shade; // -1 … 1: charge, or 0 … 1: speed
    bool anchor;
} AutoBody;

typedef struct AutoLink {
    uint32_t from;
    uint32_t to;
} AutoLink;

typedef struct AutoBarrier {
    double position[3];
    double normal[3];
} AutoBarrier;

// Sides in pixels: a panel's shorter side has AUTO_PANEL, of which AUTO_MARGIN on each side stays free.
enum { AUTO_PANEL = 540 };
#define AUTO_MARGIN 0.04

// In pixels to the right and up from the lower left corner of the panel.
typedef struct AutoLine {
    double x1, y1, x2, y2;
} AutoLine;

// What of space is shown: a box around a middle.
typedef struct AutoFrame {
    double middle[3];
    double half; // half its width; 0: not chosen yet
} AutoFrame;

typedef struct AutoSystem {
    Str name;
    uint32_t dimensions; // 1 to 3; further ones are not seen
    bool charged;        // shades are charges
    AutoBody *bodies;
    uint32_t body_count;
    AutoLink *links;
    uint32_t link_count;
    AutoBarrier *barriers;
    uint32_t barrier_count;
    AutoFrame frame;
    AutoLine *scale;
    uint32_t scale_count;
} AutoSystem;

typedef struct AutoPicture {
    const AutoSystem *systems;
    uint32_t count;
} AutoPicture;

// Chooses the frame of a system, or extends it. Without bodies it stays as it is. The arena is for temporaries.
void auto_frame(Arena *arena, AutoFrame *frame, const AutoSystem *system);
// Makes the lines of the scale for the system's frame.
void auto_scale(Arena *arena, AutoSystem *system);

#endif
