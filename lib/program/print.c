// print.c: a program as text, for --dump=code.
#include "program/program.h"
#include "value/format.h"

static const char *kind_name(ExprKind kind) {
    static const char *const names[] = {
#define EXPR(kind, text) text,
#include "program/expr_list.h"
#undef EXPR
    };
    return names[kind];
}

static void print_expr(Text *out, const SymbolTable *symbols, const Expr *expr, int depth);

static void print_function(Text *out, const SymbolTable *symbols, const FunctionCode *code, int depth) {
    text_add_format(out, " %.*s params=%u frame=%u captures=%u\n", (int)code->name.len, code->name.bytes,
                    code->param_count, code->frame_size, code->capture_count);
    for (uint32_t i = 0; i < code->capture_count; i++)
        print_expr(out, symbols, code->captures[i], depth + 2);
    print_expr(out, symbols, code->body, depth + 1);
}

static void print_operands(Text *out, const SymbolTable *symbols, const Expr *expr, int depth) {
    switch (expr->kind) {
    case EXPR_CONST:
        text_add_char(out, ' ');
        format_value(out, symbols, expr->as.value);
        break;
    case EXPR_NODE:
    case EXPR_UNBOUND:
        text_add_format(out, " %.*s", (int)expr->as.name->name.len, expr->as.name->name.bytes);
        break;
    case EXPR_GLOBAL:
        text_add_format(out, " %s", engine_name_text((EngineName)expr->slot));
        break;
    case EXPR_SLOT:
    case EXPR_CAPTURE:
    case EXPR_ARITH:
        text_add_format(out, " %u", expr->slot);
        break;
    case EXPR_BIND:
    case EXPR_FOR:
    case EXPR_IMPORT:
        text_add_format(out, " slots %u+%u", expr->slot, expr->slot_count);
        break;
    case EXPR_FUNC:
        print_function(out, symbols, expr->as.function, depth);
        return;
    default:
        break;
    }
    text_add_char(out, '\n');
}

static void print_expr(Text *out, const SymbolTable *symbols, const Expr *expr, int depth) {
    for (int i = 0; i < depth; i++)
        text_add_c(out, "  ");
    text_add_c(out, kind_name(expr->kind));
    print_operands(out, symbols, expr, depth);
    for (uint32_t i = 0; i < expr->count; i++)
        print_expr(out, symbols, expr->children[i], depth + 1);
}

void program_print(Text *out, const SymbolTable *symbols, const Program *program) {
    text_add_format(out, "frame=%u\n", program->frame_size);
    print_expr(out, symbols, program->body, 0);
}
