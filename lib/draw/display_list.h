// display_list.h: a drawing as a list of commands in flat arrays: what is drawn, in which order, with plain numbers.
// Nodes and what they inherit are gone; whoever can fill, stroke and clip paths can show it (cairo_backend.c does with
// Cairo).
//
// All references are numbers of elements; DISPLAY_NONE is none. Lists live in the arena with which they are built and
// never change afterwards; texts are borrowed from the nodes.
#ifndef PETRI_DRAW_DISPLAY_LIST_H
#define PETRI_DRAW_DISPLAY_LIST_H

#include "canvas/drawing.h"

#define DISPLAY_NONE UINT32_MAX

// x' = xx x + xy y + x0, y' = yx x + yy y + y0
typedef struct DisplayMatrix {
    double xx, yx, xy, yy, x0, y0;
} DisplayMatrix;

// Pieces of paths in `numbers`: the kind, and then its numbers.
typedef enum PathElement {
    PATH_MOVE,       // x, y
    PATH_LINE,       // x, y
    PATH_QUADRATIC,  // control x, y, end x, y
    PATH_CUBIC,      // two controls and an end
    PATH_ARC,        // begins a figure: middle x, y, radii x, y, start and sweep in turns, clockwise
    PATH_ARC_JOINED, // the same, joined by a line
    PATH_ARC_TO,     // radii x, y, rotation in turns, large and clockwise (0 or 1), end x, y
    PATH_CLOSE,
} PathElement;

// Pieces that follow each other in `numbers`.
typedef struct DisplayRun {
    uint32_t start;
    uint32_t end;
    uint32_t next; // run; DISPLAY_NONE
} DisplayRun;

// A path is what its runs say, up to `end` in the last of them.
typedef struct DisplayPath {
    uint32_t first; // DISPLAY_NONE: empty
    uint32_t last;
    uint32_t end;
    uint8_t fill_type;
} DisplayPath;

typedef enum DisplaySourceKind {
    SOURCE_COLOR,
    SOURCE_LINEAR,
    SOURCE_RADIAL,
    SOURCE_PATTERN,
    SOURCE_BLEND,
    SOURCE_NOISE
} DisplaySourceKind;

typedef struct DisplayStop {
    double offset;
    double color[4];
} DisplayStop;

// What gives each point its colour.
typedef struct DisplaySource {
    DisplaySourceKind kind;
    double color[4];
    double ends[4];       // of a linear gradient; frequencies and tile of noise
    DisplayMatrix matrix; // of the unit circle of a radial gradient; of a pattern
    uint32_t first_stop;  // or the first source of a blend
    uint32_t stop_count;  // or its second source; or the octaves of noise
    double ratio;         // nan: `mode` counts; or the seed of noise
    int mode;             // or the type of noise
    uint32_t image;
} DisplaySource;

typedef enum DisplayFilterKind {
    FILTER_BLUR,
    FILTER_SHADOW,
    FILTER_OFFSET,
    FILTER_DILATE,
    FILTER_ERODE,
    FILTER_COLOUR_MATRIX,
    FILTER_PAINT,
    FILTER_BLEND,
    FILTER_SOURCE // what is drawn, as it is
} DisplayFilterKind;

typedef struct DisplayFilter {
    DisplayFilterKind kind;
    double radius[2];
    double offset[2];
    double color[4];
    bool only;
    int mode;
    uint32_t paint;
    uint32_t numbers;   // in `numbers`: 20 of a matrix, 4 coefficients of a blend; DISPLAY_NONE: its mode counts
    uint32_t inputs[2]; // filters; DISPLAY_NONE: what is drawn, or none
    Origin place;       // of its node
} DisplayFilter;

typedef enum DisplayEffectKind {
    EFFECT_DASH,
    EFFECT_ROUND,
    EFFECT_JITTER,
    EFFECT_MATRIX,
    EFFECT_SUM
} DisplayEffectKind;

