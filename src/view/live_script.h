// live_script.h: the script of `petri view`, which runs, is reloaded when it is saved, and produces pictures.
//
// If the changed script cannot be loaded, the error is reported and the last good program keeps running. If a frame
// fails, the error is reported and the program is halted. States of the program (LiveState):
//
//                a frame failed
//              ──────────────────▶
//     RUNNING  ◀──────────────────  HALTED        Every reload that succeeds leads to RUNNING.
//        │      reset, go back, set    │
//        │ a parameter                 │ reload failed
//        ▼       a frame failed        ▼
//              ──────────────────▶
//     OUTDATED ◀──────────────────  OUTDATED_HALTED
//               as above
//
// States of the picture (PictureState), which is replaced after each frame:
//
//                    the particles are at their positions (petri_picture_ready)
//       NONE ────────────────────────────────────────────────────▶ VISIBLE ◀──────▶ COMPLETE
//        │ not yet: the picture is made only for its size            ▲       drawn with all
//        └───────────────────────▶ HIDDEN ───────────────────────────┘       shaders, or not
//
//     Out of memory: NONE. While a later frame is not ready, the picture and its state are retained.
//
// Only live_script.c changes these states.
#pragma once

#include "cli/archive.h"
#include "cli/file_watch.h"
#include "cli/memory.h"
#include "cli/options.h"
#include "cli/shader_test.h"
#include "cli/state_file.h"
#include "petri-draw.h"
#include "petri-live.h"
#include "render/recording.h"

// The warnings about the current program.
typedef struct Warnings {
    int count; // number of warnings and errors, excluding notes
    Text text;
} Warnings;

typedef enum LiveState { LIVE_RUNNING, LIVE_HALTED, LIVE_OUTDATED, LIVE_OUTDATED_HALTED } LiveState;
typedef enum PictureState { PICTURE_NONE, PICTURE_HIDDEN, PICTURE_VISIBLE, PICTURE_COMPLETE } PictureState;

typedef struct LiveScript {
    const Options *options;
    PetriSession *session;
    PetriPainter *painter;
    ShaderTester tester;
    LiveState state;
    PictureState picture_state;
    PetriPicture *picture;       // picture of the last frame; NULL: nothing to draw
    PetriPicture *last_complete; // earlier picture that was drawn with all shaders; NULL: none
    Recording recording;
    Archiving archiving; // the archive of the session
    FileWatch *watch;
    int64_t frames; // number of frames since the view was opened, not counting those before the first picture
    // True if the particles of the last frame are not at their positions yet (petri_picture_ready).
    bool before_first_picture;
    double detail; // detail of future pictures (PetriPictureOptions)
    // True while the display is not open yet. Nothing is drawn, because the display determines how the painter draws.
    bool awaits_display;
    bool all_windows;     // true if the display shows all windows of the script
    bool failed;          // true if an error occurred while reading, writing or recording
    bool memory_reported; // true if a failure to allocate memory for a picture was reported
    StateFile state_file;
    PetriHistory *history;   // used if other programs control the view (Options.listen), so that they can go back
    bool invalid_definition; // true if a value of -D is invalid for the script
    // Messages
    // True if messages are collected in `log` until the display is closed, because the display uses the terminal to
    // which standard error writes.
    bool hold_messages;
    bool shown;        // true if the last error or warning was shown; its notes are then shown too
    Text log;          // collected messages; limited in size
    Text error_text;   // current errors, for the overlay
    Warnings warnings; // warnings since the current program was loaded
} LiveScript;

// Opens a session and loads the script. Returns OPTIONS_READ on success, else the exit status. The caller calls
// live_script_close in either case.
int live_script_open(LiveScript *live, const CommandContext *context, const Options *options);
void live_script_close(LiveScript *live);
// Must be called once the display is open. From then on, pictures can be drawn.
void live_script_begin(LiveScript *live);
// Sets the number of pixels per unit of the script's size for future pictures: at most 1, the default. Screenshots
// always use 1.
void live_script_set_detail(LiveScript *live, double detail);
// Draws the picture of the last frame and returns the one to show. That is the last complete picture if a shader
// crashed the driver, or if a shader or scene exceeded a limit. NULL: nothing to show.
PetriPicture *live_script_draw(LiveScript *live);
// Computes one frame and its picture, and writes the files that the script records. Returns false if the frame failed.
bool live_script_step(LiveScript *live);
// Returns true for PETRI_OK. Reports PETRI_OUT_OF_MEMORY once.
bool live_script_check_drawn(LiveScript *live, PetriStatus status);
// If one of the script's files has changed, reloads the script and returns true, even if the reload fails. The script's
// state and clock are kept. If the reload succeeds, live_script_error_text is empty afterwards.
bool live_script_reload(LiveScript *live);
// Sets a parameter of the script, or resets it to its default if `value` is NULL. Returns false if this fails.
bool live_script_set_parameter(LiveScript *live, const char *name, const char *value);
// Returns true if a frame has failed and the program was not changed or reset since.
bool live_script_halted(const LiveScript *live);
// Starts storing frames. Returns false, after a message, if out of memory.
bool live_script_enable_history(LiveScript *live);
// Goes back `count` frames, or to the first stored frame if fewer are stored, and makes the frame's picture. On
// failure, returns false and adds the reason to `why`.
bool live_script_go_back(LiveScript *live, int64_t count, Text *why);
// Restarts the last good program before frame 0 with an empty state.
void live_script_reset(LiveScript *live);
// Returns the current errors, or "". Valid until the next call.
const char *live_script_error_text(const LiveScript *live);
// Saves the state if the last save was some seconds ago or if `at_once` is true.
void live_script_save(LiveScript *live, bool at_once);
// Writes the last frame's picture to a new PNG file in the current folder. The file name consists of the script's name
// and the frame number. Sets `name` to the file name. Returns false if the file cannot be written.
bool live_script_screenshot(LiveScript *live, char *name, size_t size);
// Writes the collected messages to standard error. Later messages are written there directly.
void live_script_release_messages(LiveScript *live);

// Sets `text` to the mark that is shown in a corner of the picture: the number of warnings and the key that lists them.
// If there are no warnings, sets `text` to "".
void warnings_mark(const Warnings *warnings, char *text, size_t size);
// Sets `text` to a line with the number of warnings, followed by the list of warnings.
void warnings_list(const Warnings *warnings, char *text, size_t size);
