// file_access.c: see file_access.h.
//
// A path is always resolved before it is compared with the allowed folders, and then opened from that folder without
// following links. If a path is not allowed, errno is EXDEV.
#include "base/file_access.h"

#include "base/file.h"
#include "base/os.h"
#include "base/source.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void file_access_add(Arena *arena, FileAccess *file_access, FileAccessKind kind, const char *const *names) {
    char resolved[PATH_MAX];
    uint32_t more = 0, count = file_access->counts[kind];
    while (names && names[more])
        more++;
    Str *folders = arena_alloc_array(arena, count + more, sizeof *folders);
    if (count)
        memcpy(folders, file_access->folders[kind], count * sizeof *folders);
    for (uint32_t i = 0; i < more; i++)
        if (file_resolve(names[i], resolved))
            folders[count++] = str_copy(arena, str_from(resolved));
    file_access->folders[kind] = folders;
    file_access->counts[kind] = count;
}

Str file_access_folder(Arena *arena, Str directory) {
    char resolved[PATH_MAX];
    const char *name = directory.len ? str_to_c(arena, directory) : ".";
    return realpath(name, resolved) ? str_copy(arena, str_from(resolved)) : (Str){0};
}

FileAccess file_access_copy(Arena *arena, const FileAccess *file_access) {
    FileAccess copy = *file_access;
    for (int kind = 0; kind < FILE_ACCESS_KIND_COUNT; kind++) {
        Str *folders = arena_alloc_array(arena, copy.counts[kind], sizeof *folders);
        for (uint32_t i = 0; i < copy.counts[kind]; i++)
            folders[i] = str_copy(arena, copy.folders[kind][i]);
        copy.folders[kind] = folders;
    }
    copy.script_folder = str_copy(arena, copy.script_folder);
    copy.directory = str_copy(arena, copy.directory);
    copy.on_read = NULL;
    return copy;
}

static bool is_below(Str folder, const char *path) {
    return folder.len == 1 || (folder.len > 0 && strncmp(path, folder.bytes, folder.len) == 0 &&
                               (path[folder.len] == '/' || path[folder.len] == '\0'));
}

// Returns the allowed folder that contains a canonical path, or NULL.
static const Str *find_folder(const FileAccess *file_access, FileAccessKind kind, const char *path) {
    if (file_access->no_files)
        return NULL;
    if (is_below(file_access->script_folder, path))
        return &file_access->script_folder;
    for (uint32_t i = 0; i < file_access->counts[kind]; i++)
        if (is_below(file_access->folders[kind][i], path))
            return &file_access->folders[kind][i];
    return NULL;
}

bool file_access_normalise(const char *path, char normal[PATH_MAX]) {
    size_t len = 0;
    bool absolute = path[0] == '/';
    if (strlen(path) >= PATH_MAX) {
        errno = ENAMETOOLONG;
        return false;
    }
    if (absolute)
        normal[len++] = '/';
    size_t root = len; // length of the prefix that ".." cannot remove
    for (size_t size; *path; path += size) {
        size = strcspn(path, "/");
        bool up = size == 2 && path[0] == '.' && path[1] == '.';
        if (up && len > root) {
            while (len > root && normal[len - 1] != '/')
                len--;
            len -= len > root;
        } else if (size && !(size == 1 && path[0] == '.') && !(up && absolute)) {
            if (len > 0 && normal[len - 1] != '/')
                normal[len++] = '/';
            memcpy(normal + len, path, size);
            len += size;
            root = up ? len : root;
        }
        size += path[size] == '/';
    }
    normal[len] = 0;
    return true;
}

bool file_access_read(const FileAccess *file_access, const char *path, Str *bytes) {
    char normal[PATH_MAX];
    if (!file_access_normalise(path, normal))
        return false;
    bytes->len = 0;
    bytes->bytes = file_access->read_file(file_access->read_user_data, normal, &bytes->len);
    errno = ENOENT;
    return bytes->bytes;
}

bool file_access_read_unsaved(const FileAccess *file_access, const char *path, Str *bytes) {
    char resolved[PATH_MAX];
    bytes->bytes = NULL;
    if (file_access && file_access->read_unsaved &&
        file_access_resolve(file_access, FILE_ACCESS_READ, path, resolved) && access(resolved, F_OK) == 0)
        bytes->bytes = file_access->read_unsaved(file_access->read_user_data, resolved, &bytes->len);
    return bytes->bytes;
}

bool file_access_allows(const FileAccess *file_access, FileAccessKind kind, const char *path) {
    return !file_access || (kind == FILE_ACCESS_READ && file_access->read_file) || find_folder(file_access, kind, path);
}

bool file_access_resolve(const FileAccess *file_access, FileAccessKind kind, const char *path,
                         char resolved[PATH_MAX]) {
    if (!file_resolve(path, resolved))
        return false;
    errno = EXDEV;
    return file_access_allows(file_access, kind, resolved);
}

