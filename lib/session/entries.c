// entries.c: the state dictionary, and the names that the host gives values to, as petri.h has them.
#include "session/session.h"

#include "base/number.h"

#include <stdlib.h>
#include <string.h>

// --- the state

// One request. What is looked up with numbers only needs no memory, and so no protected call.
typedef struct Wanted {
    PetriValue key;
    PetriValue value; // to be stored
    Value taken;
    StateSlot slot;
    PetriStatus status;
} Wanted;

static void find_entry(PetriSession *session, void *context) {
    Wanted *wanted = context;
    if (!wanted->key.numbers)
        arena_reset(&session->key_arena);
    wanted->slot = session_take(&session->key_arena, wanted->key, &wanted->taken)
                       ? state_find(session->state, wanted->taken)
                       : STATE_NO_SLOT;
}

PetriValue petri_state_get(PetriSession *session, PetriValue key) {
    Wanted wanted = {.key = key, .slot = STATE_NO_SLOT};
    if (!session || (session->torn && !session_heal(session)))
        return (PetriValue){0};
    if (key.numbers)
        find_entry(session, &wanted);
    else if (session->calls == 0)
        session_protect(session, NULL, find_entry, &wanted);
    Value room;
    return wanted.slot == STATE_NO_SLOT ? (PetriValue){0}
                                        : session_show(state_slot_at(session->state, wanted.slot, &room));
}

// Numbers that are finite, and strings.
static bool is_storable(Value v) {
    for (uint32_t i = 0; i < v.len; i++) {
        Item item = value_at(&v, i);
        if (item.type == ITEM_NUMBER ? !numbers_finite(&item.as.number, 1, 1) : item.type != ITEM_STRING)
            return false;
    }
    return true;
}

static void set_entry(PetriSession *session, void *context) {
    Wanted *wanted = context;
    Arena *arena = &session->key_arena;
    Value value;
    arena_reset(arena);
    wanted->status = PETRI_INVALID;
    if (!session_take(arena, wanted->key, &wanted->taken) || !state_key_valid(wanted->taken) ||
        !session_take(arena, wanted->value, &value) || !is_storable(value))
        return;
    wanted->status = state_set(session->state, wanted->taken, value) ? PETRI_OK : PETRI_MEMORY;
    if (state_take_exhausted(session->state))
        wanted->status = PETRI_MEMORY;
}

PetriStatus petri_state_set(PetriSession *session, PetriValue key, PetriValue value) {
    Wanted wanted = {.key = key, .value = value};
    if (!session || session->calls > 0)
        return PETRI_INVALID;
    PetriStatus status = session_protect(session, NULL, set_entry, &wanted);
    return session_tell_end(session, status == PETRI_OK ? wanted.status : status, "the state");
}

bool petri_state_next(PetriSession *session, uint32_t *cursor, PetriValue *key, PetriValue *value) {
    if (!session || !cursor || !key || !value || (session->torn && !session_heal(session)))
        return false;
    const State *state = session->state;
    while (*cursor < state_slot_count(state) && state_slot_get(state, *cursor).len == 0)
        ++*cursor;
    if (*cursor >= state_slot_count(state))
        return false;
    Value room;
    *key = session_show(state_slot_key_at(state, *cursor, &room));
    *value = session_show(state_slot_at(state, *cursor, &room));
    ++*cursor;
    return true;
}

// --- names

typedef struct Giving {
    Str name;
    PetriValue value;
    PetriStatus status;
} Giving;

static GivenName *find_given(PetriSession *session, const Symbol *name) {
    for (uint32_t i = 0; i < session->given.count; i++)
        if (session->given.items[i]->name == name)
            return session->given.items[i];
    return NULL;
}

// A name with an arena for its values, which is the session's from then on.
static GivenName *add_given(PetriSession *session, const Symbol *name) {
    GivenNames *given = &session->given;
    GivenName *added = arena_alloc(&session->arena, sizeof *added);
    const Symbol **names = arena_alloc_array(&session->arena, given->count + 1, sizeof *names);
    GivenName **items = arena_alloc_array(&session->arena, given->count + 1, sizeof(GivenName *));
    for (uint32_t i = 0; i < given->count; i++) {
        names[i] = given->names[i];
        items[i] = given->items[i];
    }
    *added = (GivenName){.name = name};
    for (int i = 0; i < 2; i++)
        session_arena(session, &added->arenas[i], "name", SIZE_MAX);
    names[given->count] = name;
    items[given->count] = added;
    given->names = names;
    given->items = items;
    given->count++;
    return added;
}

static void copy_given(void *context) {
    GivenName *given = context;
    given->next = value_copy(&given->arenas[!given->turn], given->next);
}

static void give(PetriSession *session, void *context) {
    Giving *giving = context;
    giving->status = PETRI_INVALID;
    Value value;
    arena_reset(&session->key_arena);
    if (!session_is_name(giving->name) || engine_name_exists(giving->name) ||
        !session_take(&session->key_arena, giving->value, &value))
        return;
    for (uint32_t i = 0; value.kind == VALUE_MIXED && i < value.len; i++)
        if (value.as.items[i].type > ITEM_STRING)
            return;
    const Symbol *name = symbol_intern(&session->symbols, giving->name);
    GivenName *given = find_given(session, name);
    if (!given)
        given = add_given(session, name);
    Arena *fresh = &given->arenas[!given->turn];
    given->next = value;
    arena_reset(fresh);
    if (arena_protect(&fresh, 1, copy_given, given) != ARENA_DONE)
        arena_exhausted(&session->key_arena);
    given->turn = !given->turn;
    given->value = given->next;
    giving->status = PETRI_OK;
}

PetriStatus petri_give(PetriSession *session, const char *name, PetriValue value) {
    if (!session || !name || session->calls > 0)
        return PETRI_INVALID;
    Giving giving = {str_from(name), value, PETRI_OK};
    PetriStatus status = session_protect(session, NULL, give, &giving);
    return session_tell_end(session, status == PETRI_OK ? giving.status : status, "the name");
}

void session_copy_given(const PetriSession *session, PetriSession *to) {
    for (uint32_t i = 0; i < session->given.count; i++) {
        const GivenName *given = session->given.items[i];
        petri_give(to, given->name->name.bytes, session_show(&given->value));
    }
}

void session_free_given(PetriSession *session) {
    for (uint32_t i = 0; i < session->given.count; i++)
        for (int k = 0; k < 2; k++)
            arena_free(&session->given.items[i]->arenas[k]);
}
