// state_lint.c: reports of state lookups that can never find anything.
//
// They are checked after the first frame, when the state has the keys of all systems, with the lookups of that frame
// (LookupLog). A lookup is reported only if nothing that comes later can set its key: no other part of the script has
// the symbol with which the key begins, or all
// systems have the same particles in each frame.
#include "session/session.h"
#include "value/format.h"

#include <string.h>

typedef struct StateLint {
    PetriSession *session;
    const KeyUses *keys;
    Arena *arena;
} StateLint;

static void report_unread_key(const StateLint *lint, Origin at, const char *code, Str text, Str hint) {
    session_report(lint->session, &(Diag){DIAG_WARNING, at, text, .hint = hint, .code = code});
}

static bool is_tested_key(const KeyUses *keys, const Origin *at) {
    for (uint32_t i = 0; i < keys->tested_count; i++)
        if (keys->tested[i].source == at->source && keys->tested[i].span.start == at->span.start &&
            keys->tested[i].span.end == at->span.end)
            return true;
    return false;
}

static bool occurs_elsewhere(const KeyUses *keys, double symbol) {
    bool found = keys->incomplete;
    for (uint32_t i = 0; !found && i < keys->symbol_count; i++)
        found = keys->symbols[i] == symbol;
    return found;
}

// Returns the first element of a key if it is a symbol, else NULL.
static const Symbol *first_symbol(const StateLint *lint, Value key) {
    if (key.len == 0 || value_at(&key, 0).type != ITEM_NUMBER)
        return NULL;
    return symbol_of_number(&lint->session->symbols, value_at(&key, 0).as.number);
}

static bool starts_with(Value key, Value prefix) {
    for (uint32_t i = 0; i < prefix.len; i++)
        if (i == key.len || !value_equal(NULL, value_element(key, i), value_element(prefix, i)))
            return false;
    return true;
}

// Returns true if none of the keys of a place is in the state now. The keys of particles are there from the first frame
// on, even if they do not have a value yet.
static bool all_missing(const StateLint *lint, const MissedLookup *place) {
    for (uint32_t i = 0; i < place->count && i < LOOKUP_LOG_KEYS; i++)
        if (!state_key_valid(place->keys[i]) || state_find(lint->session->state, place->keys[i]) != STATE_NO_SLOT ||
            first_symbol(lint, place->keys[i]) != first_symbol(lint, place->keys[0]))
            return false;
    return true;
}

// Searches the state for keys that begin with a symbol. Returns true if there are any. Otherwise sets *nearest to the
// most similar symbol with which a key begins, or to an empty string.
static bool is_set(const StateLint *lint, const Symbol *symbol, Str *nearest) {
    State *state = lint->session->state;
    double buffer[STATE_KEY_BUFFER];
    const Symbol *last = NULL;
    Value key, value;
    StrNearest names = str_nearest(symbol->name);
    arena_charge(lint->arena, state_slot_count(state) / 4);
    for (uint32_t cursor = 0; state_next(state, &cursor, &key, &value, buffer);) {
        const Symbol *first = first_symbol(lint, key);
        if (first == symbol)
            return true;
        if (first && first != last)
            str_try_nearest(&names, first->name);
        last = first;
    }
    if (state_clear_exhausted(state))
        arena_exhausted(lint->arena);
    *nearest = names.found;
    return false;
}

static void lint_prefix(const StateLint *lint, const MissedLookup *place, const Symbol *symbol) {
    Str nearest;
    SceneView view;
    if (occurs_elsewhere(lint->keys, symbol->number) || is_set(lint, symbol, &nearest))
        return;
    bool has_system = scene_view(lint->session->scene, lint->session->state, 0, &view);
    Str hint = nearest.len  ? str_format(lint->arena, "did you mean ':%.*s'?", STR_ARGS(nearest))
               : has_system ? str_format(lint->arena, "the particles of the first !physics are in $(%s;id)",
                                         format_text(lint->arena, &lint->session->symbols, view.prefix).bytes)
                            : str_format(lint->arena, "give a !physics or a !counter the attribute state=:%.*s",
                                         STR_ARGS(symbol->name));
    report_unread_key(
        lint, *place->at, "unknown-state",
        str_format(lint->arena, "nothing sets the state :%.*s, so this lookup is always null", STR_ARGS(symbol->name)),
        hint);
}

