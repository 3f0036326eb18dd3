// host_state.c: the host's access to the state dictionary, its digest (spec digest.md), global names and input.
#include "base/host_struct.h"
#include "base/number.h"
#include "petri-inspect.h"
#include "physics/threads.h"
#include "session/session.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the state dictionary

// A request to read or write an entry of the state dictionary. Finding a key that contains only numbers allocates
// nothing, so it needs no protected call.
typedef struct StateRequest {
    PetriValue key;
    PetriValue value; // value to store
    Value imported;
    StateSlot slot;
} StateRequest;

static PetriStatus find_state_entry(PetriSession *session, void *context) {
    StateRequest *request = context;
    if (!request->key.numbers)
        arena_reset(&session->key_arena);
    request->slot = session_import_value(&session->key_arena, request->key, &request->imported)
                        ? state_find(session->state, request->imported)
                        : STATE_NO_SLOT;
    return PETRI_OK;
}

PetriValue petri_state_get(PetriSession *session, PetriValue key) {
    StateRequest request = {.key = key, .slot = STATE_NO_SLOT};
    if (!session || (session->rollback_pending && !session_rollback(session)))
        return (PetriValue){0};
    if (key.numbers)
        find_state_entry(session, &request);
    else if (session->call_depth == 0)
        session_protect(session, NULL, find_state_entry, &request);
    Value buffer;
    return request.slot == STATE_NO_SLOT ? (PetriValue){0}
                                         : session_export_value(state_slot_at(session->state, request.slot, &buffer));
}

// Returns true if a value consists of finite numbers and strings.
static bool is_storable(Value v) {
    for (uint32_t i = 0; i < v.len; i++) {
        Item item = value_at(&v, i);
        if (item.type == ITEM_NUMBER ? !numbers_finite(&item.as.number, 1, 1) : item.type != ITEM_STRING)
            return false;
    }
    return true;
}

static PetriStatus set_entry(PetriSession *session, void *context) {
    StateRequest *request = context;
    Arena *arena = &session->key_arena;
    Value value;
    arena_reset(arena);
    if (!session_import_value(arena, request->key, &request->imported) || !state_key_valid(request->imported) ||
        !session_import_value(arena, request->value, &value) || !is_storable(value))
        return PETRI_INVALID;
    bool stored = state_set(session->state, request->imported, value);
    return state_clear_exhausted(session->state) || !stored ? PETRI_OUT_OF_MEMORY : PETRI_OK;
}

PetriStatus petri_state_set(PetriSession *session, PetriValue key, PetriValue value) {
    StateRequest request = {.key = key, .value = value};
    if (!session || session->call_depth > 0)
        return PETRI_INVALID;
    PetriStatus status = session_run(session, set_entry, &request, "the assignment");
    if (status == PETRI_OK) {
        session->frame.names_current = false; // names that statements of the prompt bind can depend on the entry
        recorder_state(session, key, value);
    }
    return status;
}

bool petri_state_next(PetriSession *session, uint32_t *cursor, PetriValue *key, PetriValue *value) {
    if (!session || !cursor || !key || !value || (session->rollback_pending && !session_rollback(session)))
        return false;
    State *state = session->state;
    StateSlot slot = state_next_slot(state, cursor);
    if (slot == STATE_NO_SLOT) {
        state_clear_exhausted(state); // must not abort the next frame
        return false;
    }
    Value buffer;
    *key = session_export_value(state_slot_key_at(state, slot, &buffer));
    *value = session_export_value(state_slot_at(state, slot, &buffer));
    return true;
}

// --- the digest

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

// --- global names

typedef struct GlobalRequest {
    Str name;
    PetriValue value;
} GlobalRequest;

static HostGlobal *find_host_global(PetriSession *session, const Symbol *name) {
    for (uint32_t i = 0; i < session->host_globals.count; i++)
        if (session->host_globals.items[i]->name == name)
            return session->host_globals.items[i];
    return NULL;
}

