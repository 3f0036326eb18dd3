// expression.c: properties that are written as expressions; see property.h.
//
// `EXPR for i in RANGE` is evaluated as the vector of its values, so that the violated element is known.
#include "property/property.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The parts of `VALUE for NAME in RANGE`, and of a comparison `LEFT OPERATOR RIGHT` in VALUE.
typedef struct Parts {
    Str value;
    Str name;  // empty: no loop
    Str range; // rest of the expression
    Str left;  // empty: no comparison
    Str operator;
    Str right;
} Parts;

// Finds a text outside brackets and strings. Returns its offset, or SIZE_MAX.
static size_t find_outside(Str text, const char *wanted) {
    size_t length = strlen(wanted);
    char quote = '\0';
    int depth = 0;
    for (size_t i = 0; i + length <= text.len; i++) {
        char c = text.bytes[i];
        if (quote) {
            quote = c == quote ? '\0' : quote;
            continue;
        }
        if (depth == 0 && memcmp(text.bytes + i, wanted, length) == 0)
            return i;
        quote = c == '"' || c == '\'' ? c : '\0';
        depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    }
    return SIZE_MAX;
}

static Str part(Str text, size_t from, size_t to) {
    while (from < to && text.bytes[from] == ' ')
        from++;
    while (to > from && text.bytes[to - 1] == ' ')
        to--;
    return (Str){text.bytes + from, to - from};
}

static Parts split(const char *expression) {
    static const char *const operators[] = {"<=", ">=", "==", "!=", "<", ">"};
    Str whole = str_from(expression);
    Parts parts = {.value = whole};
    size_t loop = find_outside(whole, " for ");
    if (loop != SIZE_MAX) {
        Str rest = part(whole, loop + 5, whole.len);
        size_t in = find_outside(rest, " in ");
        if (in != SIZE_MAX) {
            parts.value = part(whole, 0, loop);
            parts.name = part(rest, 0, in);
            parts.range = part(rest, in + 4, rest.len);
        }
    }
    bool several = find_outside(parts.value, " or ") != SIZE_MAX || find_outside(parts.value, " and ") != SIZE_MAX;
    for (size_t i = 0; !several && i < sizeof operators / sizeof operators[0] && parts.left.len == 0; i++) {
        size_t at = find_outside(parts.value, operators[i]);
        if (at == SIZE_MAX)
            continue;
        parts.left = part(parts.value, 0, at);
        parts.operator= str_from(operators[i]);
        parts.right = part(parts.value, at + parts.operator.len, parts.value.len);
    }
    return parts;
}

static bool evaluate(Attempt *attempt, const Text *text, Text *value, PetriEvaluation *result) {
    value->len = 0;
    text_add_c(value, "");
    return petri_evaluate(attempt->session, text->bytes, text->len, result, sizeof *result, text_collect, value) ==
           PETRI_OK;
}

// Returns element number `index` of a printed vector.
static Str element(const Text *value, size_t index) {
    const char *at = value->bytes;
    while (index-- > 0) {
        const char *next = strchr(at, ';');
        at = next ? next + 1 : at + strlen(at);
    }
    return (Str){at, strcspn(at, ";")};
}

// Returns the index of the first element of a printed vector that is false (or true, for never), or SIZE_MAX.
static size_t find_element(const Text *value, const PetriEvaluation *result, bool wanted) {
    for (size_t i = 0; i < result->length; i++) {
        Str word = element(value, i);
        bool is_false = str_equal(word, STR("0")) || str_equal(word, STR("-0")) || str_equal(word, STR("nan")) ||
                        str_equal(word, STR("null")) || word.len == 0;
        if (is_false != wanted)
            return i;
    }
    return SIZE_MAX;
}

// Adds the value of a part for one element, `(PART for NAME in ELEMENT)`.
static void add_part(Attempt *attempt, const Parts *parts, Str expression, Str chosen, Text *text) {
    SCOPED_TEXT code = {0}, value = {0};
    PetriEvaluation result;
    text_add_format(&code, "(%.*s", STR_ARGS(expression));
    if (parts->name.len > 0)
        text_add_format(&code, " for %.*s in %.*s", STR_ARGS(parts->name), STR_ARGS(chosen));
    text_add_c(&code, ")");
    text_add_c(text, evaluate(attempt, &code, &value, &result) && value.len > 0 ? value.bytes : "null");
}

static bool is_word(char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// Adds the key in the first `$(KEY)` of the expression, with the variable of the loop replaced by its value.
static void add_key(const Parts *parts, Str chosen, Text *key) {
    size_t start = find_outside(parts->value, "$(");
    const char *found = start != SIZE_MAX ? parts->value.bytes + start : strstr(parts->value.bytes, "$(");
    if (!found || parts->name.len == 0 || found > parts->value.bytes + parts->value.len)
        return;
    const char *at = found + 2, *end = at + strcspn(at, ")");
    for (; at < end; at++) {
        bool here = strncmp(at, parts->name.bytes, parts->name.len) == 0 && !is_word(at[-1]) && at[-1] != ':' &&
                    !is_word(at[parts->name.len]);
        if (strncmp(at, ";:velocity", 10) == 0)
            break;
        if (here)
            text_add(key, chosen);
        else
            text_add(key, (Str){at, 1});
        at += here ? parts->name.len - 1 : 0;
    }
    text_add_c(key, "");
}

static void describe(Attempt *attempt, const Parts *parts, size_t index, Violation *violation) {
    SCOPED_TEXT code = {0}, value = {0};
    PetriEvaluation result;
    Str chosen = {0};
    if (parts->name.len > 0) {
        text_add_format(&code, "(%.*s for %.*s in %.*s)", STR_ARGS(parts->name), STR_ARGS(parts->name),
                        STR_ARGS(parts->range));
        if (evaluate(attempt, &code, &value, &result))
            chosen = element(&value, index);
        text_add_format(&violation->what, "%.*s=%.*s: ", STR_ARGS(parts->name), STR_ARGS(chosen));
        add_key(parts, chosen, &violation->particle);
    }
    if (parts->left.len > 0) {
        add_part(attempt, parts, parts->left, chosen, &violation->what);
        text_add_format(&violation->what, " %.*s ", STR_ARGS(parts->operator));
        add_part(attempt, parts, parts->right, chosen, &violation->what);
    } else {
        add_part(attempt, parts, parts->value, chosen, &violation->what);
    }
}

bool expression_holds(Attempt *attempt, const Property *property, bool last, Violation *violation) {
    if (property->kind == PROPERTY_FINALLY && !last)
        return true;
    SCOPED_TEXT code = {0}, value = {0};
    PetriEvaluation result;
    text_add_format(&code, "(%s)", property->expression);
    if (!evaluate(attempt, &code, &value, &result)) {
        text_add_c(&violation->what, attempt->expired ? "" : "the expression is not valid");
        return attempt->expired;
    }
    const Parts parts = split(property->expression);
    size_t index = find_element(&value, &result, property->kind == PROPERTY_NEVER);
    bool nothing = result.length == 0 && parts.name.len == 0 && property->kind != PROPERTY_NEVER;
    if (index == SIZE_MAX && !nothing)
        return true;
    describe(attempt, &parts, index == SIZE_MAX ? 0 : index, violation);
    return false;
}
