// listen.h: a socket on which editors send text to a view: `petri view --listen`, `petri send`.
//
// A client connects, writes a text and ends its writing; it gets lines of JSON and the end. The text is evaluated as at
// the prompt of petri repl, or is one of `.set NAME VALUE`, `.set NAME` (its default), `.back N` (frames), `.drop`
// (what was sent before) and `.reset`. A line is {"text": …} of output, a diagnostic as petri check --format=json has
// it, or the last one: {"done": true or false, "frame": …, "values": …, "bindings": …, "nodes": …}.
#ifndef PETRI_SRC_VIEW_LISTEN_H
#define PETRI_SRC_VIEW_LISTEN_H

#include "view/live_script.h"

typedef struct Listener {
    char *path; // NULL: nobody listens
    int socket;
    int client;      // -1: none
    ByteBuffer text; // what the client has sent so far
} Listener;

// Opens the socket, which its owner alone may use. False after a message.
bool listener_open(Listener *listener, const char *path);
// What became of the world: nothing, something that the next frame shows, or another frame, whose picture is there.
typedef enum ListenerResult { LISTENER_NOTHING, LISTENER_ACCEPTED, LISTENER_MOVED } ListenerResult;
// Never waits for a client.
ListenerResult listener_serve(Listener *listener, LiveScript *live);
// Removes the socket. A listener that was never opened is fine.
void listener_close(Listener *listener);

#endif
