// print.c: output of frames and compiled code as text (spec cli.md 3.3).
#include "base/number.h"
#include "session/session.h"
#include "syntax/parse.h"
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
    for (int i = 0; i < STATE_DIGEST_SIZE; i++)
        text_add_format(&out->text, "%02x", digest[i]);
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

// Arguments and result of a public output function, such as petri_print.
typedef struct Printing {
    void (*print)(TextSink *out, PetriSession *session, unsigned what);
    unsigned selection; // sections of petri_print, or the PetriDump of petri_dump
    PetriWriteCallback *write;
    void *user_data;
    PetriStatus status;
} Printing;

static PetriStatus run_print(PetriSession *session, void *context) {
    Printing *printing = context;
    arena_reset(&session->text_arena);
    TextSink out = {.text = text_new(&session->text_arena), .write = printing->write, .user_data = printing->user_data};
    printing->print(&out, session, printing->selection);
    text_sink_flush(&out);
    printing->status = text_sink_finish(session, &out); // not returned, because it is reported already
    return PETRI_OK;
}

static PetriStatus print_protected(PetriSession *session, Printing printing) {
    PetriStatus status = session_protect(session, NULL, run_print, &printing);
    return status == PETRI_OK ? printing.status : session_report_abort(session, status, "the output");
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
    return print_protected(session, (Printing){print_frame, sections, write, host, PETRI_OK});
}

PetriStatus petri_print_log(PetriSession *session, PetriWriteCallback *write, void *host) {
    if (!session || !write)
        return PETRI_INVALID;
    return print_protected(session, (Printing){print_log, 0, write, host, PETRI_OK});
}

static void print_code(TextSink *out, PetriSession *session, unsigned what) {
    const Unit *unit = session->config.program;
    if (what == PETRI_DUMP_CODE) {
        program_print(&out->text, &session->symbols, unit->program);
    } else { // parses the text again, because the syntax tree was freed after compilation
        DiagSink discarded = diag_sink_new(out->text.arena, 0);
        const Ast *ast = parse_program(out->text.arena, &session->symbols, unit->source, &discarded);
        ast_print(&out->text, &session->symbols, unit->source, ast);
        diag_sink_free(&discarded);
    }
}

PetriStatus petri_dump(PetriSession *session, PetriDump what, PetriWriteCallback *write, void *host) {
    if (!session || !write || !session->config.program)
        return PETRI_INVALID;
    return print_protected(session, (Printing){print_code, what, write, host, PETRI_OK});
}
