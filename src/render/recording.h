// recording.h: the files of `!record` nodes: videos, and pictures, which are written once per file name.
#pragma once

#include "petri-draw.h"

#include <stdbool.h>

typedef struct RecordedFile RecordedFile;

// Before the first call of recording_add, `fps` must be set and all other fields must be zero.
typedef struct Recording {
    double fps;
    RecordedFile *files;
    const char *error_text; // reason for a failure; NULL: no failure, or a picture's diagnostics contain it
} Recording;

// Renders a picture, if it is not rendered yet, and writes the files of its `!record` nodes. Returns false on failure.
bool recording_add(Recording *recording, PetriPicture *picture, PetriPainter *painter);
// Completes all videos, or discards them if `abandon` is true. Returns false on failure. error_text remains valid.
bool recording_end(Recording *recording, bool abandon);
void recording_free(Recording *recording);
