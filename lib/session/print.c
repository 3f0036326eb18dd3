// print.c: frames as text (spec cli.md 3.3).
#include "session/session.h"

#include "base/number.h"
#include "base/sha256.h"
#include "syntax/parse.h"
#include "value/format.h"

#include <string.h>

// Text on its way to the host, handed over in pieces.
typedef struct Output {
    Text text;
    PetriWrite *write;
    void *host;
    bool stopped;
    Sha256 *hash; // takes the text as well, or NULL
    bool hidden;  // from the host
} Output;

enum { PIECE = 64 << 10 };

static Output output_new(PetriSession *session, PetriWrite *write, void *host) {
    arena_reset(&session->text_arena);
    return (Output){.text = text_new(&session->text_arena), .write = write, .host = host};
}

static void output_flush(Output *out) {
    if (out->hash)
        sha256_add(out->hash, out->text.bytes, out->text.len);
    if (out->text.len && !out->stopped && !out->hidden)
        out->stopped = !out->write(out->host, out->text.bytes, out->text.len);
    out->text.len = 0;
}

static void output_line_end(Output *out) {
    text_add_char(&out->text, '\n');
    if (out->text.len >= PIECE)
        output_flush(out);
}

static PetriStatus output_finish(Output *out) {
    output_flush(out);
    return out->stopped ? PETRI_INVALID : PETRI_OK;
}

static void add_number(Text *out, double x) {
    char digits[NUMBER_TEXT];
    text_add(out, (Str){digits, number_format(x, digits)});
}

static void print_header(Output *out, const Clock *clock) {
    text_add_format(&out->text, "@%lld time=", (long long)clock->number);
    add_number(&out->text, clock->time);
    text_add_c(&out->text, " beat=");
    add_number(&out->text, clock->beat);
    output_line_end(out);
}

static void print_tree(Output *out, PetriSession *session) {
    Value tree = session->frame.tree;
    for (uint32_t i = 0; tree.kind == VALUE_MIXED && i < tree.len && !out->stopped; i++)
        if (tree.as.items[i].type == ITEM_NODE) {
            format_tree(&out->text, &session->symbols, tree.as.items[i].as.node, 0);
            if (out->text.len >= PIECE)
                output_flush(out);
        }
}

typedef struct Entry {
    Value key;
    Value value;
} Entry;

// Merge sort: stable, and unlike qsort it can be given the symbol table that the order needs.
static void sort_entries(Entry *entries, Entry *scratch, uint32_t count, const SymbolTable *symbols) {
    if (count < 2)
        return;
    uint32_t half = count / 2;
    sort_entries(entries, scratch, half, symbols);
    sort_entries(entries + half, scratch, count - half, symbols);
    memcpy(scratch, entries, half * sizeof *entries);
    for (uint32_t left = 0, right = half, to = 0; left < half; to++) {
        if (right < count && format_key_compare(symbols, entries[right].key, scratch[left].key) < 0)
            entries[to] = entries[right++];
        else
            entries[to] = scratch[left++];
    }
}

static void print_state(Output *out, PetriSession *session) {
    uint32_t count = 0, room = state_count(session->state), cursor = 0;
    Entry *entries = arena_alloc_array(&session->text_arena, room, sizeof *entries);
    Entry *scratch = arena_alloc_array(&session->text_arena, room, sizeof *scratch);
    while (count < room && state_next(session->state, &cursor, &entries[count].key, &entries[count].value))
        count++;
    sort_entries(entries, scratch, count, &session->symbols);
    for (uint32_t i = 0; i < count && !out->stopped; i++) {
        bool several = entries[i].key.len != 1;
        text_add_c(&out->text, several ? "$(" : "$");
        format_value(&out->text, &session->symbols, entries[i].key);
        text_add_c(&out->text, several ? ") = " : " = ");
        format_value(&out->text, &session->symbols, entries[i].value);
        output_line_end(out);
    }
}

// The state goes to the host if that is asked for, and into the hash if that is.
static void print_and_hash_state(Output *out, PetriSession *session, unsigned sections, Sha256 *hash) {
    output_flush(out);
    out->hash = sections & PETRI_PRINT_HASH ? hash : NULL;
    out->hidden = !(sections & PETRI_PRINT_STATE);
    print_state(out, session);
    output_flush(out);
    out->hash = NULL;
    out->hidden = false;
}

static void print_hash(Output *out, Sha256 *hash) {
    char digits[SHA256_DIGITS];
    sha256_end(hash, digits);
    text_add_c(&out->text, "= ");
    text_add(&out->text, (Str){digits, sizeof digits});
    output_line_end(out);
}

// Each text on its line.
static void print_lines(Output *out, const DiagSink *sink, const char *mark, bool places) {
    for (uint32_t i = 0; i < sink->count && !out->stopped; i++) {
        text_add_c(&out->text, mark);
        text_add(&out->text, places ? diag_one_line(out->text.arena, &sink->items[i]) : sink->items[i].text);
        output_line_end(out);
    }
}

// One of the texts of a session on its way.
typedef struct Printing {
    void (*print)(Output *out, PetriSession *session, unsigned what);
    unsigned what;
    PetriWrite *write;
    void *host;
    PetriStatus status;
} Printing;

static void print(PetriSession *session, void *context) {
    Printing *printing = context;
    Output out = output_new(session, printing->write, printing->host);
    printing->print(&out, session, printing->what);
    printing->status = output_finish(&out);
}

static PetriStatus print_protected(PetriSession *session, Printing printing) {
    PetriStatus status = session_protect(session, NULL, print, &printing);
    return status == PETRI_OK ? printing.status : status;
}

static void print_log(Output *out, PetriSession *session, unsigned sections) {
    (void)sections;
    print_lines(out, &session->frame.log, "> ", false);
}

static void print_frame(Output *out, PetriSession *session, unsigned sections) {
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
}

PetriStatus petri_print(PetriSession *session, unsigned sections, PetriWrite *write, void *host) {
    if (!session || !write)
        return PETRI_INVALID;
    return print_protected(session, (Printing){print_frame, sections, write, host, PETRI_OK});
}

PetriStatus petri_print_log(PetriSession *session, PetriWrite *write, void *host) {
    if (!session || !write)
        return PETRI_INVALID;
    return print_protected(session, (Printing){print_log, 0, write, host, PETRI_OK});
}

static void print_code(Output *out, PetriSession *session, unsigned what) {
    const Unit *unit = session->config.program;
    if (what == PETRI_DUMP_CODE) {
        program_print(&out->text, &session->symbols, unit->program);
    } else { // the tree was dropped when the program was compiled
        DiagSink nowhere = diag_sink_new(out->text.arena, 0);
        const Ast *ast = parse_program(out->text.arena, &session->symbols, unit->source, &nowhere);
        ast_print(&out->text, &session->symbols, unit->source, ast);
        diag_sink_free(&nowhere);
    }
}

PetriStatus petri_dump(PetriSession *session, PetriDump what, PetriWrite *write, void *host) {
    if (!session || !write || !session->config.program)
        return PETRI_INVALID;
    return print_protected(session, (Printing){print_code, what, write, host, PETRI_OK});
}
