// digest.c: the digest of the state (spec digest.md).
#include "physics/threads.h"
#include "session/session.h"

// If there are fewer numbers, waking the other threads would take longer than hashing all numbers.
enum { MIN_SHARED_NUMBERS = 1 << 17 };

static void hash_part(void *context, int part, int parts) {
    state_digest_part(context, part, parts);
}

void session_digest(PetriSession *session, uint8_t digest[STATE_DIGEST_SIZE]) {
    Arena *arena = &session->text_arena;
    State *state = session->state;
    uint64_t numbers;
    if (state_digest_is_stale(state))
        arena_charge(arena, state_slot_count(state));
    if (!state_digest_begin(state, &numbers)) {
        state_clear_exhausted(state);
        arena_exhausted(arena);
    }
    arena_charge(arena, numbers / BUDGET_NUMBERS);
    PhysThreads *threads = numbers < MIN_SHARED_NUMBERS ? NULL : scene_threads(session->scene);
    phys_threads_run(threads, phys_threads_chunks(threads), hash_part, state);
    state_digest_end(state, digest);
}

static PetriStatus compute_digest(PetriSession *session, void *context) {
    session_digest(session, context);
    return PETRI_OK;
}

PetriStatus petri_digest(PetriSession *session, uint8_t digest[16]) {
    if (!session || !digest || session->call_depth > 0)
        return PETRI_INVALID;
    return session_run(session, compute_digest, digest, "the digest");
}
