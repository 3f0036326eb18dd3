// reach.c: see reach.h.
#define _GNU_SOURCE // openat2, O_PATH
#include "base/reach.h"

#include "base/file.h"
#include "base/source.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#if defined __linux__ && defined __has_include
#if __has_include(<linux/openat2.h>)
#include <linux/openat2.h>
#include <sys/syscall.h>
#endif
#endif
#ifndef O_PATH
#define O_PATH O_RDONLY
#endif

void reach_add(Arena *arena, Reach *reach, ReachKind kind, const char *const *names) {
    char resolved[PATH_MAX];
    uint32_t more = 0, count = reach->counts[kind];
    while (names && names[more])
        more++;
    Str *folders = arena_alloc_array(arena, count + more, sizeof *folders);
    if (count)
        memcpy(folders, reach->folders[kind], count * sizeof *folders);
    for (uint32_t i = 0; i < more; i++)
        if (file_resolve(names[i], resolved))
            folders[count++] = str_copy(arena, str_from(resolved));
    reach->folders[kind] = folders;
    reach->counts[kind] = count;
}

Str reach_folder(Arena *arena, Str directory) {
    char resolved[PATH_MAX];
    const char *name = directory.len ? str_to_c(arena, directory) : ".";
    return realpath(name, resolved) ? str_copy(arena, str_from(resolved)) : (Str){0};
}

Reach reach_copy(Arena *arena, const Reach *reach) {
    Reach copy = *reach;
    for (int kind = 0; kind < REACH_KIND_COUNT; kind++) {
        Str *folders = arena_alloc_array(arena, copy.counts[kind], sizeof *folders);
        for (uint32_t i = 0; i < copy.counts[kind]; i++)
            folders[i] = str_copy(arena, copy.folders[kind][i]);
        copy.folders[kind] = folders;
    }
    copy.own = str_copy(arena, copy.own);
    copy.directory = str_copy(arena, copy.directory);
    return copy;
}

static bool is_below(Str folder, const char *path) {
    return folder.len == 1 || (folder.len > 0 && strncmp(path, folder.bytes, folder.len) == 0 &&
                               (path[folder.len] == '/' || path[folder.len] == '\0'));
}

// The folder that a canonical path lies below; NULL: none.
static const Str *find_folder(const Reach *reach, ReachKind kind, const char *path) {
    if (reach->nothing)
        return NULL;
    if (is_below(reach->own, path))
        return &reach->own;
    for (uint32_t i = 0; i < reach->counts[kind]; i++)
        if (is_below(reach->folders[kind][i], path))
            return &reach->folders[kind][i];
    return NULL;
}

