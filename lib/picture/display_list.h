// display_list.h: display lists: drawings as arrays of numbers, whose format petri-draw.h describes. The nodes are
// already translated to commands, and inherited attributes are resolved. Any backend that can fill, stroke and clip
// paths can therefore draw a list: lib/cairo, or a host.
//
// What numbers cannot describe, such as positions in the script, is in notes beside them. After a list is built, it
// does not change. Strings of the notes are borrowed from the nodes.
#pragma once

#include "canvas/drawing.h"
#include "petri-draw.h"
#include "picture/texture.h"

// x' = xx x + xy y + x0, y' = yx x + yy y + y0. The fields have the order of a matrix in a list.
typedef struct DisplayMatrix {
    double xx, yx, xy, yy, x0, y0;
} DisplayMatrix;

// The kinds of path elements, as PETRI_PATH_…: PATH_MOVE and so on.
typedef enum PathElement {
#define ELEMENT(name, operands) PATH_##name,
#include "picture/display_list_macros.h"
} PathElement;

// The number of operands of each kind of path element.
static const uint8_t display_path_sizes[] = {
#define ELEMENT(name, operands) operands 0,
#define NUMBER(name) 1 +
#define NUMBERS(name, count) count +
#include "picture/display_list_macros.h"
};

enum { DISPLAY_HEADER = 3 }; // numbers before the first command: width, height, and true if there are filters or noise

// Successive numbers of a list, such as the elements of a path.
typedef struct DisplayNumbers {
    const double *at;
    uint32_t count;
} DisplayNumbers;

typedef struct DisplayStop {
    double offset;
    double color[4];
} DisplayStop;

typedef struct DisplayStops {
    const DisplayStop *at;
    uint32_t count;
} DisplayStops;

// The text when it is written; the code points when it is read.
typedef struct DisplayString {
    Str text;
    DisplayNumbers points;
} DisplayString;

// The operands of each command, filter and effect, as pointers into the list if they are several numbers. Filters and
// effects inside others follow the row, and when it is written, also paints, filters and effects inside commands.
#define ROW(name, operands)                                                                                            \
    typedef struct name##Operands {                                                                                    \
        int kind;                                                                                                      \
        const double *at; /* after reading: position of a command in the list */                                       \
        double alpha;     /* of paints; unused by PETRI_DRAW_COLOR */                                                  \
        operands                                                                                                       \
    } name##Operands;
#define NUMBER(name) double name;
#define ALPHA(name)
#define NUMBERS(name, count) const double *name;
#define MATRIX(name) const DisplayMatrix *name;
#define COLOUR(name) const double *name;
#define STOPS(name) DisplayStops name;
#define LIST(name) DisplayNumbers name;
#define STRING(name) DisplayString name;
#define PIXELS(name) Texture *name; /* NULL after reading */
#define PAINT(name) const double *name;
#include "picture/display_list_macros.h"

typedef union DisplayRow {
    int kind; // PETRI_DRAW_…, PETRI_FILTER_… or PETRI_EFFECT_…
#define ROW(name, operands) name##Operands name;
#include "picture/display_list_macros.h"
} DisplayRow;

// What the commands before a drawing have set.
typedef struct DisplayPaint {
    const double *source; // position of the PETRI_PAINT in the list
    STROKE_STYLEOperands style;
    DisplayNumbers filter; // empty: none
    DisplayNumbers effect; // empty: none
} DisplayPaint;

// Values of the operand `fit`.
typedef enum DisplayFit { FIT_NONE, FIT_SIZE, FIT_INSIDE, FIT_FILL } DisplayFit;

// Data of the command, filter or effect at a position of a list that numbers cannot describe.
typedef struct DisplayNote {
    uint32_t at;  // index of its first number
    Origin place; // position of its node in the script
    Str id;       // of an image that is the picture of another node, whose pixels are not in the list: id of the node
} DisplayNote;

// A growing array.
#define DISPLAY_ARRAY(type)                                                                                            \
    struct {                                                                                                           \
        type *at;                                                                                                      \
        uint32_t count;                                                                                                \
        uint32_t room;                                                                                                 \
    }

typedef struct DisplayList {
    Arena *arena;
    bool linear; // true: all colours are in linear light; image files are converted from sRGB when they are drawn
    DISPLAY_ARRAY(double) numbers;
    DISPLAY_ARRAY(DisplayNote) notes; // in the order of `at`
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

// Numbers that are read one after the other. Reading beyond their end gives zeros and sets `failed`.
typedef struct DisplayReader {
    const double *at;
    size_t left;
    bool failed;
} DisplayReader;

// Reads the command at `at`, which must be valid. Returns the position after it.
const double *display_list_read(const double *at, DisplayRow *row);
// Read the kind and operands of a filter or effect. Those inside it come next. An unknown kind of filter fails.
void display_list_read_filter(DisplayReader *reader, DisplayRow *filter);
void display_list_read_effect(DisplayReader *reader, DisplayRow *effect);
// If the command is one that changes a paint, changes the paint and returns true.
bool display_list_set_paint(const DisplayRow *row, DisplayPaint *paint);
// Returns true if the paint is the colour of the graphics state and not a paint source.
static inline bool display_paint_is_plain(const DisplayPaint *paint) {
    return (int)*paint->source == PETRI_DRAW_COLOR;
}
// Returns the alpha of the graphics state's colour, from 0 to 1, which also applies to paint sources and images.
double display_paint_alpha(const DisplayPaint *paint);
// Returns the note of the command, filter or effect at a position of the list; an empty one if there is none.
DisplayNote display_list_note(const DisplayList *list, const double *at);

// The capacities with which the arrays of the next list start: lengths of the previous list.
typedef struct DisplayListSizes {
    uint32_t numbers;
    uint32_t paths;
} DisplayListSizes;

// A host that draws lists: it lacks path effects and pictures of other nodes, so the list contains the results.
typedef struct DisplayHost {
    Texture *(*find_pixels)(void *context, Str id); // returns the picture of a node, or NULL; NULL: not available
    void *context;
} DisplayHost;

// Begins a list, whose `arena` is set, with its header.
void display_list_begin(DisplayList *list, double width, double height);
// Adds the drawing of a canvas to a list. `host` is NULL for a backend that applies effects and finds pictures itself.
// Reads initial capacities from *sizes, then stores the new array lengths there.
void display_list_build(DisplayList *list, const DrawNode *canvas, const DisplayHost *host, DisplayListSizes *sizes);
