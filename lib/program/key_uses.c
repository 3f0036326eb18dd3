// key_uses.c: collects what a program says about keys of the state (KeyUses of program.h).
#include "program/compile.h"

enum { MAX_SYMBOLS = 512 };

// Symbols are numbers that are larger than those in calculations.
static bool is_symbol(const Compiler *compiler, const Ast *ast) {
    return ast->kind == AST_LITERAL && value_is_number(ast->value) &&
           symbol_of_number(compiler->symbols, ast->value.as.number);
}

void compile_note_literal(Compiler *compiler, const Ast *ast) {
    KeyUses *keys = &compiler->keys;
    if (compiler->lookups > 0 || keys->incomplete || !is_symbol(compiler, ast))
        return;
    double symbol = ast->value.as.number;
    for (uint32_t i = 0; i < keys->symbol_count; i++)
        if (keys->symbols[i] == symbol)
            return;
    keys->incomplete = keys->symbol_count == MAX_SYMBOLS;
    if (keys->incomplete)
        return;
    keys->symbols = arena_grow_array(compiler->arena, keys->symbols, keys->symbol_count, &keys->symbol_capacity,
                                     sizeof *keys->symbols);
    keys->symbols[keys->symbol_count++] = symbol;
}

void compile_note_test(Compiler *compiler, const Ast *ast) {
    KeyUses *keys = &compiler->keys;
    if (ast->kind != AST_LOOKUP)
        return;
    keys->tested = arena_grow_array(compiler->arena, keys->tested, keys->tested_count, &keys->tested_capacity,
                                    sizeof *keys->tested);
    keys->tested[keys->tested_count++] = (Origin){compiler->source, ast->span};
}

// Returns true if an expression is directly followed by a semicolon, so it is not in parentheses.
static bool ends_at_semicolon(const Compiler *compiler, const Ast *ast) {
    const char *text = compiler->source->text.bytes + ast->span.end;
    while (*text == ' ' || *text == '\t')
        text++;
    return *text == ';';
}

void compile_note_vector(Compiler *compiler, const Ast *vector) {
    KeyUses *keys = &compiler->keys;
    const Ast *first = vector->children[0];
    if (vector->count < 2 || first->kind != AST_LOOKUP || !is_symbol(compiler, first->children[0]) ||
        !ends_at_semicolon(compiler, first))
        return;
    keys->loose =
        arena_grow_array(compiler->arena, keys->loose, keys->loose_count, &keys->loose_capacity, sizeof *keys->loose);
    keys->loose[keys->loose_count++] =
        (LooseKey){first->children[0]->value.as.number, {compiler->source, vector->span}};
}
