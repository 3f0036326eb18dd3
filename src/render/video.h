// video.h: videos, encoded by an ffmpeg process that receives frames through a pipe.
//
// The video gets its final name when it is complete (base/replace.h). If it is never completed, no file remains. On
// failure, error_text has the reason, because the calling thread does not write messages.
#pragma once

#include "base/replace.h"
#include "render/video_arguments.h"

#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

typedef struct Video {
    const char *file;
    bool open;
    Replacement film;
    int width;
    int height;
    _Atomic pid_t pid;    // process id of ffmpeg; 0: it is not running
    int frames;           // descriptor of the pipe to ffmpeg
    int errors;           // descriptor of an unnamed file with the messages of ffmpeg
    int cleanup_id;       // from signal_cleanup_begin
    char error_text[512]; // reason of the last failure
} Video;

// Starts ffmpeg. Returns false and sets error_text on failure.
bool video_open(Video *video, const char *file, const VideoOptions *options, int width, int height, double fps);
// Adds a frame of width x height pixels, in rows without gaps. If ffmpeg has failed, discards the video, sets
// error_text and returns false.
bool video_add(Video *video, const uint32_t *pixels);
// Completes the video and renames it. Returns false and sets error_text on failure.
bool video_close(Video *video);
// Stops ffmpeg and discards the video. Does nothing if no video is open.
void video_abandon(Video *video);
