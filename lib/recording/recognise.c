// recognise.c: functions of petri-archive.h that need no SQLite.
#include "recording/recognise.h"

#include "base/file.h"
#include "base/host_struct.h"
#include "petri-archive.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

void petri_archive_options_init(PetriArchiveOptions *options, size_t size) {
    const PetriArchiveOptions usual = {.size = size, .keyframe_every = 1000, .digest_every = 1};
    host_struct_write(options, size, &usual, sizeof usual);
}

int archive_open_regular(const char *path, int flags, struct stat *info) {
    if (!path || fstatat(AT_FDCWD, path, info, flags & O_NOFOLLOW ? AT_SYMLINK_NOFOLLOW : 0) != 0 ||
        !S_ISREG(info->st_mode))
        return -1;
    int file = file_open_at(AT_FDCWD, path, O_RDONLY | O_NONBLOCK | flags, 0);
    if (file >= 0 && (fstat(file, info) != 0 || !S_ISREG(info->st_mode))) {
        close(file);
        return -1;
    }
    return file;
}

bool archive_has_header(int file) {
    static const char magic[] = "SQLite format 3";
    enum { ID_AT = 68 }; // position of the application id in the header of a database
    unsigned char header[ID_AT + 4];
    const unsigned char *id = header + ID_AT;
    return pread(file, header, sizeof header, 0) == sizeof header && memcmp(header, magic, sizeof magic) == 0 &&
           ((uint32_t)id[0] << 24 | (uint32_t)id[1] << 16 | (uint32_t)id[2] << 8 | id[3]) == ARCHIVE_APPLICATION_ID;
}

bool petri_archive_is(const char *file) {
    struct stat info;
    int opened = archive_open_regular(file, 0, &info);
    bool known = opened >= 0 && archive_has_header(opened);
    if (opened >= 0)
        close(opened);
    return known;
}
