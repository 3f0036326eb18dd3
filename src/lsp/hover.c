// hover.c: hover information about a word, from petri's tables, the script, and the values of constants.
#include "base/source.h"
#include "cli/help.h"
#include "lsp/workspace.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_SHOWN = 600 }; // maximum length of a value or a statement, in bytes

static bool text_equals(Str text, const char *name) {
    return str_equal(text, str_from(name));
}

// Searches backwards for the node within the statement. Skips expressions in brackets.
size_t hover_node_of(const Document *document, size_t token, const char **name) {
    size_t depth = 0;
    for (size_t i = token; i > 0; i--) {
        Str text = document_token(document, i - 1);
        if (text_equals(text, ")") || text_equals(text, "]")) {
            depth++;
        } else if (text_equals(text, "(") || text_equals(text, "[")) {
            if (depth-- == 0)
                return SIZE_MAX;
        } else if (depth == 0 && document->tokens[i - 1].kind == PETRI_TOKEN_NODE) {
            PetriNodeKind kind;
            size_t number = 0;
            bool found = topic_find_kind((Str){text.bytes + 1, text.len - 1}, &number, &kind);
            *name = found ? kind.name : NULL;
            return found ? number : SIZE_MAX;
        }
        if (document_begins(document, i - 1))
            break;
    }
    return SIZE_MAX;
}

void hover_attribute(Text *out, const PetriNodeAttribute *attribute) {
    text_add_format(out, "**%s** — %s", attribute->name, attribute->type);
    if (attribute->unit[0] != '\0')
        text_add_format(out, ", in %s", attribute->unit);
    if (attribute->default_value[0] != '\0')
        text_add_format(out, "; default `%s`", attribute->default_value);
    text_add_format(out, "%s%s", attribute->help[0] == '\0' ? "" : "  \n", attribute->help);
}

static void hover_kinds(Text *out, Str name) {
    PetriNodeKind kind;
    PetriNodeAttribute attribute;
    for (size_t i = 0; topic_find_kind(name, &i, &kind); i++) {
        text_add_format(out, "%s**!%s** (%s) — %s\n", out->len > 0 ? "\n---\n" : "", kind.name, kind.area, kind.help);
        if (kind.formula[0] != '\0')
            text_add_format(out, "\n```text\n%s\n```\n%s\n", kind.formula, FORMULA_LETTERS);
        for (size_t k = 0; petri_node_attribute(i, k, &attribute, sizeof attribute); k++) {
            text_add_c(out, "\n- ");
            hover_attribute(out, &attribute);
        }
        text_add_c(out, "\n");
    }
}

static void hover_topic(Text *out, Str word) {
    const Topic *topic = topic_find(word);
    if (topic)
        text_add_format(out, "```flitter\n%s\n```\n%s", topic->form, topic->help);
}

// --- values

// Returns true if the expression from `start` to `end` is constant: all names in it are constant, and it contains no
// node and no `$`.
static bool is_constant(const Document *document, size_t start, size_t end, unsigned depth) {
    PetriBuiltin builtin;
    for (size_t i = document_token_at(document, start); i < document->token_count && document->tokens[i].start < end;
         i++)
        if (document_is(document, i, "$") || document->tokens[i].kind == PETRI_TOKEN_NODE)
            return false;
    for (size_t i = 0; i < document->name_count; i++) {
        const PetriBinding *name = &document->names[i];
        if (name->kind != PETRI_NAME_USE || name->start < start || name->start >= end)
            continue;
        Str text = document_slice(document, name->start, name->end);
        const PetriBinding *bound = document_binding(document, name);
        if (!bound && !topic_find_builtin(text, &builtin) &&
            str_word_number(text, "true false null pi tau inf nan") < 0)
            return false;
        bool within = bound && bound->start >= start && bound->start < end;
        if (bound && !within &&
            (depth > 8 || (bound->kind != PETRI_NAME_LET && bound->kind != PETRI_NAME_FUNC) ||
             !is_constant(document, bound->value_start, bound->value_end, depth + 1)))
            return false;
    }
    return !str_equal(document_slice(document, start, start + 5), STR("debug"));
}