bool reach_normal(const char *path, char normal[PATH_MAX]) {
    size_t len = 0;
    bool absolute = path[0] == '/';
    if (strlen(path) >= PATH_MAX) {
        errno = ENAMETOOLONG;
        return false;
    }
    if (absolute)
        normal[len++] = '/';
    size_t root = len; // what cannot be gone up from
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

bool reach_read(const Reach *reach, const char *path, Str *bytes) {
    char normal[PATH_MAX];
    if (!reach_normal(path, normal))
        return false;
    bytes->len = 0;
    bytes->bytes = reach->read(reach->read_host, normal, &bytes->len);
    errno = ENOENT;
    return bytes->bytes != NULL;
}

bool reach_unsaved(const Reach *reach, const char *path, Str *bytes) {
    char resolved[PATH_MAX];
    bytes->bytes = NULL;
    if (reach && reach->unsaved && reach_resolve(reach, REACH_READ, path, resolved) && access(resolved, F_OK) == 0)
        bytes->bytes = reach->unsaved(reach->read_host, resolved, &bytes->len);
    return bytes->bytes != NULL;
}

bool reach_has(const Reach *reach, ReachKind kind, const char *path) {
    return !reach || (kind == REACH_READ && reach->read) || find_folder(reach, kind, path);
}

bool reach_resolve(const Reach *reach, ReachKind kind, const char *path, char resolved[PATH_MAX]) {
    if (!file_resolve(path, resolved))
        return false;
    errno = EXDEV;
    return reach_has(reach, kind, resolved);
}

// Part by part, for systems that cannot do it at once.
static int walk(int folder, char *rest, int flags) {
    for (char *slash; (slash = strchr(rest, '/')) != NULL; rest = slash + 1) {
        *slash = '\0';
        int next = file_open_at(folder, rest, O_PATH | O_DIRECTORY | O_NOFOLLOW, 0);
        int error = errno;
        close(folder);
        errno = error;
        if (next < 0)
            return -1;
        folder = next;
    }
    int file = file_open_at(folder, rest[0] ? rest : ".", flags | O_NOFOLLOW, 0);
    int error = errno;
    close(folder);
    errno = error;
    return file;
}

// Opens a canonical path below a folder without following any link. It is taken apart meanwhile.
static int open_below(const Str *folder, char *path, int flags) {
    int start = file_open_at(AT_FDCWD, folder->bytes, O_PATH | O_DIRECTORY, 0);
    char *rest = path + folder->len;
    rest += rest[0] == '/';
    if (start < 0)
        return -1;
#ifdef RESOLVE_BENEATH
    struct open_how how = {.flags = (unsigned)(flags | O_CLOEXEC | O_NOCTTY),
                           .resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS};
    long file;
    do
        file = syscall(SYS_openat2, start, rest[0] ? rest : ".", &how, sizeof how);
    while (file < 0 && (errno == EINTR || errno == EAGAIN));
    if (file >= 0 || (errno != ENOSYS && errno != EPERM)) { // those two: an old kernel, a sandbox around us
        int error = errno;
        close(start);
        errno = error;
        return (int)file;
    }
#endif
    return walk(start, rest, flags);
}

int reach_open(const Reach *reach, const char *path, int flags) {
    char resolved[PATH_MAX];
    if (!reach)
        return file_open_at(AT_FDCWD, path, flags, 0);
    if (!reach_resolve(reach, REACH_READ, path, resolved))
        return -1;
    return open_below(find_folder(reach, REACH_READ, resolved), resolved, flags);
}

bool reach_replace(const Reach *reach, const char *path, Replacement *replacement) {
    char resolved[PATH_MAX];
    if (!reach)
        return replace_begin(replacement, path, 0);
    if (!reach_resolve(reach, REACH_WRITE, path, resolved))
        return false;
    const Str *folder = find_folder(reach, REACH_WRITE, resolved);
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

bool reach_make_folders(const Reach *reach, const char *path) {
    char resolved[PATH_MAX], prefix[PATH_MAX];
    struct stat info;
    if (strlen(path) >= sizeof prefix)
        return true; // writing says what is wrong
    for (const char *slash = strchr(path + 1, '/'); path[0] && slash; slash = strchr(slash + 1, '/')) {
        memcpy(prefix, path, (size_t)(slash - path));
        prefix[slash - path] = '\0';
        if (stat(prefix, &info) < 0 && errno == ENOENT && reach_resolve(reach, REACH_WRITE, prefix, resolved))
            mkdir(resolved, 0777);
    }
    return reach_resolve(reach, REACH_WRITE, path, resolved) || errno != EXDEV;
}

const char *reach_refusal(Arena *arena, const Reach *reach, ReachKind kind, const char *path) {
    static const char *const words[] = {[REACH_READ] = "read", [REACH_WRITE] = "write"};
    char resolved[PATH_MAX];
    if (reach->nothing)
        return "scripts may use no files here (--no-files)";
    if (!file_resolve(path, resolved))
        return "it is out of the script's reach";
    struct stat info;
    bool is_folder = stat(resolved, &info) == 0 && S_ISDIR(info.st_mode);
    Str folder = is_folder ? str_from(resolved) : path_directory(str_from(resolved));
    folder.len -= folder.len > 1 && !is_folder;
    return str_to_c(arena, str_format(arena, "a script may not %s there; '--allow-%s %.*s' would allow it", words[kind],
                                      words[kind], (int)folder.len, folder.bytes));
}
