// replace.c: see replace.h.
//
// All steps refer to the open folder, so that they are not redirected if the folder is renamed. A temporary file is
// locked while its process lives, so files without a lock are stale. After an error, errno has the cause and the
// temporary file is removed.
#include "base/replace.h"

#include "base/file.h"
#include "base/os.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Temporary names consist of a prefix, 16 hexadecimal digits and a suffix.
#define PREFIX ".petri-"
#define SUFFIX ".tmp"
enum { PREFIX_LENGTH = sizeof PREFIX - 1, NAME_DIGITS = 16, MAX_TRIES = 100, MAX_SCANNED_ENTRIES = 4096 };

// Writes a random temporary name. Avoids snprintf, because this function may be called from a signal handler.
static bool make_name(char name[NAME_MAX + 1]) {
    uint64_t number = 0;
    if (!os_random(&number, sizeof number))
        return false;
    memcpy(name, PREFIX, PREFIX_LENGTH);
    for (int i = 0; i < NAME_DIGITS; i++, number >>= 4)
        name[PREFIX_LENGTH + i] = "0123456789abcdef"[number & 15];
    memcpy(name + PREFIX_LENGTH + NAME_DIGITS, SUFFIX, sizeof SUFFIX);
    return true;
}

static bool is_temporary_name(const char *name) {
    return strlen(name) == PREFIX_LENGTH + NAME_DIGITS + sizeof SUFFIX - 1 &&
           memcmp(name, PREFIX, PREFIX_LENGTH) == 0 &&
           strspn(name + PREFIX_LENGTH, "0123456789abcdef") == NAME_DIGITS &&
           strcmp(name + PREFIX_LENGTH + NAME_DIGITS, SUFFIX) == 0;
}

// Removes temporary files of killed processes, which are recognised because no process holds a lock on them.
static void remove_stale_files(int folder) {
    int again = file_open_at(folder, ".", O_RDONLY | O_DIRECTORY, 0);
    DIR *entries = again < 0 ? NULL : fdopendir(again);
    const struct dirent *entry;
    for (int i = 0; entries && i < MAX_SCANNED_ENTRIES && (entry = readdir(entries)); i++) {
        int file = is_temporary_name(entry->d_name)
                       ? file_open_at(folder, entry->d_name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK, 0)
                       : -1;
        if (file >= 0 && os_lock(file))
            unlinkat(folder, entry->d_name, 0);
        if (file >= 0)
            close(file);
    }
    if (entries)
        closedir(entries);
    else if (again >= 0)
        close(again);
}

// Locks a temporary file, so that other processes do not remove it. Also returns true if the file system has no locks,
// because remove_stale_files removes nothing there.
static bool lock_file(int file) {
    return os_lock(file) || errno != EWOULDBLOCK;
}

// Opens an unnamed file. Returns false if that is not supported.
static bool open_unnamed(Replacement *r) {
    r->file = os_open_unnamed(r->folder);
    if (r->file < 0)
        return false;
    if (lock_file(r->file))
        return true;
    close(r->file);
    r->file = -1;
    return false;
}

static bool open_named(Replacement *r) {
    struct stat info;
    for (int i = 0; i < MAX_TRIES && make_name(r->temporary_name); i++) {
        r->file = file_open_at(r->folder, r->temporary_name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0666);
        if (r->file < 0 && errno != EEXIST)
            break;
        // Another process may have removed the file before it was locked.
        if (r->file >= 0 && lock_file(r->file) && fstat(r->file, &info) == 0 && info.st_nlink > 0)
            return true;
        if (r->file >= 0)
            close(r->file);
        r->file = -1;
    }
    r->temporary_name[0] = '\0';
    return false;
}

static bool abort_with_error(Replacement *r, int error) {
    replace_abort(r);
    errno = error;
    return false;
}

bool replace_begin_in(Replacement *r, int folder, const char *name, unsigned flags) {
    struct stat info;
    size_t length = strlen(name);
    *r = (Replacement){.file = -1, .folder = folder, .only_new = flags & REPLACE_CREATE_ONLY};
    if (length == 0 || length > NAME_MAX)
        return abort_with_error(r, length == 0 ? ENOENT : ENAMETOOLONG);
    memcpy(r->name, name, length + 1);
    bool exists = fstatat(folder, name, &info, AT_SYMLINK_NOFOLLOW) == 0;
    if (exists && r->only_new)
        return abort_with_error(r, EEXIST);
    if (exists && !S_ISREG(info.st_mode))
        return abort_with_error(r, S_ISLNK(info.st_mode) ? ELOOP : S_ISDIR(info.st_mode) ? EISDIR : ENXIO);
    bool named = flags & REPLACE_NAMED || !open_unnamed(r);
    if (exists || named)
        remove_stale_files(folder);
    return !named || open_named(r) || abort_with_error(r, errno);
}

