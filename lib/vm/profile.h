// profile.h: a profiler that measures the evaluation time of each source line.
//
// The VM reports each change of line, and the time since the last change is charged to the previous line. The time of a
// call is charged to the lines of the called function. Returning to the calling line does not count as another hit of
// that line.
#pragma once

#include "base/source.h"

#include <stdbool.h>

typedef struct ProfileLine {
    uint64_t nanoseconds;
    uint64_t hits; // number of times that evaluation reached the line
} ProfileLine;

// One version of a source file.
typedef struct ProfileFile {
    const Source *source; // a copy, because programs may be freed
    // The Source with the same path and text that the program uses; NULL: not evaluated yet in this frame.
    const Source *frame_source;
    ProfileLine *lines; // one element per line of the source
} ProfileFile;

// Current position of the evaluation.
typedef struct ProfilePosition {
    const Source *source;
    uint32_t line;
    ProfileLine *counts; // counters of this line; NULL: none
} ProfilePosition;

typedef struct Profile {
    Arena arena;
    ProfileFile *files;
    uint32_t file_count;
    uint32_t file_capacity;
    ProfilePosition position;
    uint64_t last_change; // time of the last change of line, from the monotonic clock, in nanoseconds
} Profile;

// Returns NULL if out of memory. Free it with vm_profile_free.
Profile *vm_profile_new(void);
void vm_profile_free(Profile *profile);
// Clears all measurements.
void vm_profile_clear(Profile *profile);

// Must be called at the start and the end of a frame's evaluation. If memory runs out between these calls, the profiler
// escapes with a longjmp to `escape`.
void vm_profile_begin(Profile *profile, jmp_buf *escape);
void vm_profile_end(Profile *profile);
// Charges the elapsed time to the previous line and counts a hit of the given line.
void vm_profile_move(Profile *profile, const Source *source, uint32_t line);
// Charges the elapsed time to the previous line and returns to `place`, the position of a call.
void vm_profile_return(Profile *profile, ProfilePosition place);

// Must be called before each instruction is executed. `line` is the instruction's line in `source`.
static inline void vm_profile_at(Profile *profile, const Source *source, uint32_t line) {
    if (line != profile->position.line || source != profile->position.source)
        vm_profile_move(profile, source, line);
}
