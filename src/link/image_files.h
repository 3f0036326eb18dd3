// image_files.h: finds the image files of a picture without drawing it.
#pragma once

#include "petri-draw.h"

// Receives the name of a file, which is valid during the call.
typedef void ImageFileCallback(void *user_data, const char *name);

// Calls `found` with the file of each image in the display list of a picture, in the order in which they are drawn.
// Those that only a filter uses are not in the list, nor those of other canvases of a window.
void image_files_find(PetriPicture *picture, ImageFileCallback *found, void *user_data);
