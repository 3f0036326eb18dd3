// outline.c: symbols of documents and of the workspace, folding ranges and semantic tokens.
#include "cli/help.h"
#include "lsp/workspace.h"

#include <stdlib.h>
#include <string.h>

// --- symbols

// SymbolKind of the protocol.
enum { AS_MODULE = 2, AS_FUNCTION = 12, AS_VARIABLE = 13, AS_OBJECT = 19 };
enum { MAX_SYMBOLS = 1000 }; // of the workspace

// Adds a symbol, whose object stays open.
static void open_symbol(JsonWriter *json, const RequestContext *request, Str name, int kind, size_t start, size_t end,
                        size_t at, size_t at_end) {
    bool utf8 = request->server->utf8;
    json_open(json, NULL, "{");
    json_put_str(json, "name", name);
    json_put_integer(json, "kind", kind);
    document_put_range(json, "range", request->document, start < at ? start : at, end > at_end ? end : at_end, utf8);
    document_put_range(json, "selectionRange", request->document, at, at_end, utf8);
}

// Returns the SymbolKind of a name that is bound at the top level, else 0.
static int symbol_kind(const Document *document, const PetriBinding *name) {
    if (name->depth > 0 || name->scope_end < document->text.len)
        return 0;
    return name->kind == PETRI_NAME_FUNC     ? AS_FUNCTION
           : name->kind == PETRI_NAME_LET    ? AS_VARIABLE
           : name->kind == PETRI_NAME_IMPORT ? AS_MODULE
                                             : 0;
}

void answer_symbols(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    const Document *document = request->document;
    json_open(result, NULL, "[");
    for (size_t i = 0; i < document->name_count; i++) {
        const PetriBinding *name = &document->names[i];
        int kind = symbol_kind(document, name);
        if (kind != 0) {
            Str text = document_slice(document, name->start, name->end);
            open_symbol(result, request, text, kind, name->value_start, name->value_end, name->start, name->end);
            json_close(result, "}");
        }
    }
    for (size_t i = 0; i < document->token_count; i++) {
        if (document->tokens[i].kind == PETRI_TOKEN_NODE && document_begins(document, i) &&
            document_level(document, i) == 0) {
            size_t start = document->tokens[i].start, end = document->tokens[i].end;
            open_symbol(result, request, document_token(document, i), AS_OBJECT, start, document_block_end(document, i),
                        start, end);
            Str rest = document_slice(document, end, document->text.len);
            const char *line = memchr(rest.bytes, '\n', rest.len);
            Str attributes = str_trim((Str){rest.bytes, !line ? rest.len : (size_t)(line - rest.bytes)});
            json_put_str(result, "detail", str_truncate(attributes, 80));
            json_close(result, "}");
        }
    }
    json_close(result, "]");
}

static char lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

// Returns true if `name` contains the letters of the query in this order, in upper or lower case.
static bool matches(Str name, const char *query) {
    for (size_t i = 0; i < name.len && *query != '\0'; i++)
        if (lower(name.bytes[i]) == lower(*query))
            query++;
    return *query == '\0';
}

void answer_workspace_symbols(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    const char *query = json_text(request->params, "query");
    size_t count = 0;
    json_open(result, NULL, "[");
    Workspace workspace;
    workspace_open_all(&workspace, request->server);
    for (size_t file = 0; file < workspace.count; file++) {
        const Document *document = workspace.documents[file];
        for (size_t i = 0; i < document->name_count && count < MAX_SYMBOLS; i++) {
            const PetriBinding *name = &document->names[i];
            int kind = symbol_kind(document, name);
            Str text = document_slice(document, name->start, name->end);
            if (kind == 0 || kind == AS_MODULE || !matches(text, query ? query : ""))
                continue;
            json_open(result, NULL, "{");
            json_put_str(result, "name", text);
            json_put_integer(result, "kind", kind);
            json_open(result, "location", "{");
            json_put_text(result, "uri", document->uri);
            document_put_range(result, "range", document, name->start, name->end, request->server->utf8);
            json_close(result, "}}");
            count++;
        }
    }
    workspace_close(&workspace);
    json_close(result, "]");
}

// --- folding

static void add_fold(JsonWriter *list, size_t first, size_t last, const char *kind) {
    if (last <= first)
        return;
    json_open(list, NULL, "{");
    json_put_integer(list, "startLine", (int64_t)first);
    json_put_integer(list, "endLine", (int64_t)last);
    if (kind)
        json_put_text(list, "kind", kind);
    json_close(list, "}");
}

void answer_folding(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    const Document *document = request->document;
    json_open(result, NULL, "[");
    size_t first = SIZE_MAX, last = 0; // first and last line of the current run of consecutive comment lines
    for (size_t i = 0; i <= document->token_count; i++) {
        bool comment = i < document->token_count && document->tokens[i].kind == PETRI_TOKEN_COMMENT;
        size_t line = 0, end = 0, character, column;
        if (i < document->token_count)
            document_position(document, document->tokens[i].start, true, &line, &column);
        if (first != SIZE_MAX && (!comment || line != last + 1)) {
            add_fold(result, first, last, "comment");
            first = SIZE_MAX;
        }
        bool alone = comment && (i == 0 || memchr(document->text.bytes + document->tokens[i - 1].end, '\n',
                                                  document->tokens[i].start - document->tokens[i - 1].end));
        if (alone) {
            first = first == SIZE_MAX ? line : first;
            last = line;
        }
        if (i < document->token_count && !comment && document_begins(document, i)) {
            document_position(document, document_block_end(document, i), true, &end, &character);
            add_fold(result, line, end, NULL);
        }
    }
    json_close(result, "]");
}

