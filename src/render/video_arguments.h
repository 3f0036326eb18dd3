// video_arguments.h: chooses ffmpeg's arguments for a video file.
#pragma once

#include <stdbool.h>
#include <stddef.h>

// How to encode a video. All words come from a fixed list (schema/word_list.h).
typedef struct VideoOptions {
    const char *codec;   // NULL or "": the default of the container
    const char *pixfmt;  // pixel format; NULL or "": the default of the codec
    const char *preset;  // NULL or "": the default of the codec
    const char *profile; // NULL or "": the default of the encoder
    double crf;          // constant rate factor; NaN: the default of the codec
} VideoOptions;

typedef struct VideoArguments {
    const char *words[32]; // some point into this struct
    size_t count;
    char filter[160];
    char crf[16];
    char problem[200]; // reason why the options are not possible
} VideoArguments;

// Returns true if the file name ends in .mp4, .m4v, .mov, .mkv, .webm, .ogg or .gif.
bool video_has_suffix(const char *file);
// Fills `arguments` for a file with such a name. If the container does not allow the codec, or the codec does not have
// an option, returns false and sets `problem`.
bool video_arguments(VideoArguments *arguments, const char *file, const VideoOptions *options);
