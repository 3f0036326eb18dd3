// expression.c: expressions that commands evaluate in several frames; `prev(EXPR)` is the value of EXPR in the frame
// before, and `changes EXPR` is true if the value differs from that one.
//
// The values of the frame before are put into the text of the expression, so an expression with `prev` is a normal one
// for the language.
#include "prompt/prompt.h"

#include <stdlib.h>
#include <string.h>

// Tokens of a text. The first INNER of them that form `prev(` are kept.
typedef struct Scan {
    const char *text;
    Expression *out;
    size_t start; // start of the current `prev`; SIZE_MAX: none
    size_t open;  // first byte after its parenthesis
    int depth;    // open brackets within it
    size_t last;  // end of the token before if it is `prev`, else SIZE_MAX
    bool nested;
    bool after_func; // true if the token before is `func`, so that `prev` is a definition
} Scan;

static void add_inner(Scan *scan, size_t end) {
    Expression *out = scan->out;
    out->inner = memory_realloc(out->inner, (out->inner_count + 1) * sizeof *out->inner);
    out->inner[out->inner_count++] = (Inner){
        .start = scan->start,
        .end = end + 1,
        .text = memory_strndup(scan->text + scan->open, end - scan->open),
    };
    scan->start = SIZE_MAX;
}

static void see_token(void *user_data, const PetriToken *token) {
    Scan *scan = user_data;
    Str word = {scan->text + token->start, token->end - token->start};
    bool is_prev = token->kind == PETRI_TOKEN_NAME && str_equal(word, STR("prev")) && !scan->after_func;
    char c = word.len == 1 ? word.bytes[0] : '\0';
    bool opens = c == '(' || c == '[' || c == '{', closes = c == ')' || c == ']' || c == '}';
    if (scan->start == SIZE_MAX) {
        if (scan->last == token->start && c == '(') {
            scan->start = token->start - strlen("prev");
            scan->open = token->end;
            scan->depth = 0;
        }
    } else if (closes && scan->depth == 0) {
        add_inner(scan, token->start);
    } else {
        scan->depth += opens - closes;
        scan->nested = scan->nested || (scan->last == token->start && c == '(');
    }
    scan->last = is_prev ? token->end : SIZE_MAX;
    scan->after_func = str_equal(word, STR("func"));
}

// Returns true if the script or the prompt binds `prev` or `changes`, which then has no special meaning.
static bool is_bound(Prompt *prompt, const char *word) {
    const char *name;
    for (size_t i = 0; (name = petri_visible_name(prompt->session, i)); i++)
        if (strcmp(name, word) == 0)
            return true;
    return false;
}

static bool find_inner(Prompt *prompt, Expression *out) {
    Scan scan = {.text = out->text, .out = out, .start = SIZE_MAX, .last = SIZE_MAX};
    if (!strstr(out->text, "prev(") || is_bound(prompt, "prev"))
        return true;
    petri_tokenise(prompt->session, out->text, strlen(out->text), see_token, &scan);
    return !scan.nested || prompt_fail(prompt, "prev() cannot contain prev()");
}

// Appends the text with the values of the frame before.
static void add_text(const Expression *expression, Text *text) {
    size_t at = 0;
    for (size_t i = 0; i < expression->inner_count; i++) {
        const Inner *inner = &expression->inner[i];
        text_add(text, (Str){expression->text + at, inner->start - at});
        text_add_format(text, "(%s)", inner->value ? inner->value : "null");
        at = inner->end;
    }
    text_add_c(text, expression->text + at);
}

PetriStatus expression_evaluate(Prompt *prompt, const Expression *expression, PetriEvaluation *result, Text *value) {
    SCOPED_TEXT text = {0};
    SCOPED_TEXT own = {0};
    add_text(expression, &text);
    PetriStatus status = petri_evaluate(prompt->session, text.bytes, text.len, result, sizeof *result, text_collect,
                                        expression->changes ? &own
                                        : value             ? value
                                                            : &own);
    if (status == PETRI_OK && expression->changes) {
        result->is_true = expression->before && strcmp(expression->before, own.len > 0 ? own.bytes : "") != 0;
        if (value)
            text_add_c(value, result->is_true ? "true" : "false");
    }
    return status;
}

static PetriStatus keep_value(Prompt *prompt, const char *text, char **kept) {
    SCOPED_TEXT value = {0};
    PetriEvaluation result;
    PetriStatus status =
        petri_evaluate(prompt->session, text, PETRI_NUL_TERMINATED, &result, sizeof result, text_collect, &value);
    free(*kept);
    *kept = status == PETRI_OK ? memory_strdup(value.len > 0 ? value.bytes : "") : NULL;
    return status;
}

static void forget(Expression *expression) {
    free(expression->before);
    expression->before = NULL;
    for (size_t i = 0; i < expression->inner_count; i++) {
        free(expression->inner[i].value);
        expression->inner[i].value = NULL;
    }
}

