// memory.c: arenas, units, lists of statements and the results of a frame, as memory that a session owns.
#include "base/heap.h"
#include "builtin/files.h"
#include "session/session.h"

#include <string.h>

void session_arena(PetriSession *session, Arena *arena, const char *name, size_t limit) {
    arena_init(arena, name, limit);
    arena->budget = &session->budget;
}

// --- units

Unit *unit_new(PetriSession *session) {
    Unit *unit = heap_calloc(1, sizeof *unit);
    if (!unit)
        arena_exhausted(&session->arena);
    unit->references = 1;
    session_arena(session, &unit->arena, "program", SIZE_MAX);
    session_arena(session, &unit->scratch, "compiler", SIZE_MAX);
    unit_arena(session, unit);
    return unit;
}

Arena *unit_arena(const PetriSession *session, Unit *unit) {
    unit->arena.escape = unit->scratch.escape = session->arena.escape;
    return &unit->arena;
}

void unit_free(Unit *unit) {
    if (!unit || --unit->references > 0)
        return;
    diag_sink_free(&unit->parse_sink);
    diag_sink_free(&unit->sink);
    arena_free(&unit->scratch);
    arena_free(&unit->arena);
    unit_free(unit->parse_cache);
    unit_free(unit->last_good);
    heap_free(unit);
}

static Unit **chain_of(PetriSession *session, Str path) {
    return &session->loader.by_path[(hash_bytes(0, path.bytes, path.len) >> 32) % MODULE_CHAINS];
}

void session_add_module(PetriSession *session, Unit *unit) {
    Unit **first = chain_of(session, unit->path);
    unit->same_hash = *first;
    *first = unit;
}

Unit *session_find_module(PetriSession *session, Str path) {
    Unit *unit = *chain_of(session, path);
    while (unit && (unit->retired || !str_equal(unit->path, path)))
        unit = unit->same_hash;
    return unit;
}

Unit *session_use_unit(PetriSession *session, Unit *unit) {
    session->loader.generation++;
    return unit;
}

void session_clear_files(PetriSession *session) {
    file_cache_clear(session->files);
    for (Unit *unit = session->loader.modules; unit; unit = unit->next)
        unit->retired = true;
}

static void free_retired(PetriSession *session) {
    bool any = false;
    for (Unit **link = &session->loader.modules; *link;) {
        Unit *unit = *link;
        if (!unit->retired) {
            link = &unit->next;
            continue;
        }
        *link = unit->next;
        unit_free(unit);
        any = true;
    }
    if (!any)
        return;
    memset(session->loader.by_path, 0, sizeof session->loader.by_path);
    for (Unit *unit = session->loader.modules; unit; unit = unit->next)
        session_add_module(session, unit);
}

// --- lists of statements

// Allocates a list for `count` statements. Its names are those in `before`, then the exports of a program (NULL: none).
static PromptList *make_list(Names before, uint32_t count, const Program *program) {
    uint32_t old = before.count, more = program ? program->export_count : 0;
    PromptList *list = heap_alloc(sizeof *list + count * sizeof *list->statements + (old + more) * sizeof(Symbol *));
    if (!list)
        return NULL;
    const Symbol **names = (const Symbol **)(void *)(list->statements + count);
    for (uint32_t i = 0; i < old; i++)
        names[i] = before.items[i];
    for (uint32_t i = 0; i < more; i++)
        names[old + i] = program->exports[i].name;
    list->references = 1;
    list->count = count;
    list->names = (Names){names, old + more};
    return list;
}

PromptList *prompt_list_new(Names host_names, const Program *script) {
    return make_list((Names){host_names.items, script ? script->param_count : 0}, 0, script);
}

PromptList *prompt_list_add(const PromptList *before, const PromptStatement *statement) {
    PromptList *list = make_list(before->names, before->count + 1, statement->program);
    if (!list)
        return NULL;
    for (uint32_t i = 0; i < before->count; i++)
        list->statements[i] = before->statements[i];
    list->statements[before->count] = *statement;
    for (uint32_t i = 0; i < list->count; i++)
        list->statements[i].unit->references++;
    return list;
}

void prompt_list_free(PromptList *list) {
    if (!list || --list->references > 0)
        return;
    for (uint32_t i = 0; i < list->count; i++)
        unit_free(list->statements[i].unit);
    heap_free(list);
}

// --- results of a frame

void session_clear_frame(PetriSession *session) {
    SessionFrame *frame = &session->frame;
    frame->tree = VALUE_NULL;
    frame->evaluated = frame->names_current = false;
    frame->values = NULL;
    frame->value_count = 0;
    frame->system_names = NULL;
    frame->system_name_count = 0;
    diag_sink_free(&frame->log);
    diag_sink_free(&frame->errors);
    arena_reset(&frame->arena);
    arena_reset(&frame->systems_arena);
    arena_reset(&session->text_arena);
    arena_reset(&session->view_arena);
    phys_explanation_free(&session->explanation);
    scene_forget_origins(session->scene);
    free_retired(session);
}

void session_drop_frame(PetriSession *session) {
    session_clear_frame(session);
    arena_free(&session->frame.arena);
    arena_free(&session->frame.systems_arena);
}
