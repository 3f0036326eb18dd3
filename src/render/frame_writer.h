// frame_writer.h: threads that draw and write pictures while the next frames are computed.
//
// Pictures wait in a short queue. Frames of a video are drawn in order by one thread; for files there is one thread per
// processor. After the first failure nothing more is written.
#ifndef PETRI_SRC_FRAME_WRITER_H
#define PETRI_SRC_FRAME_WRITER_H

#include "petri-draw.h"

#include <stdbool.h>

typedef struct FrameWriter FrameWriter;

// Starts the threads. `film`: file name of the video, with `film_fps` frames per second; NULL: none. Videos of
// `!record` nodes have `fps`. Returns NULL after a message.
FrameWriter *frame_writer_start(const char *film, double film_fps, double fps);
// Adds a picture and takes ownership of it. It is added to the video if `for_film` is true, written to `file` unless
// that is NULL (the name is copied), and written by its `!record` nodes. Pictures that need history must be added for
// every frame. Waits while the queue is full, unless a signal arrives. Returns false if writing has failed before.
bool frame_writer_add(FrameWriter *writer, PetriPicture *picture, bool for_film, const char *file);
// Reports the diagnostics of finished pictures to the session's callback and frees the pictures.
void frame_writer_report(FrameWriter *writer, PetriSession *session);
// Waits for all pictures and completes the video; with `abandon`, discards unfinished pictures. After a signal, files
// get a moment to be finished; the current frame of a video gets as long as it needs. Returns false if writing has
// failed. *error_text is then a reason that no picture's diagnostics contain, or NULL; valid until frame_writer_free.
bool frame_writer_finish(FrameWriter *writer, PetriSession *session, bool abandon, const char **error_text);
// Returns how many pictures frame_writer_finish abandoned. If it is not 0, threads may still be drawing, and only the
// end of the process stops them.
int frame_writer_unfinished_count(const FrameWriter *writer);
// Returns the seconds that all threads together spent drawing and writing.
double frame_writer_seconds(const FrameWriter *writer);
// Frees the writer. Must not be called if frame_writer_unfinished_count is not 0.
void frame_writer_free(FrameWriter *writer);

#endif