static bool is_top_level(const PetriBinding *name) {
    return name->depth == 0 && name->kind == PETRI_NAME_LET && name->is_sole;
}

// Returns true for a parameter: `let NAME=NAME or DEFAULT`.
static bool is_parameter(const Document *document, const PetriBinding *name) {
    Str value = document_slice(document, name->value_start, name->value_end);
    Str own = document_slice(document, name->start, name->end);
    return str_starts_with(value, own) && value.len > own.len && value.bytes[own.len] == ' ';
}

static const PetriBinding *last_binding_of(const Document *document, const PetriBinding *name) {
    const PetriBinding *last = document_export(document, document_slice(document, name->start, name->end));
    return last;
}

static void find_values(Server *server, Document *document) {
    PetriOptions options = petri_default_options();
    options.work_limit = 1 << 22; // about 40 ms
    options.threads = 1;
    options.stack_limit = server->host->stack_bytes;
    options.read_unsaved = server_unsaved;
    options.read_user_data = server;
    PetriSession *session = petri_open(&options);
    document->values = memory_calloc(document->name_count * sizeof *document->values);
    bool loaded =
        session && petri_load_text(session, document->path, document->text.bytes, document->text.len) == PETRI_OK;
    for (size_t i = 0; loaded && i < document->name_count; i++) {
        const PetriBinding *name = &document->names[i];
        bool wanted = is_top_level(name) && last_binding_of(document, name) == name &&
                      (is_parameter(document, name) || is_constant(document, name->value_start, name->value_end, 0));
        SCOPED_TEXT value = {0};
        PetriEvaluation result;
        SCOPED_STRING own = memory_strndup(document->text.bytes + name->start, name->end - name->start);
        if (wanted &&
            petri_evaluate(session, own, strlen(own), &result, sizeof result, text_collect, &value) == PETRI_OK &&
            value.len > 0) {
            Str shown = str_truncate(text_str(&value), MAX_SHOWN);
            document->values[i] = memory_strndup(shown.bytes, shown.len);
        }
    }
    petri_close(&session);
}

const char *hover_value(Server *server, Document *document, const PetriBinding *name) {
    if (!name || !is_top_level(name) || last_binding_of(document, name) != name)
        return NULL;
    if (!document->values)
        find_values(server, document);
    return document->values[name - document->names];
}

// --- names bound in the script

// Appends the comment lines directly above a statement.
static void add_comment_above(Text *out, const Document *document, size_t start) {
    size_t line, character, first;
    document_position(document, start, true, &line, &character);
    for (first = line; first > 0; first--) {
        Str above = str_trim(document_slice(document, document->lines[first - 1], document->lines[first]));
        if (!str_starts_with(above, STR("--")))
            break;
    }
    for (; first < line; first++) {
        Str text = str_trim(document_slice(document, document->lines[first], document->lines[first + 1]));
        text_add(out, (Str){text.bytes + 2, text.len - 2});
        text_add_c(out, "  \n");
    }
}

// Returns the end of a binding with the parentheses that enclose its value, which value_end does not include.
static size_t binding_end(const Document *document, const PetriBinding *name) {
    size_t end = name->value_end > name->end ? name->value_end : name->end, open = 0;
    for (size_t i = document_token_at(document, name->end); i < document->token_count; i++) {
        const PetriToken *token = &document->tokens[i];
        bool closes = document_is(document, i, ")");
        if (token->start >= end && token->kind != PETRI_TOKEN_COMMENT && (open == 0 || !closes))
            break;
        open += document_is(document, i, "(");
        open -= closes && open > 0;
        if (closes && token->end > end)
            end = token->end;
    }
    return end;
}

