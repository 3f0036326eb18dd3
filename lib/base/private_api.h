// private_api.h: exports of libpetri.so for libpetri-draw.so and libpetri-archive.so.
#pragma once

// Marks an internal function that these libraries call, because it works on a session or the heap, or because a copy
// would be large (lib/maths/table.h). They have copies of other code without state (`copied` in
// lib/schema/meson.build), which needs no mark. One library for all of it would need Cairo in programs that do not
// draw. The symbol is `_petri_NAME`, which cannot collide with a name of a host. Its symbol version is that of one
// release (petri.map), so all libraries must be of the same release.
#ifdef PETRI_SINGLE_FILE // petri.c (src/packaging/single.py), which has no other libraries
#define PRIVATE_API(name)
#else
#define PRIVATE_API(name)                                                                                              \
    __asm__(PRIVATE_API_TEXT(__USER_LABEL_PREFIX__) "_petri_" #name) __attribute__((visibility("default")))
#define PRIVATE_API_TEXT(prefix) PRIVATE_API_QUOTE(prefix) // prefix of all C names: "_" on macOS, else ""
#define PRIVATE_API_QUOTE(prefix) #prefix
#endif
