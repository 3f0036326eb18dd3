// profile.c: see profile.h.
//
// The counts outlive a reload: a file is recognised by its path and text, and only once in each frame, because texts
// are long to compare (find_file).
#include "vm/profile.h"

#include "base/clock.h"
#include "base/heap.h"

#include <string.h>

Profile *vm_profile_new(void) {
    Profile *profile = heap_calloc(1, sizeof *profile);
    if (profile)
        arena_init(&profile->arena, "profile", SIZE_MAX);
    return profile;
}

void vm_profile_free(Profile *profile) {
    if (profile)
        arena_free(&profile->arena);
    heap_free(profile);
}

void vm_profile_clear(Profile *profile) {
    arena_reset(&profile->arena);
    profile->files = NULL;
    profile->file_count = profile->file_capacity = 0;
    profile->position = (ProfilePosition){0};
}

void vm_profile_begin(Profile *profile, jmp_buf *escape) {
    profile->arena.escape = escape;
    for (uint32_t i = 0; i < profile->file_count; i++)
        profile->files[i].frame_source = NULL;
    profile->position = (ProfilePosition){0};
    profile->last_change = clock_nanoseconds();
}

static void charge_elapsed(Profile *profile) {
    uint64_t time = clock_nanoseconds();
    if (profile->position.counts)
        profile->position.counts->nanoseconds += time - profile->last_change;
    profile->last_change = time;
}

void vm_profile_end(Profile *profile) {
    charge_elapsed(profile);
    profile->position = (ProfilePosition){0};
    profile->arena.escape = NULL;
}

static ProfileFile *add_file(Profile *profile, const Source *source) {
    profile->files = arena_grow_array(&profile->arena, profile->files, profile->file_count, &profile->file_capacity,
                                      sizeof *profile->files);
    size_t size = source->line_count * sizeof(ProfileLine);
    ProfileFile file = {.source = source_new(&profile->arena, source->name, source->path, source->text),
                        .lines = arena_alloc(&profile->arena, size)};
    if (size)
        memset(file.lines, 0, size);
    profile->files[profile->file_count] = file;
    return &profile->files[profile->file_count++];
}

// Returns the profile of a source. Adds a profile if there is none. The complete text is compared once per frame,
// because the source may have been reloaded.
static ProfileFile *find_file(Profile *profile, const Source *source) {
    for (uint32_t i = 0; i < profile->file_count; i++)
        if (profile->files[i].frame_source == source)
            return &profile->files[i];
    ProfileFile *found = NULL;
    for (uint32_t i = 0; i < profile->file_count && !found; i++) {
        const Source *known = profile->files[i].source;
        if (str_equal(known->path, source->path) && str_equal(known->text, source->text))
            found = &profile->files[i];
    }
    if (!found)
        found = add_file(profile, source);
    found->frame_source = source;
    return found;
}

void vm_profile_move(Profile *profile, const Source *source, uint32_t line) {
    charge_elapsed(profile);
    ProfileFile *file = find_file(profile, source);
    ProfileLine *counts = line > 0 && line <= file->source->line_count ? &file->lines[line - 1] : NULL;
    if (counts)
        counts->hits++;
    profile->position = (ProfilePosition){source, line, counts};
}

void vm_profile_return(Profile *profile, ProfilePosition place) {
    charge_elapsed(profile);
    profile->position = place;
}