void file_access_report(const FileAccess *file_access, const char *path, Str bytes) {
    if (file_access && file_access->on_read)
        file_access->on_read(file_access->on_read_user_data, path, bytes);
}

// Closes a folder and keeps errno.
static void close_folder(int folder) {
    int error = errno;
    close(folder);
    errno = error;
}

int file_open_below(int folder, char *rest, int flags, mode_t mode, bool make_folders) {
    for (char *slash; (slash = strchr(rest, '/')); rest = slash + 1) {
        *slash = '\0';
        if (make_folders)
            mkdirat(folder, rest, 0777); // fails if it exists
        int next = file_open_at(folder, rest, OS_SEARCH | O_DIRECTORY | O_NOFOLLOW, 0);
        close_folder(folder);
        if (next < 0)
            return -1;
        folder = next;
    }
    int file = file_open_at(folder, rest[0] ? rest : ".", flags | O_NOFOLLOW, mode);
    close_folder(folder);
    return file;
}

// Opens a canonical path below a folder without following links. Modifies `path`.
static int open_below(const Str *folder, char *path, int flags) {
    int start = file_open_at(AT_FDCWD, folder->bytes, OS_SEARCH | O_DIRECTORY, 0);
    char *rest = path + folder->len;
    rest += rest[0] == '/';
    if (start < 0)
        return -1;
    int file = os_open_below(start, rest[0] ? rest : ".", flags);
    if (file < 0 && errno == ENOSYS)
        return file_open_below(start, rest, flags, 0, false);
    close_folder(start);
    return file;
}

int file_access_open(const FileAccess *file_access, const char *path, int flags) {
    char resolved[PATH_MAX];
    if (!file_access)
        return file_open_at(AT_FDCWD, path, flags, 0);
    if (!file_access_resolve(file_access, FILE_ACCESS_READ, path, resolved))
        return -1;
    return open_below(find_folder(file_access, FILE_ACCESS_READ, resolved), resolved, flags);
}

bool file_access_replace(const FileAccess *file_access, const char *path, Replacement *replacement) {
    char resolved[PATH_MAX];
    if (!file_access)
        return replace_begin(replacement, path, 0);
    if (!file_access_resolve(file_access, FILE_ACCESS_WRITE, path, resolved))
        return false;
    const Str *folder = find_folder(file_access, FILE_ACCESS_WRITE, resolved);
    char *slash = strrchr(resolved, '/'), name[NAME_MAX + 1];
    if (strlen(slash + 1) > NAME_MAX || (size_t)(slash - resolved) < (folder->len > 1 ? folder->len : 0)) {
        errno = strlen(slash + 1) > NAME_MAX ? ENAMETOOLONG : EISDIR;
        return false;
    }
    memcpy(name, slash + 1, strlen(slash + 1) + 1);
    slash[slash == resolved] = '\0';
    int open = open_below(folder, resolved, O_RDONLY | O_DIRECTORY);
    return open >= 0 && replace_begin_in(replacement, open, name, 0);
}

bool file_access_make_folders(const FileAccess *file_access, const char *path) {
    char resolved[PATH_MAX], prefix[PATH_MAX];
    struct stat info;
    if (strlen(path) >= sizeof prefix)
        return true; // the error is reported when the file is written
    for (const char *slash = strchr(path + 1, '/'); path[0] && slash; slash = strchr(slash + 1, '/')) {
        memcpy(prefix, path, (size_t)(slash - path));
        prefix[slash - path] = '\0';
        if (stat(prefix, &info) < 0 && errno == ENOENT &&
            file_access_resolve(file_access, FILE_ACCESS_WRITE, prefix, resolved))
            mkdir(resolved, 0777);
    }
    return file_access_resolve(file_access, FILE_ACCESS_WRITE, path, resolved) || errno != EXDEV;
}

const char *file_access_reason(Arena *arena, const FileAccess *file_access, FileAccessKind kind, const char *path) {
    static const char *const words[] = {[FILE_ACCESS_READ] = "read", [FILE_ACCESS_WRITE] = "write"};
    char resolved[PATH_MAX];
    if (file_access->no_files)
        return "file access is disabled (--no-files)";
    if (!file_resolve(path, resolved))
        return "access denied";
    struct stat info;
    bool is_folder = stat(resolved, &info) == 0 && S_ISDIR(info.st_mode);
    Str folder = is_folder ? str_from(resolved) : path_directory(str_from(resolved));
    folder.len -= folder.len > 1 && !is_folder;
    return str_format(arena, "scripts are not allowed to %s there; to allow it, use '--allow-%s %.*s'", words[kind],
                      words[kind], (int)folder.len, folder.bytes)
        .bytes;
}
