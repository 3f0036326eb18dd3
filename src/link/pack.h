// pack.h: a script in a link, as the page in src/web has it: `#` and, compressed (deflate without a header, base64url),
// JSON: v version, t the script's text, n its file's name, c changes of parameters as [after which frame, name, value],
// f frame, h the hash of the state there. src/web/page/link.mjs is the same for JavaScript.
#ifndef PETRI_SRC_PACK_H
#define PETRI_SRC_PACK_H

#include "cli/byte_buffer.h"

typedef struct LinkedChange {
    int64_t frame; // after which one; -1: from the start
    char *name;
    char *value; // as the script would write it
} LinkedChange;

typedef struct Linked {
    ByteBuffer text;
    char *name;
    LinkedChange *changes;
    size_t change_count;
    int64_t frame; // -1: none was made
    char *hash;    // NULL: not told
} Linked;

// Whether petri was built with the libraries that this takes; says so if not.
bool link_possible(void);
// Adds `#…`. False after a message: the text is too long.
bool link_pack(ByteBuffer *out, const Linked *linked);
// Reads what is behind the first `#`, or all. False after a message. To be freed in any case.
bool link_read(Linked *linked, const ByteBuffer *link);
void link_free(Linked *linked);

#endif
