// pack.h: links that contain a script, shared with the playground (src/web/page/link.mjs).
//
// A link is `#` and compressed JSON (deflate without a header, then base64url). `v` is the version, `t` the script
// text, `n` the file name, `f` a frame, `d` the digest of the state in that frame and `s` the version of the
// specification by which it was computed; links of petri 0.3 have none. `c` contains changes of
// parameters, each as [frame after which it is made, name, value]. Links of petri 0.2 have `h`, the SHA-256 of the
// printed state, instead of `d`.
#pragma once

#include "cli/memory.h"

enum { LINK_MAX_LENGTH = 100000 }; // maximum number of characters of a link

typedef struct LinkedChange {
    int64_t frame; // frame after which the change is made; -1: before the first frame
    size_t number; // index of the change in the link
    char *name;
    char *value; // in the syntax of scripts
} LinkedChange;

typedef struct Linked {
    Text text;
    char *name;
    LinkedChange *changes; // ordered by frame
    size_t change_count;
    int64_t frame; // frame to which the script runs; -1: no frame was computed
    char *digest;  // digest of the state in that frame, in hexadecimal; NULL: not in the link
    char *spec;    // version of the specification
    char *hash;    // SHA-256 of the printed state, in links of petri 0.2; NULL: not in the link
} Linked;

// Returns true if petri was built with the libraries for links. Otherwise returns false after a message.
bool link_possible(void);
// Adds the link, which starts with `#`. Returns false after a message if it is longer than `max_length` characters.
bool link_pack(Text *out, const Linked *linked, size_t max_length);
// Adds bytes in base64url.
void link_add_base64(Text *out, const char *bytes, size_t length);
// Reads a link: the part after the first `#`, or all of it if there is no `#`. Returns false after a message. The
// caller frees *linked with link_free even after a failure.
bool link_read(Linked *linked, const Text *link);
void link_free(Linked *linked);
