// history.h: dependence of pictures on earlier frames.
#pragma once

#include "session/draw_access.h"

// Returns true if a painter must render the pictures of this frame in order, for one of these reasons: they show or may
// show pictures of earlier frames, they refer to other pictures of the frame, or a `!record` saves them.
bool picture_needs_history(const DrawAccess *access);
// Like picture_needs_history, but false if all pictures that the frame refers to are certainly pictures of the same
// frame. A shader that reads the time since the previous picture (`beats`) counts as a reference to an earlier frame.
bool picture_shows_history(const DrawAccess *access);
