// pictures.h: makes the tree of pictures of a frame (spec pictures.md 2 to 5): canvases, images, programs over them.
//
// Each node makes one picture, children first. What has an id is known to those that ask for it later, in this frame or
// in the next. A painter keeps the last frame's pictures for that: frames whose trees look back (petri_looks_back) must
// all be made by one painter, in their order.
#ifndef PETRI_DRAW_PICTURES_H
#define PETRI_DRAW_PICTURES_H

#include "draw/paint.h"

typedef struct Pictures Pictures; // what is kept from frame to frame

// NULL if memory is used up.
Pictures *pictures_new(void);
void pictures_free(PetriPainter *painter); // those of a painter

// What the next frame would continue.
void pictures_forget(PetriPainter *painter);

// Makes all pictures of a frame. *shown is the one of the picture's window, or NULL if it has none; it is kept until
// the next call, as are the records. What cannot be made is reported and left out. PETRI_OK,
// PETRI_MEMORY, or PETRI_INVALID after an error.
PetriStatus pictures_make(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults, Texture **shown);
const Recorded *pictures_records(const Pictures *pictures, uint32_t *count);
// The picture with this id, as it is known now; NULL: none. Borrowed.
Texture *pictures_find(const Pictures *pictures, Str id);

// The size of a node's picture in one that is width x height large.
void pictures_size(const DrawNode *node, int *width, int *height);
// The canvas whose pixels are the picture of a node of that size as they are, in whatever size they are drawn; NULL if
// programs are needed, or pictures are mixed.
const DrawNode *pictures_direct(const DrawNode *node, int width, int height);
// Can its result be made by mixing what is inside?
bool pictures_plain(const DrawNode *node);

#endif
