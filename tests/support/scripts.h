// scripts.h: a test of every script in the folders that the command line names.
#ifndef PETRI_TESTS_SCRIPTS_H
#define PETRI_TESTS_SCRIPTS_H

#include "check.h"

#include <ftw.h>

typedef void VisitScript(const char *path);

static char **script_folders;
static int script_folder_count;
static VisitScript *visit_script;

static inline int scripts_visit(const char *path, const struct stat *info, int type, struct FTW *walk) {
    (void)info;
    (void)walk;
    size_t len = strlen(path);
    if (type == FTW_F && len >= 3 && strcmp(path + len - 3, ".fl") == 0)
        visit_script(path);
    return 0;
}

// Calls `visit` for each `.fl` file in the folders and below.
static inline void scripts_each(VisitScript *visit) {
    visit_script = visit;
    for (int i = 0; i < script_folder_count; i++)
        assert_int_equal(nftw(script_folders[i], scripts_visit, 16, FTW_PHYS), 0);
}

static inline void scripts_take_folders(int argc, char **argv) {
    script_folder_count = argc - 1;
    script_folders = argv + 1;
}

#endif
