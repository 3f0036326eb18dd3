// recording.h: what `!record` nodes write: pictures, once for each name, and films.
#ifndef PETRI_SRC_RECORDING_H
#define PETRI_SRC_RECORDING_H

#include "petri-draw.h"

#include <stdbool.h>

typedef struct RecordedFile RecordedFile;

// Begin with zeros and the frames per second.
typedef struct Recording {
    double fps;
    RecordedFile *files;
    const char *error_text; // why something failed that was not told through pictures
} Recording;

// Makes a picture, if that is not done, and writes what its records say. False if something failed.
bool recording_add(Recording *recording, PetriPicture *picture, PetriPainter *painter);
// Completes all films, or gives them up. False if that failed; *trouble stays valid.
bool recording_end(Recording *recording, bool abandon);
void recording_free(Recording *recording);

#endif
