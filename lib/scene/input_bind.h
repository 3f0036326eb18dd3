// input_bind.h: `!pointer` and `!key` inside a `!window`: what the user's hands do, in the state dictionary.
//
// The host reports what happens whenever it happens; the state is written between two frames, so that one frame sees
// one thing throughout. What was pressed and let go again between two frames counts as pressed for one frame. Until the
// host has reported something, nothing is written.
#ifndef PETRI_SCENE_INPUT_BIND_H
#define PETRI_SCENE_INPUT_BIND_H

#include "schema/reader.h"
#include "state/state.h"

enum { INPUT_BUTTONS = 8, INPUT_KEYS = 105, INPUT_KEY_NONE = -1 };

// Something that is pressed and let go.
typedef struct InputSwitch {
    bool down;       // as reported
    bool frame_down; // as the present frame sees it
    bool toggled;    // changes with each push
    uint32_t pushes; // not shown yet
    double pushed;   // beat of the frame that saw the last push; nan: there was none
    double released; // beat of the frame that saw the last release; nan: there was none
} InputSwitch;

// A node of the last frame's tree: where its input goes.
typedef struct InputBinding {
    Value state;
    int key; // INPUT_KEY_NONE: a pointer
} InputBinding;

typedef struct InputBindings {
    Arena arena; // of the keys of the state, too
    InputBinding *items;
    uint32_t count;
    uint32_t capacity;
} InputBindings;

// What has been reported and shown.
typedef struct InputState {
    InputSwitch keys[INPUT_KEYS]; // by number of their names
    InputSwitch buttons[INPUT_BUTTONS];
    bool has_reports; // the host has reported something
    bool inside;
    double position[2];
} InputState;

typedef struct Input {
    InputBindings bindings;
    InputState state;
    // Words of state keys
    const Symbol *button_words[INPUT_BUTTONS];
    const Symbol *pushed;
    const Symbol *released;
    const Symbol *toggled;
    const Symbol *beat;
} Input;

// Puts them to before anything was reported or bound.
void input_reset(InputState *input_state, InputBindings *bindings);
void input_init(Input *input, SymbolTable *symbols);
void input_free(Input *input);

// The number of a key's name; INPUT_KEY_NONE if there is no such key.
int input_key_number(Str name);
// Whether a node of the last frame's tree asks for the key.
bool input_key_is_bound(const Input *input, int key);

// What the host reports. A press while pressed changes nothing.
void input_report_key(Input *input, int key, bool pressed);
// `position` is NULL outside the window, else two finite numbers; bit i of `buttons` is button i.
void input_report_pointer(Input *input, const double *position, uint32_t buttons);
// Everything is let go and the pointer is outside.
void input_release_all(Input *input);

// Adds a binding; the key of the state is copied.
void input_add_binding(InputBindings *bindings, Value state, int key);
// Takes the bindings from the windows of a frame's tree; `arena` is for messages, and its escape the one to use.
void input_bind(Input *input, Schema *schema, Value tree, Arena *arena);
// What a write has changed, for when the frame is given up.
typedef struct InputChange InputChange;
typedef struct InputUndo {
    const InputChange *last; // in the write's arena
    bool has_reports;
    InputState state;
} InputUndo;
// Writes the state before the frame of this beat is evaluated; `arena` is that of the frame.
void input_write(Input *input, State *state, Arena *arena, double beat, InputUndo *undo);
void input_undo_write(Input *input, State *state, const InputUndo *undo);

#endif
