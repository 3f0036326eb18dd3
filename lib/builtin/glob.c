// glob.c: the paths that match a pattern (spec builtins.md B13.2).
#include "base/os.h"
#include "base/source.h"
#include "builtin/family.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#ifndef PATH_MAX
#define PATH_MAX 4096
#endif

// --- matching one path component

// Tests whether a set, such as [a-z], contains the character c. The "[" of the set is directly before *at. Returns 1 if
// the set contains c, else 0, and moves *at past the "]" of the set. Returns -1 if there is no "]"; the "[" is then an
// ordinary character. A "]" directly after "[" or "[!" is a member of the set.
static int match_set(Str pattern, size_t *at, int32_t c) {
    size_t i = *at;
    bool negated = i < pattern.len && pattern.bytes[i] == '!', found = false;
    i += negated;
    for (bool first = true;; first = false) {
        if (i >= pattern.len)
            return -1;
        int32_t low = utf8_next(pattern, &i), high = low;
        if (low == ']' && !first)
            break;
        if (i + 1 < pattern.len && pattern.bytes[i] == '-' && pattern.bytes[i + 1] != ']') {
            i++;
            high = utf8_next(pattern, &i);
        }
        found = found || (low <= c && c <= high);
    }
    *at = i;
    return found != negated;
}

// Matches the next element of the pattern, which is not "*", against the next character of the name. Advances both.
static bool match_one(Str pattern, size_t *at, Str name, size_t *from) {
    int32_t c = utf8_next(name, from);
    int32_t p = utf8_next(pattern, at);
    if (p == '?')
        return true;
    if (p == '[') {
        int answer = match_set(pattern, at, c);
        if (answer >= 0)
            return answer;
    }
    return p == c;
}

// Returns true if the name matches the pattern: `*` matches any characters, `?` one character, and `[…]` one from a
// set. If a character does not match, going back to the last star is sufficient.
static bool match_name(Str pattern, Str name) {
    size_t at = 0, from = 0, star = SIZE_MAX, star_from = 0;
    while (from < name.len || at < pattern.len) {
        if (at < pattern.len && pattern.bytes[at] == '*') {
            star = ++at;
            star_from = from;
            continue;
        }
        if (at < pattern.len && from < name.len && match_one(pattern, &at, name, &from))
            continue;
        if (star == SIZE_MAX || star_from >= name.len)
            return false;
        utf8_next(name, &star_from);
        at = star;
        from = star_from;
    }
    return true;
}

// --- directory traversal

// Maximum numbers of directories listed and paths found by one call, and work units per directory and per path.
enum { MAX_LISTINGS = 1 << 18, MAX_FOUND = 1 << 20, LISTING_WORK = 1000, PATH_WORK = 100 };

typedef struct Glob {
    Arena *arena;
    const FileAccess *file_access;
    Str *parts;
    uint32_t part_count;
    bool only_directories;
    Str *found;
    uint32_t found_count;
    uint32_t found_capacity;
    uint32_t listings;
    bool limit_exceeded;
    const char *denied; // a path to which access was denied, or NULL
} Glob;

static bool is_deep(Str part) {
    return str_equal(part, STR("**"));
}

// Splits a pattern into parts at slashes. Empty parts, "." and repeated "**" have no effect and are dropped.
static void glob_parse(Glob *glob, Str pattern) {
    glob->parts = arena_alloc_array(glob->arena, pattern.len, sizeof *glob->parts);
    glob->only_directories = pattern.bytes[pattern.len - 1] == '/';
    for (size_t at = 0; at < pattern.len;) {
        const char *slash = memchr(pattern.bytes + at, '/', pattern.len - at);
        size_t end = slash ? (size_t)(slash - pattern.bytes) : pattern.len;
        Str part = {pattern.bytes + at, end - at};
        bool repeated = glob->part_count && is_deep(part) && is_deep(glob->parts[glob->part_count - 1]);
        if (part.len && !str_equal(part, STR(".")) && !repeated)
            glob->parts[glob->part_count++] = part;
        at = end + 1;
    }
}

static void glob_found(Glob *glob, Str path) {
    if (glob->found_count == MAX_FOUND) {
        glob->limit_exceeded = true;
        return;
    }
    glob->found = arena_grow_array(glob->arena, glob->found, glob->found_count, &glob->found_capacity, sizeof path);
    glob->found[glob->found_count++] = path;
}

// Gets the names in a folder from the host (PetriOptions.read_file), which returns one name per line.
static bool host_names(const FileAccess *file_access, const char *path, Str *names) {
    char folder[PATH_MAX + 2];
    if (!file_access_normalise(path, folder))
        return false;
    strcat(folder, folder[0] ? "/" : "./");
    names->len = 0;
    names->bytes = file_access->read_file(file_access->read_user_data, folder, &names->len);
    return names->bytes;
}

