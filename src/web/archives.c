// archives.c: wrappers for the functions of petri-archive.h, as in engine.c. Only engine-archives.wasm contains them.
// The files are in JavaScript's memory (engine/archive.mjs).
#include "petri-archive.h"
#include "petri-inspect.h"
#include "web/host.h"

#include <string.h>

EXPORT(PetriArchive *, web_archive_open, const char *file, double memory) {
    return petri_archive_open(file, (size_t)memory);
}

EXPORT(void, web_archive_close, PetriArchive *archive) {
    petri_archive_close(&archive);
}

EXPORT(bool, web_archive_info, PetriArchive *archive) {
    PetriArchiveInfo info;
    if (!petri_archive_info(archive, &info, sizeof info))
        return false;
    host_archive(info.script, info.command, info.version, info.sha256, (double)info.first_frame,
                 (double)info.last_frame);
    return true;
}

// Passes each version of each file to host_archived_file, except removed files.
EXPORT(void, web_archive_files, PetriArchive *archive) {
    PetriArchiveFile file;
    for (size_t i = 0; petri_archive_file(archive, i, &file, sizeof file); i++)
        if (file.bytes)
            host_archived_file(file.name, (double)file.frame, file.bytes, file.length);
}

EXPORT(PetriStatus, web_archive_load, PetriArchive *archive, PetriSession *session, double frame) {
    return petri_archive_load(archive, session, (int64_t)frame);
}

// Compares the current frame of a replay with the archive. Returns 0 if the archive has no digest of it, 1 if it is the
// same, and 2 if it differs.
EXPORT(int, web_archive_compare, PetriArchive *archive, PetriSession *session) {
    uint8_t recorded[16], computed[16];
    bool has_digest = petri_archive_digest(archive, petri_frame_number(session), recorded);
    bool differs = petri_archive_keyframe_differs(archive) ||
                   (has_digest &&
                    (petri_digest(session, computed) != PETRI_OK || memcmp(recorded, computed, sizeof recorded) != 0));
    return differs ? 2 : has_digest;
}
