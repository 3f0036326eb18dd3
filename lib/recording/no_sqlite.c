// no_sqlite.c: archives in a build without SQLite. Each has this as its problem.
#include "base/heap.h"
#include "petri-archive.h"

struct PetriArchive {
    int nothing;
};

PetriArchive *petri_archive_create(PetriSession *session, const char *file, const PetriArchiveOptions *options) {
    (void)options;
    return session && file ? heap_calloc(1, sizeof(PetriArchive)) : NULL;
}

PetriArchive *petri_archive_open(const char *file, size_t memory_limit) {
    (void)memory_limit;
    return file ? heap_calloc(1, sizeof(PetriArchive)) : NULL;
}

PetriStatus petri_archive_complete(PetriArchive *archive) {
    (void)archive;
    return PETRI_UNSUPPORTED;
}

void petri_archive_close(PetriArchive **archive) {
    if (!archive)
        return;
    heap_free(*archive);
    *archive = NULL;
}

const char *petri_archive_problem(const PetriArchive *archive) {
    return archive ? "petri was built without SQLite; on Debian, install libsqlite3-dev and build petri again" : NULL;
}

PetriStatus petri_archive_add_note(PetriArchive *archive, const char *text) {
    (void)archive;
    (void)text;
    return PETRI_INVALID;
}

bool petri_archive_info(PetriArchive *archive, PetriArchiveInfo *info, size_t size) {
    (void)archive;
    (void)info;
    (void)size;
    return false;
}

bool petri_archive_file(PetriArchive *archive, size_t number, PetriArchiveFile *file, size_t size) {
    (void)archive;
    (void)number;
    (void)file;
    (void)size;
    return false;
}

bool petri_archive_parameter(PetriArchive *archive, size_t number, const char **name, const char **value) {
    (void)archive;
    (void)number;
    (void)name;
    (void)value;
    return false;
}

bool petri_archive_keyframe(PetriArchive *archive, size_t number, PetriArchiveKeyframe *keyframe, size_t size) {
    (void)archive;
    (void)number;
    (void)keyframe;
    (void)size;
    return false;
}

bool petri_archive_digest(PetriArchive *archive, int64_t frame, uint8_t digest[16]) {
    (void)archive;
    (void)frame;
    (void)digest;
    return false;
}

const char *petri_archive_read(void *archive, const char *name, size_t *length) {
    (void)archive;
    (void)name;
    (void)length;
    return NULL;
}

PetriStatus petri_archive_load(PetriArchive *archive, PetriSession *session, int64_t frame) {
    (void)archive;
    (void)session;
    (void)frame;
    return PETRI_UNSUPPORTED;
}

PetriStatus petri_archive_replay(PetriArchive *archive, PetriSession *session, int64_t frame) {
    (void)archive;
    (void)session;
    (void)frame;
    return PETRI_UNSUPPORTED;
}

void petri_archive_end_replay(PetriArchive *archive) {
    (void)archive;
}

bool petri_archive_keyframe_differs(PetriArchive *archive) {
    (void)archive;
    return false;
}

PetriStatus petri_archive_check(PetriArchive *archive) {
    (void)archive;
    return PETRI_UNSUPPORTED;
}
