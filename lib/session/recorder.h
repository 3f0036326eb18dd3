// recorder.h: the interface through which lib/recording records and replays sessions.
//
// A recording has everything that determines how a session continues. A keyframe is a complete copy: the state (in the
// form of a state file) and the setup, which is everything else. Between two keyframes, the recording has the files
// that were read, and all inputs that the host gave: changes of the configuration, pointer and keys, values that the
// host stored, and in real time the clock. Both texts have lines `NAME = VALUE` with values in printed form.
#pragma once

#include "base/private_api.h"
#include "base/str.h"
#include "petri-live.h"
#include "session/clock.h"

// Callbacks. Any of them may be NULL.
typedef struct Recorder {
    void *user_data;
    // Called before each frame. If a recording is replayed, it gives the inputs of the frame to the session, stores the
    // frame's clock in *clock and sets *has_clock. If it does not return PETRI_OK, petri_step returns that status.
    PetriStatus (*before_frame)(void *user_data, FrameClock *clock, bool *has_clock);
    // Called after each frame. `complete` is false if the frame counts but was aborted.
    void (*after_frame)(void *user_data, const FrameClock *clock, bool complete);
    // Called after frame number and state were replaced: by petri_load, petri_reset, petri_rewind or petri_restore.
    void (*jump)(void *user_data);
    // Called after the host has given an input of a kind (recorder_apply_input).
    void (*input)(void *user_data, const char *kind, Str payload);
    // Called after a file was read or a folder was listed, within a call of the session: must not call the session.
    // `name` is relative to the script's folder; that of a folder ends in a slash. If `bytes.bytes` is NULL, there is
    // no such file.
    void (*file)(void *user_data, const char *name, Str bytes);
    // Called before the session is closed or gets other callbacks. The session then has no callbacks.
    void (*end)(void *user_data);
    bool ignores_input; // true: the pointer and keys that the host reports have no effect
} Recorder;

// Sets the callbacks of a session; NULL removes them. Copies the struct.
void recorder_set(PetriSession *session, const Recorder *recorder) PRIVATE_API(recorder_set);

// --- for archives that are written

typedef enum RecorderText {
    RECORDER_SETUP,         // a keyframe's setup
    RECORDER_CONFIGURATION, // the part of the setup that petri_config_get returns
    RECORDER_STATE,         // the state of a keyframe
} RecorderText;

// Sets *text to a text of the session. It is valid until the next call that uses the session.
PetriStatus recorder_write(PetriSession *session, RecorderText what, Str *text) PRIVATE_API(recorder_write);

// Reports the text of the loaded script as a file that was read. After petri_rewind and petri_config_apply, it can
// differ from the text that was read last.
void recorder_report_script(PetriSession *session) PRIVATE_API(recorder_report_script);
// Returns true if a script is loaded.
bool recorder_has_script(const PetriSession *session) PRIVATE_API(recorder_has_script);
// Reads all files of the loaded script again and compiles it, so that they are reported. Returns the statuses of
// petri_reload.
PetriStatus recorder_read_again(PetriSession *session) PRIVATE_API(recorder_read_again);
typedef bool RecorderKnowsFile(void *user_data, Str name);
// Reads each file that a node of the last frame names for drawing, so that it is reported, except those that `knows`
// returns true for. If a file cannot be read, that is reported. If the search exceeds a limit of the session, reports
// it and returns PETRI_LIMIT_EXCEEDED; if it is interrupted, the next frame is too.
PetriStatus recorder_read_drawn_files(PetriSession *session, RecorderKnowsFile *knows, void *user_data)
    PRIVATE_API(recorder_read_drawn_files);
// Returns the file name of the loaded script, without its folder. Valid until the next load.
const char *recorder_script_name(const PetriSession *session) PRIVATE_API(recorder_script_name);

// --- for archives that are read

// Loads a keyframe into a session that has no script yet, or that has replayed earlier frames of the same recording.
// Returns PETRI_INVALID if the texts are not valid, or after a diagnostic.
PetriStatus recorder_restore(PetriSession *session, Str setup, Str state) PRIVATE_API(recorder_restore);
// Gives an input to the session. Kinds are "configuration", "pointer", "key", "state" and "global". Returns
// PETRI_INVALID for the same reasons as recorder_restore.
PetriStatus recorder_apply_input(PetriSession *session, Str kind, Str payload) PRIVATE_API(recorder_apply_input);
// Sets Recorder.ignores_input.
void recorder_ignore_input(PetriSession *session, bool ignores) PRIVATE_API(recorder_ignore_input);
// Returns true if petri_interrupt was called and the interrupt is pending.
bool recorder_is_interrupted(const PetriSession *session) PRIVATE_API(recorder_is_interrupted);
// Returns the number of functions, forces and variations of the host, which a recording cannot contain.
uint32_t recorder_host_functions(const PetriSession *session) PRIVATE_API(recorder_host_functions);

// --- for the session, which calls them after the events

void recorder_jump(PetriSession *session);
void recorder_pointer(PetriSession *session, const PetriPointer *pointer);
void recorder_key(PetriSession *session, const char *name, bool pressed);
void recorder_state(PetriSession *session, PetriValue key, PetriValue value);
void recorder_global(PetriSession *session, const char *name, PetriValue value);
void recorder_file(PetriSession *session, const char *path, Str bytes);
