// profile.c: see profile.h.
#include "vm/profile.h"

#include "base/heap.h"

#include <string.h>
#include <time.h>

static uint64_t now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (uint64_t)time.tv_sec * 1000000000u + (uint64_t)time.tv_nsec;
}

Profile *vm_profile_new(void) {
    Profile *profile = heap_zeroed(1, sizeof *profile);
    if (profile)
        arena_init(&profile->arena, "profile", SIZE_MAX);
    return profile;
}

void vm_profile_free(Profile *profile) {
    if (profile)
        arena_free(&profile->arena);
    heap_give(profile);
}

void vm_profile_clear(Profile *profile) {
    arena_reset(&profile->arena);
    profile->files = NULL;
    profile->file_count = profile->file_capacity = 0;
    profile->place = (ProfilePlace){0};
}

void vm_profile_begin(Profile *profile, jmp_buf *escape) {
    profile->arena.escape = escape;
    for (uint32_t i = 0; i < profile->file_count; i++)
        profile->files[i].seen = NULL;
    profile->place = (ProfilePlace){0};
    profile->since = now();
}

static void leave(Profile *profile) {
    uint64_t time = now();
    if (profile->place.counts)
        profile->place.counts->nanoseconds += time - profile->since;
    profile->since = time;
}

void vm_profile_end(Profile *profile) {
    leave(profile);
    profile->place = (ProfilePlace){0};
    profile->arena.escape = NULL;
}

static ProfileFile *add_file(Profile *profile, const Source *source) {
    profile->files = arena_room(&profile->arena, profile->files, profile->file_count, &profile->file_capacity,
                                sizeof *profile->files);
    size_t size = source->line_count * sizeof(ProfileLine);
    ProfileFile file = {.source = source_new(&profile->arena, source->name, source->path, source->text),
                        .lines = arena_alloc(&profile->arena, size)};
    if (size)
        memset(file.lines, 0, size);
    profile->files[profile->file_count] = file;
    return &profile->files[profile->file_count++];
}

// The file of a source, which is compared as a whole once in a frame: it may have been loaded again.
static ProfileFile *find_file(Profile *profile, const Source *source) {
    for (uint32_t i = 0; i < profile->file_count; i++)
        if (profile->files[i].seen == source)
            return &profile->files[i];
    ProfileFile *found = NULL;
    for (uint32_t i = 0; i < profile->file_count && !found; i++) {
        const Source *known = profile->files[i].source;
        if (str_equal(known->path, source->path) && str_equal(known->text, source->text))
            found = &profile->files[i];
    }
    if (!found)
        found = add_file(profile, source);
    found->seen = source;
    return found;
}

void vm_profile_move(Profile *profile, const Source *source, uint32_t line) {
    leave(profile);
    ProfileFile *file = find_file(profile, source);
    ProfileLine *counts = line > 0 && line <= file->source->line_count ? &file->lines[line - 1] : NULL;
    if (counts)
        counts->times++;
    profile->place = (ProfilePlace){source, line, counts};
}

void vm_profile_return(Profile *profile, ProfilePlace place) {
    leave(profile);
    profile->place = place;
}
