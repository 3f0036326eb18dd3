// display_list_build.h: internal declarations of the files that translate nodes to a display list.
#pragma once

#include "picture/display_list_write.h"

#define DISPLAY_NONE UINT32_MAX // a null index

// A range of consecutive path elements in DisplayListBuild.paths.
typedef struct DisplayRun {
    uint32_t start;
    uint32_t end;
    uint32_t next; // index of the next run; DISPLAY_NONE: this is the last run
} DisplayRun;

// A path: a linked list of runs. Levels of the tree copy this struct. The original path can be extended later, and then
// the last run of the copy can become longer. A copy therefore uses its last run only up to the copy's own `end`.
typedef struct DisplayPath {
    uint32_t first; // index of the first run; DISPLAY_NONE: empty path
    uint32_t last;
    uint32_t end;
    uint8_t fill_type; // FILL_WINDING and so on
} DisplayPath;

// A paint source, filter or path effect that is valid, and the graphics state where it is set.
typedef struct DisplaySetting {
    const DrawNode *node;
    GraphicsState state;
} DisplaySetting;

typedef struct DisplayListBuild {
    DisplayList *list;
    Arena *arena; // of the list
    const DisplayHost *host;
    DISPLAY_ARRAY(double) paths; // path elements with their operands
    DISPLAY_ARRAY(DisplayRun) runs;
    DISPLAY_ARRAY(DisplaySetting) settings;
    DISPLAY_ARRAY(double) joined; // elements of the last path that has several runs
    int depth;                    // current nesting depth within sources, filters and effects
    const GraphicsState *state;   // graphics state for the source or filter that is being translated
    uint32_t effect_elements;     // path elements created for the host by effects so far
} DisplayListBuild;

// display_list_shapes.c
extern const DisplayPath display_list_build_no_path;
// Adds the elements of a SHAPE (schema_list.h) to a path.
void display_list_build_shape(DisplayListBuild *build, DisplayPath *path, const DrawNode *node);
void display_list_build_rectangle(DisplayListBuild *build, DisplayPath *path, const double point[2],
                                  const double size[2]);
// Returns the elements of a path, valid until the next call or until a path is extended.
DisplayNumbers display_list_build_elements(DisplayListBuild *build, const DisplayPath *path);

// display_list_filters.c
// Write a filter or path effect, with those inside it. Return false if it is not complete.
bool display_list_build_filter(DisplayListBuild *build, const DrawNode *node);
bool display_list_build_effect(DisplayListBuild *build, const DrawNode *node);

// display_list_paints.c
// Writes a paint source. Returns false if a required attribute is missing.
bool display_list_build_source(DisplayListBuild *build, const DrawNode *node, double alpha);
// Writes the paint and stroke style of a graphics state. `dash` is the node with the dashes; NULL: none.
void display_list_build_colour(DisplayListBuild *build, const GraphicsState *state, const DrawNode *dash);
// Rounds the sRGB colour of a gradient stop or shadow to 8 bits. In a linear canvas, also converts it to linear light.
void display_list_build_stop_color(const DisplayListBuild *build, const double color[4], double out[4]);
// Returns true if the node names an image, which display_list_build_image can write.
bool display_list_build_has_image(const DrawNode *node);
void display_list_build_image(DisplayListBuild *build, const DrawNode *node);
// Reads the paint and font attributes of a node into the state. Returns false if the node has none.
bool display_list_build_read_state(GraphicsState *state, const DrawNode *node);
// Multiplies *matrix by the transform attributes of a node, in the order in which they are written. If `after` is true,
// the product transforms points by the old matrix first and then by the attributes. Otherwise, the attributes come
// first.
void display_list_build_transform(DisplayMatrix *matrix, const DrawNode *node, bool after);
