// parameters.c: parameters of scripts, `let NAME=NAME or DEFAULT` or `let X=NAME or NUMBER`; see program.h.
//
// The language needs no special rule: an undefined name is null, which is false, so `or` selects the default. This file
// suppresses the warning about the undefined name and collects the parameters for listings. The comments that describe
// them are read from the source text, because the lexer drops comments.
#include "ast/literal.h"
#include "program/compile.h"

#include <math.h>
#include <string.h>

// Returns the NAME of `NAME or … or …`, or NULL for other values.
static const Ast *first_operand(const Ast *value) {
    if (value->kind != AST_OR)
        return NULL;
    while (value->kind == AST_OR)
        value = value->children[0];
    return value->kind == AST_NAME ? value : NULL;
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

// Returns the source text between two offsets, without white space at its ends.
static Str text_between(const Source *source, uint32_t start, uint32_t end) {
    return str_trim((Str){source->text.bytes + start, end > start ? end - start : 0});
}

// Returns the source text of a default: the part of `value` after the first `or`. `use` is the NAME before the `or`.
static Str default_text(const Source *source, const Ast *use, const Ast *value) {
    Str rest = text_between(source, use->span.end, value->span.end);
    if (str_starts_with(rest, STR("or")))
        rest = (Str){rest.bytes + 2, rest.len - 2};
    return str_trim(rest);
}

// Returns the comment that follows a binding on its last line, or an empty string. `at` is the offset at which the
// binding ends. Only blanks and closing parentheses may be between the binding and the comment.
static Str trailing_comment(const Source *source, uint32_t at) {
    const char *text = source->text.bytes;
    while (is_blank(text[at]) || text[at] == ')')
        at++;
    if (text[at] != '-' || text[at + 1] != '-')
        return (Str){0};
    while (text[at] == '-')
        at++;
    const char *end = memchr(text + at, '\n', source->text.len - at);
    return text_between(source, at, (uint32_t)(end - text));
}

// Parses one end of a range. Sets *x to the number or, if the text is empty, to `if_absent`. Returns false if the text
// is neither empty nor a number.
static bool parse_bound(Str text, double if_absent, double *x) {
    *x = if_absent;
    return text.len == 0 || (literal_parse_number(text, x) && !isnan(*x));
}

// Parses `MIN..MAX` or `MIN..MAX|STEP`, where either MIN or MAX can be omitted, and sets the range of the parameter.
// Returns false for other text.
static bool parse_range(Str word, Parameter *parameter) {
    double min, max, step = 0;
    const char *dots = NULL, *bar = memchr(word.bytes, '|', word.len);
    size_t len = bar ? (size_t)(bar - word.bytes) : word.len;
    for (size_t i = 0; !dots && i + 1 < len; i++)
        if (word.bytes[i] == '.' && word.bytes[i + 1] == '.')
            dots = word.bytes + i;
    if (!dots || len == 2)
        return false;
    Str first = {word.bytes, (size_t)(dots - word.bytes)}, last = {dots + 2, len - first.len - 2};
    if (bar && !(literal_parse_number((Str){bar + 1, word.len - len - 1}, &step) && step > 0 && isfinite(step)))
        return false;
    if (!parse_bound(first, -INFINITY, &min) || !parse_bound(last, INFINITY, &max) || !(min <= max))
        return false;
    parameter->min = min;
    parameter->max = max;
    parameter->step = step;
    return true;
}

// Sets the range of the parameter from the start of its comment, if there is one, and parameter->comment to the rest.
static void parse_comment(Str comment, Parameter *parameter) {
    size_t len = 0;
    while (len < comment.len && !is_blank(comment.bytes[len]))
        len++;
    Str word = {comment.bytes, len};
    while (word.len && strchr(",;:", word.bytes[word.len - 1]))
        word.len--;
    parameter->min = -INFINITY;
    parameter->max = INFINITY;
    parameter->comment = comment;
    if (comment.len && parse_range(word, parameter))
        parameter->comment = str_trim((Str){comment.bytes + len, comment.len - len});
}

// Warns about a default that is outside the parameter's range.
static void lint_default(Compiler *compiler, const Parameter *parameter) {
    Value v = parameter->value;
    bool within = true;
    for (uint32_t i = 0; parameter->is_static && v.kind == VALUE_NUMBERS && i < v.len; i++) {
        double x = value_numbers(&v)[i];
        within = within && x >= parameter->min && x <= parameter->max;
    }
    if (compiler->options->lint && !within)
        compile_report(compiler, parameter->span, DIAG_WARNING, "out-of-range",
                       str_format(compiler->arena, "the default of '%.*s' is outside the range in its comment",
                                  STR_ARGS(parameter->name->name)),
                       (Str){0});
}

// Returns true for a number or a vector of numbers.
static bool is_plain_number(const Ast *ast) {
    bool plain =
        ast->kind == AST_LITERAL ? ast->value.kind == VALUE_NUMBERS : ast->kind == AST_NEG || ast->kind == AST_COMPOSE;
    for (uint32_t i = 0; plain && i < ast->count; i++)
        plain = is_plain_number(ast->children[i]);
    return plain;
}

// Returns true if `let X=NAME or DEFAULT` defines the parameter NAME. If NAME is not X, it must occur only here, and
// the default must be numbers. A name that is similar to another one is probably misspelled.
static bool is_parameter(Compiler *compiler, const Ast *use, const Ast *name, const Ast *value) {
    if (!use || !compile_is_free(compiler, use->name))
        return false;
    if (use->name == name->name)
        return true;
    return !compiler->options->module && value->children[0] == use && is_plain_number(value->children[1]) &&
           compile_is_used_once(compiler, use->name) && !compile_has_hint(compiler, use, name->name);
}

void compile_note_parameter(Compiler *compiler, const Ast *binding) {
    const Ast *names = binding->children[0], *value = binding->children[1], *use = first_operand(value);
    compiler->parameter_use = compiler->parameter_default = NULL;
    if (compiler->depth != 1 || names->count != 1 || !is_parameter(compiler, use, names->children[0], value))
        return;
    Parameter parameter = {.name = use->name,
                           .source = compiler->source,
                           .span = names->children[0]->span,
                           .default_text = default_text(compiler->source, use, value)};
    parse_comment(trailing_comment(compiler->source, value->span.end), &parameter);
    compiler->parameters = arena_grow_array(compiler->arena, compiler->parameters, compiler->parameter_count,
                                            &compiler->parameter_capacity, sizeof parameter);
    compiler->parameters[compiler->parameter_count++] = parameter;
    compiler->parameter_use = use;
    if (value->children[0] == use) // in `X or A or B`, the tree has no node for the default `A or B`
        compiler->parameter_default = value->children[1];
}

void compile_note_default(Compiler *compiler, const Expr *default_expr) {
    uint32_t last = compiler->parameter_count - 1;
    Parameter *parameter = &compiler->parameters[last];
    parameter->is_static = default_expr->kind == EXPR_CONST;
    if (parameter->is_static)
        parameter->value = default_expr->as.value;
    if (compiler->folding_pass) {
        parameter->is_static = compiler->folding_pass->parameters[last].is_static;
        parameter->value = compiler->folding_pass->parameters[last].value;
    }
    lint_default(compiler, parameter);
}

void compile_note_define(Compiler *compiler, const Binding *binding) {
    uint32_t count = compiler->options->module ? 0 : compiler->options->define_count;
    for (uint32_t i = 0; i < count; i++)
        if (compiler->options->defines[i].name == binding->name && !compiler->define_uses[i].bound.source) {
            compiler->define_uses[i].bound = (Origin){compiler->source, binding->span};
            compiler->define_uses[i].by_let = binding->kind == BINDING_LET && compiler->depth == 1;
        }
}

const Parameter *program_find_parameter(const Program *program, const Symbol *name) {
    for (uint32_t i = 0; i < program->parameter_count; i++)
        if (program->parameters[i].name == name)
            return &program->parameters[i];
    return NULL;
}
