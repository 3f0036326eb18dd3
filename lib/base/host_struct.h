// host_struct.h: structs that the library shares with a host. The host may have been compiled with an older or newer
// petri.h, in which the struct has fewer or more fields at its end.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

enum { MAX_HOST_STRUCT_SIZE = 4096 }; // a larger size is that of a struct that was not initialised

// Reads a struct of a host, whose first member is its size. `to` has `size` bytes and contains the defaults. Fields
// that the host does not know keep their defaults. Returns false if `from` is NULL or its size is not valid, or if the
// host sets a field that this library does not know.
static inline bool host_struct_read(void *to, size_t size, const void *from) {
    size_t given = 0;
    if (from)
        memcpy(&given, from, sizeof given);
    if (given < sizeof given || given > MAX_HOST_STRUCT_SIZE)
        return false;
    for (size_t i = size; i < given; i++)
        if (((const unsigned char *)from)[i] != 0)
            return false;
    memcpy(to, from, given < size ? given : size);
    memcpy(to, &size, sizeof size);
    return true;
}

// Writes a struct of `from_size` bytes to a struct of a host, which has `size` bytes. Fields that only the host knows
// become 0. Returns false if `to` is NULL.
static inline bool host_struct_write(void *to, size_t size, const void *from, size_t from_size) {
    if (!to)
        return false;
    memcpy(to, from, size < from_size ? size : from_size);
    if (size > from_size)
        memset((char *)to + from_size, 0, size - from_size);
    return true;
}
