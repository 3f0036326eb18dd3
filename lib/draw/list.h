// list.h: a drawing as a list of commands in flat arrays: what is drawn, in which order, with plain numbers. Nodes and
// what they inherit are gone; whoever can fill, stroke and clip paths can show it (show.c does with Cairo).
//
// All references are numbers of elements; LIST_NONE is none. Lists live in the arena with which they are built and
// never change afterwards; texts are borrowed from the nodes.
#ifndef PETRI_DRAW_LIST_H
#define PETRI_DRAW_LIST_H

#include "canvas/drawing.h"

#define LIST_NONE UINT32_MAX

// x' = xx x + xy y + x0, y' = yx x + yy y + y0
typedef struct ListMatrix {
    double xx, yx, xy, yy, x0, y0;
} ListMatrix;

// Pieces of paths in `numbers`: the kind, and then its numbers.
typedef enum ListPiece {
    PIECE_MOVE,    // x, y
    PIECE_LINE,    // x, y
    PIECE_CURVE_2, // control x, y, end x, y
    PIECE_CURVE_3, // two controls and an end
    PIECE_ARC,     // begins a figure: middle x, y, radii x, y, start and sweep in turns, clockwise
    PIECE_ARC_ON,  // the same, joined by a line
    PIECE_ARC_TO,  // radii x, y, rotation in turns, large and clockwise (0 or 1), end x, y
    PIECE_CLOSE,
} ListPiece;

// Pieces that follow each other in `numbers`.
typedef struct ListRun {
    uint32_t start;
    uint32_t end;
    uint32_t next; // run; LIST_NONE
} ListRun;

// A path is what its runs say, up to `end` in the last of them.
typedef struct ListPath {
    uint32_t first; // LIST_NONE: empty
    uint32_t last;
    uint32_t end;
    uint8_t fill_type;
} ListPath;

typedef enum ListSourceKind {
    SOURCE_COLOR,
    SOURCE_LINEAR,
    SOURCE_RADIAL,
    SOURCE_PATTERN,
    SOURCE_BLEND,
    SOURCE_NOISE
} ListSourceKind;

typedef struct ListStop {
    double offset;
    double color[4];
} ListStop;

// What gives each point its colour.
typedef struct ListSource {
    ListSourceKind kind;
    double color[4];
    double ends[4];      // of a linear gradient; frequencies and tile of noise
    ListMatrix matrix;   // of the unit circle of a radial gradient; of a pattern
    uint32_t first_stop; // or the first source of a blend
    uint32_t stop_count; // or its second source; or the octaves of noise
    double ratio;        // nan: `mode` counts; or the seed of noise
    int mode;            // or the type of noise
    uint32_t image;
} ListSource;

typedef enum ListFilterKind {
    FILTER_BLUR,
    FILTER_SHADOW,
    FILTER_OFFSET,
    FILTER_DILATE,
    FILTER_ERODE,
    FILTER_MATRIX,
    FILTER_PAINT,
    FILTER_BLEND,
    FILTER_DRAWN // what is drawn, as it is
} ListFilterKind;

typedef struct ListFilter {
    ListFilterKind kind;
    double radius[2];
    double offset[2];
    double color[4];
    bool only;
    int mode;
    uint32_t paint;
    uint32_t numbers;   // in `numbers`: 20 of a matrix, 4 coefficients of a blend; LIST_NONE: its mode counts
    uint32_t inputs[2]; // filters; LIST_NONE: what is drawn, or none
    Origin place;       // of its node
} ListFilter;

typedef enum ListEffectKind { EFFECT_DASH, EFFECT_ROUND, EFFECT_JITTER, EFFECT_MATRIX, EFFECT_SUM } ListEffectKind;

// What changes a figure before it is filled or stroked.
typedef struct ListEffect {
    ListEffectKind kind;
    uint32_t inner;   // an effect that comes first; LIST_NONE
    uint32_t numbers; // in `numbers`: dashes, 9 of a matrix by rows, the effects of a sum
    uint32_t count;
    double amounts[2]; // offset of dashes; radius; length and deviation
    double seed;
    Origin place;
} ListEffect;

// How something is painted.
typedef struct ListPaint {
    double color[4]; // its alpha counts for sources and images, too
    double stroke_width;
    uint32_t source;
    uint32_t filter;
    uint32_t effect;
    int join;
    int cap;
    int composite;
    bool antialias;
} ListPaint;

typedef struct ListText {
    Str text;
    const char *family;
    double size;
    double weight;
    int width;
    double point[2];
    int slant;
    bool center;
} ListText;

typedef enum ListFit { FIT_NONE, FIT_SIZE, FIT_INSIDE, FIT_FILL } ListFit;

typedef struct ListImage {
    Str file; // or
    Str id;
    double point[2];
    double size[2];
    ListFit fit;
    NodeKind kind; // of its node
    Origin place;
} ListImage;

typedef enum ListCommandKind {
    LIST_DRAW, // path
    LIST_TEXT,
    LIST_IMAGE,
    LIST_CLIP,      // to the path
    LIST_MASK,      // to what is outside of it
    LIST_SAVE,      // the clip
    LIST_RESTORE,   // it
    LIST_LAYER,     // what follows is drawn on a transparent layer,
    LIST_LAYER_END, // which is laid over with this alpha
} ListCommandKind;

typedef struct ListCommand {
    ListCommandKind kind;
    bool fill; // fill and stroke are one figure
    bool stroke;
    uint32_t matrix;
    uint32_t paint;
    uint32_t item; // text, image; place of a layer
    ListPath path;
    double alpha;
} ListCommand;

// An array that grows.
#define LIST_ARRAY(type)                                                                                               \
    struct {                                                                                                           \
        type *at;                                                                                                      \
        uint32_t count;                                                                                                \
        uint32_t room;                                                                                                 \
    }

typedef struct List {
    bool linear; // colours are linear light; stops and images of files are not
    LIST_ARRAY(ListCommand) commands;
    LIST_ARRAY(ListMatrix) matrices;
    LIST_ARRAY(ListPaint) paints;
    LIST_ARRAY(double) numbers;
    LIST_ARRAY(ListRun) runs;
    LIST_ARRAY(ListSource) sources;
    LIST_ARRAY(ListStop) stops;
    LIST_ARRAY(ListFilter) filters;
    LIST_ARRAY(ListEffect) effects;
    LIST_ARRAY(ListText) texts;
    LIST_ARRAY(ListImage) images;
    LIST_ARRAY(Origin) places; // of nodes, to tell where something is wrong
} List;

// Makes room for `more` elements and returns the first of them.
#define LIST_ADD(arena, array, more)                                                                                   \
    ((array).at = list_room((arena), (array).at, (array).count, &(array).room, (more), sizeof *(array).at),            \
     (array).count += (uint32_t)(more), (array).at + (array).count - (uint32_t)(more))
void *list_room(Arena *arena, void *items, uint32_t count, uint32_t *room, uint32_t more, size_t size);

// m a: first a, then m.
ListMatrix list_multiply(ListMatrix m, ListMatrix a);
// Has it an inverse?
bool list_invertible(const ListMatrix *m);

// How long the arrays of a list have become: the next one, of the frame after perhaps, begins with as much room.
typedef struct ListSizes {
    uint32_t commands;
    uint32_t matrices;
    uint32_t paints;
    uint32_t numbers;
    uint32_t runs;
} ListSizes;

// What a canvas shows. In the arena.
const List *list_build(Arena *arena, const DrawNode *canvas, ListSizes *sizes);

#endif
