// checkpoint.c: see checkpoint.h.
//
// A checkpoint is a sequence of 64-bit words, in three parts (image.h) that each end with the word END:
// - the key and value of each slot of the dictionary
// - each system with its slots
// - the lines of the input, each with the address of its name
//
// A value starts with a word for its length and kind. In a numeric value, the numbers follow. In a mixed value, each
// element starts with a word for its type and length, and strings are padded to whole words. All slots are stored in
// order, so that each has the same number after a restore and the session behaves identically.
#include "base/heap.h"
#include "session/session.h"

#include <string.h>

#define END UINT64_MAX
static const unsigned parts[] = {IMAGE_ENTRIES, IMAGE_SYSTEMS, IMAGE_INPUT};

typedef struct CheckpointWriter {
    ImageSink sink; // first member, so that a pointer to it can be cast to CheckpointWriter
    Checkpoint *to;
    bool failed;
} CheckpointWriter;

static void write_bytes(CheckpointWriter *writer, const void *bytes, size_t size) {
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

static void write_word(CheckpointWriter *writer, uint64_t word) {
    write_bytes(writer, &word, sizeof word);
}

static void write_item(CheckpointWriter *writer, Item item) {
    if (item.type == ITEM_STRING) {
        write_word(writer, (uint64_t)item.as.string->text.len << 2 | ITEM_STRING);
        write_bytes(writer, item.as.string->text.bytes, item.as.string->text.len);
    } else {
        write_word(writer, ITEM_NUMBER); // the dictionary contains no other types
        write_bytes(writer, &item.as.number, sizeof item.as.number);
    }
}

static void write_value(CheckpointWriter *writer, Value v) {
    write_word(writer, (uint64_t)v.len << 2 | v.kind);
    if (v.kind == VALUE_NUMBERS && v.len > 0)
        write_bytes(writer, value_numbers(&v), v.len * sizeof(double));
    for (uint32_t i = 0; v.kind == VALUE_MIXED && i < v.len; i++)
        write_item(writer, v.as.items[i]);
}

static void write_entry(ImageSink *sink, Value key, Value value) {
    CheckpointWriter *writer = (CheckpointWriter *)sink;
    write_value(writer, key);
    write_value(writer, value);
}

static void write_system(ImageSink *sink, const SceneSystem *system) {
    CheckpointWriter *writer = (CheckpointWriter *)sink;
    write_word(writer, system->prefix);
    write_word(writer, system->occurrence);
    write_word(writer, system->slot_count);
    write_bytes(writer, system->slots, system->slot_count * sizeof *system->slots);
}

static void write_line(ImageSink *sink, const char *name, Value first, Value rest) {
    CheckpointWriter *writer = (CheckpointWriter *)sink;
    write_word(writer, (uintptr_t)name);
    write_value(writer, first);
    write_value(writer, rest);
}

bool checkpoint_save(Checkpoint *checkpoint, PetriSession *session) {
    CheckpointWriter writer = {.sink = {write_line, write_entry, write_system, true}, .to = checkpoint};
    checkpoint->clock = session->clock;
    checkpoint->size = 0;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        image_write(session, parts[i], &writer.sink);
        write_word(&writer, END);
    }
    return !writer.failed;
}

typedef struct CheckpointReader {
    const unsigned char *at;
    Arena *arena;
} CheckpointReader;

static const void *read_bytes(CheckpointReader *reader, size_t size) {
    const void *bytes = reader->at;
    reader->at += (size + 7) & ~(size_t)7;
    return bytes;
}

static uint64_t read_word(CheckpointReader *reader) {
    uint64_t word;
    memcpy(&word, read_bytes(reader, sizeof word), sizeof word);
    return word;
}

static Item read_item(CheckpointReader *reader) {
    Item item = {.type = ITEM_NUMBER};
    uint64_t word = read_word(reader);
    if ((word & 3) == ITEM_STRING) {
        String *string = arena_alloc(reader->arena, sizeof *string);
        size_t len = (size_t)(word >> 2);
        *string = (String){{read_bytes(reader, len), len}};
        item.type = ITEM_STRING;
        item.as.string = string;
    } else {
        memcpy(&item.as.number, read_bytes(reader, sizeof(double)), sizeof(double));
    }
    return item;
}