// What changes a figure before it is filled or stroked.
typedef struct DisplayEffect {
    DisplayEffectKind kind;
    uint32_t inner;   // an effect that comes first; DISPLAY_NONE
    uint32_t numbers; // in `numbers`: dashes, 9 of a matrix by rows, the effects of a sum
    uint32_t count;
    double amounts[2]; // offset of dashes; radius; length and deviation
    double seed;
    Origin place;
} DisplayEffect;

// How something is painted.
typedef struct DisplayPaint {
    double color[4]; // its alpha counts for sources and images, too
    double stroke_width;
    uint32_t source;
    uint32_t filter;
    uint32_t effect;
    int join;
    int cap;
    int composite;
    bool antialias;
} DisplayPaint;

typedef struct DisplayText {
    Str text;
    const char *family;
    double size;
    double weight;
    int width;
    double point[2];
    int slant;
    bool center;
} DisplayText;

typedef enum DisplayFit { FIT_NONE, FIT_SIZE, FIT_INSIDE, FIT_FILL } DisplayFit;

typedef struct DisplayImage {
    Str file; // or
    Str id;
    double point[2];
    double size[2];
    DisplayFit fit;
    NodeKind kind; // of its node
    Origin place;
} DisplayImage;

typedef enum DisplayCommandKind {
    DISPLAY_DRAW, // path
    DISPLAY_TEXT,
    DISPLAY_IMAGE,
    DISPLAY_CLIP,      // to the path
    DISPLAY_MASK,      // to what is outside of it
    DISPLAY_SAVE,      // the clip
    DISPLAY_RESTORE,   // it
    DISPLAY_LAYER,     // what follows is drawn on a transparent layer,
    DISPLAY_LAYER_END, // which is laid over with this alpha
} DisplayCommandKind;

typedef struct DisplayCommand {
    DisplayCommandKind kind;
    bool fill; // fill and stroke are one figure
    bool stroke;
    uint32_t matrix;
    uint32_t paint;
    uint32_t item; // text, image; place of a layer
    DisplayPath path;
    double alpha;
} DisplayCommand;

// An array that grows.
#define DISPLAY_ARRAY(type)                                                                                            \
    struct {                                                                                                           \
        type *at;                                                                                                      \
        uint32_t count;                                                                                                \
        uint32_t room;                                                                                                 \
    }

typedef struct DisplayList {
    bool linear; // colours are linear light; stops and images of files are not
    DISPLAY_ARRAY(DisplayCommand) commands;
    DISPLAY_ARRAY(DisplayMatrix) matrices;
    DISPLAY_ARRAY(DisplayPaint) paints;
    DISPLAY_ARRAY(double) numbers;
    DISPLAY_ARRAY(DisplayRun) runs;
    DISPLAY_ARRAY(DisplaySource) sources;
    DISPLAY_ARRAY(DisplayStop) stops;
    DISPLAY_ARRAY(DisplayFilter) filters;
    DISPLAY_ARRAY(DisplayEffect) effects;
    DISPLAY_ARRAY(DisplayText) texts;
    DISPLAY_ARRAY(DisplayImage) images;
    DISPLAY_ARRAY(Origin) places; // of nodes, to tell where something is wrong
} DisplayList;

// Makes room for `more` elements and returns the first of them.
#define DISPLAY_ADD(arena, array, more)                                                                                \
    ((array).at = display_list_grow((arena), (array).at, (array).count, &(array).room, (more), sizeof *(array).at),    \
     (array).count += (uint32_t)(more), (array).at + (array).count - (uint32_t)(more))
void *display_list_grow(Arena *arena, void *items, uint32_t count, uint32_t *capacity, uint32_t more, size_t size);

// m a: first a, then m.
DisplayMatrix display_matrix_multiply(DisplayMatrix m, DisplayMatrix a);
// Has it an inverse?
bool display_matrix_is_invertible(const DisplayMatrix *m);

// How long the arrays of a list have become: the next one, of the frame after perhaps, begins with as much room.
typedef struct DisplayListSizes {
    uint32_t commands;
    uint32_t matrices;
    uint32_t paints;
    uint32_t numbers;
    uint32_t runs;
} DisplayListSizes;

// What a canvas shows. In the arena.
const DisplayList *display_list_build(Arena *arena, const DrawNode *canvas, DisplayListSizes *sizes);

#endif
