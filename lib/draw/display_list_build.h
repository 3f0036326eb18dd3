// display_list_build.h: internal declarations of the files that translate nodes to a display list.
#pragma once

#include "draw/display_list.h"

typedef struct DisplayListBuild {
    Arena *arena;
    DisplayList *list;
    int depth; // current nesting depth within sources, filters and effects
} DisplayListBuild;

// display_list_shapes.c
extern const DisplayPath display_list_build_no_path;
// Adds the elements of a node to a path. Returns false if nodes of this kind do not add to paths.
bool display_list_build_element(DisplayListBuild *build, DisplayPath *path, const DrawNode *node);
void display_list_build_rectangle(DisplayListBuild *build, DisplayPath *path, const double point[2],
                                  const double size[2]);

// display_list_filters.c
// Translates a paint node (source, filter or effect) and stores it in the graphics state of the siblings after it.
void display_list_build_paint_node(DisplayListBuild *build, GraphicsState *state, const DrawNode *node);

// display_list_paints.c
// Adds a paint source and returns its index. Returns DISPLAY_NONE if a required attribute is missing.
uint32_t display_list_build_source(DisplayListBuild *build, const GraphicsState *state, const DrawNode *node);
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
