// resume.h: a trajectory that is there already, for a run that goes on from a state (`--state`).
//
// Such a file is not replaced but lengthened: what is on the disk when a state is saved has all frames up to it, so a
// run that goes on from there cuts what is later, whole or not, and adds the same frames again.
#ifndef PETRI_SRC_RESUME_H
#define PETRI_SRC_RESUME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The frame of the state that the run goes on from.
typedef struct Resume {
    bool wanted;      // there is a `--state`
    int64_t after;    // its frame; -1: the run begins
    int64_t expected; // the last frame that a trajectory has before it; -1: none
} Resume;

typedef struct ResumeFile {
    int fd;              // locked, to be lengthened from `end`; -1: there is no file
    size_t end;          // of what is kept
    int64_t last;        // frame in it; -1: none
    uint32_t dimensions; // that a CSV's header has; 0: it has none yet
} ResumeFile;

// Opens a file of text and cuts what is later than the frame. False after a message; a file that is no trajectory of
// petri is left alone.
bool resume_open(ResumeFile *file, const char *path, bool csv, int64_t after);
// Tells of frames that are missing between what the file has and the state.
void resume_report_gap(const char *path, int64_t last, const Resume *resume);

#endif