// --- semantic tokens

typedef enum Class {
    CLASS_KEYWORD,
    CLASS_COMMENT,
    CLASS_STRING,
    CLASS_NUMBER,
    CLASS_OPERATOR,
    CLASS_VARIABLE,
    CLASS_PARAMETER,
    CLASS_FUNCTION,
    CLASS_PROPERTY,
    CLASS_NODE,
    CLASS_SYMBOL,
    CLASS_TAG,
    CLASS_NONE,
} Class;
enum { IS_DECLARATION = 1, IS_BUILT_IN = 2 };

void tokens_put_legend(JsonWriter *json) {
    json_open(json, "legend", "{");
    JSON_PUT_ARRAY(json, "tokenTypes", "keyword", "comment", "string", "number", "operator", "variable", "parameter",
                   "function", "property", "class", "enumMember", "decorator");
    JSON_PUT_ARRAY(json, "tokenModifiers", "declaration", "defaultLibrary");
    json_close(json, "}");
}

static Class class_of_name(const Document *document, size_t token, int *modifiers) {
    const PetriBinding *name = document_name_at(document, document->tokens[token].start);
    if (!name)
        return CLASS_PROPERTY; // the name of an attribute or argument
    const PetriBinding *bound = document_binding(document, name);
    PetriBuiltin builtin;
    if (!bound) {
        *modifiers = IS_BUILT_IN;
        return topic_find_builtin(document_token(document, token), &builtin) ? CLASS_FUNCTION : CLASS_VARIABLE;
    }
    *modifiers = bound == name ? IS_DECLARATION : 0;
    return bound->kind == PETRI_NAME_FUNC        ? CLASS_FUNCTION
           : bound->kind == PETRI_NAME_PARAMETER ? CLASS_PARAMETER
                                                 : CLASS_VARIABLE;
}

static Class class_of(const Document *document, size_t token, int *modifiers) {
    static const Class classes[] = {
        [PETRI_TOKEN_KEYWORD] = CLASS_KEYWORD,   [PETRI_TOKEN_NUMBER] = CLASS_NUMBER,
        [PETRI_TOKEN_STRING] = CLASS_STRING,     [PETRI_TOKEN_SYMBOL] = CLASS_SYMBOL,
        [PETRI_TOKEN_NODE] = CLASS_NODE,         [PETRI_TOKEN_TAG] = CLASS_TAG,
        [PETRI_TOKEN_OPERATOR] = CLASS_OPERATOR, [PETRI_TOKEN_COMMENT] = CLASS_COMMENT,
        [PETRI_TOKEN_INVALID] = CLASS_NONE,
    };
    *modifiers = 0;
    return document->tokens[token].kind == PETRI_TOKEN_NAME ? class_of_name(document, token, modifiers)
                                                            : classes[document->tokens[token].kind];
}

// Encodes each token as five numbers: line and character relative to the previous token, length, class, modifiers. If
// the previous token is in another line, the character counts from the start of the line.
typedef struct Encoder {
    JsonWriter *data;
    size_t line;
    size_t character;
} Encoder;

static void add_number(Encoder *encoder, size_t number) {
    json_put_integer(encoder->data, NULL, (int64_t)number);
}

// Encodes a token, with one entry per line, because tokens of the protocol must not span several lines.
static void encode(Encoder *encoder, const RequestContext *request, const PetriToken *token, Class class,
                   int modifiers) {
    const Document *document = request->document;
    for (size_t start = token->start, end; start < token->end; start = end + 1) {
        Str rest = document_slice(document, start, token->end);
        const char *stop = memchr(rest.bytes, '\n', rest.len);
        end = !stop ? token->end : start + (size_t)(stop - rest.bytes);
        size_t line, character, last_line, last;
        document_position(document, start, request->server->utf8, &line, &character);
        document_position(document, end, request->server->utf8, &last_line, &last);
        if (end == start)
            continue;
        add_number(encoder, line - encoder->line);
        add_number(encoder, line == encoder->line ? character - encoder->character : character);
        add_number(encoder, last - character);
        add_number(encoder, (size_t) class);
        add_number(encoder, (size_t)modifiers);
        encoder->line = line;
        encoder->character = character;
    }
}

void answer_tokens(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    const Document *document = request->document;
    Encoder encoder = {.data = result};
    json_open(result, NULL, "{");
    json_open(result, "data", "[");
    for (size_t i = 0; i < document->token_count; i++) {
        int modifiers;
        Class class = class_of(document, i, &modifiers);
        if (class != CLASS_NONE)
            encode(&encoder, request, &document->tokens[i], class, modifiers);
    }
    json_close(result, "]}");
}
