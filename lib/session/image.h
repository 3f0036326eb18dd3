// image.h: one walk over everything that determines how a session continues.
//
// image_write passes each part of a session to a sink. There are two: the words of a checkpoint (checkpoint.c), and
// the text of state files and keyframes (image_text.c). Digests have their own walk (state/digest.c), because they
// hash only the entries, in parallel and without going through values that did not change.
//
// Configuration and names of the host are lines `NAME = VALUE`, like the clock and the input:
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
//
// Systems refer to the entries of their particles by slots of the dictionary.
#pragma once

#include "petri.h"
#include "scene/scene.h"
#include "session/clock.h"

// The parts of an image, in the order in which they are written.
enum {
    IMAGE_CONFIGURATION = 1,
    IMAGE_CLOCK = 2,
    IMAGE_HOST_NAMES = 4,
    IMAGE_INPUT = 8,
    IMAGE_ENTRIES = 16,
    IMAGE_SYSTEMS = 32,
};

typedef struct ImageSink ImageSink;
struct ImageSink {
    // Receives a line. Its value consists of the elements of `first`, then those of `rest`. `name` is a string literal.
    // The values are valid only during the call.
    void (*line)(ImageSink *sink, const char *name, Value first, Value rest);
    void (*entry)(ImageSink *sink, Value key, Value value);
    void (*system)(ImageSink *sink, const SceneSystem *system);
    // True: receives all slots of the dictionary in their order, so that each entry keeps its slot. False: receives
    // only entries that have a value, in canonical order (spec digest.md 2), so that equal states have equal images.
    bool all_slots;
};

// Passes the parts of a session to a sink.
void image_write(PetriSession *session, unsigned parts, ImageSink *sink);

// New data that will replace the session's data (checkpoint_replace).
typedef struct Incoming {
    Arena arena; // temporary data of the function that fills in the other fields
    State *state;
    Clock clock;
    InputState input_state;
    InputBindings bindings;
    unsigned old_rules; // by which the new data was computed (base/spec.h)
    bool has_input;     // false: the new data contains no input, so the session keeps its own
} Incoming;

// Reads a line of the part IMAGE_INPUT; ignores lines of other parts. Returns false if its value is not valid.
bool image_read_input(Incoming *incoming, Str name, Value value);
// Restores a system into the scene.
void image_read_system(PetriSession *session, Incoming *incoming, const SceneSystem *system);

// Stores the element `index` of a value, if it is a finite number, else returns false.
bool image_number_at(Value value, uint32_t index, double *number);
// Copies `count` finite numbers from a value. Returns false if the value is not of this form.
bool image_numbers(Value value, double *numbers, uint32_t count);
bool image_is_integer(double x, double min, double max);
