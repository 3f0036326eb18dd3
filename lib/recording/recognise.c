// recognise.c: functions of petri-archive.h that need no SQLite.
#include "recording/recognise.h"

#include "base/host_struct.h"
#include "petri-archive.h"

#include <stdio.h>
#include <string.h>

void petri_archive_options_init(PetriArchiveOptions *options, size_t size) {
    const PetriArchiveOptions usual = {.size = size, .keyframe_every = 1000, .digest_every = 1};
    host_struct_write(options, size, &usual, sizeof usual);
}

bool petri_archive_is(const char *file) {
    static const char magic[] = "SQLite format 3";
    enum { ID_AT = 68 }; // position of the application id in the header of a database
    unsigned char header[ID_AT + 4];
    FILE *stream = file ? fopen(file, "rb") : NULL;
    size_t length = stream ? fread(header, 1, sizeof header, stream) : 0;
    if (stream)
        fclose(stream);
    const unsigned char *id = header + ID_AT;
    return length == sizeof header && memcmp(header, magic, sizeof magic) == 0 &&
           ((uint32_t)id[0] << 24 | (uint32_t)id[1] << 16 | (uint32_t)id[2] << 8 | id[3]) == ARCHIVE_APPLICATION_ID;
}
