// live_script.h: what `petri view` looks at: a script that runs, is loaded anew when it is saved, and has pictures.
//
// A script that cannot be loaded, or a frame that cannot be made, is told and changes nothing: the last good program
// goes on, or waits.
#ifndef PETRI_SRC_VIEW_LIVE_SCRIPT_H
#define PETRI_SRC_VIEW_LIVE_SCRIPT_H

#include "cli/byte_buffer.h"
#include "cli/file_watch.h"
#include "cli/history.h"
#include "cli/options.h"
#include "cli/state_file.h"
#include "petri-draw.h"
#include "render/recording.h"

// What was told about a script that runs all the same, for a view to list.
typedef struct Warnings {
    int count; // without notes
    ByteBuffer text;
} Warnings;

typedef struct LiveScript {
    const Options *options;
    PetriSession *session;
    PetriPainter *painter;
    PetriPicture *picture; // of the last frame; NULL: there is nothing to draw
    Recording recording;
    FileWatch *watch;
    int64_t frames;            // made since the view was opened, without early ones
    bool before_first_picture; // the last frame could not show particles where they are (petri_picture_ready)
    double detail;             // of the pictures (PetriPictureOptions), for those to come
    bool awaits_display;       // for a display, which has a say in how the painter draws: no picture is made yet
    bool picture_hidden;       // `picture` is of an early frame: it tells its size and is not shown
    bool halted;               // a frame could not be made; the next load or reset goes on
    bool broken;               // the script on disk cannot be loaded; an earlier version is running
    bool failed;               // something could not be read, written or recorded
    bool memory_reported;      // there was no memory for a picture, which was told
    StateFile state;
    bool keeps_history;      // frames are kept, to go back to them
    FrameHistory history;    // … here
    bool invalid_definition; // the script cannot take a value of -D
    // Messages
    bool hold_messages;    // standard error belongs to the display: messages are kept in `log` until it is closed
    bool shown;            // the last diagnostic that was no note was shown
    ByteBuffer log;        // bounded
    ByteBuffer error_text; // what is wrong now, for the overlay
    Warnings warnings;     // of the program that is running, since it was loaded
} LiveScript;

// Opens and loads; the status to exit with, or OPTIONS_READ. The options have been read. Close in either case.
int live_script_open(LiveScript *live, const CommandContext *context, const Options *options);
void live_script_close(LiveScript *live);
// There is a display: pictures can be made from here on.
void live_script_begin(LiveScript *live);
// Pictures are made with so many pixels for each unit of the script's size, at most 1, which is the default; those of
// live_script_screenshot always with 1.
void world_set_detail(LiveScript *live, double detail);
// One frame and its picture; records what the script asks for. False if it could not be made.
bool live_script_step(LiveScript *live);
// Tells, once, that there was no memory for a picture; true for PETRI_OK.
bool live_script_check_drawn(LiveScript *live, PetriStatus status);
// If files of the script have changed: loads it, keeping state and clock. True if there was an attempt; then
// world->trouble tells whether it went well.
bool live_script_reload(LiveScript *live);
// Gives a parameter of the script another value, or its default if that is NULL, and goes on; false if it cannot be.
bool live_script_set_parameter(LiveScript *live, const char *name, const char *value);
// From here on frames are kept. False if there is no memory for that, which is told.
bool live_script_enable_history(LiveScript *live);
// Goes back so many frames, or to the first that is kept, of which there is a picture then. False with what keeps it
// from that.
bool live_script_go_back(LiveScript *live, int64_t count, ByteBuffer *why);
// The last good program starts anew: without state, before frame 0.
void live_script_reset(LiveScript *live);
// What is wrong, "" if nothing is. Valid until the next call.
const char *live_script_error_text(const LiveScript *live);
// Saves the state every few seconds, or at once.
void live_script_save(LiveScript *live, bool at_once);
// Writes the last frame's picture to a PNG file that did not exist, named after script and frame, in this folder. False
// if it cannot be written. `name` gets what it is called.
bool live_script_screenshot(LiveScript *live, char *name, size_t size);
// Writes what was kept while standard error was not ours, and writes there from now on.
void live_script_release_messages(LiveScript *live);

// What may be in a corner all the time: how many there are, and the key that lists them; "" if there are none.
void warnings_mark(const Warnings *warnings, char *text, size_t size);
// The list, under a line that tells how many there are.
void warnings_list(const Warnings *warnings, char *text, size_t size);

#endif
