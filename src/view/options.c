// options.c: see options.h.
#include "view/options.h"

#include "cli/option_groups.h"

typedef ViewOptions Own;

// clang-format off
static const OptionSpec ROWS[] = {
    OWN("terminal", 0, NULL, option_flag, terminal, "show the picture in the terminal even if there is a display")
    OWN("fullscreen", 0, NULL, option_flag, full_screen, "fill the screen; the key f switches it off")
    OWN("screen", 0, "N", WHOLE(0, 63), screen, "open the window on screen N, counted from 0 (default: 0)")
    OWN("auto", 0, NULL, option_flag, automatic, "show the particles instead of the script's canvas")
    OWN("listen", 0, "SOCKET", option_text, listen, "accept code from `petri view --send` on the Unix socket SOCKET, only from the same user")
    OWN("send", 0, "SOCKET", option_text, send, "send code, the operand, to the view that listens on SOCKET, and print its answer")
    SHARED("frames", 0, "N", WHOLE(0, INT64_MAX), frames, "close after N frames")
    SHARED("runtime", 0, "T", option_time, run_time, "close after a time T: seconds, or minutes and hours as m:s or h:m:s")
    OWN("window", 0, "WINDOW", option_text, window, "show only the window with this id or number, counted from 0 (default: all windows; in a terminal, the first)")
    FPS_OPTION
    SHARED("lockstep", 0, NULL, option_unset, realtime, "run as fast as possible with time = frame/fps")
    SHARED("realtime", 0, NULL, option_flag, realtime, "follow the wall clock (default); frame 0 is at time 0")
    DEFINE_OPTION STATE_OPTION FILE_OPTIONS THREADS_OPTION LIMIT_OPTIONS METHOD_OPTIONS RECORDING_OPTIONS
    REPORT_OPTIONS NO_MORE_OPTIONS
};
// clang-format on
const OptionTable VIEW_OPTIONS = {ROWS, sizeof(Own), &(const Own){.screen = -1}};
