// listen.h: a socket for `petri view --listen`, on which editors send text to a view with `petri send`.
//
// A client connects, writes a text and shuts down its writing side; it then receives lines of JSON until the end. The
// text is evaluated as in petri repl, or is a command: `.set NAME VALUE`, `.set NAME` (reset to the
// default), `.back N` (frames), `.drop` (remove everything sent before) or `.reset`. Each line is output, {"text": …};
// or a diagnostic as in petri check --format=json; or the last line, {"done": true or false, "frame": …, "values": …,
// "bindings": …, "nodes": …}.
#ifndef PETRI_SRC_VIEW_LISTEN_H
#define PETRI_SRC_VIEW_LISTEN_H

#include "view/live_script.h"

typedef struct Listener {
    char *path; // NULL: not listening
    int socket;
    int client;      // -1: none
    ByteBuffer text; // what the client has sent so far
} Listener;

// Opens the socket, accessible only to its owner. Returns false after a message.
bool listener_open(Listener *listener, const char *path);
// The effect on the script: none, one that the next frame shows, or a move to another frame whose picture exists.
typedef enum ListenerResult { LISTENER_NOTHING, LISTENER_ACCEPTED, LISTENER_MOVED } ListenerResult;
// Handles a connection, if there is one, without waiting.
ListenerResult listener_serve(Listener *listener, LiveScript *live);
// Removes the socket. A listener that was never opened is ignored.
void listener_close(Listener *listener);

#endif