PetriStatus expression_remember(Prompt *prompt, Expression *expression) {
    PetriStatus status = PETRI_OK;
    if (petri_frame_number(prompt->session) < 0) { // there are no values before the first frame
        forget(expression);
        return PETRI_OK;
    }
    for (size_t i = 0; i < expression->inner_count && status == PETRI_OK; i++)
        status = keep_value(prompt, expression->inner[i].text, &expression->inner[i].value);
    // `changes` compares the value with that of the frame before, in which `prev` refers to the frame before that.
    if (status == PETRI_OK && expression->changes)
        status = keep_value(prompt, expression->text, &expression->before);
    return status;
}

bool expression_uses_previous(const Expression *expression) {
    return expression->changes || expression->inner_count > 0;
}

// Fails if the text has what looks like an option, because the language would ignore it as a comment.
static bool has_no_option(Prompt *prompt, const char *text) {
    const char *option = text;
    while ((option = strstr(option, "--"))) {
        bool is_option = (option == text || strchr(" \t", option[-1])) && option[2] >= 'a' && option[2] <= 'z';
        if (is_option)
            return prompt_fail(prompt, "no such option: '%.*s'; a comment has a blank after its dashes",
                               (int)strcspn(option, " \t="), option);
        option += 2;
    }
    return true;
}

bool expression_parse(Prompt *prompt, const char *text, Expression *out) {
    static const char word[] = "changes";
    size_t length = strlen(word);
    *out = (Expression){.typed = memory_strdup(text)};
    out->changes = strncmp(text, word, length) == 0 && strchr(" \t(", text[length]) && text[length] != '\0' &&
                   !is_bound(prompt, word);
    SCOPED_STRING rest = argument_trimmed(text + (out->changes ? length : 0));
    out->text = memory_strdup(rest);
    PetriEvaluation result;
    bool good = has_no_option(prompt, rest) && find_inner(prompt, out);
    if (good && out->changes && out->inner_count > 0)
        good = prompt_fail(prompt, "'changes' compares with the frame before, so it takes no prev()");
    for (size_t i = 0; i < out->inner_count && good; i++)
        good = prompt_status(prompt, petri_evaluate(prompt->session, out->inner[i].text, PETRI_NUL_TERMINATED, &result,
                                                    sizeof result, NULL, NULL));
    good = good && prompt_status(prompt, expression_evaluate(prompt, out, &result, NULL));
    if (!good)
        expression_free(out);
    return good;
}

bool expression_learn(Prompt *prompt, Expression *expression) {
    int64_t now = petri_frame_number(prompt->session);
    PetriStatus status = PETRI_OK;
    if (!expression_uses_previous(expression) || now <= prompt_timeline(prompt).first)
        return true;
    prompt_busy(prompt);
    status = prompt_go_to(prompt, now - 1);
    if (status == PETRI_OK)
        status = expression_remember(prompt, expression);
    PetriStatus returned = prompt_go_to(prompt, now);
    bool stopped = prompt_idle(prompt);
    return prompt_status(prompt, stopped ? PETRI_INTERRUPTED : status != PETRI_OK ? status : returned);
}

bool expression_expand(Prompt *prompt, const char *text, Text *out) {
    Expression expression = {.text = memory_strdup(text)};
    bool good = find_inner(prompt, &expression) && expression_learn(prompt, &expression);
    if (good && expression.inner_count > 0)
        add_text(&expression, out);
    expression_free(&expression);
    return good;
}

void expression_free(Expression *expression) {
    for (size_t i = 0; i < expression->inner_count; i++) {
        free(expression->inner[i].text);
        free(expression->inner[i].value);
    }
    free(expression->inner);
    free(expression->before);
    free(expression->text);
    free(expression->typed);
    *expression = (Expression){0};
}

void expressions_add(Expressions *list, const Expression *expression) {
    list->items = memory_realloc(list->items, (list->count + 1) * sizeof *list->items);
    list->items[list->count++] = *expression;
}

size_t expressions_find(const Expressions *list, const char *typed) {
    size_t i = 0;
    while (i < list->count && strcmp(list->items[i].typed, typed) != 0)
        i++;
    return i;
}

bool expressions_remove(Expressions *list, const char *typed) {
    size_t kept = 0, count = list->count;
    for (size_t i = 0; i < count; i++)
        if (typed[0] == '\0' || strcmp(typed, list->items[i].typed) == 0)
            expression_free(&list->items[i]);
        else
            list->items[kept++] = list->items[i];
    list->count = kept;
    return typed[0] == '\0' || kept < count;
}

void expressions_free(Expressions *list) {
    expressions_remove(list, "");
    free(list->items);
    *list = (Expressions){0};
}
