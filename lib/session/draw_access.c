// draw_access.c: implementation of draw_access.h.
#include "session/session.h"

#include <string.h>

DrawAccess session_draw_access(PetriSession *session) {
    const Unit *program = session->config.program;
    return (DrawAccess){.number = program ? session->clock.number : -1,
                        .beat = session->clock.beat,
                        .tree = session->frame.tree,
                        .schema = &session->schema,
                        .scene = session->scene,
                        .state = session->state,
                        .directory = program ? program->source->directory : STR(""),
                        .reach = &session->reach,
                        .memory_limit = session->options.memory_limit,
                        .samples = session->vm.builtins.pictures && session->vm.builtins.pictures->samples,
                        .budget = &session->budget};
}

void session_set_pictures(PetriSession *session, BuiltinPictures *pictures) {
    session->vm.builtins.pictures = pictures;
}

uint32_t session_frame_numbers(PetriSession *session, Arena *arena, const char *names[], double numbers[],
                               uint32_t capacity) {
    static const char *const all[] = {
#define ENGINE_NAME(id, text, is_static) text,
#include "program/engine_names.h"
#undef ENGINE_NAME
    };
    uint32_t count = 0;
    for (uint32_t i = 0; i < sizeof all / sizeof *all && count < capacity; i++) {
        Value v = session->vm.globals[i];
        if (v.kind != VALUE_NUMBERS || v.len != 1)
            continue;
        names[count] = all[i];
        numbers[count++] = v.as.number;
    }
    for (uint32_t i = 0; i < session->config.define_count && count < capacity; i++) {
        const Define *define = &session->config.defines[i];
        if (define->value.kind != VALUE_NUMBERS || define->value.len != 1)
            continue;
        names[count] = str_to_c(arena, define->name->name);
        numbers[count++] = define->value.as.number;
    }
    return count;
}

void session_add_work(PetriSession *session, uint64_t work) {
    session->total_work += work;
}

bool session_has_source(const PetriSession *session, const Diag *diag) {
    const Unit *program = session->config.program;
    for (const Unit *unit = program; unit; unit = unit == program ? session->loader.modules : unit->next)
        for (const Unit *version = unit; version; version = version->last_good)
            if (version->source == diag->at.source && diag->at.source)
                return diag->at.span.end <= diag->at.source->text.len;
    return false;
}

bool petri_has_picture(PetriSession *session) {
    if (!session)
        return false;
    const Node *window;
    SceneView view;
    for (uint32_t at = 0; (window = canvas_next_window(&session->schema, session->frame.tree, &at));)
        if (canvas_window_has_picture(&session->schema, window))
            return true;
    return scene_view(session->scene, session->state, 0, &view);
}

void *session_draw_memory(PetriSession *session, size_t size) {
    if (!session->draw_memory) {
        session->draw_memory = memset(arena_alloc(&session->arena, size), 0, size);
        session->draw_memory_size = size;
    }
    return session->draw_memory;
}
