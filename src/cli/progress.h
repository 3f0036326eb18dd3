// progress.h: the progress line on standard error: a bar, frames, frames per second, time left.
#ifndef PETRI_SRC_PROGRESS_H
#define PETRI_SRC_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct Progress {
    bool enabled;
    bool drawn;
    int64_t total;      // frames to come in all
    const char *things; // what they are called: frames
    double start;       // seconds of the monotonic clock
    double last;        // when it was drawn last
} Progress;

// Seconds of the monotonic clock.
double clock_seconds(void);
// The size of the terminal that a descriptor is; what is not known stays.
void terminal_extent(int fd, int *columns, int *rows);
// Whether standard error is a terminal that knows how to erase a line.
bool progress_possible(void);

void progress_start(Progress *progress, bool enabled, int64_t total);
// Redraws the line, though not more often than the eye can follow.
void progress_update(Progress *progress, int64_t done);
// Removes the line, so that other text can be written.
void progress_erase(Progress *progress);

#endif
