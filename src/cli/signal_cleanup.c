// signal_cleanup.c: see signal_cleanup.h.
#include "cli/signal_cleanup.h"

#include <poll.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <unistd.h>

enum { MAX_FILES = 4, PAUSE_MS = 20 };

typedef enum EntryState { FREE, CHANGING, REGISTERED } EntryState;

// Global, because a signal handler has no context.
static struct {
    atomic_int state;
    SignalCleanup *act;
    void *context;
} entries[MAX_FILES];
static atomic_bool ending;

int signal_cleanup_begin(SignalCleanup *act, void *context) {
    while (atomic_load(&ending))
        pause();
    for (int i = 0; i < MAX_FILES; i++) {
        int expected = FREE;
        if (atomic_compare_exchange_strong(&entries[i].state, &expected, CHANGING)) {
            entries[i].act = act;
            entries[i].context = context;
            atomic_store(&entries[i].state, REGISTERED);
            return i;
        }
    }
    return -1;
}

void signal_cleanup_end(int number) {
    if (number >= 0)
        atomic_store(&entries[number].state, FREE);
}

// Other threads keep running. The second pass runs all actions again, including those that these threads registered
// during the first pass.
void signal_cleanup_run(void) {
    atomic_store(&ending, true);
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < MAX_FILES; i++)
            if (atomic_load(&entries[i].state) == REGISTERED)
                entries[i].act(entries[i].context);
        poll(NULL, 0, pass == 0 ? PAUSE_MS : 0);
    }
}
