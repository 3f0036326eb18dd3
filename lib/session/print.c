// print.c: output of frames as text (spec cli.md 3.3).
#include "base/number.h"
#include "petri-inspect.h"
#include "session/session.h"
#include "session/text_sink.h"
#include "value/format.h"

static void print_header(TextSink *out, const Clock *clock) {
    text_add_format(&out->text, "@%lld time=", (long long)clock->number);
    text_add_number(&out->text, clock->time);
    text_add_c(&out->text, " beat=");
    text_add_number(&out->text, clock->beat);
    text_sink_end_line(out);
}

static void print_tree(TextSink *out, PetriSession *session) {
    Value tree = session->frame.tree;
    for (uint32_t i = 0; tree.kind == VALUE_MIXED && i < tree.len && !out->stopped; i++)
        if (tree.as.items[i].type == ITEM_NODE)
            text_sink_add_tree(out, &session->symbols, tree.as.items[i].as.node);
}

static void print_state(TextSink *out, PetriSession *session) {
    const State *state = session->state;
    uint32_t count = 0, capacity = state_count(state);
    StateSlot *slots = arena_alloc_array(&session->text_arena, capacity, sizeof *slots);
    StateSlot *scratch = arena_alloc_array(&session->text_arena, capacity, sizeof *scratch);
    double numbers[STATE_KEY_BUFFER];
    for (StateSlot slot = 0; count < capacity && slot < state_slot_count(state); slot++)
        if (state_slot_get(state, slot).len > 0)
            slots[count++] = slot;
    state_sort_slots(state, &session->symbols, slots, scratch, count);
    for (uint32_t i = 0; i < count && !out->stopped; i++) {
        Value key = state_slot_key_in(state, slots[i], numbers);
        text_add_c(&out->text, key.len != 1 ? "$(" : "$");
        format_value(&out->text, &session->symbols, key);
        text_add_c(&out->text, key.len != 1 ? ") = " : " = ");
        format_value(&out->text, &session->symbols, state_slot_get(state, slots[i]));
        text_sink_end_line(out);
    }
}

// Writes the state to the host, to the hash, or to both, depending on the sections.
static void print_and_hash_state(TextSink *out, PetriSession *session, unsigned sections, Sha256 *hash) {
    text_sink_flush(out);
    out->hash = sections & PETRI_PRINT_HASH ? hash : NULL;
    out->muted = !(sections & PETRI_PRINT_STATE);
    print_state(out, session);
    text_sink_flush(out);
    out->hash = NULL;
    out->muted = false;
}

static void print_hash(TextSink *out, Sha256 *hash) {
    char digits[SHA256_DIGITS];
    sha256_end(hash, digits);
    text_add_c(&out->text, "= ");
    text_add(&out->text, (Str){digits, sizeof digits});
    text_sink_end_line(out);
}

static void print_digest(TextSink *out, PetriSession *session) {
    uint8_t digest[STATE_DIGEST_SIZE];
    session_digest(session, digest);
    text_add_c(&out->text, "= ");
    text_add_hex(&out->text, digest, sizeof digest);
    text_sink_end_line(out);
}

// Writes each diagnostic on a line that starts with `mark`. If `positions` is true, the line includes the position of
// the diagnostic.
static void print_lines(TextSink *out, const DiagSink *sink, const char *mark, bool positions) {
    for (uint32_t i = 0; i < sink->count && !out->stopped; i++) {
        text_add_c(&out->text, mark);
        text_add(&out->text, positions ? diag_one_line(out->text.arena, &sink->items[i]) : sink->items[i].text);
        text_sink_end_line(out);
    }
}

static void print_log(TextSink *out, PetriSession *session, unsigned sections) {
    (void)sections;
    print_lines(out, &session->frame.log, "> ", false);
}

static void print_frame(TextSink *out, PetriSession *session, unsigned sections) {
    print_header(out, &session->clock);
    if (sections & PETRI_PRINT_TREE)
        print_tree(out, session);
    Sha256 hash = sha256_new();
    if (sections & (PETRI_PRINT_STATE | PETRI_PRINT_HASH))
        print_and_hash_state(out, session, sections, &hash);
    if (sections & PETRI_PRINT_LOG)
        print_log(out, session, sections);
    if (sections & PETRI_PRINT_ERROR)
        print_lines(out, &session->frame.errors, "? ", true);
    if (sections & PETRI_PRINT_HASH)
        print_hash(out, &hash);
    if (sections & PETRI_PRINT_DIGEST)
        print_digest(out, session);
}

PetriStatus petri_print(PetriSession *session, unsigned sections, PetriWriteCallback *write, void *host) {
    if (!session || !write)
        return PETRI_INVALID;
    return text_sink_run(session, print_frame, sections, write, host);
}

PetriStatus petri_print_log(PetriSession *session, PetriWriteCallback *write, void *host) {
    if (!session || !write)
        return PETRI_INVALID;
    return text_sink_run(session, print_log, 0, write, host);
}
