// world.h: what `petri view` looks at: a script that runs, is loaded anew when it is saved, and has pictures.
//
// A script that cannot be loaded, or a frame that cannot be made, is told and changes nothing: the last good program
// goes on, or waits.
#ifndef PETRI_SRC_VIEW_WORLD_H
#define PETRI_SRC_VIEW_WORLD_H

#include "cli/bytes.h"
#include "cli/history.h"
#include "cli/options.h"
#include "cli/state_file.h"
#include "cli/watch.h"
#include "petri-draw.h"
#include "render/recording.h"

// What was told about a script that runs all the same, for a view to list.
typedef struct Warnings {
    int count; // without notes
    Bytes text;
} Warnings;

typedef struct World {
    const Options *options;
    PetriSession *session;
    PetriPainter *painter;
    PetriPicture *picture; // of the last frame; NULL: there is nothing to draw
    Recording recording;
    Watch *watch;
    int64_t frames; // made since the view was opened, without early ones
    bool early;     // the last frame could not show particles where they are (petri_picture_ready)
    bool waits;     // for a display, which has a say in how the painter draws: no picture is made yet
    bool unseen;    // `picture` is of an early frame: it tells its size and is not shown
    bool halted;    // a frame could not be made; the next load or reset goes on
    bool broken;    // the script on disk cannot be loaded; an earlier version is running
    bool failed;    // something could not be read, written or recorded
    bool lacking;   // there was no memory for a picture, which was told
    StateFile state;
    bool remembers;        // frames are kept, to go back to them
    FrameHistory history;  // … here
    bool wrong_definition; // the script cannot take a value of -D
    // Messages
    bool mute;         // standard error belongs to the display: messages are kept in `log` until it is closed
    bool shown;        // the last diagnostic that was no note was shown
    Bytes log;         // bounded
    Bytes trouble;     // what is wrong now, for the overlay
    Warnings warnings; // of the program that is running, since it was loaded
} World;

// Opens and loads; the status to exit with, or OPTIONS_READ. The options have been read. Close in either case.
int world_open(World *world, const Host *host, const Options *options);
void world_close(World *world);
// There is a display: pictures can be made from here on.
void world_begin(World *world);
// One frame and its picture; records what the script asks for. False if it could not be made.
bool world_step(World *world);
// Tells, once, that there was no memory for a picture; true for PETRI_OK.
bool world_drawn(World *world, PetriStatus status);
// If files of the script have changed: loads it, keeping state and clock. True if there was an attempt; then
// world->trouble tells whether it went well.
bool world_reload(World *world);
// Gives a parameter of the script another value, or its default if that is NULL, and goes on; false if it cannot be.
bool world_set_parameter(World *world, const char *name, const char *value);
// From here on frames are kept. False if there is no memory for that, which is told.
bool world_remember(World *world);
// Goes back so many frames, or to the first that is kept, of which there is a picture then. False with what keeps it
// from that.
bool world_go_back(World *world, int64_t count, Bytes *why);
// The last good program starts anew: without state, before frame 0.
void world_reset(World *world);
// What is wrong, "" if nothing is. Valid until the next call.
const char *world_trouble(const World *world);
// Saves the state every few seconds, or at once.
void world_save(World *world, bool at_once);
// Writes the last frame's picture to a PNG file that did not exist, named after script and frame, in this folder. False
// if it cannot be written. `name` gets what it is called.
bool world_screenshot(World *world, char *name, size_t size);
// Writes what was kept while standard error was not ours, and writes there from now on.
void world_unmute(World *world);

// What may be in a corner all the time: how many there are, and the key that lists them; "" if there are none.
void warnings_mark(const Warnings *warnings, char *text, size_t size);
// The list, under a line that tells how many there are.
void warnings_list(const Warnings *warnings, char *text, size_t size);

#endif
