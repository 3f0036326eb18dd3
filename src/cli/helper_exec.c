// helper_exec.c: see helper_exec.h.
//
// Helper programs are in the folder of this program (in a build) or in ../libexec (if installed).
#include "cli/helper_exec.h"

#include "base/os.h"
#include "cli/cli.h"
#include "cli/mpirun.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Returns the last component of the path.
static char *find_base_name(char *path) {
    char *slash = strrchr(path, '/');
    return !slash ? path : slash + 1;
}

// Executes a helper program. On failure, returns the value of errno and sets `path` to the folder of this program.
static int exec_helper(const char *name, char **argv, char path[PATH_MAX + 64]) {
    static const char *const folders[] = {"", "../libexec/"};
    if (!os_program_path(path) && !realpath(argv[0], path))
        path[0] = '\0';
    char *base_name = find_base_name(path);
    int cause = 0;
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        strcpy(base_name, folders[i]);
        strcat(base_name, name);
        execvp(path, argv); // searches PATH if `path` has no slash
        cause = cause == 0 || errno != ENOENT ? errno : cause;
    }
    *base_name = '\0';
    return cause;
}

int helper_exec(const char *name, char **argv) {
    char path[PATH_MAX + 64];
    return exec_helper(name, argv, path);
}

int helper_exec_pictures(char **argv) {
    char path[PATH_MAX + 64];
    int cause = exec_helper("petri-pictures", argv, path);
    int folder = (int)strlen(path), above = folder - 1;
    while (above > 0 && path[above - 1] != '/')
        above--;
    message("cannot start petri-pictures: %s; install it in %.*s or %.*slibexec/", strerror(cause), folder, path,
            above < 0 ? 0 : above, path);
    return STATUS_FAILED;
}

// Returns a hint for a missing petri-ranks. `folder` is that of this program.
static const char *ranks_hint(char folder[PATH_MAX + 64]) {
    if (!HAVE_MPI)
        return "; petri was built without MPI; on Debian, install libopenmpi-dev and build petri again";
    strcat(folder, "../build.ninja");
    return access(folder, F_OK) == 0 ? "; run './dev build', which builds it" : "; on Debian, install petri-mpi";
}

int helper_exec_ranks(char **argv, bool needed) {
    int rank = 0, count = 0;
    if (!mpirun_rank(&rank, &count))
        return -1;
    char path[PATH_MAX + 64];
    int cause = exec_helper("petri-ranks", argv, path);
    if (cause == ENOENT && !needed)
        return -1;
    if (rank == 0)
        message("cannot start petri-ranks: %s%s", strerror(cause), cause == ENOENT ? ranks_hint(path) : "");
    return STATUS_FAILED;
}
