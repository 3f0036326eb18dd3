// resume.h: continuing an existing trajectory file in a run that continues from a state (`--state`).
//
// Such a file is extended, not replaced. Whenever a state is saved, the file contains all frames up to that state.
// A run that continues from the state removes later frames from the file and computes them again.
#pragma once

#include "run/xyz.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The state from which the run continues.
typedef struct Resume {
    bool wanted;      // true if `--state` was given
    int64_t after;    // frame of the state; -1: the run starts from the beginning
    int64_t expected; // last frame up to `after` that a trajectory should contain; -1: none
} Resume;

typedef struct ResumeFile {
    int fd;              // descriptor of the locked file, positioned at `end`; -1: the file does not exist
    size_t end;          // length of the file in bytes, after later frames were removed
    int64_t last;        // last frame in the file; -1: none
    uint32_t dimensions; // number of dimensions in a CSV header; 0: no header yet
    bool energies;       // true if a CSV header has columns for energies
} ResumeFile;

// Opens a trajectory and removes the frames after frame `after`. Adds the names in an XYZ file to `names`; if `names`
// is NULL, the file is a CSV file. Returns false after a message. Does not modify a file that was not written by petri.
bool resume_open(ResumeFile *file, const char *path, XyzNames *names, int64_t after);
// Reports the frames that are missing in the file: those from last + 1 up to the state. `last` is the last frame in the
// file.
void resume_report_gap(const char *path, int64_t last, const Resume *resume);