// Adds a name with two arenas for its values. The arenas are freed with the session.
static HostGlobal *add_host_global(PetriSession *session, const Symbol *name) {
    HostGlobals *global = &session->host_globals;
    HostGlobal *added = arena_alloc(&session->arena, sizeof *added);
    const Symbol **names = arena_alloc_array(&session->arena, global->count + 1, sizeof *names);
    HostGlobal **items = arena_alloc_array(&session->arena, global->count + 1, sizeof(HostGlobal *));
    for (uint32_t i = 0; i < global->count; i++) {
        names[i] = global->names[i];
        items[i] = global->items[i];
    }
    *added = (HostGlobal){.name = name};
    for (int i = 0; i < 2; i++)
        session_arena(session, &added->arenas[i], "name", SIZE_MAX);
    names[global->count] = name;
    items[global->count] = added;
    global->names = names;
    global->items = items;
    global->count++;
    return added;
}

static void copy_host_global(void *context) {
    HostGlobal *global = context;
    global->next = value_copy(&global->arenas[!global->turn], global->next);
}

static PetriStatus set_global(PetriSession *session, void *context) {
    const GlobalRequest *request = context;
    Value value;
    arena_reset(&session->key_arena);
    if (!session_is_name(request->name) || engine_name_exists(request->name) ||
        !session_import_value(&session->key_arena, request->value, &value))
        return PETRI_INVALID;
    for (uint32_t i = 0; value.kind == VALUE_MIXED && i < value.len; i++)
        if (value.as.items[i].type > ITEM_STRING)
            return PETRI_INVALID;
    const Symbol *name = symbol_intern(&session->symbols, request->name);
    HostGlobal *global = find_host_global(session, name);
    if (!global)
        global = add_host_global(session, name);
    Arena *fresh = &global->arenas[!global->turn];
    global->next = value;
    arena_reset(fresh);
    if (arena_protect(&fresh, 1, copy_host_global, global) != ARENA_OK)
        arena_exhausted(&session->key_arena);
    global->turn = !global->turn;
    global->value = global->next;
    return PETRI_OK;
}

PetriStatus petri_set_global(PetriSession *session, const char *name, PetriValue value) {
    if (!session || !name || session->call_depth > 0)
        return PETRI_INVALID;
    GlobalRequest request = {str_from(name), value};
    PetriStatus status = session_run(session, set_global, &request, "the assignment");
    if (status == PETRI_OK)
        recorder_global(session, name, value);
    return status;
}

void session_copy_host_globals(const PetriSession *session, PetriSession *to) {
    for (uint32_t i = 0; i < session->host_globals.count; i++) {
        const HostGlobal *global = session->host_globals.items[i];
        petri_set_global(to, global->name->name.bytes, session_export_value(&global->value));
    }
}

void session_free_host_globals(PetriSession *session) {
    for (uint32_t i = 0; i < session->host_globals.count; i++)
        for (int k = 0; k < 2; k++)
            arena_free(&session->host_globals.items[i]->arenas[k]);
}

// --- input

static PetriStatus report_pointer(PetriSession *session, const PetriPointer *given) {
    PetriPointer pointer = {0};
    if (!session)
        return PETRI_INVALID;
    Input *input = scene_input(session->scene);
    if (!given) {
        input_release_all(input);
        return PETRI_OK;
    }
    if (!host_struct_read(&pointer, sizeof pointer, given))
        return PETRI_INVALID;
    if (!pointer.inside) {
        input_report_pointer(input, NULL, pointer.buttons);
        return PETRI_OK;
    }
    if (!isfinite(pointer.x) || !isfinite(pointer.y))
        return PETRI_INVALID;
    input_report_pointer(input, (double[]){fmin(1, fmax(0, pointer.x)), fmin(1, fmax(0, pointer.y))}, pointer.buttons);
    return PETRI_OK;
}

PetriStatus petri_report_pointer(PetriSession *session, const PetriPointer *pointer) {
    if (session && session->recorder.ignores_input)
        return PETRI_OK;
    PetriStatus status = report_pointer(session, pointer);
    if (status == PETRI_OK)
        recorder_pointer(session, pointer);
    return status;
}

PetriStatus petri_report_key(PetriSession *session, const char *name, bool pressed) {
    if (!session || !name)
        return PETRI_INVALID;
    int key = input_key_number(str_from(name));
    if (key == INPUT_KEY_NONE)
        return PETRI_INVALID;
    if (session->recorder.ignores_input)
        return PETRI_OK;
    input_report_key(scene_input(session->scene), key, pressed);
    recorder_key(session, name, pressed);
    return PETRI_OK;
}

bool petri_key_is_bound(PetriSession *session, const char *name) {
    return session && name && input_key_is_bound(scene_input(session->scene), input_key_number(str_from(name)));
}
