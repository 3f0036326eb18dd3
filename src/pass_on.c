// pass_on.c: starting the other program, petri-pictures, for what this one cannot do.
//
// It lies beside this one, under whatever name this one was started.
#include "pass_on.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"

#ifdef PETRI_PICTURES
enum { HAS_ALL = true };
#else
enum { HAS_ALL = false };
#endif

bool pass_on_wanted(const char *first) {
    static const char *const words[] = {"view", "render", "repl", "help", "--help", "-h"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strcmp(first, words[i]) == 0) {
            return !HAS_ALL;
        }
    }
    return false;
}

bool pass_on_all(void) {
    return !HAS_ALL;
}

int pass_on(char **argv) {
    static const char name[] = "petri-pictures";
    char path[PATH_MAX + sizeof name];
    ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - 1);
    if (length > 0) {
        path[length] = '\0';
    } else if (realpath(argv[0], path) == NULL) {
        path[0] = '\0';
    }
    char *slash = strrchr(path, '/');
    strcpy(slash == NULL ? path : slash + 1, name);
    execvp(path, argv); // looks along PATH if there is no slash
    message("cannot start %s, which draws and prompts: %s", path, strerror(errno));
    return STATUS_FAILED;
}
