// spool.c: see spool.h.
//
// The first line of the file is one of KINDS. Blocks follow, each preceded by an Entry. The valid part ends before the
// first block with a wrong hash.
#include "hdf5/spool.h"

#include "base/file.h"
#include "base/hash_index.h"
#include "base/os.h"
#include "cli/cli.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

// First line of a spool. [0]: the spool continues an HDF5 file. [1]: the spool contains the whole trajectory.
static const char *const KINDS[] = {"petri spool 1 appends\n", "petri spool 1 creates\n"};
enum { LINE = 22 }; // length of the first line

typedef struct Entry {
    Hdf5Head head;
    uint64_t hash; // hash of the block
} Entry;

static bool report_error(const Spool *spool, const char *why) {
    message("cannot write %s: %s", spool->path.bytes, why);
    return false;
}

// Waits up to ten seconds for the lock: the petri-hdf5 of a run that was killed may still be finishing its file.
// Returns false if the file is still locked after that.
static bool lock_file(int file) {
    enum { TRIES = 200, PAUSE_MS = 50 };
    for (int i = 0; i < TRIES; i++) {
        if (os_lock(file) || errno != EWOULDBLOCK)
            return true;
        poll(NULL, 0, PAUSE_MS);
    }
    return false;
}

// Opens and locks the file. Tries twice, because the process that held the lock may have deleted the file.
static bool open_locked(Spool *spool) {
    struct stat info = {0};
    for (int i = 0; i < 2; i++) {
        spool->file = file_open_at(AT_FDCWD, spool->path.bytes, O_RDWR | O_CREAT | O_NOFOLLOW, 0666);
        if (spool->file < 0)
            return report_error(spool, strerror(errno));
        bool locked = lock_file(spool->file);
        if (locked && fstat(spool->file, &info) == 0 && info.st_nlink > 0) {
            spool->size = (uint64_t)info.st_size;
            return true;
        }
        close(spool->file);
        if (!locked)
            return report_error(spool, "the file is in use by another petri-hdf5 process");
    }
    return report_error(spool, "another process has deleted the file");
}

static bool read_at(const Spool *spool, uint64_t at, void *bytes, size_t length) {
    return lseek(spool->file, (off_t)at, SEEK_SET) >= 0 && file_read_bytes(spool->file, bytes, length);
}

static bool reset_spool(Spool *spool, bool whole) {
    spool->complete = whole;
    spool->has_frames = false;
    spool->size = spool->at = LINE;
    return (file_truncate(spool->file, 0) && lseek(spool->file, 0, SEEK_SET) == 0 &&
            file_write(spool->file, KINDS[whole], LINE)) ||
           report_error(spool, strerror(errno));
}

bool spool_open(Spool *spool, const char *path, bool begins) {
    char line[LINE] = "";
    *spool = (Spool){.file = -1};
    text_add_format(&spool->path, "%s.part", path);
    if (!open_locked(spool))
        return false;
    bool read = read_at(spool, 0, line, LINE);
    spool->complete = memcmp(line, KINDS[1], LINE) == 0;
    if (spool->size >= LINE && !spool->complete && memcmp(line, KINDS[0], LINE) != 0)
        return report_error(spool, "the existing file was not written by petri");
    spool->at = LINE;
    spool->has_frames = spool->size > LINE + sizeof(Entry); // a spool without frames has one empty block, HDF5_NEW_RUN
    return !begins && read ? true : reset_spool(spool, begins);
}

// Part of a block that has not been checked yet.
typedef struct Unchecked {
    const char *at;
    uint64_t length;
} Unchecked;

// Copies `size` bytes to `out`, unless `out` is NULL, and moves on. Returns false if there are fewer bytes.
static bool skip_bytes(Unchecked *rest, void *out, uint64_t size) {
    if (size > rest->length)
        return false;
    if (out)
        memcpy(out, rest->at, size);
    rest->at += size;
    rest->length -= size;
    return true;
}

