// moves.c: see moves.h.
#include "session/moves.h"

#include "base/heap.h"
#include "base/number.h"
#include "session/session.h"

// A call of moves_add.
typedef struct MoveRequest {
    Moves *moves;
    size_t system;
    uint32_t particle;
    const double *const *vectors;
    ParticleMove changes[2]; // of position and velocity
    Value before[2];
} MoveRequest;

static PetriStatus prepare_moves(PetriSession *session, void *context) {
    MoveRequest *request = context;
    Arena *arena = &request->moves->arena;
    SceneView view;
    if (!scene_view(session->scene, session->state, request->system, &view) ||
        request->particle >= view.particle_count || phys_is_anchor(view.engine, request->particle))
        return PETRI_INVALID;
    for (int i = 0; i < 2; i++) {
        const double *vector = request->vectors[i];
        StateSlot slot = view.slots[2 * (size_t)request->particle + (size_t)i];
        if (!vector)
            continue;
        if (!numbers_finite(vector, view.dimensions, 1))
            return PETRI_INVALID;
        request->changes[i] = (ParticleMove){
            .frame = session->clock.number,
            .key = value_copy(arena, state_slot_key_in(session->state, slot, (double[STATE_KEY_BUFFER]){0})),
            .value = value_copy(arena, value_numbers_view(vector, view.dimensions)),
        };
        request->before[i] = value_copy(arena, state_slot_get(session->state, slot));
    }
    return PETRI_OK;
}

static PetriStatus store_moved(PetriSession *session, Value key, Value value) {
    PetriStatus status = petri_state_set(session, session_export_value(&key), session_export_value(&value));
    if (status == PETRI_OK)
        scene_show_entry(session->scene, session->state, state_find(session->state, key));
    return status;
}

PetriStatus moves_add(Moves *moves, PetriSession *session, size_t system, uint32_t particle,
                      const double *const vectors[2]) {
    MoveRequest request = {.moves = moves, .system = system, .particle = particle, .vectors = vectors};
    if (!moves->arena.name)
        session_arena(session, &moves->arena, "moves", SIZE_MAX);
    PetriStatus status = session_protect(session, &moves->arena, prepare_moves, &request);
    session_report_abort(session, status, "the move");
    if (status == PETRI_OK &&
        !heap_reserve((void **)&moves->items, &moves->capacity, moves->count + 1, sizeof *moves->items))
        status = PETRI_OUT_OF_MEMORY;
    int stored = 0;
    for (; stored < 2 && status == PETRI_OK; stored++)
        if (vectors[stored])
            status = store_moved(session, request.changes[stored].key, request.changes[stored].value);
    if (status != PETRI_OK) {
        if (stored > 1 && vectors[0])
            store_moved(session, request.changes[0].key, request.before[0]);
        return status;
    }
    moves_drop_after(moves, session->clock.number);
    for (int i = 0; i < 2; i++)
        if (vectors[i])
            moves->items[moves->count++] = request.changes[i];
    return PETRI_OK;
}

PetriStatus moves_repeat(Moves *moves, PetriSession *session) {
    PetriStatus status = PETRI_OK;
    uint32_t first = moves->count;
    while (first > 0 && moves->items[first - 1].frame >= session->clock.number)
        first--;
    for (uint32_t i = first; i < moves->count && moves->items[i].frame == session->clock.number; i++) {
        PetriStatus stored = store_moved(session, moves->items[i].key, moves->items[i].value);
        status = status == PETRI_OK ? stored : status;
    }
    moves->torn = status != PETRI_OK;
    return status;
}

bool moves_exist(const Moves *moves, int64_t frame) {
    for (uint32_t i = 0; i < moves->count; i++)
        if (moves->items[i].frame == frame)
            return true;
    return false;
}

void moves_drop_after(Moves *moves, int64_t frame) {
    while (moves->count > 0 && moves->items[moves->count - 1].frame > frame)
        moves->count--;
}

void moves_free(Moves *moves) {
    heap_free(moves->items);
    arena_free(&moves->arena);
    *moves = (Moves){0};
}
