// lint_angles.c: lints of angles, which are in turns: those that are written in degrees or radians; see compile.h.
//
// A whole number of 2 or more is taken for degrees; in a vector of angles, only one of 9 or more. An expression with pi
// or tau is taken for radians. An expression that divides by tau has already been converted.
#include "builtin/builtin.h"
#include "program/compile.h"
#include "schema/help.h"

#include <math.h>
#include <string.h>

// Returns the visible binding of a NAME, or NULL.
static const Binding *binding_of(const Compiler *compiler, const Ast *ast) {
    return ast->kind == AST_NAME ? compile_find_binding(compiler, ast->name) : NULL;
}

static bool is_builtin_name(const Compiler *compiler, const Ast *ast, const char *names) {
    return ast->kind == AST_NAME && str_word_number(ast->name->name, names) >= 0 && !binding_of(compiler, ast);
}

bool lint_is_whole(const Compiler *compiler, const Ast *ast, double *largest) {
    const Binding *binding = binding_of(compiler, ast);
    switch (ast->kind) {
    case AST_LITERAL:
        if (!value_is_number(ast->value) || ast->value.as.number != rint(ast->value.as.number))
            return false;
        *largest = fmax(*largest, fabs(ast->value.as.number));
        return fabs(ast->value.as.number) < 1e6; // a symbol is a huge number
    case AST_NAME:
        if (binding && binding->traits.is_whole && binding->kind == BINDING_LET)
            *largest = fmax(*largest, binding->traits.largest);
        return binding && (binding->kind == BINDING_LOOP ? binding->traits.counts : binding->traits.is_whole);
    case AST_NEG:
    case AST_POS:
        return lint_is_whole(compiler, ast->children[0], largest);
    case AST_ADD:
    case AST_SUB:
    case AST_MUL:
        return lint_is_whole(compiler, ast->children[0], largest) && lint_is_whole(compiler, ast->children[1], largest);
    default:
        return false;
    }
}

bool lint_is_count(const Compiler *compiler, const Ast *ast) {
    bool whole = ast->kind == AST_RANGE;
    double largest = 0;
    for (uint32_t i = 0; whole && i < ast->count; i += 2) // start and step; the end does not matter
        whole = !ast->children[i] || lint_is_whole(compiler, ast->children[i], &largest);
    return whole;
}

// The places at which an expression contains pi or tau.
typedef struct Circles {
    bool above; // as a factor or a term
    bool below; // as a divisor, which converts radians to turns
} Circles;

static void find_circles(const Compiler *compiler, const Ast *ast, bool divisor, Circles *found) {
    if (is_builtin_name(compiler, ast, "pi tau \u03c0 \U0001d70f")) {
        *(divisor ? &found->below : &found->above) = true;
        return;
    }
    if (ast->kind == AST_DIV || ast->kind == AST_MUL || ast->kind == AST_ADD || ast->kind == AST_SUB ||
        ast->kind == AST_NEG)
        for (uint32_t i = 0; i < ast->count; i++)
            find_circles(compiler, ast->children[i], divisor != (ast->kind == AST_DIV && i == 1), found);
}

// Returns a hint with an expression that converts an angle to turns.
static Str conversion(const Compiler *compiler, const Ast *angle, bool degrees) {
    Str text = {compiler->source->text.bytes + angle->span.start, angle->span.end - angle->span.start};
    if (degrees && angle->kind == AST_LITERAL)
        return str_format(compiler->arena, "to convert it, write %.*sdeg", STR_ARGS(text));
    bool plain = angle->kind == AST_LITERAL || angle->kind == AST_NAME;
    return str_format(compiler->arena, plain ? "to convert it, write %.*s/%s" : "to convert it, write (%.*s)/%s",
                      STR_ARGS(text), degrees ? "360" : "tau");
}

static bool is_in_turns(const SchemaRow *row) {
    const char *unit = schema_help[row - schema_rows].unit;
    return unit[0] == 't' && strcmp(unit, "turns") == 0; // most rows need no call
}

static bool has_name(const SchemaRow *row, Str node, Str attr) {
    return str_equal(attr, str_from(schema_names[row->name])) &&
           str_equal(node, str_from(schema_kinds[row->kind].name));
}

// Returns true if an attribute is in turns in all kinds of nodes with this name that have it.
static bool is_angle(Str node, Str attr) {
    bool found = false;
    for (int i = 0; i < ROW_COUNT && !found; i++)
        found = is_in_turns(&schema_rows[i]) && has_name(&schema_rows[i], node, attr);
    for (int i = 0; i < ROW_COUNT && found; i++)
        found = is_in_turns(&schema_rows[i]) || !has_name(&schema_rows[i], node, attr);
    return found;
}

// A function or attribute that takes angles.
typedef struct Taker {
    Str name;
    const Symbol *node; // node of the attribute; whether the attribute takes angles is not known yet. NULL: a function
} Taker;

// Checks one angle. A whole number counts as degrees if it is `smallest` or more. Looks for the attribute only if its
// value would be reported, because this is done for each attribute of a script.
static void check_angle(Compiler *compiler, const Ast *angle, double smallest, Taker taker) {
    Circles circles = {0};
    double largest = 0;
    bool degrees = lint_is_whole(compiler, angle, &largest) && largest >= smallest;
    find_circles(compiler, angle, false, &circles);
    if ((!degrees && (!circles.above || circles.below)) || (taker.node && !is_angle(taker.node->name, taker.name)))
        return;
    compile_report(compiler, angle->span, DIAG_WARNING, "angle-unit",
                   str_format(compiler->arena, "%.*s takes angles in turns, and this one seems to be in %s",
                              STR_ARGS(taker.name), degrees ? "degrees" : "radians"),
                   conversion(compiler, angle, degrees));
}

// Checks the angles that are the elements of a vector. If `first` is true, only the first element is an angle.
// Small whole numbers in a vector of several angles are not reported, because they are common in examples.
static void check_angles(Compiler *compiler, const Ast *angles, bool first, Taker taker) {
    enum { MIN_DEGREES = 2, MIN_OF_SEVERAL = 9 };
    if (angles->kind != AST_COMPOSE)
        check_angle(compiler, angles, MIN_DEGREES, taker);
    for (uint32_t i = 0; angles->kind == AST_COMPOSE && i < (first ? 1 : angles->count); i++)
        check_angle(compiler, angles->children[i], first ? MIN_DEGREES : MIN_OF_SEVERAL, taker);
}

void lint_call_angles(Compiler *compiler, const Ast *call) {
    static const struct {
        const char *function;
        uint32_t argument;
        bool first;
    } angles[] = {
#define ANGLE(function, argument, first) {#function, argument, first},
#include "program/angle_list.h"
    };
    const Ast *callee = call->children[0];
    for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++)
        if (is_builtin_name(compiler, callee, angles[i].function) && call->count > angles[i].argument + 1)
            check_angles(compiler, call->children[angles[i].argument + 1], angles[i].first,
                         (Taker){str_from(angles[i].function), NULL});
}

void lint_attribute_angles(Compiler *compiler, const Symbol *node, const Ast *attr) {
    check_angles(compiler, attr->children[0], false, (Taker){attr->name->name, node});
}
