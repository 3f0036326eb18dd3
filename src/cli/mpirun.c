// mpirun.c: see mpirun.h.
#include "cli/mpirun.h"

#include <stddef.h>
#include <stdlib.h>

// Returns the integer value of an environment variable, or -1 if it is not set.
static int read_variable(const char *name) {
    const char *text = getenv(name);
    return !text ? -1 : atoi(text);
}

bool mpirun_rank(int *rank, int *count) {
    static const char *const names[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, {"PMI_RANK", "PMI_SIZE"}};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        *rank = read_variable(names[i][0]);
        *count = read_variable(names[i][1]);
        if (*rank >= 0 && *rank < *count)
            return *count > 1;
    }
    return false;
}
