// lint_nodes.c: lints of the attributes of nodes in the syntax tree; see compile.h.
//
// What lints need to know about a value is computed once, when a name is bound to it (Traits). So a chain of bindings
// is not walked again for each use of a name.
#include "builtin/builtin.h"
#include "program/compile.h"

// Returns true for a name such as `time`, whose value changes from frame to frame.
static bool is_clock(const Compiler *compiler, const Ast *ast) {
    bool is_static = true;
    return compile_find_engine_name(compiler, ast->name->name, &is_static) >= 0 && !is_static &&
           !compile_find_binding(compiler, ast->name);
}

// Returns true if the value of an expression depends on the clock.
static bool follows_clock(const Compiler *compiler, const Ast *ast) {
    arena_charge(compiler->scratch, 1);
    if (ast->kind == AST_NAME) {
        const Binding *binding = compile_find_binding(compiler, ast->name);
        return is_clock(compiler, ast) || (binding && binding->traits.follows_clock);
    }
    for (uint32_t i = 0; i < ast->count; i++)
        if (ast->children[i] && ast->kind != AST_FUNC && follows_clock(compiler, ast->children[i]))
            return true;
    return false;
}

// Returns true if a name has the same value in every frame.
static bool is_fixed_name(const Compiler *compiler, const Ast *ast) {
    const Binding *binding = compile_find_binding(compiler, ast->name);
    if (binding)
        return binding->traits.is_fixed;
    const Builtin *builtin = compile_find_builtin(compiler, ast->name->name);
    return !is_clock(compiler, ast) && (!builtin || builtin->pure);
}

bool lint_is_fixed(const Compiler *compiler, const Ast *ast) {
    arena_charge(compiler->scratch, 1);
    if (ast->kind == AST_NAME)
        return is_fixed_name(compiler, ast);
    bool fixed = ast->kind != AST_LOOKUP && ast->kind != AST_FUNC;
    for (uint32_t i = 0; fixed && i < ast->count; i++)
        fixed = !ast->children[i] || lint_is_fixed(compiler, ast->children[i]);
    return fixed;
}

Traits lint_traits(const Compiler *compiler, const Ast *value) {
    double largest = 0;
    bool is_fixed = lint_is_fixed(compiler, value), is_whole = lint_is_whole(compiler, value, &largest);
    return (Traits){.is_whole = is_whole,
                    .largest = largest,
                    .is_fixed = is_fixed,
                    .follows_clock = !is_fixed && follows_clock(compiler, value),
                    .counts = lint_is_count(compiler, value)};
}

static const Ast *find_attr(const Ast *decorate, Str name) {
    for (uint32_t i = 1; i < decorate->count; i++)
        if (decorate->children[i]->kind == AST_ATTR && str_equal(decorate->children[i]->name->name, name))
            return decorate->children[i];
    return NULL;
}

// Returns true if a system may start later than in the first frame, or several times.
static bool can_restart(const Compiler *compiler, const Ast *physics) {
    const Ast *time = find_attr(physics, STR("time")), *dimensions = find_attr(physics, STR("dimensions"));
    const Ast *clock = time ? time->children[0] : NULL;
    return find_attr(physics, STR("run")) || (clock && (clock->kind != AST_NAME || !is_clock(compiler, clock))) ||
           (dimensions && !lint_is_fixed(compiler, dimensions->children[0]));
}

// Records whether the particle or anchor may be absent from some frames.
static void note_id(Compiler *compiler, const Ast *particle) {
    const Ast *id = find_attr(particle, STR("id"));
    if (!id || compiler->varies > 0 || !lint_is_fixed(compiler, id->children[0]))
        compiler->keys.ids_change = true;
}

// Warns about the start of a particle that exists in every frame, if the start changes with the clock.
static void lint_start(Compiler *compiler, const Ast *particle, Str name) {
    const Ast *start = find_attr(particle, name), *id = find_attr(particle, STR("id"));
    if (!start || !id || compiler->varies > 0 || compiler->restarts || !lint_is_fixed(compiler, id->children[0]) ||
        !follows_clock(compiler, start->children[0]))
        return;
    compile_report(compiler, start->span, DIAG_WARNING, "changing-start",
                   str_format(compiler->arena, "the %.*s of a !particle is only its start; later values are ignored",
                              STR_ARGS(name)),
                   STR("to move it with the clock, write !anchor instead of !particle"));
}

// Warns about a longest step of several frames if the clock of the system counts frames. For other clocks,
// lib/scene checks the step, because their rate is not known here.
static void lint_step(Compiler *compiler, const Ast *physics) {
    const Ast *time = find_attr(physics, STR("time")), *step = find_attr(physics, STR("resolution"));
    const Ast *clock = time ? time->children[0] : NULL, *value = step ? step->children[0] : NULL;
    if (!clock || clock->kind != AST_NAME || !str_equal(clock->name->name, STR("frame")) ||
        !is_clock(compiler, clock) || !value || value->kind != AST_LITERAL || !value_is_number(value->value) ||
        !(value->value.as.number >= 2))
        return;
    Str text = {compiler->source->text.bytes + value->span.start, value->span.end - value->span.start};
    compile_report(compiler, step->span, DIAG_WARNING, "long-resolution",
                   STR("resolution is the longest time step, and a step is never longer than a frame"),
                   str_format(compiler->arena, "for %.*s steps per frame, write resolution=1/%.*s", STR_ARGS(text),
                              STR_ARGS(text)));
}

static bool is_same(const Ast *a, const Ast *b) {
    if (a->kind != b->kind || a->count > 0)
        return false;
    return a->kind == AST_NAME ? a->name == b->name : a->kind == AST_LITERAL && value_equal(NULL, a->value, b->value);
}

// Warns about a force between a particle and itself.
static void lint_ends(Compiler *compiler, const Ast *distance) {
    const Ast *from = find_attr(distance, STR("from")), *to = find_attr(distance, STR("to"));
    if (from && to && is_same(from->children[0], to->children[0]))
        compile_report(compiler, to->span, DIAG_WARNING, "self-distance",
                       STR("the force has the same particle at both ends, so it does nothing"),
                       STR("give 'to' the id of another particle"));
}

void lint_node(Compiler *compiler, const Ast *decorate) {
    const Ast *subject = decorate->children[0];
    if (subject->kind != AST_NODE)
        return;
    Str kind = subject->name->name;
    if (str_equal(kind, STR("physics"))) {
        lint_step(compiler, decorate);
        compiler->restarts = compiler->restarts || can_restart(compiler, decorate);
    }
    if (str_equal(kind, STR("particle")) || str_equal(kind, STR("anchor")))
        note_id(compiler, decorate);
    if (str_equal(kind, STR("particle"))) {
        lint_start(compiler, decorate, STR("position"));
        lint_start(compiler, decorate, STR("velocity"));
    }
    if (str_equal(kind, STR("distance")))
        lint_ends(compiler, decorate);
    for (uint32_t i = 1; i < decorate->count; i++)
        if (decorate->children[i]->kind == AST_ATTR)
            lint_attribute_angles(compiler, subject->name, decorate->children[i]);
}