// Returns a hint with an id of the system: the most similar one, else the first.
static Str id_hint(const StateLint *lint, const SceneView *view, Value id) {
    enum { MAX_IDS = 256 };
    const SymbolTable *symbols = &lint->session->symbols;
    if (view->particle_count == 0)
        return STR("it has no particles");
    Str first = format_text(lint->arena, symbols, scene_view_id(lint->arena, lint->session->state, view, 0));
    StrNearest nearest = str_nearest(format_text(lint->arena, symbols, id));
    arena_charge(lint->arena, MAX_IDS);
    for (uint32_t i = 0; first_symbol(lint, id) && i < view->particle_count && i < MAX_IDS; i++)
        str_try_nearest(&nearest,
                        format_text(lint->arena, symbols, scene_view_id(lint->arena, lint->session->state, view, i)));
    Str prefix = format_text(lint->arena, symbols, view->prefix);
    return str_format(lint->arena,
                      nearest.found.len ? "did you mean $(%.*s;%.*s)?" : "its first particle is $(%.*s;%.*s)",
                      STR_ARGS(prefix), STR_ARGS(nearest.found.len ? nearest.found : first));
}

static void lint_id(const StateLint *lint, const MissedLookup *place, const SceneView *view) {
    const SymbolTable *symbols = &lint->session->symbols;
    if (place->count > LOOKUP_LOG_KEYS || lint->keys->ids_change || lint->keys->incomplete)
        return;
    for (uint32_t i = 0; i < place->count; i++)
        if (!starts_with(place->keys[i], view->prefix))
            return;
    Value key = place->keys[0], id = value_slice(lint->arena, key, view->prefix.len, key.len - view->prefix.len);
    report_unread_key(lint, *place->at, "unknown-id",
                      str_format(lint->arena, "no particle of %s has the id %s, so this lookup is always null",
                                 format_text(lint->arena, symbols, view->prefix).bytes,
                                 format_text(lint->arena, symbols, id).bytes),
                      id_hint(lint, view, id));
}

static void lint_lookup(const StateLint *lint, const MissedLookup *place) {
    const Symbol *symbol = first_symbol(lint, place->keys[0]);
    SceneView view;
    if (!symbol || is_tested_key(lint->keys, place->at) || !all_missing(lint, place))
        return;
    for (size_t i = 0; scene_view(lint->session->scene, lint->session->state, i, &view); i++)
        if (starts_with(place->keys[0], view.prefix)) {
            lint_id(lint, place, &view);
            return;
        }
    lint_prefix(lint, place, symbol);
}

// Reports `$:s;0` where :s is the state of a system.
static void lint_loose_key(const StateLint *lint, const LooseKey *key) {
    SceneView view;
    const char *text = key->origin.source->text.bytes + key->origin.span.start;
    for (size_t i = 0; scene_view(lint->session->scene, lint->session->state, i, &view); i++)
        if (view.prefix.len == 1 && value_at(&view.prefix, 0).type == ITEM_NUMBER &&
            value_at(&view.prefix, 0).as.number == key->symbol) {
            report_unread_key(lint, key->origin, "loose-key",
                              STR("without parentheses, only the part before the semicolon is a key of the state"),
                              str_format(lint->arena, "write $(%.*s)",
                                         (int)(key->origin.span.end - key->origin.span.start - 1), text + 1));
            return;
        }
}

PetriStatus session_lint_state(PetriSession *session, void *context) {
    const LookupLog *log = context;
    const KeyUses *keys = session->config.program->program->keys;
    StateLint lint = {session, keys, &session->frame.systems_arena};
    for (uint32_t i = 0; i < keys->loose_count; i++)
        lint_loose_key(&lint, &keys->loose[i]);
    for (uint32_t i = 0; i < log->count; i++)
        lint_lookup(&lint, &log->places[i]);
    return PETRI_OK;
}
