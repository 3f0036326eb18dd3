// display_list_build.h: internal declarations of the files that translate nodes to a display list.
#pragma once

#include "picture/display_list.h"

typedef struct DisplayListBuild {
    Arena *arena;
    DisplayList *list;
    int depth;                  // current nesting depth within sources, filters and effects
    const GraphicsState *state; // graphics state for the source or filter that is being translated
} DisplayListBuild;

// display_list_shapes.c
extern const DisplayPath display_list_build_no_path;
// Adds the elements of a SHAPE (schema_list.h) to a path.
void display_list_build_shape(DisplayListBuild *build, DisplayPath *path, const DrawNode *node);
void display_list_build_rectangle(DisplayListBuild *build, DisplayPath *path, const double point[2],
                                  const double size[2]);

// display_list_filters.c
// Add a filter or path effect, with those inside it, and return its index. Return DISPLAY_NONE if it is not complete.
uint32_t display_list_build_filter(DisplayListBuild *build, const DrawNode *node);
uint32_t display_list_build_effect(DisplayListBuild *build, const DrawNode *node);

// display_list_paints.c
// Adds a paint source and returns its index. Returns DISPLAY_NONE if a required attribute is missing.
uint32_t display_list_build_source(DisplayListBuild *build, const DrawNode *node);
// Rounds the sRGB colour of a gradient stop or shadow to 8 bits. In a linear canvas, also converts it to linear light.
void display_list_build_stop_color(const DisplayListBuild *build, const double color[4], double out[4]);
uint32_t display_list_build_image(DisplayListBuild *build, const DrawNode *node);

// display_list_build.c
// Multiplies *matrix by the transform attributes of a node, in the order in which they are written. If `after` is true,
// the product transforms points by the old matrix first and then by the attributes. Otherwise, the attributes come
// first.
void display_list_build_transform(DisplayMatrix *matrix, const DrawNode *node, bool after);
uint32_t display_list_build_paint(DisplayListBuild *build, const GraphicsState *state);
// Reads the paint and font attributes of a node into the state. Returns false if the node has none.
bool display_list_build_read_state(GraphicsState *state, const DrawNode *node);