// If stdout or stderr is the file that `info` describes, returns its descriptor, else -1.
static int find_stream(const struct stat *info) {
    struct stat stream;
    for (int fd = STDOUT_FILENO; fd <= STDERR_FILENO; fd++)
        if (fstat(fd, &stream) == 0 && stream.st_dev == info->st_dev && stream.st_ino == info->st_ino)
            return fd;
    return -1;
}

bool replace_begin(Replacement *r, const char *path, unsigned flags) {
    char target[PATH_MAX];
    struct stat info;
    *r = (Replacement){.file = -1, .folder = -1};
    if (flags & REPLACE_CREATE_ONLY && lstat(path, &info) == 0) {
        errno = EEXIST;
        return false;
    }
    if (stat(path, &info) == 0 && !S_ISDIR(info.st_mode)) {
        int stream = find_stream(&info);
        r->direct = stream >= 0 || !S_ISREG(info.st_mode);
        if (r->direct) {
            r->file = stream >= 0 ? fcntl(stream, F_DUPFD_CLOEXEC, 0) : file_open_at(AT_FDCWD, path, O_WRONLY, 0);
            return r->file >= 0;
        }
    }
    if (!file_resolve(path, target))
        return false;
    char *name = strrchr(target, '/') + 1;
    char first = name[0];
    name[0] = '\0';
    int folder = file_open_at(AT_FDCWD, target, O_RDONLY | O_DIRECTORY, 0);
    if (folder < 0 && errno == EACCES)
        folder = file_open_at(AT_FDCWD, target, OS_SEARCH | O_DIRECTORY, 0);
    name[0] = first;
    if (folder < 0)
        return false;
    return replace_begin_in(r, folder, name, flags);
}

// The errors EINVAL and EBADF count as success, because they mean that the file system, or a descriptor opened with
// OS_SEARCH, does not support fsync.
bool replace_sync(int file) {
    bool done;
    do
        done = os_sync(file);
    while (!done && errno == EINTR);
    return done || errno == EINVAL || errno == EBADF;
}

// Gives the new file the target's name. If the file is unnamed and the target does not exist, linkat does this.
// Otherwise the file is first given a temporary name, unless it already has one. Then it is renamed to the target or,
// with only_new, linked as the target.
static bool link_or_rename(Replacement *r, bool exists) {
    bool named = r->temporary_name[0] != '\0';
    if (!named && (r->only_new || !exists)) {
        if (os_link_unnamed(r->file, r->folder, r->name))
            return true;
        if (errno != EEXIST || r->only_new)
            return false;
    }
    for (int i = 0; !named && i < MAX_TRIES && make_name(r->temporary_name); i++) {
        named = os_link_unnamed(r->file, r->folder, r->temporary_name);
        if (!named && errno != EEXIST)
            break;
    }
    if (!named) {
        r->temporary_name[0] = '\0';
        return false;
    }
    if (r->only_new) // unlike renameat, linkat fails if the target exists
        return linkat(r->folder, r->temporary_name, r->folder, r->name, 0) == 0;
    int result;
    do
        result = renameat(r->folder, r->temporary_name, r->folder, r->name);
    while (result != 0 && errno == EINTR);
    if (result != 0)
        return false;
    r->temporary_name[0] = '\0';
    return true;
}

bool replace_flush(Replacement *r) {
    struct stat info;
    if (!r->direct && fstatat(r->folder, r->name, &info, AT_SYMLINK_NOFOLLOW) == 0) {
        if (!S_ISREG(info.st_mode))
            return abort_with_error(r, EEXIST);
        (void)!fchown(r->file, info.st_uid, info.st_gid);
        (void)!fchmod(r->file, info.st_mode & 07777);
    }
    return replace_sync(r->file) || r->direct || abort_with_error(r, errno);
}

bool replace_rename(Replacement *r) {
    struct stat info;
    if (r->direct)
        return true;
    bool exists = fstatat(r->folder, r->name, &info, AT_SYMLINK_NOFOLLOW) == 0;
    if (exists && !S_ISREG(info.st_mode))
        return abort_with_error(r, EEXIST);
    return link_or_rename(r, exists) || abort_with_error(r, errno);
}

bool replace_end(Replacement *r) {
    if (r->direct) {
        int file = r->file;
        r->file = -1;
        return close(file) == 0 || errno == EINTR;
    }
    if (!replace_sync(r->folder)) // the new name must also reach the disk
        return abort_with_error(r, errno);
    replace_abort(r);
    return true;
}

bool replace_commit(Replacement *r) {
    return replace_flush(r) && replace_rename(r) && replace_end(r);
}

void replace_abort(Replacement *r) {
    if (r->temporary_name[0] != '\0')
        unlinkat(r->folder, r->temporary_name, 0);
    if (r->file >= 0)
        close(r->file);
    if (r->folder >= 0)
        close(r->folder);
    r->file = r->folder = -1;
    r->temporary_name[0] = '\0';
}