static bool is_hosted(const FileAccess *file_access) {
    return file_access && file_access->read_file;
}

static size_t list_hosted(Glob *glob, const char *path, Str **names) {
    Str text, line;
    if (!host_names(glob->file_access, path, &text))
        return 0;
    uint32_t count = 0, capacity = 0;
    for (size_t at = 0; at < text.len; at += line.len + 1) {
        const char *end = memchr(text.bytes + at, '\n', text.len - at);
        line = (Str){text.bytes + at, end ? (size_t)(end - text.bytes) - at : text.len - at};
        *names = arena_grow_array(glob->arena, *names, count, &capacity, sizeof line);
        if (line.len && utf8_find_error(line) == line.len)
            (*names)[count++] = (Str){line.bytes, line.len - (line.bytes[line.len - 1] == '/')};
    }
    return count;
}

// Sets *count to the number of entries of a directory that have valid names, and *size to the total length of these
// names. If `names` is not NULL, also copies the names. *count and *size must then initially be the capacities of
// `names` and `bytes`; names that do not fit are dropped. Allocates nothing while the directory is open, because a
// failed allocation would leave it open.
static void scan_directory(Arena *arena, const char *path, Str *names, char *bytes, size_t *count, size_t *size) {
    size_t max_count = *count, max_size = *size;
    *count = *size = 0;
    DIR *directory = opendir(path);
    if (!directory && errno == ENOMEM)
        arena_exhausted(arena);
    if (!directory)
        return;
    for (const struct dirent *entry; (entry = readdir(directory));) {
        Str name = str_from(entry->d_name);
        if (str_equal(name, STR(".")) || str_equal(name, STR("..")) || utf8_find_error(name) < name.len)
            continue;
        if (names) {
            if (*count == max_count || *size + name.len > max_size)
                break;
            memcpy(bytes + *size, name.bytes, name.len);
            names[*count] = (Str){bytes + *size, name.len};
        }
        ++*count;
        *size += name.len;
    }
    closedir(directory);
}

static bool is_directory(const FileAccess *file_access, const char *path, bool follow_links);

// Reports the names in a folder, one per line; those of folders end in a slash.
static void report_names(const Glob *glob, const char *path, const Str *names, size_t count) {
    if (!glob->file_access || !glob->file_access->on_read)
        return;
    Text list = text_new(glob->arena);
    text_add_c(&list, "");
    for (size_t i = 0; i < count; i++) {
        Str below = path_join(glob->arena, str_from(path), names[i]);
        text_add(&list, names[i]);
        text_add_c(&list, is_directory(NULL, str_to_c(glob->arena, below), true) ? "/\n" : "\n");
    }
    file_access_report(glob->file_access, str_format(glob->arena, "%s/", path).bytes, text_str(&list));
}

static size_t list_directory(Glob *glob, const char *path, Str **names) {
    arena_charge(glob->arena, LISTING_WORK);
    if (glob->listings++ == MAX_LISTINGS)
        glob->limit_exceeded = true;
    if (glob->limit_exceeded)
        return 0;
    if (is_hosted(glob->file_access))
        return list_hosted(glob, path, names);
    char resolved[PATH_MAX];
    if (!file_access_resolve(glob->file_access, FILE_ACCESS_READ, path, resolved)) {
        glob->denied = errno == EXDEV ? path : glob->denied;
        return 0;
    }
    size_t count = 0, size = 0;
    scan_directory(glob->arena, path, NULL, NULL, &count, &size);
    *names = arena_alloc_array(glob->arena, count, sizeof **names);
    char *bytes = arena_alloc(glob->arena, size);
    scan_directory(glob->arena, path, *names, bytes, &count, &size);
    report_names(glob, path, *names, count);
    return count;
}

static bool is_directory(const FileAccess *file_access, const char *path, bool follow_links) {
    struct stat info;
    Str names;
    if (is_hosted(file_access))
        return host_names(file_access, path, &names);
    return (follow_links ? stat(path, &info) : lstat(path, &info)) == 0 && S_ISDIR(info.st_mode);
}

static bool path_exists(const FileAccess *file_access, const char *path) {
    struct stat info;
    Str bytes;
    if (is_hosted(file_access))
        return file_access_read(file_access, path, &bytes) || host_names(file_access, path, &bytes);
    return lstat(path, &info) == 0;
}

static void visit_parts(Glob *glob, Str path, uint32_t k);

// Handles a path that matches the parts 0 to k of the pattern. If k is the last part, adds the path to the results.
// Otherwise continues in the directory `path` with the next part.
static void visit_path(Glob *glob, Str path, uint32_t k) {
    const char *c_path = str_to_c(glob->arena, path);
    arena_charge(glob->arena, PATH_WORK);
    bool last = k + 1 == glob->part_count;
    if (last && !glob->only_directories ? path_exists(glob->file_access, c_path)
                                        : is_directory(glob->file_access, c_path, true)) {
        if (last)
            glob_found(glob, path);
        else
            visit_parts(glob, path, k + 1);
    }
}

