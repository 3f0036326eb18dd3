// explain.c: what is known of a word: petri's tables, the script itself, and values that never change.
#include <stdlib.h>
#include <string.h>

#include "base/source.h"
#include "cli/help.h"
#include "lsp/workspace.h"

enum { MOST_SHOWN = 600 }; // bytes of a value or a statement

static bool same(Str text, const char *name) {
    return str_equal(text, str_from(name));
}

bool explain_kind(Str name, size_t *number, PetriNodeKind *kind) {
    for (size_t i = *number; petri_node_kind(i, kind); i++) {
        if (same(name, kind->name)) {
            *number = i;
            return true;
        }
    }
    return false;
}

bool explain_builtin(Str name, PetriBuiltin *builtin) {
    for (size_t i = 0; petri_builtin(i, builtin); i++) {
        if (same(name, builtin->name)) {
            return true;
        }
    }
    return false;
}

// Backwards within the statement, over what is in brackets: the node that begins what the attribute is added to.
size_t explain_node_of(const Document *document, size_t token, const char **name) {
    size_t depth = 0;
    for (size_t i = token; i > 0; i--) {
        Str text = document_token(document, i - 1);
        if (same(text, ")") || same(text, "]")) {
            depth++;
        } else if (same(text, "(") || same(text, "[")) {
            if (depth-- == 0) {
                return SIZE_MAX;
            }
        } else if (depth == 0 && document->tokens[i - 1].kind == PETRI_TOKEN_NODE) {
            PetriNodeKind kind;
            size_t number = 0;
            bool found = explain_kind((Str){text.bytes + 1, text.len - 1}, &number, &kind);
            *name = found ? kind.name : NULL;
            return found ? number : SIZE_MAX;
        }
        if (document_begins(document, i - 1)) {
            break;
        }
    }
    return SIZE_MAX;
}

void explain_attribute(Bytes *out, const PetriNodeAttribute *attribute) {
    bytes_format(out, "**%s** — %s", attribute->name, attribute->type);
    if (attribute->unit[0] != '\0') {
        bytes_format(out, ", in %s", attribute->unit);
    }
    if (attribute->fallback[0] != '\0') {
        bytes_format(out, "; default `%s`", attribute->fallback);
    }
    bytes_format(out, "%s%s", attribute->help[0] == '\0' ? "" : "  \n", attribute->help);
}

static void explain_kinds(Bytes *out, Str name) {
    PetriNodeKind kind;
    PetriNodeAttribute attribute;
    for (size_t i = 0; explain_kind(name, &i, &kind); i++) {
        bytes_format(out, "%s**!%s** (%s) — %s\n", out->length > 0 ? "\n---\n" : "", kind.name, kind.area, kind.help);
        if (kind.formula[0] != '\0') {
            bytes_format(out, "\n```text\n%s\n```\n%s\n", kind.formula, FORMULA_LETTERS);
        }
        for (size_t k = 0; petri_node_attribute(i, k, &attribute); k++) {
            bytes_add_text(out, "\n- ");
            explain_attribute(out, &attribute);
        }
        bytes_add_text(out, "\n");
    }
}

static bool explain_topic(Bytes *out, Str word) {
    for (size_t i = 0; TOPICS[i].word != NULL; i++) {
        if (same(word, TOPICS[i].word)) {
            bytes_format(out, "```flitter\n%s\n```\n%s", TOPICS[i].form, TOPICS[i].help);
            return true;
        }
    }
    return false;
}

// --- values

// Do all names in a part of the text stand for what never changes?
static bool is_constant(const Document *document, size_t start, size_t end, unsigned depth) {
    PetriBuiltin builtin;
    for (size_t i = document_token_at(document, start); i < document->token_count && document->tokens[i].start < end;
         i++) {
        if (document_is(document, i, "$") || document->tokens[i].kind == PETRI_TOKEN_NODE) {
            return false;
        }
    }
    for (size_t i = 0; i < document->name_count; i++) {
        const PetriTextName *name = &document->names[i];
        if (name->kind != PETRI_NAME_USE || name->start < start || name->start >= end) {
            continue;
        }
        Str text = document_part(document, name->start, name->end);
        const PetriTextName *bound = document_binding(document, name);
        if (bound == NULL && !explain_builtin(text, &builtin) &&
            str_word_number(text, "true false null pi tau inf nan") < 0) {
            return false;
        }
        bool within = bound != NULL && bound->start >= start && bound->start < end;
        if (bound != NULL && !within &&
            (depth > 8 || (bound->kind != PETRI_NAME_LET && bound->kind != PETRI_NAME_FUNC) ||
             !is_constant(document, bound->value_start, bound->value_end, depth + 1))) {
            return false;
        }
    }
    return !str_equal(document_part(document, start, start + 5), STR("debug"));
}

