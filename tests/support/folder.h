// folder.h: a temporary folder with files for one test.
#pragma once

#include "check.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct Folder {
    char path[200];
    char file[600]; // the path that folder_file returned last
    int version;
} Folder;

static inline void folder_open(Folder *folder) {
    const char *place = getenv("TMPDIR");
    snprintf(folder->path, sizeof folder->path, "%s/petri-unit-XXXXXX", place && strlen(place) < 100 ? place : "/tmp");
    assert_non_null(mkdtemp(folder->path));
    folder->version = 0;
}

// Returns the path of a file in the folder. Valid until the next call.
static inline const char *folder_file(Folder *folder, const char *name) {
    snprintf(folder->file, sizeof folder->file, "%s/%s", folder->path, name);
    return folder->file;
}

// Writes a file. The modification time differs for each write.
static inline void folder_write(Folder *folder, const char *name, const char *text) {
    FILE *file = fopen(folder_file(folder, name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, strlen(text), file), strlen(text));
    assert_int_equal(fclose(file), 0);
    const struct timespec times[2] = {{.tv_sec = 1000000000 + ++folder->version},
                                      {.tv_sec = 1000000000 + folder->version}};
    assert_int_equal(utimensat(AT_FDCWD, folder->file, times, 0), 0);
}

// Removes the folder with its files and its empty subfolders.
static inline void folder_close(Folder *folder) {
    DIR *entries = opendir(folder->path);
    for (struct dirent *entry; entries && (entry = readdir(entries));)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            remove(folder_file(folder, entry->d_name));
    if (entries)
        closedir(entries);
    assert_int_equal(rmdir(folder->path), 0);
}
