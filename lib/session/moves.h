// moves.h: particles that the host has moved in frames of a timeline (petri_history_move_particle). A move is part of
// its frame: it is repeated each time the frame is computed again.
#pragma once

#include "base/arena.h"
#include "petri-live.h"
#include "value/value.h"

// A new value of an entry of the state.
typedef struct ParticleMove {
    int64_t frame;
    Value key;
    Value value;
} ParticleMove;

// A zeroed struct has no moves.
typedef struct Moves {
    ParticleMove *items; // ordered by frame
    uint32_t count;
    uint32_t capacity;
    Arena arena; // keys and values
    bool torn;   // true if moves_repeat failed, so that the current frame lacks moves
} Moves;

// Moves a particle of the current frame. `vectors` are its new position and velocity; NULL: keeps it. Returns the
// statuses of petri_history_move_particle.
PetriStatus moves_add(Moves *moves, PetriSession *session, size_t system, uint32_t particle,
                      const double *const vectors[2]);
// Repeats the moves of the current frame, after it was computed or restored.
PetriStatus moves_repeat(Moves *moves, PetriSession *session);
bool moves_exist(const Moves *moves, int64_t frame);
// Drops the moves in frames after `frame`.
void moves_drop_after(Moves *moves, int64_t frame);
void moves_free(Moves *moves);
