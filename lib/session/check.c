// check.c: what can be said of a script without running it, and of the nodes at the top of its first frame.
#include "session/session.h"

#include <string.h>

// Any node may stand at the top, and means nothing there; one that is nearly spelled like one that does is a mistake.
// Empty if this is none.
static Str nearly(Str kind) {
    StrNearest nearest = {.wanted = kind, .limit = (int)kind.len < 6 ? (int)kind.len / 3 + 1 : 3};
    for (int i = 0; i < KIND_COUNT && nearest.limit > 0; i++)
        if (schema_kinds[i].place == PLACE_SCENE || schema_kinds[i].place == PLACE_TOP)
            str_try_nearest(&nearest, str_from(schema_kinds[i].name));
    return nearest.limit > 0 ? nearest.found : (Str){0};
}

void session_look_at_top(PetriSession *session) {
    const Symbol *last = NULL; // a loop makes many of a kind
    for (uint32_t i = 0; session->frame.tree.kind == VALUE_MIXED && i < session->frame.tree.len; i++) {
        const Item *item = &session->frame.tree.as.items[i];
        if (item->type != ITEM_NODE || item->as.node->kind == last)
            continue;
        last = item->as.node->kind;
        Str kind = last->name, nearest = nearly(kind);
        if (!nearest.len)
            continue;
        Origin place = node_place(item->as.node, NULL);
        session_tell(
            session,
            &(Diag){.level = DIAG_WARNING,
                    .source = place.source,
                    .span = place.span,
                    .text = str_format(&session->frame.systems_arena, "'!%.*s' does nothing", STR_ARGS(kind)),
                    .hint = str_format(&session->frame.systems_arena, "did you mean '!%.*s'?", STR_ARGS(nearest)),
                    .code = "unknown-node"});
    }
}

// Reads all windows, as if they were to be drawn.
static void look_at_windows(PetriSession *session, void *context) {
    const Node *window;
    (void)context;
    for (uint32_t at = 0; (window = canvas_next_window(&session->schema, session->frame.tree, &at)) != NULL;)
        canvas_read(&session->schema, &session->frame.systems_arena, window);
}

// What the scratch session has to say. Its stages each see the whole script; people read it from top to bottom.
typedef struct Heard {
    PetriSession *scratch;
    Arena arena;
    PetriDiagnostic *items;
    size_t count;
    bool lost; // something, for want of memory
} Heard;

static const char *keep(Heard *heard, const char *text) {
    return text ? str_to_c(&heard->arena, str_from(text)) : NULL;
}

typedef struct Hearing {
    Heard *heard;
    const PetriDiagnostic *diagnostic;
} Hearing;

static void add_heard(void *context) {
    const Hearing *hearing = context;
    Heard *heard = hearing->heard;
    size_t size = heard->count * sizeof *heard->items;
    heard->items = arena_grow(&heard->arena, heard->items, size, size + sizeof *heard->items);
    PetriDiagnostic *item = &heard->items[heard->count];
    *item = *hearing->diagnostic;
    item->file = keep(heard, item->file);
    item->text = keep(heard, item->text);
    item->code = keep(heard, item->code);
    item->rendered = keep(heard, item->rendered);
    item->hint = keep(heard, item->hint);
    heard->count++;
}

static void hear(void *host, const PetriDiagnostic *diagnostic) {
    Heard *heard = host;
    Arena *arena = &heard->arena;
    if (diagnostic->code && strcmp(diagnostic->code, "undrawn-node") == 0)
        return; // the script is right, petri shows less of it
    Hearing hearing = {heard, diagnostic};
    heard->lost |= arena_protect(&arena, 1, add_heard, &hearing) != ARENA_DONE;
}

static bool comes_before(const PetriDiagnostic *a, const PetriDiagnostic *b) {
    return a->file && b->file && strcmp(a->file, b->file) == 0 &&
           (a->line < b->line || (a->line == b->line && a->column < b->column));
}

// In the order of the text, as far as they are of one file.
static void tell_in_order(PetriSession *session, Heard *heard) {
    for (size_t i = 0; i < heard->count; i++) {
        PetriDiagnostic item = heard->items[i];
        size_t at = i;
        for (; at > 0 && comes_before(&item, &heard->items[at - 1]); at--)
            heard->items[at] = heard->items[at - 1];
        heard->items[at] = item;
    }
    for (size_t i = 0; i < heard->count; i++)
        diagnostics_pass_on(session, &heard->items[i]);
}

static void open_scratch(PetriSession *session, Heard *heard) {
    PetriOptions options = session->options;
    options.realtime = options.profile = options.interruptible = options.keep_forces = false;
    options.threads = 1;
    options.diagnostic = hear;
    options.host = heard;
    heard->scratch = petri_open(&options);
    if (heard->scratch)
        heard->scratch->reach = session->reach; // whose lists outlive it
    if (heard->scratch)
        session_copy_given(session, heard->scratch);
    if (heard->scratch)
        heard->scratch->functions = session->functions;
    for (uint32_t i = 0; heard->scratch && i < session->config.define_count; i++)
        if (petri_define(heard->scratch, session->config.defines[i].text) == PETRI_MEMORY)
            petri_close(&heard->scratch);
}

static PetriStatus look_over(PetriSession *scratch, const char *file, const char *text, size_t length) {
    scratch->loader.lint = scratch->schema.lint = true;
    PetriStatus status = text ? petri_load_text(scratch, file, text, length) : petri_load(scratch, file);
    scratch->loader.lint = false; // modules, which the frame loads, are checked for themselves
    if (status == PETRI_OK)
        status = petri_step(scratch);
    if (status == PETRI_OK)
        status = session_tell_end(scratch, session_protect(scratch, NULL, look_at_windows, NULL), "the check");
    return status;
}

// A file, or a text of this name.
static PetriStatus check(PetriSession *session, const char *file, const char *text, size_t length) {
    Heard heard = {0};
    PetriStatus status = PETRI_MEMORY;
    arena_init(&heard.arena, "check", SIZE_MAX);
    open_scratch(session, &heard);
    bool told = heard.scratch != NULL;
    if (told)
        status = look_over(heard.scratch, file, text, length);
    petri_close(&heard.scratch);
    tell_in_order(session, &heard);
    arena_free(&heard.arena);
    return heard.lost || !told ? session_tell_end(session, PETRI_MEMORY, "the check") : status;
}

PetriStatus petri_check(PetriSession *session, const char *file) {
    if (!session || !file)
        return PETRI_INVALID;
    return check(session, file, NULL, 0);
}

PetriStatus petri_check_text(PetriSession *session, const char *name, const char *text, size_t length) {
    if (!session || !name || !text)
        return PETRI_INVALID;
    return check(session, name, text, length);
}
