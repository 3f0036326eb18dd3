// claim.c: the file of an archive that is written. Another recording of the same file is refused before anything is
// written, and so is any file that is not an archive.
#include "base/file.h"
#include "base/os.h"
#include "recording/archive.h"
#include "recording/journal.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static bool check_name(PetriArchive *archive, const char *name) {
    size_t length = strlen(name);
    if (length == 0)
        return archive_fail(archive, "the name is empty");
    if (strcmp(name, "-") == 0)
        return archive_fail(archive, "an archive cannot be written to standard output");
    if (name[0] == ':')
        return archive_fail(archive, "the name begins with ':', as those of SQLite's databases in memory do");
    if (name[length - 1] == '/')
        return archive_fail(archive, "the name is that of a folder");
    if (length + sizeof "./-journal" > PATH_MAX)
        return archive_fail(archive, "%s", strerror(ENAMETOOLONG));
    return true;
}

// Fails with the process that records the file, if the system knows it: SQLite also holds a lock.
static bool fail_in_use(PetriArchive *archive, int file) {
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (file >= 0 && fcntl(file, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK && lock.l_pid > 0)
        return archive_fail(archive, "the file is in use by another petri process (%ld)", (long)lock.l_pid);
    return archive_fail(archive, "the file is in use by another recording");
}

static const char *kind_of(mode_t mode) {
    return S_ISDIR(mode)    ? "it is a folder"
           : S_ISLNK(mode)  ? "it is a symbolic link"
           : S_ISFIFO(mode) ? "it is a named pipe"
                            : "it is not a regular file";
}

// Locks the open file, which must still have its name. On systems without such locks, SQLite's lock remains.
static bool lock(PetriArchive *archive, const char *name, int file) {
    struct stat opened, named;
    if (!os_lock(file) && errno == EWOULDBLOCK)
        return fail_in_use(archive, file);
    if (fstat(file, &opened) != 0 || lstat(name, &named) != 0 || opened.st_ino != named.st_ino ||
        opened.st_dev != named.st_dev)
        return fail_in_use(archive, -1); // another process has replaced the file
    return true;
}

// Creates the file and locks it. Returns the descriptor, or -1 after a problem.
static int create(PetriArchive *archive, const char *name) {
    int file = file_open_at(AT_FDCWD, name, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW, 0666);
    if (file < 0 && errno == EEXIST)
        fail_in_use(archive, -1);
    else if (file < 0)
        archive_fail(archive, "%s", strerror(errno));
    else if (lock(archive, name, file))
        return file;
    if (file >= 0)
        close(file);
    return -1;
}

// Removes the journal of a recording that was killed, because SQLite would apply it to the new archive.
static bool remove_journal(PetriArchive *archive, const char *name) {
    char journal[PATH_MAX];
    unsigned char magic[ARCHIVE_JOURNAL_MAGIC_BYTES] = {0}, none[sizeof magic] = {0};
    struct stat info;
    snprintf(journal, sizeof journal, "%s-wal", name);
    if (lstat(journal, &info) == 0)
        return archive_fail(archive, "'%s' is in the way; move it", journal);
    snprintf(journal, sizeof journal, "%s-journal", name);
    if (lstat(journal, &info) != 0)
        return true;
    int file = S_ISREG(info.st_mode) ? file_open_at(AT_FDCWD, journal, O_RDONLY | O_NONBLOCK | O_NOFOLLOW, 0) : -1;
    bool known = file >= 0 && file_read_some(file, magic, sizeof magic) >= 0 &&
                 (memcmp(magic, archive_journal_magic, sizeof magic) == 0 || memcmp(magic, none, sizeof magic) == 0);
    if (file >= 0)
        close(file);
    if (!known)
        return archive_fail(archive, "'%s' is in the way; move it", journal);
    return unlink(journal) == 0 || archive_fail(archive, "%s", strerror(errno));
}

// Replaces an existing file, which is locked. The new archive is another file, so that replays of the old one and its
// hard links keep their contents. An empty file is used as it is, with its permissions.
static int replace(PetriArchive *archive, const char *name, int old) {
    struct stat info;
    bool empty = fstat(old, &info) == 0 && info.st_size == 0;
    if (!empty && !archive_has_header(old)) {
        archive_fail(archive, "the file exists and is not an archive");
        return -1;
    }
    if (!remove_journal(archive, name))
        return -1;
    int file = empty ? fcntl(old, F_DUPFD_CLOEXEC, 0) : unlink(name);
    if (file < 0)
        archive_fail(archive, "%s", strerror(errno));
    return empty || file < 0 ? file : create(archive, name);
}

bool archive_claim_file(PetriArchive *archive, const char *name) {
    struct stat info;
    if (!check_name(archive, name))
        return false;
    if (lstat(name, &info) != 0) {
        if (remove_journal(archive, name))
            archive->claim = create(archive, name);
        return archive->claim >= 0;
    }
    if (!S_ISREG(info.st_mode))
        return archive_fail(archive, "%s", kind_of(info.st_mode));
    int old = file_open_at(AT_FDCWD, name, O_RDWR | O_NONBLOCK | O_NOFOLLOW, 0);
    if (old < 0)
        return archive_fail(archive, "%s", strerror(errno));
    if (fstat(old, &info) != 0 || !S_ISREG(info.st_mode))
        archive_fail(archive, "it is not a regular file");
    else if (lock(archive, name, old))
        archive->claim = replace(archive, name, old);
    close(old);
    return archive->claim >= 0;
}
