// automatic_systems.h: the particle systems of a session's last frame, copied for the automatic picture.
#pragma once

#include "picture/automatic.h"
#include "session/draw_access.h"

enum { SYSTEMS_MAX = 64 }; // maximum number of systems in an automatic picture

uint32_t auto_count(const DrawAccess *shown);
// Copies the first `count` systems to the arena. Chooses or extends the views of these systems in `frames`.
AutoPicture auto_copy(const DrawAccess *shown, Arena *arena, AutoFrame *frames, uint32_t count);
// Chooses or extends the views of all systems in `frames`, without making a picture. Temporary data is allocated from
// the arena.
void auto_follow(const DrawAccess *shown, Arena *arena, AutoFrame *frames);
