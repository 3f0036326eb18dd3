// scripts.h: calls a function for each script in the folders named on the command line.
#pragma once

#include "check.h"

#include <dirent.h>
#include <stdio.h>
#include <sys/stat.h>

typedef void VisitScript(const char *path);

static char **script_folders;
static int script_folder_count;
static VisitScript *visit_script;

// Does not use nftw, because the memory sanitizer does not support it.
static inline void scripts_walk(const char *folder) {
    DIR *entries = opendir(folder);
    assert_non_null(entries);
    const struct dirent *entry;
    while ((entry = readdir(entries))) {
        char path[4096];
        struct stat info;
        size_t len = strlen(entry->d_name);
        assert_true((size_t)snprintf(path, sizeof path, "%s/%s", folder, entry->d_name) < sizeof path);
        assert_int_equal(lstat(path, &info), 0);
        if (S_ISDIR(info.st_mode) && entry->d_name[0] != '.')
            scripts_walk(path);
        else if (S_ISREG(info.st_mode) && len >= 3 && strcmp(entry->d_name + len - 3, ".fl") == 0)
            visit_script(path);
    }
    closedir(entries);
}

// Calls `visit` for each `.fl` file in or below the folders.
static inline void scripts_each(VisitScript *visit) {
    visit_script = visit;
    for (int i = 0; i < script_folder_count; i++)
        scripts_walk(script_folders[i]);
}

static inline void scripts_set_folders(int argc, char **argv) {
    script_folder_count = argc - 1;
    script_folders = argv + 1;
}