static bool is_top(const PetriTextName *name) {
    return name->depth == 0 && name->kind == PETRI_NAME_LET && name->alone;
}

// `let NAME=NAME or DEFAULT`: its default.
static bool is_parameter(const Document *document, const PetriTextName *name) {
    Str value = document_part(document, name->value_start, name->value_end);
    Str own = document_part(document, name->start, name->end);
    return str_starts_with(value, own) && value.len > own.len && value.bytes[own.len] == ' ';
}

static const PetriTextName *last_of(const Document *document, const PetriTextName *name) {
    const PetriTextName *last = explain_export(document, document_part(document, name->start, name->end));
    return last;
}

static void find_values(Server *server, Document *document) {
    PetriOptions options = petri_default_options();
    options.work = 1 << 22; // some 40 ms
    options.threads = 1;
    options.stack_bytes = server->host->stack_bytes;
    options.unsaved = server_unsaved;
    options.read_host = server;
    PetriSession *session = petri_open(&options);
    document->values = json_object_new_object();
    bool loaded = session != NULL &&
                  petri_load_text(session, document->path, document->text.data, document->text.length) == PETRI_OK;
    for (size_t i = 0; loaded && i < document->name_count; i++) {
        const PetriTextName *name = &document->names[i];
        bool wanted = is_top(name) && last_of(document, name) == name &&
                      (is_parameter(document, name) || is_constant(document, name->value_start, name->value_end, 0));
        SCOPED_BYTES value = {0};
        PetriResult result;
        SCOPED_TEXT own = memory_copied(document->text.data + name->start, name->end - name->start);
        if (wanted && petri_evaluate(session, own, strlen(own), &result, bytes_collect, &value) == PETRI_OK &&
            value.length > 0) {
            Str shown = str_cut((Str){value.data, value.length}, MOST_SHOWN);
            json_put(document->values, own, json_from(shown));
        }
    }
    petri_close(&session);
}

const char *explain_value(Server *server, Document *document, const PetriTextName *name) {
    if (name == NULL || !is_top(name) || last_of(document, name) != name) {
        return NULL;
    }
    if (document->values == NULL) {
        find_values(server, document);
    }
    SCOPED_TEXT own = memory_copied(document->text.data + name->start, name->end - name->start);
    return json_text(document->values, own);
}

// --- the script's own names

const PetriTextName *explain_export(const Document *document, Str text) {
    const PetriTextName *found = NULL;
    for (size_t i = 0; i < document->name_count; i++) {
        const PetriTextName *name = &document->names[i];
        if (name->kind != PETRI_NAME_USE && name->depth == 0 && name->kind != PETRI_NAME_LOOP &&
            str_equal(document_part(document, name->start, name->end), text) &&
            name->scope_end >= document->text.length) {
            found = name;
        }
    }
    return found;
}

// The lines of comment right above a statement, which say what it is for.
static void add_comment_above(Bytes *out, const Document *document, size_t start) {
    size_t line, character, first;
    document_place(document, start, true, &line, &character);
    for (first = line; first > 0; first--) {
        Str above = str_trim(document_part(document, document->lines[first - 1], document->lines[first]));
        if (!str_starts_with(above, STR("--"))) {
            break;
        }
    }
    for (; first < line; first++) {
        Str text = str_trim(document_part(document, document->lines[first], document->lines[first + 1]));
        bytes_add(out, text.bytes + 2, text.len - 2);
        bytes_add_text(out, "  \n");
    }
}

