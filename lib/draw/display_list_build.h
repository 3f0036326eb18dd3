// display_list_build.h: what the files that turn nodes into a list share.
#ifndef PETRI_DRAW_DISPLAY_LIST_BUILD_H
#define PETRI_DRAW_DISPLAY_LIST_BUILD_H

#include "draw/display_list.h"

typedef struct DisplayListBuild {
    Arena *arena;
    DisplayList *list;
    int depth; // of nested sources and filters
} DisplayListBuild;

// display_list_shapes.c
extern const DisplayPath display_list_build_no_path;
// Adds what a node stands for to a path. False if the node is none that adds to paths.
bool display_list_build_element(DisplayListBuild *build, DisplayPath *path, const DrawNode *node);
void display_list_build_rectangle(DisplayListBuild *build, DisplayPath *path, const double point[2],
                                  const double size[2]);

// display_list_filters.c
// Takes one of the nodes that change how siblings after it are painted into the look.
void display_list_build_paint_node(DisplayListBuild *build, GraphicsState *state, const DrawNode *node);

// display_list_paints.c
// DISPLAY_NONE without what is needed.
uint32_t display_list_build_source(DisplayListBuild *build, const GraphicsState *state, const DrawNode *node);
// Colours of stops count as encoded, with bytes.
void display_list_build_stop_color(const DisplayListBuild *build, const double color[4], double out[4]);
uint32_t display_list_build_image(DisplayListBuild *build, const DrawNode *node);

// display_list_build.c
// Takes a node's transform attributes in their order.
void display_list_build_transform(DisplayMatrix *matrix, const DrawNode *node, bool after);
uint32_t display_list_build_paint(DisplayListBuild *build, const GraphicsState *state);
// Takes its paint and font attributes. False if it has none.
bool display_list_build_read_state(GraphicsState *state, const DrawNode *node);

#endif
