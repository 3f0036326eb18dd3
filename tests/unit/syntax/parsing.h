// parsing.h: helpers that parse a script and return its syntax tree or errors as a string.
#pragma once

#include "syntax/parse.h"
#include "values.h"

typedef struct Parsed {
    const Source *source;
    const Ast *ast; // NULL: the script was rejected
    DiagSink diags;
} Parsed;

// The caller frees parsed.diags with diag_sink_free.
static inline Parsed parse_str(World *world, Str text) {
    Parsed parsed = {.source = source_new(&world->arena, STR("t.fl"), STR("t.fl"), text),
                     .diags = diag_sink_new(&world->arena, 50)};
    parsed.ast = parse_program(&world->arena, &world->symbols, parsed.source, &parsed.diags);
    return parsed;
}

static inline bool accepts_str(World *world, Str text) {
    Parsed parsed = parse_str(world, text);
    bool accepted = parsed.ast != NULL;
    assert_true(accepted == (parsed.diags.error_count == 0)); // exactly the rejected programs have errors
    diag_sink_free(&parsed.diags);
    return accepted;
}

static inline bool accepts(World *world, const char *text) {
    return accepts_str(world, str_from(text));
}

// Appends a tree on one line as `(kind name child child)`. Literals are written as petri prints their values; missing
// children are `_`.
static inline void add_shape(World *world, Text *out, const Ast *ast) {
    if (!ast) {
        text_add_c(out, "_");
        return;
    }
    if (ast->kind == AST_LITERAL) {
        format_value(out, &world->symbols, ast->value);
        return;
    }
    bool bare = ast->kind == AST_NAME && ast->count == 0;
    if (!bare)
        text_add_format(out, "(%s", ast_kind_name(ast->kind));
    if (ast->name)
        text_add_format(out, bare ? "%.*s" : " %.*s", (int)ast->name->name.len, ast->name->name.bytes);
    for (uint32_t i = 0; i < ast->count; i++) {
        text_add_char(out, ' ');
        add_shape(world, out, ast->children[i]);
    }
    if (!bare)
        text_add_char(out, ')');
}

// Returns the trees of all statements, separated by spaces, or "rejected".
static inline const char *shape(World *world, const char *program) {
    Parsed parsed = parse_str(world, str_from(program));
    Text out = text_new(&world->arena);
    for (uint32_t i = 0; parsed.ast && i < parsed.ast->count; i++) {
        if (i)
            text_add_char(&out, ' ');
        add_shape(world, &out, parsed.ast->children[i]);
    }
    if (!parsed.ast)
        text_add_c(&out, "rejected");
    diag_sink_free(&parsed.diags);
    return text_c(&out);
}

// Returns the errors as `line:column: text | hint`, one per line.
static inline const char *complaints(World *world, Str program) {
    Parsed parsed = parse_str(world, program);
    Text out = text_new(&world->arena);
    for (uint32_t i = 0; i < parsed.diags.count; i++) {
        const Diag *diag = &parsed.diags.items[i];
        SourcePosition place = source_locate(diag->at.source, diag->at.span.start);
        text_add_format(&out, "%s%u:%u: ", i ? "\n" : "", place.line, place.column);
        text_add(&out, diag->text);
        if (diag->hint.len)
            text_add_format(&out, " | %.*s", (int)diag->hint.len, diag->hint.bytes);
    }
    diag_sink_free(&parsed.diags);
    return text_c(&out);
}
