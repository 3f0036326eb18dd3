// saved.c: see saved.h.
#include "repl/saved.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// The path of the file; false if there is no home for it.
static bool file_path(Bytes *path) {
    const char *folder = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
    if (folder != NULL && folder[0] == '/') { // relative ones do not count, says XDG
        bytes_format(path, "%s", folder);
    } else if (home != NULL && home[0] != '\0') {
        bytes_format(path, "%s/.local/state", home);
    } else {
        return false;
    }
    bytes_format(path, "/petri/history");
    return true;
}

void saved_read(Bytes *lines) {
    Bytes path = {0};
    if (file_path(&path)) {
        bytes_read_file(lines, path.data);
    }
    if (lines->length > 0 && lines->data[lines->length - 1] != '\n') {
        bytes_add(lines, "\n", 1);
    }
    bytes_free(&path);
}

// Makes the folders that a file lies in; only its owner may look into new ones.
static void make_folders(char *path) {
    for (char *slash = strchr(path + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(path, 0700);
        *slash = '/';
    }
}

// Where the last `most` lines begin.
static size_t start_of_last(const Bytes *lines, size_t most) {
    size_t at = lines->length;
    while (at > 0 && most > 0) {
        at--;
        while (at > 0 && lines->data[at - 1] != '\n') {
            at--;
        }
        most--;
    }
    return at;
}

void saved_add(const Bytes *lines) {
    Bytes path = {0}, all = {0};
    if (lines->length > 0 && file_path(&path)) {
        saved_read(&all); // again: another session may have added to it
        bytes_add(&all, lines->data, lines->length);
        size_t start = start_of_last(&all, SAVED_MOST);
        Bytes kept = {.data = all.data + start, .length = all.length - start};
        make_folders(path.data);
        bytes_replace_file(&kept, path.data);
    }
    bytes_free(&all);
    bytes_free(&path);
}
