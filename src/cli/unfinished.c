// unfinished.c: see unfinished.h.
#include "cli/unfinished.h"

#include <poll.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <unistd.h>

enum { MOST_FILES = 4, MOMENT = 20 }; // milliseconds

typedef enum EntryState { FREE, CHANGING, BEGUN } EntryState;

// A signal handler can reach nothing but globals.
static struct {
    atomic_int state;
    Unfinished *act;
    void *context;
} entries[MOST_FILES];
static atomic_bool ending;

int unfinished_begin(Unfinished *act, void *context) {
    while (atomic_load(&ending)) {
        pause();
    }
    for (int i = 0; i < MOST_FILES; i++) {
        int expected = FREE;
        if (atomic_compare_exchange_strong(&entries[i].state, &expected, CHANGING)) {
            entries[i].act = act;
            entries[i].context = context;
            atomic_store(&entries[i].state, BEGUN);
            return i;
        }
    }
    return -1;
}

void unfinished_end(int number) {
    if (number >= 0) {
        atomic_store(&entries[number].state, FREE);
    }
}

// Other threads are still at work; what they were just beginning is there a moment later.
void unfinished_act(void) {
    atomic_store(&ending, true);
    for (int round = 0; round < 2; round++) {
        for (int i = 0; i < MOST_FILES; i++) {
            if (atomic_load(&entries[i].state) == BEGUN) {
                entries[i].act(entries[i].context);
            }
        }
        poll(NULL, 0, round == 0 ? MOMENT : 0);
    }
}