// Moves on by padded strings of `bytes` bytes. Returns false if they contain fewer than `count` strings.
static bool skip_texts(Unchecked *rest, uint64_t bytes, uint64_t count) {
    Unchecked texts = {rest->at, bytes};
    if (bytes % 8 != 0 || !skip_bytes(rest, NULL, bytes))
        return false;
    for (; count > 0; count--) {
        const char *end = texts.length == 0 ? NULL : memchr(texts.at, '\0', texts.length);
        if (!end)
            return false;
        skip_bytes(&texts, NULL, (uint64_t)(end - texts.at) + 1);
    }
    return true;
}

// Moves on by a system. Returns false if it is invalid, or if an id refers to none of the first `texts` strings.
static bool skip_system(Unchecked *rest, uint64_t texts) {
    enum { MAX_EMPTY = 1 << 20 }; // maximum number of dimensions of a system without particles
    Hdf5System system;
    if (!skip_bytes(rest, &system, sizeof system) || !skip_texts(rest, system.name_bytes, 1) ||
        system.dimensions == 0 || system.dimensions > (system.particles > 0 ? UINT32_MAX : MAX_EMPTY))
        return false;
    uint64_t values = 2 * system.dimensions + HDF5_NUMBERS; // of a particle
    if (system.particles > rest->length / (values * 8) || !skip_bytes(rest, NULL, system.particles * (values - 2) * 8))
        return false;
    for (uint64_t i = 0; i < system.particles; i++) {
        int64_t id = -1;
        skip_bytes(rest, &id, sizeof id);
        if (id < -1 && (uint64_t)(-2 - id) >= texts)
            return false;
    }
    return skip_bytes(rest, NULL, system.particles * 8); // anchor flags
}

// Reads the start of a block, and returns true if the block contains a valid frame. Adds the number of its strings to
// *texts, the number of strings of the earlier frames of the run. A hash does not suffice, because anyone can compute
// it.
static bool read_frame(const char *block, uint64_t length, Hdf5Frame *frame, uint64_t *texts) {
    Unchecked rest = {block, length};
    if (!skip_bytes(&rest, frame, sizeof *frame) || !skip_texts(&rest, frame->text_bytes, frame->text_count))
        return false;
    *texts += frame->text_count;
    for (uint64_t i = 0; i < frame->system_count; i++)
        if (!skip_system(&rest, *texts))
            return false;
    return rest.length == 0;
}

bool spool_next(Spool *spool, int64_t after, Hdf5Head *head, char **block) {
    Entry entry;
    uint64_t at = spool->at + sizeof entry, texts = spool->texts;
    Hdf5Frame frame;
    if (at > spool->size || !read_at(spool, spool->at, &entry, sizeof entry) || entry.head.bytes > spool->size - at)
        return false;
    *head = entry.head;
    *block = memory_realloc(*block, head->bytes + 1);
    if (!read_at(spool, at, *block, head->bytes) || hash_bytes(head->command, *block, head->bytes) != entry.hash)
        return false;
    if (head->command == HDF5_ADD) {
        if (!read_frame(*block, head->bytes, &frame, &texts) || frame.number > after)
            return false;
        spool->has_frames = true;
    } else {
        texts = 0;
    }
    spool->texts = texts;
    spool->at = at + head->bytes;
    return true;
}

bool spool_add(Spool *spool, const Hdf5Head *head, const char *block) {
    Entry entry = {*head, hash_bytes(head->command, block, head->bytes)};
    if ((spool->at < spool->size && !file_truncate(spool->file, spool->at)) ||
        lseek(spool->file, (off_t)spool->at, SEEK_SET) < 0)
        return report_error(spool, strerror(errno));
    if (!file_write(spool->file, (const char *)&entry, sizeof entry) || !file_write(spool->file, block, head->bytes))
        return report_error(spool, strerror(errno));
    spool->at += sizeof entry + head->bytes;
    spool->size = spool->at;
    spool->has_frames = spool->has_frames || head->command == HDF5_ADD;
    return true;
}

bool spool_save(Spool *spool, int folder) {
    return (replace_sync(spool->file) && replace_sync(folder)) || report_error(spool, strerror(errno));
}

void spool_close(Spool *spool, bool done) {
    if (spool->file >= 0 && (done || !spool->has_frames))
        unlink(spool->path.bytes);
    if (spool->file >= 0)
        close(spool->file);
    text_free(&spool->path);
}
