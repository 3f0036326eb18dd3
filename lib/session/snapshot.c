// snapshot.c: state and systems as one block of memory, and back.
//
// Everything is a row of 64-bit words: how many slots the dictionary has, key and value of each, how many systems there
// are, and each with its slots. A value is a word with its length and kind, then its numbers; a mixed one has a word
// with type and length before each element, and strings are padded. Slots keep their numbers, so that what comes after
// is the same in every respect.
#include "session/session.h"

#include <stdlib.h>
#include <string.h>

typedef struct Writer {
    PetriSnapshot *to;
    bool failed;
} Writer;

static void put_bytes(Writer *writer, const void *bytes, size_t size) {
    PetriSnapshot *to = writer->to;
    size_t padded = (size + 7) & ~(size_t)7;
    if (to->size + padded > to->capacity) {
        size_t capacity = 2 * to->capacity > to->size + padded ? 2 * to->capacity : to->size + padded;
        unsigned char *larger = realloc(to->bytes, capacity);
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

bool session_take(PetriSession *session, PetriSnapshot *snapshot) {
    Writer writer = {snapshot, false};
    snapshot->frame = session->frame;
    snapshot->base = session->base;
    snapshot->delta = session->delta;
    snapshot->size = 0;
    uint32_t count = state_slot_count(session->state);
    put_word(&writer, count);
    for (uint32_t i = 0; i < count; i++) {
        put_value(&writer, state_slot_key(session->state, i));
        put_value(&writer, state_slot_get(session->state, i));
    }
    put_systems(&writer, session->scene);
    return !writer.failed;
}

typedef struct SnapshotReader {
    const unsigned char *at;
    Arena *arena;
} SnapshotReader;

static const void *take_bytes(SnapshotReader *reader, size_t size) {
    const void *bytes = reader->at;
    reader->at += (size + 7) & ~(size_t)7;
    return bytes;
}

static uint64_t take_word(SnapshotReader *reader) {
    uint64_t word;
    memcpy(&word, take_bytes(reader, sizeof word), sizeof word);
    return word;
}

static Item take_item(SnapshotReader *reader) {
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

// A view of the snapshot's memory where it can be.
static Value take_value(SnapshotReader *reader) {
    uint64_t word = take_word(reader);
    uint32_t len = (uint32_t)(word >> 2);
    if ((word & 3) == VALUE_NUMBERS)
        return value_numbers_view(take_bytes(reader, len * sizeof(double)), len);
    Item *items = arena_alloc_array(reader->arena, len, sizeof *items);
    for (uint32_t i = 0; i < len; i++)
        items[i] = take_item(reader);
    return (Value){.len = len, .kind = VALUE_MIXED, .as.items = items};
}

// A new dictionary, or NULL.
static State *take_state(SnapshotReader *reader) {
    State *state = state_new();
    uint64_t count = take_word(reader);
    for (uint64_t i = 0; state && i < count; i++) {
        StateSlot slot = state_slot(state, take_value(reader));
        if (slot != i || !state_slot_set(state, slot, take_value(reader))) {
            state_free(state);
            state = NULL;
        }
    }
    return state;
}

static bool take_systems(SnapshotReader *reader, PetriSession *session) {
    SceneFrame frame = {.state = session->state, .arena = reader->arena};
    bool done = true;
    scene_reset(session->scene, NULL);
    for (uint64_t left = take_word(reader); left > 0 && done; left--) {
        SceneSystem system = {.prefix = (StateSlot)take_word(reader)};
        system.occurrence = (uint32_t)take_word(reader);
        system.slot_count = (uint32_t)take_word(reader);
        system.slots = take_bytes(reader, system.slot_count * sizeof *system.slots);
        done = scene_restore_system(session->scene, &system, &frame);
    }
    return done;
}

bool session_put_back(PetriSession *session, const PetriSnapshot *snapshot) {
    Arena arena;
    arena_init(&arena, "snapshot", SIZE_MAX);
    SnapshotReader reader = {snapshot->bytes, &arena};
    State *state = take_state(&reader);
    bool done = state != NULL;
    if (done) {
        session_clear_frame(session);
        state_free(session->state);
        session->state = state;
        done = take_systems(&reader, session);
        session->frame = snapshot->frame;
        session->base = snapshot->base;
        session->delta = snapshot->delta;
    }
    arena_free(&arena);
    return done;
}

PetriSnapshot *petri_snapshot(PetriSession *session) {
    PetriConfig *config = petri_config(session);
    PetriSnapshot *snapshot = config ? calloc(1, sizeof *snapshot) : NULL;
    if (snapshot && session_take(session, snapshot)) {
        snapshot->config = config;
        unsigned char *exact = realloc(snapshot->bytes, snapshot->size); // many are kept
        snapshot->bytes = exact ? exact : snapshot->bytes;
        return snapshot;
    }
    petri_config_free(config);
    petri_snapshot_free(snapshot);
    return NULL;
}

void petri_snapshot_free(PetriSnapshot *snapshot) {
    if (!snapshot)
        return;
    petri_config_free(snapshot->config);
    free(snapshot->bytes);
    free(snapshot);
}

size_t petri_snapshot_bytes(const PetriSnapshot *snapshot) {
    return sizeof *snapshot + snapshot->size;
}

PetriStatus petri_rewind(PetriSession *session, const PetriSnapshot *snapshot) {
    if (!session_put_back(session, snapshot))
        return PETRI_MEMORY;
    petri_config_use(session, snapshot->config);
    session_rewind_wall_clock(session);
    return PETRI_OK;
}
