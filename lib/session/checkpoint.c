// checkpoint.c: see checkpoint.h; snapshots.
//
// Everything is a row of 64-bit words: how many slots the dictionary has, key and value of each; how many systems there
// are, and each with its slots; what the user's hands have done, if anything, and where that goes. A value is a word
// with its length and kind, then its numbers; a mixed one has a word with type and length before each element, and
// strings are padded. Slots keep their numbers, so that what comes after is the same in every respect.
#include "session/session.h"

#include "base/heap.h"

#include <string.h>

typedef struct Writer {
    Checkpoint *to;
    bool failed;
} Writer;

static void put_bytes(Writer *writer, const void *bytes, size_t size) {
    Checkpoint *to = writer->to;
    size_t padded = (size + 7) & ~(size_t)7;
    if (to->size + padded > to->capacity) {
        size_t capacity = 2 * to->capacity > to->size + padded ? 2 * to->capacity : to->size + padded;
        unsigned char *larger = heap_resize(to->bytes, capacity);
        if (!larger) {
            writer->failed = true;
            return;
        }
        to->bytes = larger;
        to->capacity = capacity;
    }
    if (size)
        memcpy(to->bytes + to->size, bytes, size);
    memset(to->bytes + to->size + size, 0, padded - size);
    to->size += padded;
}

static void put_word(Writer *writer, uint64_t word) {
    put_bytes(writer, &word, sizeof word);
}

static void put_item(Writer *writer, Item item) {
    if (item.type == ITEM_STRING) {
        put_word(writer, (uint64_t)item.as.string->text.len << 2 | ITEM_STRING);
        put_bytes(writer, item.as.string->text.bytes, item.as.string->text.len);
    } else {
        put_word(writer, ITEM_NUMBER); // the dictionary holds nothing else
        put_bytes(writer, &item.as.number, sizeof item.as.number);
    }
}

static void put_value(Writer *writer, Value v) {
    put_word(writer, (uint64_t)v.len << 2 | v.kind);
    if (v.kind == VALUE_NUMBERS && v.len > 0)
        put_bytes(writer, value_numbers(&v), v.len * sizeof(double));
    for (uint32_t i = 0; v.kind == VALUE_MIXED && i < v.len; i++)
        put_item(writer, v.as.items[i]);
}

static void put_state(Writer *writer, const State *state) {
    uint32_t count = state_slot_count(state);
    double room[STATE_KEY_ROOM];
    put_word(writer, count);
    for (uint32_t i = 0; i < count; i++) {
        put_value(writer, state_slot_key_in(state, i, room));
        put_value(writer, state_slot_get(state, i));
    }
}

static void put_systems(Writer *writer, const Scene *scene) {
    uint64_t count = 0;
    const void *cursor = NULL;
    for (SceneSystem system; scene_next_system(scene, &cursor, &system);)
        count++;
    put_word(writer, count);
    cursor = NULL;
    for (SceneSystem system; scene_next_system(scene, &cursor, &system);) {
        put_word(writer, system.prefix);
        put_word(writer, system.occurrence);
        put_word(writer, system.slot_count);
        put_bytes(writer, system.slots, system.slot_count * sizeof *system.slots);
    }
}

static void put_input(Writer *writer, const Input *input) {
    const InputBindings *bindings = &input->bindings;
    put_word(writer, bindings->count);
    for (uint32_t i = 0; i < bindings->count; i++) {
        put_word(writer, (uint64_t)(bindings->items[i].key - INPUT_KEY_NONE));
        put_value(writer, bindings->items[i].state);
    }
    put_word(writer, input->hands.heard);
    if (input->hands.heard)
        put_bytes(writer, &input->hands, sizeof input->hands);
}

bool checkpoint_take(Checkpoint *checkpoint, PetriSession *session) {
    Writer writer = {checkpoint, false};
    checkpoint->clock = session->clock;
    checkpoint->size = 0;
    put_state(&writer, session->state);
    put_systems(&writer, session->scene);
    put_input(&writer, scene_input(session->scene));
    return !writer.failed;
}

typedef struct Taker {
    const unsigned char *at;
    Arena *arena;
} Taker;

static const void *take_bytes(Taker *reader, size_t size) {
    const void *bytes = reader->at;
    reader->at += (size + 7) & ~(size_t)7;
    return bytes;
}

static uint64_t take_word(Taker *reader) {
    uint64_t word;
    memcpy(&word, take_bytes(reader, sizeof word), sizeof word);
    return word;
}

static Item take_item(Taker *reader) {
    Item item = {.type = ITEM_NUMBER};
    uint64_t word = take_word(reader);
    if ((word & 3) == ITEM_STRING) {
        String *string = arena_alloc(reader->arena, sizeof *string);
        size_t len = (size_t)(word >> 2);
        *string = (String){{take_bytes(reader, len), len}};
        item.type = ITEM_STRING;
        item.as.string = string;
    } else {
        memcpy(&item.as.number, take_bytes(reader, sizeof(double)), sizeof(double));
    }
    return item;
}

// A view of the checkpoint's memory where it can be.
static Value take_value(Taker *reader) {
    uint64_t word = take_word(reader);
    uint32_t len = (uint32_t)(word >> 2);
    if ((word & 3) == VALUE_NUMBERS)
        return value_numbers_view(take_bytes(reader, len * sizeof(double)), len);
    Item *items = arena_alloc_array(reader->arena, len, sizeof *items);
    for (uint32_t i = 0; i < len; i++)
        items[i] = take_item(reader);
    return (Value){.len = len, .kind = VALUE_MIXED, .as.items = items};
}

