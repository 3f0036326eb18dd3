// unfinished.c: see unfinished.h.
#include "cli/unfinished.h"

#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_FILES = 24, MOMENT = 20 }; // milliseconds

typedef enum EntryState { FREE, CHANGING, BEGUN } EntryState;

// A signal handler can reach nothing but globals.
static struct {
    atomic_int state;
    _Atomic pid_t process; // 0: none
    char path[PATH_MAX];
} entries[MOST_FILES];
static atomic_bool ending;

static void set_path(char path[PATH_MAX], const char *file) {
    char *target = realpath(file, NULL); // a symbolic link stays one
    snprintf(path, PATH_MAX, "%s.%ld.tmp", target == NULL ? file : target, (long)getpid());
    free(target);
}

int unfinished_begin(const char *file) {
    while (atomic_load(&ending)) {
        pause();
    }
    for (int i = 0; i < MOST_FILES; i++) {
        int expected = FREE;
        if (atomic_compare_exchange_strong(&entries[i].state, &expected, CHANGING)) {
            set_path(entries[i].path, file);
            atomic_store(&entries[i].process, 0);
            atomic_store(&entries[i].state, BEGUN);
            return i;
        }
    }
    return -1;
}

void unfinished_process(int number, pid_t process) {
    if (number >= 0) {
        atomic_store(&entries[number].process, process);
    }
}

void unfinished_end(int number) {
    if (number >= 0) {
        atomic_store(&entries[number].state, FREE);
    }
}

static void remove_all(void) {
    for (int i = 0; i < MOST_FILES; i++) {
        if (atomic_load(&entries[i].state) != BEGUN) {
            continue;
        }
        pid_t process = atomic_exchange(&entries[i].process, 0);
        if (process > 0) {
            kill(process, SIGKILL);
            waitpid(process, NULL, 0); // it might make the file anew
        }
        unlink(entries[i].path);
    }
}

// Other threads are still at work; what they were just beginning is there a moment later.
void unfinished_abandon(void) {
    atomic_store(&ending, true);
    remove_all();
    poll(NULL, 0, MOMENT);
    remove_all();
}
