// listen.h: a socket for `petri view --listen`, on which editors send text to a view with `petri view --send`.
//
// A client connects, writes code or a command, and shuts down its writing side. It then receives lines of JSON until
// the connection is closed. Code is evaluated as in petri repl. The commands are `.set NAME VALUE`, `.set NAME` (reset
// to the default), `.back N` (frames), `.drop` (remove everything sent before), `.reset`, and those of petri repl that
// stay in the frame, such as `.why`. Each line contains output,
// {"text": …}, or a diagnostic as in petri check --format=json. The last line is {"done": true or false, "frame": …,
// "values": …, "bindings": …, "nodes": …, "shadowed": …}.
#pragma once

#include "view/live_script.h"

typedef struct Listener {
    char *path;   // NULL: not listening
    int socket;   // accepts connections
    int client;   // connection to the current client; -1: none
    double heard; // clock_seconds() when the client connected or last sent something
    Text text;    // what the client has sent so far
} Listener;

// Opens the socket, accessible only to its owner. Returns false after a message.
bool listener_open(Listener *listener, const char *path);
// The effect of what a client sent. LISTENER_NOTHING: none. LISTENER_ACCEPTED: a change that the next frame shows.
// LISTENER_MOVED: a move to another frame, whose picture has already been made.
typedef enum ListenerResult { LISTENER_NOTHING, LISTENER_ACCEPTED, LISTENER_MOVED } ListenerResult;
// Handles a pending connection, if there is one. Does not wait for clients.
ListenerResult listener_serve(Listener *listener, LiveScript *live);
// Removes the socket. A listener that was never opened is ignored.
void listener_close(Listener *listener);