void hover_binding(Text *out, Server *server, Document *document, const PetriBinding *name) {
    static const char *const kinds[] = {"", "let ", "", "parameter ", "for ", "import "};
    size_t end = binding_end(document, name);
    size_t start = name->kind == PETRI_NAME_FUNC ? name->value_start : name->start;
    Str text = document_slice(document, start, end);
    const char *stop = memchr(text.bytes, '\n', text.len);
    bool head = stop && name->kind == PETRI_NAME_FUNC; // show the function without its body
    text = head ? (Str){text.bytes, (size_t)(stop - text.bytes)} : str_truncate(text, MAX_SHOWN);
    text_add_format(out, "```flitter\n%s%.*s\n```\n", kinds[name->kind], STR_ARGS(text));
    const char *value = hover_value(server, document, name);
    if (value)
        text_add_format(out, "= `%s`\n\n", value);
    add_comment_above(out, document, start);
    size_t next = document_token_at(document, end);
    if (!head && next < document->token_count && document->tokens[next].kind == PETRI_TOKEN_COMMENT &&
        !memchr(document->text.bytes + end, '\n', document->tokens[next].start - end)) {
        Str comment = document_token(document, next);
        text_add(out, (Str){comment.bytes + 2, comment.len - 2});
    }
}

static void hover_name(Text *out, const RequestContext *request, size_t token) {
    const Document *document = request->document;
    Str text = document_token(document, token);
    const PetriBinding *name = document_name_at(document, document->tokens[token].start);
    Workspace workspace;
    workspace_open(&workspace, request->server, request->document, false);
    BindingSet meant = workspace_resolve(&workspace, token);
    if (meant.count > 0) {
        hover_binding(out, request->server, workspace.documents[meant.items[0].file],
                      workspace_name(&workspace, meant.items[0]));
    }
    workspace_close(&workspace);
    if (meant.count > 0)
        return;
    const char *node = NULL;
    size_t kind = !name && document_is(document, token + 1, "=") ? hover_node_of(document, token, &node) : SIZE_MAX;
    PetriNodeAttribute attribute;
    for (size_t k = 0; kind != SIZE_MAX && petri_node_attribute(kind, k, &attribute, sizeof attribute); k++) {
        if (text_equals(text, attribute.name)) {
            hover_attribute(out, &attribute);
            text_add_format(out, "\n\nof `!%s`", node);
            return;
        }
    }
    PetriBuiltin builtin;
    if (topic_find_builtin(text, &builtin))
        text_add_format(out, "```flitter\n%s(%s)\n```\n%s", builtin.name, builtin.parameters, builtin.help);
    else
        hover_topic(out, text);
}

// Appends the value of a number literal, which can have a suffix or be a time code.
static void hover_number(Text *out, Str text) {
    SCOPED_STRING copy = memory_strndup(text.bytes, text.len);
    double x;
    if (petri_parse_number(copy, &x))
        text_add_format(out, "= `%.17g`", x);
}

void answer_hover(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    Document *document = request->document;
    size_t token = document_token_at(document, request->offset);
    bool touches = token > 0 && document->tokens[token - 1].end == request->offset &&
                   document->tokens[token - 1].kind != PETRI_TOKEN_OPERATOR; // the cursor is at the end of the token
    token -= touches ? 1 : 0;
    if (token >= document->token_count || document->tokens[token].start > request->offset)
        return;
    SCOPED_TEXT out = {0};
    Str text = document_token(document, token);
    switch (document->tokens[token].kind) {
    case PETRI_TOKEN_NODE:
        hover_kinds(&out, (Str){text.bytes + 1, text.len - 1});
        break;
    case PETRI_TOKEN_NAME:
        hover_name(&out, request, token);
        break;
    case PETRI_TOKEN_NUMBER:
        hover_number(&out, text);
        break;
    case PETRI_TOKEN_KEYWORD:
        hover_topic(&out, text.bytes[0] == '%' ? (Str){text.bytes + 1, text.len - 1} : text);
        break;
    default:
        hover_topic(&out, text);
        break;
    }
    if (out.len == 0)
        return;
    json_open(result, NULL, "{");
    JSON_PUT_OBJECT(result, "contents", "kind", "markdown", "value", out.bytes);
    document_put_range(result, "range", document, document->tokens[token].start, document->tokens[token].end,
                       request->server->utf8);
    json_close(result, "}");
}
