// input_bind.h: `!pointer` and `!key` inside a `!window`: the user's input in the state dictionary.
//
// The host reports input at any time. The state is written between two frames, so that a frame sees consistent input. A
// key that was pressed and released between two frames counts as pressed for one frame. Nothing is written before the
// first report.
#pragma once

#include "schema/reader.h"
#include "state/state.h"

enum { INPUT_BUTTONS = 8, INPUT_KEYS = 105, INPUT_KEY_NONE = -1 };

// A key or button.
typedef struct InputSwitch {
    bool down;       // true if pressed according to the last report
    bool frame_down; // true if pressed for the current frame
    bool toggled;    // inverted by each press
    uint32_t pushes; // number of presses since the last frame
    double pushed;   // beat of the frame that saw the last press; NaN: none yet
    double released; // beat of the frame that saw the last release; NaN: none yet
} InputSwitch;

// Where the input for one `!pointer` or `!key` of the last frame's tree is stored in the state.
typedef struct InputBinding {
    Value state; // key in the state dictionary, which is also the prefix of further keys
    int key;     // number of the key (input_key_number); INPUT_KEY_NONE: a pointer
} InputBinding;

typedef struct InputBindings {
    Arena arena; // holds the items and their state keys
    InputBinding *items;
    uint32_t count;
    uint32_t capacity;
} InputBindings;

// Reported input, and the input that the current frame sees.
typedef struct InputState {
    InputSwitch keys[INPUT_KEYS]; // indexed by input_key_number
    InputSwitch buttons[INPUT_BUTTONS];
    bool has_reports;   // true after the first report
    bool inside;        // true if the pointer is in the window
    double position[2]; // last position inside the window
} InputState;

typedef struct Input {
    InputBindings bindings;
    InputState state;
    // Symbols of state keys
    const Symbol *button_words[INPUT_BUTTONS];
    const Symbol *pushed;
    const Symbol *released;
    const Symbol *toggled;
    const Symbol *beat;
} Input;

// Initialises the structs: no reports and no bindings.
void input_reset(InputState *input_state, InputBindings *bindings);
void input_init(Input *input, SymbolTable *symbols);
void input_free(Input *input);

// Returns the number of a key by its name, or INPUT_KEY_NONE if there is no such key.
int input_key_number(Str name);
// Returns true if a `!key` of the last frame's tree uses the key.
bool input_key_is_bound(const Input *input, int key);

// The input_report functions record input from the host. Pressing a key that is already pressed changes nothing.
void input_report_key(Input *input, int key, bool pressed);
// `position` is NULL outside the window, else two finite numbers; bit i of `buttons` is set if button i is pressed.
void input_report_pointer(Input *input, const double *position, uint32_t buttons);
// Releases all keys and buttons, and moves the pointer out of the window.
void input_release_all(Input *input);

// Adds a binding. Copies the state key.
void input_add_binding(InputBindings *bindings, Value state, int key);
// Reads the bindings from the windows of a frame's tree. Messages are allocated from `arena`. If memory for the
// bindings runs out, the call is aborted through arena->escape.
void input_bind(Input *input, Schema *schema, Value tree, Arena *arena);
// Changes made by input_write, which are undone if the frame is aborted.
typedef struct InputChange InputChange;
typedef struct InputUndo {
    const InputChange *last; // last change, in the arena of input_write; NULL: none
    bool has_reports;        // true if `state` is set
    InputState state;        // value of Input.state before input_write
} InputUndo;
// Writes the reported input to the state. Called before the frame at `beat` is evaluated. `arena` is the frame's arena.
// Stores the changes in `undo`.
void input_write(Input *input, State *state, Arena *arena, double beat, InputUndo *undo);
void input_undo_write(Input *input, State *state, const InputUndo *undo);
