// link_work.h: the limit of work for opening a link, used by `petri run LINK`, `petri link` and the playground.
#pragma once

#include <stdint.h>

// Returns the maximum units of work to open a link, if each frame may use `frame_limit` units (--work): about half a
// minute by default.
static inline uint64_t link_work_limit(uint64_t frame_limit) {
    enum { FRAMES = 3 };
    return frame_limit < UINT64_MAX / FRAMES ? frame_limit * FRAMES : UINT64_MAX;
}
