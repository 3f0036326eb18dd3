// automatic.h: the automatic picture of particle systems, for scripts that do not draw.
//
// Each system gets a separate panel. One- and two-dimensional systems are viewed from above, with y upwards as in
// physics. Three-dimensional systems are drawn in perspective, viewed from the front and slightly from the right and
// above.
//
// The view of a system is chosen in the first frame that has particles. If particles leave the view later, the view
// grows around its centre; it never shrinks. The view depends only on the particles of the frames for which auto_frame
// was called. Axes through the origin and a labelled scale bar provide orientation.
#pragma once

#include "picture/display_list.h"

typedef struct AutoBody {
    double position[3]; // finite
    double velocity[3];
    double radius;
    double shade; // relative charge from -1 to 1 if the system is `charged`, else relative speed from 0 to 1
    bool anchor;
} AutoBody;

// A line between two bodies that a `!distance` force connects.
typedef struct AutoLink {
    uint32_t from; // index in `bodies`
    uint32_t to;
} AutoLink;

typedef struct AutoBarrier {
    double position[3]; // a point on the wall
    double normal[3];
} AutoBarrier;

// The shorter side of a panel is AUTO_PANEL panel pixels long, whatever the size of the picture. AUTO_MARGIN is the
// fraction of this side that stays free at each edge.
enum { AUTO_PANEL = 540 };
#define AUTO_MARGIN 0.04

// A line of the scale bar, in panel pixels from the lower left corner of the panel; y points upwards.
typedef struct AutoLine {
    double x1, y1, x2, y2;
} AutoLine;

// The region of space that a panel shows: a cube around the point `middle`.
typedef struct AutoFrame {
    double middle[3];
    double half; // half the side of the cube, in the system's units; 0 until the view is chosen
} AutoFrame;

typedef struct AutoSystem {
    Str name;
    uint32_t dimensions; // 1 to 3; further dimensions are not shown
    bool charged;        // true if shades are charges, false if they are speeds
    AutoBody *bodies;
    uint32_t body_count;
    AutoLink *links;
    uint32_t link_count;
    AutoBarrier *barriers;
    uint32_t barrier_count;
    AutoFrame frame;
    AutoLine *scale; // lines of the scale bar
    uint32_t scale_count;
} AutoSystem;

typedef struct AutoPicture {
    const AutoSystem *systems;
    uint32_t count;
} AutoPicture;

// If the view of the system has not been chosen yet, chooses it and stores it in *frame. Otherwise, extends *frame if
// bodies have left the view. If there are no bodies, *frame does not change. Temporary data is allocated from the
// arena.
void auto_frame(Arena *arena, AutoFrame *frame, const AutoSystem *system);
// Creates the lines of the scale bar for system->frame and stores them in system->scale.
void auto_scale(Arena *arena, AutoSystem *system);

// A gradient from one circle to another: centre x, y and radius of each.
typedef struct AutoGradient {
    double inner[3];
    double outer[3];
    DisplayStop stops[3];
} AutoGradient;

// A shape of the picture, in the picture's units.
typedef struct AutoShape {
    const double *path; // path elements and their operands, as in DisplayList.numbers
    uint32_t length;
    double line; // width of the line; 0: the shape is filled
    double color[4];
    const AutoGradient *gradient; // NULL: use `color`
} AutoShape;

#define AUTO_GROUND 0.06, 0.07, 0.09 // colour of the background

// What the picture is drawn on. The caller fills it with AUTO_GROUND first.
typedef struct AutoTarget {
    Arena *arena; // for temporary data
    double width; // size in the picture's units
    double height;
    double scale; // pixels per unit
    // Begins a panel: clips to a box, x, y, width and height. NULL ends the panel.
    void (*clip)(void *context, const double *box);
    void (*draw)(void *context, const AutoShape *shape);
    void *context;
} AutoTarget;

void auto_draw(const AutoTarget *target, const AutoPicture *picture);
