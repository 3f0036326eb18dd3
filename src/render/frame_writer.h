// frame_writer.h: threads that draw and write pictures while the next frames are computed.
//
// Pictures wait in a short queue. Frames of videos are drawn in order by one thread. Image files are drawn by one
// thread per processor. After the first failure, nothing more is written.
#pragma once

#include "petri-draw.h"

#include <stdbool.h>

typedef struct FrameWriter FrameWriter;

// A file for a picture of a frame.
typedef struct FrameOutput {
    int window;       // number of the window to draw; -1: the one that the picture shows
    const char *file; // name of an image or a video
} FrameOutput;

// Starts the threads. If `films` is true, outputs are added to videos, which have `film_fps` frames per second,
// otherwise each output is an image. Videos of `!record` nodes have `fps` frames per second. Returns NULL after a
// message.
FrameWriter *frame_writer_start(bool films, double film_fps, double fps);
// Adds a picture to the queue and takes ownership of it. A thread writes the `count` outputs, whose file names are
// copied. The thread also writes the files of the picture's `!record` nodes. Pictures that need history
// (petri_picture_needs_history) must be added in order, and once for each frame that must be rendered
// (petri_must_render). Waits while the queue is full, unless a signal arrives. Returns false if writing has failed
// before.
bool frame_writer_add(FrameWriter *writer, PetriPicture *picture, const FrameOutput *outputs, size_t count);
// Reports the diagnostics of finished pictures to the session's callback and frees the pictures.
void frame_writer_report(FrameWriter *writer, PetriSession *session);
// Waits for all pictures and completes the videos. If `abandon` is true, discards unfinished pictures. After a signal,
// waits only briefly, but does not stop while a frame is partly written to a video. Returns false if writing has
// failed. *error_text is then the reason, or NULL if a picture's diagnostics contain the reason. The text is valid
// until frame_writer_free.
bool frame_writer_finish(FrameWriter *writer, PetriSession *session, bool abandon, const char **error_text);
// Returns the number of pictures that frame_writer_finish has abandoned. If it is not 0, threads may still be drawing.
// They stop only when the process ends.
int frame_writer_unfinished_count(const FrameWriter *writer);
// Returns the seconds that all threads together spent drawing and writing.
double frame_writer_seconds(const FrameWriter *writer);
// Frees the writer. Must not be called if frame_writer_unfinished_count is not 0.
void frame_writer_free(FrameWriter *writer);
