// setup.h: the setup of a keyframe as text: configuration, clock, input and host globals (recorder.h).
//
//     run_time = null                configuration: values of `run_time` and `realtime` in scripts,
//     realtime = 0
//     script = 'dish.fl'             the loaded script,
//     host_names = 0                 number of names that the host had set when the script was compiled,
//     define = 'N=11'                each definition,
//     prompt = 'let a=1'             each statement of the prompt,
//     rates = 60;120;4               fps, tempo and quantum,
//     pragma_rates = 60;120;4        rates that the script's pragmas set,
//     base = 0;0;0                   frame, time and beat from which time is counted,
//     resolution = 0
//     clock = 1.5;3;2;0              time and beat of the frame, `performance` and `slow_frame`
//     global = 'N'                   each name that the host set,
//     value = 1;2                    with its value in the next line
//     binding = -1;:mouse            each `!pointer` (-1) or `!key` (its number), with its state key
//     pointer = 1;0.5;0.5            input: the pointer is inside; position
//     switch = 4;1;1;0;0             keys and buttons that are not as at the start: number, down, down in the frame,
//                                    toggled, presses; buttons follow the keys
//     pushed = 4;3                   beat of the last press
//     released = 4;2.5               beat of the last release
#pragma once

#include "session/session.h"

// Returns the text of the setup, or only of the configuration, in the session's text arena. Called within a protected
// call.
Str setup_write(PetriSession *session, bool whole);
