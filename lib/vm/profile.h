// profile.h: the time that evaluation spends on each line of its sources.
//
// The machine tells when it comes to another line; the time until then goes to the line that it leaves. A call's time
// goes to the lines of the function, and coming back from it does not count as coming to the line again.
#ifndef PETRI_VM_PROFILE_H
#define PETRI_VM_PROFILE_H

#include "base/source.h"

#include <stdbool.h>

typedef struct ProfileLine {
    uint64_t nanoseconds;
    uint64_t hits; // that evaluation came to the line
} ProfileLine;

// One version of a source file.
typedef struct ProfileFile {
    const Source *source;       // a copy: programs may be dropped
    const Source *frame_source; // what it is known as in this frame, or NULL
    ProfileLine *lines;         // as many as the source has
} ProfileFile;

// Where evaluation is.
typedef struct ProfilePosition {
    const Source *source;
    uint32_t line;
    ProfileLine *counts;
} ProfilePosition;

typedef struct Profile {
    Arena arena;
    ProfileFile *files;
    uint32_t file_count;
    uint32_t file_capacity;
    ProfilePosition position;
    uint64_t last_change; // clock at the last change
} Profile;

// NULL if memory is used up.
Profile *vm_profile_new(void);
void vm_profile_free(Profile *profile);
// Forgets everything.
void vm_profile_clear(Profile *profile);

// A frame begins or ends. What the profile needs beyond its memory leaves through the escape.
void vm_profile_begin(Profile *profile, jmp_buf *escape);
void vm_profile_end(Profile *profile);
void vm_profile_move(Profile *profile, const Source *source, uint32_t line);
// Back from a call to where it was made.
void vm_profile_return(Profile *profile, ProfilePosition place);

// Evaluation is at this line now.
static inline void vm_profile_at(Profile *profile, const Source *source, uint32_t line) {
    if (line != profile->position.line || source != profile->position.source)
        vm_profile_move(profile, source, line);
}

#endif