// Returns a value. Its strings, and the numbers of a numeric value, still refer to the checkpoint's memory.
static Value read_value(CheckpointReader *reader) {
    uint64_t word = read_word(reader);
    uint32_t len = (uint32_t)(word >> 2);
    if ((word & 3) == VALUE_NUMBERS)
        return value_numbers_view(read_bytes(reader, len * sizeof(double)), len);
    Item *items = arena_alloc_array(reader->arena, len, sizeof *items);
    for (uint32_t i = 0; i < len; i++)
        items[i] = read_item(reader);
    return (Value){.len = len, .kind = VALUE_MIXED, .as.items = items};
}

// Returns true, and skips the word, if a part ends here.
static bool read_end(CheckpointReader *reader) {
    uint64_t word;
    memcpy(&word, reader->at, sizeof word);
    reader->at += word == END ? sizeof word : 0;
    return word == END;
}

static void read_state(CheckpointReader *reader, State *state) {
    while (!read_end(reader)) {
        StateSlot slot = state_slot(state, read_value(reader));
        state_slot_set(state, slot, read_value(reader));
    }
}

void checkpoint_read_state(const Checkpoint *checkpoint, Arena *arena, State *state) {
    CheckpointReader reader = {checkpoint->bytes, arena};
    read_state(&reader, state);
}

static void read_system(CheckpointReader *reader, PetriSession *session, Incoming *incoming) {
    SceneSystem system = {.prefix = (StateSlot)read_word(reader)};
    system.occurrence = (uint32_t)read_word(reader);
    system.slot_count = (uint32_t)read_word(reader);
    system.slots = read_bytes(reader, system.slot_count * sizeof *system.slots);
    image_read_system(session, incoming, &system);
}

static void read_line(CheckpointReader *reader, Incoming *incoming) {
    const char *name = (const char *)(uintptr_t)read_word(reader);
    Vector value = vector_new(reader->arena);
    vector_add(&value, read_value(reader));
    vector_add(&value, read_value(reader));
    image_read_input(incoming, str_from(name), vector_finish(&value));
}

static PetriStatus read_checkpoint(PetriSession *session, Incoming *incoming, void *context) {
    const Checkpoint *checkpoint = context;
    CheckpointReader reader = {checkpoint->bytes, &incoming->arena};
    read_state(&reader, incoming->state);
    while (!read_end(&reader))
        read_system(&reader, session, incoming);
    while (!read_end(&reader))
        read_line(&reader, incoming);
    incoming->has_input = true;
    incoming->clock = checkpoint->clock;
    return PETRI_OK;
}

PetriStatus checkpoint_restore(PetriSession *session, const Checkpoint *checkpoint) {
    return checkpoint_replace(session, read_checkpoint, (void *)checkpoint);
}

typedef struct Filling {
    FillIncoming *fill;
    Incoming *incoming;
    void *context;
} Filling;

static PetriStatus run_fill(PetriSession *session, void *context) {
    const Filling *filling = context;
    Incoming *incoming = filling->incoming;
    incoming->bindings.arena.escape = incoming->arena.escape;
    incoming->state = state_new(&session->budget);
    if (!incoming->state)
        arena_exhausted(&incoming->arena);
    PetriStatus status = filling->fill(session, incoming, filling->context);
    if (state_clear_exhausted(incoming->state))
        arena_exhausted(&incoming->arena);
    return status;
}

static void install_incoming(PetriSession *session, Incoming *incoming) {
    Input *input = scene_input(session->scene);
    InputBindings bindings = input->bindings;
    State *state = session->state;
    session_clear_frame(session);
    session->rollback_pending = session->undo_of_frame = false;
    session->state = incoming->state;
    session->clock = incoming->clock;
    incoming->state = state;
    if (!incoming->has_input)
        return;
    input->state = incoming->input_state;
    input->bindings = incoming->bindings;
    incoming->bindings = bindings;
}

PetriStatus checkpoint_replace(PetriSession *session, FillIncoming *make, void *context) {
    Incoming incoming = {.clock = session->clock};
    Filling filling = {make, &incoming, context};
    PhysicsSystem *systems = scene_detach_systems(session->scene);
    session_arena(session, &incoming.arena, "incoming state", SIZE_MAX);
    input_reset(&incoming.input_state, &incoming.bindings);
    PetriStatus status = session_attempt(session, &incoming.arena, run_fill, &filling);
    if (status == PETRI_OK)
        install_incoming(session, &incoming);
    else
        scene_attach_systems(session->scene, systems);
    state_free(incoming.state);
    if (status == PETRI_OK)
        scene_free_systems(systems);
    arena_free(&incoming.bindings.arena);
    arena_free(&incoming.arena);
    return status;
}
