// ast.c: see ast.h.
#include "ast/ast.h"

#include "value/format.h"

AstList *ast_list_new(Arena *arena) {
    AstList *list = arena_alloc(arena, sizeof *list);
    *list = (AstList){.arena = arena};
    return list;
}

AstList *ast_list_add(AstList *list, Ast *item) {
    list->items = arena_grow_array(list->arena, list->items, list->count, &list->capacity, sizeof *list->items);
    list->items[list->count++] = item;
    return list;
}

AstList *ast_list_add_all(AstList *list, const AstList *more) {
    for (uint32_t i = 0; i < more->count; i++)
        ast_list_add(list, more->items[i]);
    return list;
}

Ast *ast_new(Arena *arena, AstKind kind, Span span, const Symbol *name, Ast *const *children, uint32_t count) {
    arena_charge(arena, 1 + count / 8);
    Ast *ast = arena_alloc(arena, sizeof *ast);
    uint32_t height = 0;
    for (uint32_t i = 0; i < count; i++)
        if (children[i] && children[i]->height > height)
            height = children[i]->height;
    *ast = (Ast){.kind = kind,
                 .count = count,
                 .height = height + 1,
                 .span = span,
                 .name = name,
                 .children = arena_copy(arena, children, count * sizeof *children)};
    return ast;
}

Ast *ast_from_list(Arena *arena, AstKind kind, Span span, const Symbol *name, const AstList *children) {
    return ast_new(arena, kind, span, name, children->items, children->count);
}

Ast *ast_literal(Arena *arena, Span span, Value value) {
    Ast *ast = ast_new(arena, AST_LITERAL, span, NULL, NULL, 0);
    ast->value = value;
    return ast;
}

const char *ast_kind_name(AstKind kind) {
    static const char *const names[] = {
#define AST(kind, text) text,
#include "ast/ast_list.h"
#undef AST
    };
    return names[kind];
}

static void print_level(Text *out, const SymbolTable *symbols, const Source *source, const Ast *ast, int depth) {
    for (int i = 0; i < depth; i++)
        text_add_c(out, "  ");
    if (!ast) {
        text_add_c(out, "(none)\n");
        return;
    }
    text_add_c(out, ast_kind_name(ast->kind));
    if (ast->name) {
        text_add_char(out, ' ');
        text_add(out, ast->name->name);
    }
    if (ast->kind == AST_LITERAL) {
        text_add_char(out, ' ');
        format_value(out, symbols, ast->value);
    }
    SourcePosition place = source_locate(source, ast->span.start);
    text_add_format(out, "  @%u:%u\n", place.line, place.column);
    for (uint32_t i = 0; i < ast->count; i++)
        print_level(out, symbols, source, ast->children[i], depth + 1);
}

void ast_print(Text *out, const SymbolTable *symbols, const Source *source, const Ast *ast) {
    print_level(out, symbols, source, ast, 0);
}
