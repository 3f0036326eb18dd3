// segments.h: verification of the segments of an archive by several threads.
//
// A segment begins with a keyframe and has the frames up to the next one. Each thread has its own session and computes
// whole segments.
#pragma once

#include "cli/memory.h"
#include "cli/options.h"
#include "petri-archive.h"

#include <pthread.h>

enum { DIGEST_BYTES = 16 };

// The first frame of a segment that differs.
typedef struct SegmentResult {
    int64_t frame;
    bool has_digests;
    uint8_t digests[2][DIGEST_BYTES]; // of the archive and of the computed frame
    Text details;                     // what differs in the next keyframe; empty: unknown
} SegmentResult;

typedef struct Verification {
    const CommandContext *context;
    const Options *options;
    const char *file;
    PetriArchiveKeyframe *segments; // those that are verified
    size_t count;                   // number of segments in the archive
    size_t chosen;                  // number of segments that are verified
    size_t given;                   // number of keyframes that were given
    size_t stride;                  // number of ranks, which verify every `stride`-th segment
    // Results, which `mutex` protects
    pthread_mutex_t mutex;
    size_t next;          // number of the next segment of this rank
    size_t running;       // number of threads that have not ended
    int64_t frames;       // number of verified frames
    bool failed;          // true if a segment could not be computed
    bool differs;         // true if `result` is valid
    size_t differs_at;    // segment of `result`
    SegmentResult result; // of the first segment that differs
    TextList reported;    // diagnostics that were printed
} Verification;

// Chooses the segments: all, or `sample` random ones if it is positive.
void segments_choose(Verification *verification, PetriArchive *archive, int64_t sample);
// Verifies the segments of this rank. Sets verification->failed after a message if that is not possible.
void segments_verify(Verification *verification);
void segments_free(Verification *verification);