void explain_binding(Bytes *out, Server *server, Document *document, const PetriTextName *name) {
    static const char *const kinds[] = {"", "let ", "", "parameter ", "for ", "import "};
    size_t end = name->value_end > name->end ? name->value_end : name->end;
    size_t start = name->kind == PETRI_NAME_FUNC ? name->value_start : name->start;
    Str text = document_part(document, start, end);
    const char *stop = memchr(text.bytes, '\n', text.len);
    bool head = stop != NULL && name->kind == PETRI_NAME_FUNC; // without its body
    text = head ? (Str){text.bytes, (size_t)(stop - text.bytes)} : str_cut(text, MOST_SHOWN);
    bytes_format(out, "```flitter\n%s%.*s\n```\n", kinds[name->kind], STR_ARGS(text));
    const char *value = explain_value(server, document, name);
    if (value != NULL) {
        bytes_format(out, "= `%s`\n\n", value);
    }
    add_comment_above(out, document, start);
    size_t behind = document_token_at(document, end);
    if (!head && behind < document->token_count && document->tokens[behind].kind == PETRI_TOKEN_COMMENT &&
        memchr(document->text.data + end, '\n', document->tokens[behind].start - end) == NULL) {
        Str comment = document_token(document, behind);
        bytes_add(out, comment.bytes + 2, comment.len - 2);
    }
}

static void explain_name(Bytes *out, const Place *place, size_t token) {
    const Document *document = place->document;
    Str text = document_token(document, token);
    const PetriTextName *name = document_name_at(document, document->tokens[token].start);
    Workspace workspace;
    workspace_open(&workspace, place->server, place->document, false);
    Senses meant = workspace_meaning(&workspace, token);
    if (meant.count > 0) {
        explain_binding(out, place->server, workspace.documents[meant.items[0].file],
                        workspace_name(&workspace, meant.items[0]));
    }
    workspace_close(&workspace);
    if (meant.count > 0) {
        return;
    }
    const char *node = NULL;
    size_t kind =
        name == NULL && document_is(document, token + 1, "=") ? explain_node_of(document, token, &node) : SIZE_MAX;
    PetriNodeAttribute attribute;
    for (size_t k = 0; kind != SIZE_MAX && petri_node_attribute(kind, k, &attribute); k++) {
        if (same(text, attribute.name)) {
            explain_attribute(out, &attribute);
            bytes_format(out, "\n\nof `!%s`", node);
            return;
        }
    }
    PetriBuiltin builtin;
    if (explain_builtin(text, &builtin)) {
        bytes_format(out, "```flitter\n%s(%s)\n```\n%s", builtin.name, builtin.parameters, builtin.help);
    } else {
        explain_topic(out, text);
    }
}

// A number with a suffix, or a time code, is not what it looks like.
static void explain_number(Bytes *out, Str text) {
    SCOPED_TEXT copy = memory_copied(text.bytes, text.len);
    double x;
    if (petri_read_number(copy, &x)) {
        bytes_format(out, "= `%.17g`", x);
    }
}

Json *answer_hover(const Place *place, const char **problem) {
    (void)problem;
    Document *document = place->document;
    size_t token = document_token_at(document, place->offset);
    bool touches = token > 0 && document->tokens[token - 1].end == place->offset &&
                   document->tokens[token - 1].kind != PETRI_TOKEN_OPERATOR; // the cursor is behind it
    token -= touches ? 1 : 0;
    if (token >= document->token_count || document->tokens[token].start > place->offset) {
        return NULL;
    }
    SCOPED_BYTES out = {0};
    Str text = document_token(document, token);
    switch (document->tokens[token].kind) {
    case PETRI_TOKEN_NODE:
        explain_kinds(&out, (Str){text.bytes + 1, text.len - 1});
        break;
    case PETRI_TOKEN_NAME:
        explain_name(&out, place, token);
        break;
    case PETRI_TOKEN_NUMBER:
        explain_number(&out, text);
        break;
    case PETRI_TOKEN_KEYWORD:
        explain_topic(&out, text.bytes[0] == '%' ? (Str){text.bytes + 1, text.len - 1} : text);
        break;
    default:
        explain_topic(&out, text);
        break;
    }
    if (out.length == 0) {
        return NULL;
    }
    Json *result = json_put(json_object_new_object(), "contents", json_markdown(out.data));
    return json_put(
        result, "range",
        document_range(document, document->tokens[token].start, document->tokens[token].end, place->server->utf8));
}
