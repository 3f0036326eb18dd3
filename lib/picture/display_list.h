// display_list.h: a drawing as a list of commands in flat arrays of plain numbers. The nodes are already translated to
// commands, and inherited attributes are resolved. Any backend that can fill, stroke and clip paths can therefore draw
// a list; lib/cairo uses Cairo.
//
// All references are indices; DISPLAY_NONE is the null reference. display_list_build allocates the list from the arena
// that it is given. After that, the list does not change. The strings of the list are borrowed from the nodes.
#pragma once

#include "canvas/drawing.h"

#define DISPLAY_NONE UINT32_MAX

// x' = xx x + xy y + x0, y' = yx x + yy y + y0
typedef struct DisplayMatrix {
    double xx, yx, xy, yy, x0, y0;
} DisplayMatrix;

// The kinds of path elements, as PETRI_PATH_… of petri-draw.h: PATH_MOVE and so on. In DisplayList.numbers, each
// element is stored as its kind, followed by its operands.
typedef enum PathElement {
#define ELEMENT(name, operands) PATH_##name,
#include "picture/display_list_rows.h"
} PathElement;

// The number of operands of each kind of path element.
static const uint8_t display_path_sizes[] = {
#define ELEMENT(name, operands) operands 0,
#define NUMBER(name) 1 +
#define NUMBERS(name, count) count +
#include "picture/display_list_rows.h"
};

// A range of consecutive path elements in DisplayList.numbers.
typedef struct DisplayRun {
    uint32_t start;
    uint32_t end;
    uint32_t next; // index of the next run; DISPLAY_NONE: this is the last run
} DisplayRun;

// A path: a linked list of runs. Commands copy this struct. The original path can be extended later, and then the last
// run of the copy can become longer. A copy therefore uses its last run only up to the copy's own `end`.
typedef struct DisplayPath {
    uint32_t first; // index of the first run; DISPLAY_NONE: empty path
    uint32_t last;
    uint32_t end;
    uint8_t fill_type; // FILL_WINDING and so on
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

// A paint source, which defines the colour of each point.
typedef struct DisplaySource {
    DisplaySourceKind kind;
    double color[4];
    double ends[4]; // for a linear gradient: end points; for noise: frequencies x, y and tile size x, y
    // For a radial gradient: maps the unit circle to its edge. For a pattern: maps image pixels to units.
    DisplayMatrix matrix;
    uint32_t first_stop; // for a gradient: index of the first stop; for a blend: index of the first source
    uint32_t stop_count; // for a gradient: number of stops; for a blend: index of the second source; for noise: octaves
    double ratio;        // for a blend: mixing ratio (NaN: use `mode`); for noise: seed
    int mode;            // for a blend: composite mode; for noise: type
    uint32_t image;      // for a pattern: index of the image
} DisplaySource;

// The kinds of filters, as PETRI_FILTER_…. FILTER_SOURCE is the unfiltered drawing.
typedef enum DisplayFilterKind {
#define FILTER_KIND(name, operands) FILTER_##name,
#include "picture/display_list_rows.h"
} DisplayFilterKind;

enum {
    FILTER_COUNT = 0
#define FILTER_KIND(name, operands) +1
#include "picture/display_list_rows.h"
};

typedef struct DisplayFilter {
    DisplayFilterKind kind;
    double radius[2]; // for blur and shadow: standard deviation; for dilate and erode: reach
    double offset[2];
    double colour[4];
    bool only;        // true: draw the shadow without the object
    int mode;         // for a blend: composite mode; -1: use `numbers`
    uint32_t paint;   // for FILTER_PAINT: index of the paint
    uint32_t numbers; // index in DisplayList.numbers of 20 matrix elements or 4 coefficients; DISPLAY_NONE: use `mode`
    uint32_t inputs[2]; // indices of filters; DISPLAY_NONE: the unfiltered drawing; only blends use the second input
    Origin place;       // position of the filter's node in the script
} DisplayFilter;

typedef enum DisplayEffectKind {
#define EFFECT(id, name, help) EFFECT_##id,
#include "schema/schema_list.h"
} DisplayEffectKind;

// A path effect, which changes a path before it is filled or stroked.
typedef struct DisplayEffect {
    DisplayEffectKind kind;
    uint32_t inner;    // index of the effect that is applied before this one; DISPLAY_NONE: none, as in sums
    uint32_t numbers;  // index in DisplayList.numbers of the dashes, of a row-major 3 x 3 matrix, or of a sum's effects
    uint32_t count;    // number of dashes or of effects in a sum
    double amounts[2]; // for dashes: offset; for round corners: radius; for jitter: segment length and deviation
    double seed;
    Origin place;
} DisplayEffect;

// Paint attributes of a command.
typedef struct DisplayPaint {
    double color[4]; // the alpha of the colour also applies to sources and images
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
    Str file; // name of the image file; empty: use `id`
    Str id;
    double point[2];
    double size[2];
    DisplayFit fit;
    NodeKind kind; // kind of the image's node, for messages
    Origin place;
} DisplayImage;

typedef enum DisplayCommandKind {
    DISPLAY_DRAW, // fills or strokes the path
    DISPLAY_TEXT,
    DISPLAY_IMAGE,
    DISPLAY_CLIP,      // clips to the path
    DISPLAY_MASK,      // clips to the outside of the path
    DISPLAY_SAVE,      // saves the clip
    DISPLAY_RESTORE,   // restores the clip
    DISPLAY_LAYER,     // redirects drawing to a transparent layer
    DISPLAY_LAYER_END, // composites the layer with `alpha`
} DisplayCommandKind;

typedef struct DisplayCommand {
    DisplayCommandKind kind;
    bool fill; // if both `fill` and `stroke` are true, the filled and the stroked area are painted as one shape
    bool stroke;
    uint32_t matrix;
    uint32_t paint;
    uint32_t item; // index of a text or image; for a layer: index in `places`
    DisplayPath path;
    double alpha;
} DisplayCommand;

// A growing array.
#define DISPLAY_ARRAY(type)                                                                                            \
    struct {                                                                                                           \
        type *at;                                                                                                      \
        uint32_t count;                                                                                                \
        uint32_t room;                                                                                                 \
    }

typedef struct DisplayList {
    bool linear; // true: all colours are in linear light; image files are converted from sRGB when they are drawn
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
    DISPLAY_ARRAY(Origin) places; // positions of nodes in the script, for diagnostics
} DisplayList;

// Adds `more` elements and returns a pointer to the first of them.
#define DISPLAY_ADD(arena, array, more)                                                                                \
    ((array).at = display_list_grow((arena), (array).at, (array).count, &(array).room, (more), sizeof *(array).at),    \
     (array).count += (uint32_t)(more), (array).at + (array).count - (uint32_t)(more))
void *display_list_grow(Arena *arena, void *items, uint32_t count, uint32_t *capacity, uint32_t more, size_t size);

// Returns the product m a, which applies a first and then m.
DisplayMatrix display_matrix_multiply(DisplayMatrix m, DisplayMatrix a);
// Returns true if the matrix is invertible.
bool display_matrix_is_invertible(const DisplayMatrix *m);

// The array lengths of the previous list. The arrays of the next list start with these capacities.
typedef struct DisplayListSizes {
    uint32_t commands;
    uint32_t matrices;
    uint32_t paints;
    uint32_t numbers;
    uint32_t runs;
} DisplayListSizes;

// Builds the display list of a canvas in the arena. Reads initial capacities from *sizes, then stores the new array
// lengths there.
const DisplayList *display_list_build(Arena *arena, const DrawNode *canvas, DisplayListSizes *sizes);