// Handles "**" at part k: searches this directory and, recursively, all its subdirectories except symbolic links.
static void visit_deep(Glob *glob, Str path, uint32_t k) {
    bool last = k + 1 == glob->part_count;
    if (last)
        glob_found(glob, path);
    else
        visit_parts(glob, path, k + 1);
    Str *names = NULL;
    size_t count = list_directory(glob, str_to_c(glob->arena, path), &names);
    for (size_t i = 0; i < count && !glob->limit_exceeded; i++) {
        Str below = path_join(glob->arena, path, names[i]);
        arena_charge(glob->arena, PATH_WORK);
        if (is_directory(glob->file_access, str_to_c(glob->arena, below), false))
            visit_parts(glob, below, k);
        else if (last && !glob->only_directories)
            glob_found(glob, below);
    }
}

// Finds everything below the directory `path` that matches part k and the parts after it. The maximum path length
// limits the depth of the recursion.
static void visit_parts(Glob *glob, Str path, uint32_t k) {
    if (path.len >= PATH_MAX || glob->limit_exceeded)
        return;
    Str part = glob->parts[k];
    if (is_deep(part)) {
        visit_deep(glob, path, k);
    } else if (!memchr(part.bytes, '*', part.len) && !memchr(part.bytes, '?', part.len) &&
               !memchr(part.bytes, '[', part.len)) {
        visit_path(glob, path_join(glob->arena, path, part), k);
    } else {
        Str *names = NULL;
        size_t count = list_directory(glob, str_to_c(glob->arena, path), &names);
        for (size_t i = 0; i < count && !glob->limit_exceeded; i++)
            if (match_name(part, names[i]))
                visit_path(glob, path_join(glob->arena, path, names[i]), k);
    }
}

// --- results

static bool resolve_found(const Glob *glob, Str path, char resolved[PATH_MAX]) {
    const char *name = str_to_c(glob->arena, path);
    return is_hosted(glob->file_access) ? file_access_normalise(name, resolved) : realpath(name, resolved) != NULL;
}

// Returns the matches as sorted absolute paths without symbolic links. A match that "**" has found several times is
// returned once. Different matches that are links to the same file are all returned.
static Value glob_value(Glob *glob) {
    Arena *arena = glob->arena;
    const Str *found = builtin_sort_texts(arena, glob->found, glob->found_count);
    Str *paths = arena_alloc_array(arena, glob->found_count, sizeof *paths);
    uint32_t count = 0;
    char resolved[PATH_MAX];
    for (uint32_t i = 0; i < glob->found_count; i++) {
        arena_charge(arena, PATH_WORK);
        bool again = i > 0 && str_equal(found[i], found[i - 1]);
        if (again || !resolve_found(glob, found[i], resolved))
            continue;
        if (!file_access_allows(glob->file_access, FILE_ACCESS_READ, resolved)) {
            glob->denied = str_to_c(arena, found[i]);
            continue;
        }
        Str path = str_from(resolved);
        if (utf8_find_error(path) == path.len)
            paths[count++] = str_copy(arena, path);
    }
    if (count == 0)
        return VALUE_NULL;
    return builtin_texts(arena, builtin_sort_texts(arena, paths, count), count);
}

Value builtin_glob(BuiltinContext *context, const Value *args, uint32_t count) {
    Str pattern = value_text(context->arena, context->symbols, args[0]);
    if (pattern.len == 0 || pattern.bytes[0] == '/')
        return builtin_error(context, "glob", "%s",
                             pattern.len ? "the pattern must not start with '/'" : "the pattern is empty");
    if (!context->files || pattern.len >= PATH_MAX || memchr(pattern.bytes, 0, pattern.len))
        return VALUE_NULL;
    Glob glob = {.arena = context->arena, .file_access = context->file_access};
    glob_parse(&glob, pattern);
    Str start = context->directory.len ? context->directory : STR(".");
    if (glob.file_access && glob.file_access->on_read && !is_hosted(glob.file_access)) {
        Str *names; // reported even if the pattern has no wildcards
        list_directory(&glob, str_to_c(glob.arena, start), &names);
        glob.listings = 0;
    }
    if (glob.part_count)
        visit_parts(&glob, start, 0);
    else
        glob_found(&glob, start);
    if (glob.limit_exceeded)
        return builtin_error(context, "glob", "the pattern matches too many files or searches too many directories");
    Value paths = glob.found_count ? glob_value(&glob) : VALUE_NULL;
    if (glob.denied)
        builtin_error(context, "glob", "%s",
                      file_access_reason(context->arena, context->file_access, FILE_ACCESS_READ, glob.denied));
    return paths;
}