static void take_state(Taker *reader, State *state) {
    uint64_t count = take_word(reader);
    for (uint64_t i = 0; i < count; i++) {
        StateSlot slot = state_slot(state, take_value(reader));
        state_slot_set(state, slot, take_value(reader));
    }
}

static void take_systems(Taker *reader, PetriSession *session, Incoming *incoming) {
    for (uint64_t left = take_word(reader); left > 0; left--) {
        SceneSystem system = {.prefix = (StateSlot)take_word(reader)};
        system.occurrence = (uint32_t)take_word(reader);
        system.slot_count = (uint32_t)take_word(reader);
        system.slots = take_bytes(reader, system.slot_count * sizeof *system.slots);
        checkpoint_restore_system(session, incoming, &system);
    }
}

static void take_input(Taker *reader, Incoming *incoming) {
    incoming->has_input = true;
    for (uint64_t left = take_word(reader); left > 0; left--) {
        int key = (int)take_word(reader) + INPUT_KEY_NONE;
        input_add_binding(&incoming->bindings, take_value(reader), key);
    }
    if (take_word(reader))
        memcpy(&incoming->hands, take_bytes(reader, sizeof incoming->hands), sizeof incoming->hands);
}

static void take_all(PetriSession *session, Incoming *incoming, void *context) {
    const Checkpoint *checkpoint = context;
    Taker reader = {checkpoint->bytes, &incoming->arena};
    take_state(&reader, incoming->state);
    take_systems(&reader, session, incoming);
    take_input(&reader, incoming);
    incoming->clock = checkpoint->clock;
}

PetriStatus checkpoint_put_back(PetriSession *session, const Checkpoint *checkpoint) {
    return checkpoint_replace(session, take_all, (void *)checkpoint);
}

void checkpoint_restore_system(PetriSession *session, Incoming *incoming, const SceneSystem *system) {
    SceneFrame frame = {.state = incoming->state, .arena = &incoming->arena};
    if (!scene_restore_system(session->scene, system, &frame))
        arena_exhausted(&incoming->arena);
}

typedef struct Filling {
    FillIncoming *fill;
    Incoming *incoming;
    void *context;
} Filling;

static void fill(PetriSession *session, void *context) {
    const Filling *filling = context;
    Incoming *incoming = filling->incoming;
    incoming->bindings.arena.escape = incoming->arena.escape;
    incoming->state = state_new(&session->meter);
    if (!incoming->state)
        arena_exhausted(&incoming->arena);
    filling->fill(session, incoming, filling->context);
    if (state_take_exhausted(incoming->state))
        arena_exhausted(&incoming->arena);
}

static void install(PetriSession *session, Incoming *incoming) {
    Input *input = scene_input(session->scene);
    InputBindings bindings = input->bindings;
    State *state = session->state;
    session_clear_frame(session);
    session->torn = false;
    session->state = incoming->state;
    session->clock = incoming->clock;
    incoming->state = state;
    if (!incoming->has_input)
        return;
    input->hands = incoming->hands;
    input->bindings = incoming->bindings;
    incoming->bindings = bindings;
}

PetriStatus checkpoint_replace(PetriSession *session, FillIncoming *make, void *context) {
    Incoming incoming = {.clock = session->clock, .good = true};
    Filling filling = {make, &incoming, context};
    PhysicsSystem *systems = scene_set_aside(session->scene);
    session_arena(session, &incoming.arena, "incoming state", SIZE_MAX);
    input_forget(&incoming.hands, &incoming.bindings);
    PetriStatus status = session_protect(session, &incoming.arena, fill, &filling);
    if (status == PETRI_OK && !incoming.good)
        status = PETRI_INVALID;
    if (status == PETRI_OK)
        install(session, &incoming);
    else
        scene_bring_back(session->scene, systems);
    state_free(incoming.state);
    if (status == PETRI_OK)
        scene_free_systems(systems);
    arena_free(&incoming.bindings.arena);
    arena_free(&incoming.arena);
    return status;
}

PetriSnapshot *petri_snapshot(PetriSession *session) {
    if (!session || (session->torn && !session_heal(session)))
        return NULL;
    PetriSnapshot *snapshot = heap_zeroed(1, sizeof *snapshot);
    if (!snapshot)
        return NULL;
    snapshot->config = petri_config(session);
    if (!snapshot->config || !checkpoint_take(&snapshot->at, session)) {
        petri_snapshot_free(snapshot);
        return NULL;
    }
    unsigned char *exact = heap_resize(snapshot->at.bytes, snapshot->at.size); // many are kept
    snapshot->at.bytes = exact ? exact : snapshot->at.bytes;
    return snapshot;
}

void petri_snapshot_free(PetriSnapshot *snapshot) {
    if (!snapshot)
        return;
    petri_config_free(snapshot->config);
    heap_give(snapshot->at.bytes);
    heap_give(snapshot);
}

size_t petri_snapshot_bytes(const PetriSnapshot *snapshot) {
    return snapshot ? sizeof *snapshot + snapshot->at.size : 0;
}

PetriStatus petri_rewind(PetriSession *session, const PetriSnapshot *snapshot) {
    if (!session || !snapshot)
        return PETRI_INVALID;
    PetriStatus status = checkpoint_put_back(session, &snapshot->at);
    if (status != PETRI_OK)
        return PETRI_MEMORY;
    petri_config_use(session, snapshot->config);
    clock_follow_frame(&session->clock);
    return PETRI_OK;
}
