// video.h: films, made by an ffmpeg process that gets frames through a pipe.
//
// The film takes its name when it is complete (base/replace.h); nothing is left behind otherwise. What fails says why
// in `trouble`, since this is for a thread that does not write messages.
#ifndef PETRI_SRC_VIDEO_H
#define PETRI_SRC_VIDEO_H

#include "base/replace.h"

#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

typedef struct Video {
    const char *file;
    bool open;
    Replacement film;
    int width;
    int height;
    _Atomic pid_t pid;    // 0: none
    int frames;           // pipe to ffmpeg
    int errors;           // file without a name that holds its messages
    int cleanup_id;       // its number there (signal_cleanup.h)
    char error_text[512]; // why the last of the functions below failed
} Video;

// Whether the name's suffix is one of a film: .mp4, .webm or .gif.
bool video_has_suffix(const char *file);
// Starts ffmpeg. False with trouble.
bool video_open(Video *video, const char *file, int width, int height, double fps);
// Adds a frame of width x height pixels, in rows without gaps. False, with trouble, if ffmpeg has failed; the film is
// then given up.
bool video_add(Video *video, const uint32_t *pixels);
// Completes the film and gives it its name. False with trouble.
bool video_close(Video *video);
// Gives a film up. To do so twice, or without a film, is fine.
void video_abandon(Video *video);

#endif
