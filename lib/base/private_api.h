// private_api.h: exports of libpetri.so for libpetri-draw.so and libpetri-archive.so.
#pragma once

// Marks an internal function or table that these libraries use. Its symbol is `_petri_NAME`, which cannot collide with
// a name of a host. Its symbol version is that of one release (petri.map), so all libraries must be of the same
// release.
#define PRIVATE_API(name) __asm__("_petri_" #name) __attribute__((visibility("default")))
