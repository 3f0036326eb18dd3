// automatic.h: the picture of particle systems by themselves, for scripts that do not draw.
//
// Each system gets a panel of its own. One and two dimensions are seen from above (y upwards, as in physics), three in
// perspective from the front, a little to the right and above. What is framed changes only when it must: it grows as
// soon as particles leave it, and shrinks when they need less than half of it.
#ifndef PETRI_DRAW_AUTOMATIC_H
#define PETRI_DRAW_AUTOMATIC_H

#include "base/arena.h"
#include "base/str.h"

typedef struct AutoBody {
    double position[3]; // finite
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
} AutoSystem;

typedef struct AutoPicture {
    const AutoSystem *systems;
    uint32_t count;
} AutoPicture;

// Chooses what is shown of a system, given what was shown of it before. The arena is for temporaries.
void auto_frame(Arena *arena, AutoFrame *frame, const AutoSystem *system);

#endif
