// parameters.c: parameters of scripts, `let NAME=NAME or DEFAULT` or `let X=NAME or NUMBER`; see program.h.
//
// Instead of `NAME or DEFAULT`, a script can write `NAME if NAME != null else DEFAULT`. The language needs no special
// rule: an undefined name is null, which is false, so `or` selects the default. This file
// suppresses the warning about the undefined name and collects the parameters for listings. The comments that describe
// them are read from the source text, because the lexer drops comments.
#include "ast/literal.h"
#include "program/compile.h"

#include <math.h>
#include <string.h>

// A value that can declare a parameter.
typedef struct Declaration {
    const Ast *use;           // NAME; NULL: the value does not declare a parameter
    const Ast *test;          // the second NAME of `NAME if NAME != null else DEFAULT`, or NULL
    const Ast *default_value; // DEFAULT; NULL: it is not one node, because the value is `NAME or A or B`
    uint32_t default_start;   // offset at which the source text of the default begins
} Declaration;

// Returns the operand that is compared with null in `A != null`, or NULL for other expressions.
static const Ast *tested_for_null(const Ast *test) {
    if (test->kind != AST_NE)
        return NULL;
    for (uint32_t i = 0; i < 2; i++)
        if (test->children[i]->kind == AST_NAME && str_equal(test->children[i]->name->name, STR("null")))
            return test->children[1 - i];
    return NULL;
}

static Declaration read_cond(const Ast *cond) {
    const Ast *use = cond->children[0], *test = tested_for_null(cond->children[1]), *other = cond->children[2];
    if (use->kind != AST_NAME || !test || test->kind != AST_NAME || test->name != use->name || !other)
        return (Declaration){0};
    return (Declaration){use, test, other, other->span.start};
}

// Reads `NAME or … or …` or `NAME if NAME != null else …`.
static Declaration read_declaration(const Ast *value) {
    if (value->kind == AST_COND)
        return read_cond(value);
    const Ast *use = value;
    while (use->kind == AST_OR)
        use = use->children[0];
    if (value->kind != AST_OR || use->kind != AST_NAME)
        return (Declaration){0};
    return (Declaration){use, NULL, value->children[0] == use ? value->children[1] : NULL, use->span.end};
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

// Returns the source text between two offsets, without white space at its ends.
static Str text_between(const Source *source, uint32_t start, uint32_t end) {
    return str_trim((Str){source->text.bytes + start, end > start ? end - start : 0});
}

// Returns the source text of a default: the part of `value` from `start`, without an `or` at its beginning.
static Str default_text(const Source *source, uint32_t start, const Ast *value) {
    Str rest = text_between(source, start, value->span.end);
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
static bool is_parameter(Compiler *compiler, const Declaration *declared, const Ast *name) {
    const Ast *use = declared->use;
    if (!use || !compile_is_free(compiler, use->name))
        return false;
    if (use->name == name->name)
        return true;
    return !compiler->options->module && declared->default_value && is_plain_number(declared->default_value) &&
           compile_count_uses(compiler, use->name) == (declared->test ? 2 : 1) &&
           !compile_has_hint(compiler, use, name->name);
}

void compile_note_parameter(Compiler *compiler, const Ast *binding) {
    const Ast *names = binding->children[0], *value = binding->children[1];
    Declaration declared = read_declaration(value);
    compiler->parameter_use = compiler->parameter_test = compiler->parameter_default = NULL;
    if (compiler->depth != 1 || names->count != 1 || !is_parameter(compiler, &declared, names->children[0]))
        return;
    Parameter parameter = {.name = declared.use->name,
                           .source = compiler->source,
                           .span = names->children[0]->span,
                           .keeps_false = declared.test,
                           .default_text = default_text(compiler->source, declared.default_start, value)};
    parse_comment(trailing_comment(compiler->source, value->span.end), &parameter);
    compiler->parameters = arena_grow_array(compiler->arena, compiler->parameters, compiler->parameter_count,
                                            &compiler->parameter_capacity, sizeof parameter);
    compiler->parameters[compiler->parameter_count++] = parameter;
    compiler->parameter_use = declared.use;
    compiler->parameter_test = declared.test;
    compiler->parameter_default = declared.default_value;
}

Str program_null_test(Arena *arena, const Parameter *parameter) {
    Str name = parameter->name->name;
    Str bound = text_between(parameter->source, parameter->span.start, parameter->span.end);
    return str_format(arena, "write 'let %.*s=%.*s if %.*s != null else %.*s'", STR_ARGS(bound), STR_ARGS(name),
                      STR_ARGS(name), STR_ARGS(parameter->default_text));
}

// Warns about a range with values that `or` replaces by the default.
static void lint_zero(Compiler *compiler, const Parameter *parameter) {
    bool has_range = parameter->min > -INFINITY || parameter->max < INFINITY;
    bool has_zero = has_range && parameter->min <= 0 && parameter->max >= 0;
    if (compiler->options->lint && has_zero && !parameter->keeps_false &&
        !(parameter->is_static && !value_true(parameter->value)))
        compile_report(compiler, parameter->span, DIAG_WARNING, "zero-in-range",
                       str_format(compiler->arena, "the range contains 0, but `or` replaces 0 by the default %.*s",
                                  STR_ARGS(parameter->default_text)),
                       program_null_test(compiler->arena, parameter));
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
    lint_zero(compiler, parameter);
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
