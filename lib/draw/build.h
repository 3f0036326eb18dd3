// build.h: what the files that turn nodes into a list share.
#ifndef PETRI_DRAW_BUILD_H
#define PETRI_DRAW_BUILD_H

#include "draw/list.h"

typedef struct Build {
    Arena *arena;
    List *list;
    int depth; // of nested sources and filters
} Build;

// shapes.c
extern const ListPath build_no_path;
// Adds what a node stands for to a path. False if the node is none that adds to paths.
bool build_piece(Build *build, ListPath *path, const DrawNode *node);
void build_rectangle(Build *build, ListPath *path, const double point[2], const double size[2]);

// changes.c
// Takes one of the nodes that change how siblings after it are painted into the look.
void build_paint_node(Build *build, Look *look, const DrawNode *node);

// sources.c
// LIST_NONE without what is needed.
uint32_t build_source(Build *build, const Look *look, const DrawNode *node);
// Colours of stops count as encoded, with bytes.
void build_stop_color(const Build *build, const double color[4], double out[4]);
uint32_t build_image(Build *build, const DrawNode *node);

// build.c
// Takes a node's transform attributes in their order.
void build_transform(ListMatrix *matrix, const DrawNode *node, bool after);
uint32_t build_paint(Build *build, const Look *look);
// Takes its paint and font attributes. False if it has none.
bool build_take(Look *look, const DrawNode *node);

#endif
