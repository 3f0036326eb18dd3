// progress.h: a progress line on standard error with a bar, frames, frames per second and time left.
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef struct Progress {
    bool enabled;
    bool drawn;         // true if the line is on the screen
    int64_t total;      // number of frames or other items
    const char *things; // plural noun for the items, such as "frames"
    double start;       // seconds of the monotonic clock
    double last;        // time of the last redraw on the same clock; 0: none
} Progress;

// Sets *columns and *rows to the size of the terminal `fd`. Does not modify them if `fd` is not a terminal.
void terminal_extent(int fd, int *columns, int *rows);
// Returns true if standard error is a terminal that can erase a line.
bool progress_possible(void);

// Starts a progress line. Nothing is drawn unless `enabled` is true and `total` is positive.
void progress_start(Progress *progress, bool enabled, int64_t total);
// Redraws the line, at most ten times per second.
void progress_update(Progress *progress, int64_t done);
// Erases the line, so that other text can be written.
void progress_erase(Progress *progress);
