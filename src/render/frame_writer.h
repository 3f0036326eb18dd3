// frame_writer.h: draws and writes pictures in threads of their own, while the next frames are computed.
//
// Pictures wait in a short queue. Those that go to the film are drawn in their order by one thread; files have as many
// threads as there are processors. After the first failure nothing more is written.
#ifndef PETRI_SRC_FRAME_WRITER_H
#define PETRI_SRC_FRAME_WRITER_H

#include "petri-draw.h"

#include <stdbool.h>

typedef struct FrameWriter FrameWriter;

// A film of this name and speed (NULL: none) is made of the pictures that are added for it; those that `!record` nodes
// name are `fps` fast. NULL after a message.
FrameWriter *frame_writer_start(const char *film, double film_fps, double fps);
// Takes over a picture: for the film, for a file (whose name is copied) or NULL, and for the files that its own
// `!record` nodes name. Pictures that look back are to be added of each frame. Waits while many are waiting, until a
// signal came. False if something has failed before.
bool frame_writer_add(FrameWriter *painting, PetriPicture *picture, bool for_film, const char *file);
// Gives what was wrong with pictures that are done to the session's diagnostic callback, and frees them.
void frame_writer_report(FrameWriter *painting, PetriSession *session);
// Waits for what is waiting and completes the film; with `abandon` gives up what is not done. After a signal pictures
// have a moment to be done, frames of a film all the time that they need. False if something has
// failed; *trouble is then the reason if there is one that was not told through pictures, valid until
// frame_writer_free.
bool frame_writer_finish(FrameWriter *painting, PetriSession *session, bool abandon, const char **error_text);
// How many pictures frame_writer_finish has given up, some in the midst of their being drawn: nothing stops those
// threads but the end of the process.
int frame_writer_unfinished_count(const FrameWriter *painting);
// Seconds spent on drawing and writing, by all threads.
double frame_writer_seconds(const FrameWriter *painting);
// Only if none is left.
void frame_writer_free(FrameWriter *painting);

#endif
