// last_frame.h: the data of the last frame, for tests.
#pragma once

#include "petri.h"

static inline PetriFrame last_frame(const PetriSession *session) {
    PetriFrame frame = {.number = -1};
    petri_frame(session, &frame, sizeof frame);
    return frame;
}
