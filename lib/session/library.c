// library.c: functions that do not depend on a session: allocator, version and texts of statuses.
#include "base/heap.h"
#include "base/host_struct.h"
#include "petri.h"

PetriStatus petri_set_allocator(const PetriAllocator *given) {
    PetriAllocator allocator = {0};
    if (!given)
        return heap_set_allocator(NULL) ? PETRI_OK : PETRI_INVALID;
    if (!host_struct_read(&allocator, sizeof allocator, given) || !allocator.allocate || !allocator.resize ||
        !allocator.release)
        return PETRI_INVALID;
    HeapAllocator source = {allocator.allocate, allocator.resize, allocator.release, allocator.user_data};
    return heap_set_allocator(&source) ? PETRI_OK : PETRI_INVALID;
}

#define TEXT(x) #x
#define VERSION_TEXT(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

const char *petri_version(void) {
    return VERSION_TEXT(PETRI_VERSION_MAJOR, PETRI_VERSION_MINOR, PETRI_VERSION_PATCH);
}

int petri_version_number(void) {
    return PETRI_VERSION_NUMBER;
}

const char *petri_status_text(PetriStatus status) {
    static const char *const texts[] = {
        [PETRI_OK] = "success",
        [PETRI_INVALID] = "invalid argument",
        [PETRI_LIMIT_EXCEEDED] = "limit exceeded",
        [PETRI_OUT_OF_MEMORY] = "out of memory",
        [PETRI_UNSUPPORTED] = "not supported by this build",
        [PETRI_INTERRUPTED] = "interrupted",
    };
    return (unsigned)status < sizeof texts / sizeof texts[0] ? texts[status] : "unknown status";
}
