// options.c: see options.h.
#include "render/options.h"

#include "cli/option_groups.h"
#include "petri-draw.h"

#include <stdlib.h>

typedef RenderOptions Own;

// Reads WIDTHxHEIGHT, in pixels.
static bool read_size(const Args *args, void *field) {
    char *end = NULL;
    long width = strtol(args->value, &end, 10);
    long height = end != args->value && (*end == 'x' || *end == 'X') ? strtol(end + 1, &end, 10) : 0;
    if (*end != '\0' || width < 1 || height < 1 || width > PETRI_MAX_PICTURE_SIDE || height > PETRI_MAX_PICTURE_SIDE) {
        SCOPED_TEXT expected = {0};
        text_add_format(&expected, "WIDTHxHEIGHT, each from 1 to %d", PETRI_MAX_PICTURE_SIDE);
        return option_invalid(args, expected.bytes);
    }
    *(Size *)field = (Size){(int)width, (int)height};
    return true;
}

// clang-format off
static const OptionSpec ROWS[] = {
    OWN("output", 'o', "FILE", NOT_IN_GOLDENS(option_text), output, "write to OUT.png, OUT%05d.png (one per frame), OUT.svg, OUT.pdf, or a video such as OUT.mp4 or OUT.gif; - for standard output")
    OWN("format", 0, "F", NOT_IN_GOLDENS(option_text), format, "select the format for '-o -': png, svg, pdf, mp4, m4v, mov, mkv, webm, ogg or gif (default: png)")
    SHARED("frame", 0, "N", WHOLE(0, INT64_MAX - 1), frame, "draw only frame N, counted from 0 (default: the last)")
    LENGTH_OPTIONS
    OWN("every", 0, "K", WHOLE(1, INT64_MAX), every, "draw every K-th frame, starting with the first")
    OWN("size", 0, "WxH", read_size, size, "set the picture size in pixels (default: the size of the script's window)")
    OWN("scale", 0, "S", option_positive, scale, "multiply the size of the picture in pixels by S (default: 1)")
    OWN("window", 0, "WINDOW", option_text, window, "draw the window with this id or number, counted from 0 (default: the first with content)")
    OWN("auto", 0, NULL, option_flag, automatic, "draw the particles instead of the script's canvas")
    CLOCK_OPTIONS DEFINE_OPTION STATE_OPTION FILE_OPTIONS THREADS_OPTION LIMIT_OPTIONS METHOD_OPTIONS FROM_OPTION
    REPORT_OPTIONS NO_MORE_OPTIONS
};
// clang-format on
const OptionTable RENDER_OPTIONS = {ROWS, sizeof(Own), &(const Own){.every = 1, .scale = 1}};
