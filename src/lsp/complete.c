// complete.c: what may go on at a place: names, functions, nodes, attributes, keys, files; and the parameters of calls.
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include "base/source.h"
#include "cli/help.h"
#include "lsp/workspace.h"

// Kinds of the protocol.
enum {
    AS_FUNCTION = 3,
    AS_FIELD = 5,
    AS_VARIABLE = 6,
    AS_CLASS = 7,
    AS_KEYWORD = 14,
    AS_FILE = 17,
    AS_FOLDER = 19,
    AS_ENUM = 20,
    AS_CONSTANT = 21
};

// One list of items. What replaces the word that is begun is the label, or `insert`.
typedef struct Offer {
    const Place *place;
    Json *items;
    size_t start;    // of the word
    TextList labels; // so far
} Offer;

static Json *offer(Offer *all, const char *label, int kind, const char *insert, char order) {
    if (texts_hold(&all->labels, label)) {
        return NULL;
    }
    texts_add(&all->labels, label);
    Json *item = json_put_number(json_put_text(json_object_new_object(), "label", label), "kind", kind);
    Json *edit =
        json_put(json_object_new_object(), "range",
                 document_range(all->place->document, all->start, all->place->offset, all->place->server->utf8));
    json_put(item, "textEdit", json_put_text(edit, "newText", insert));
    json_put_text(item, "filterText", insert);
    SCOPED_BYTES sort = {0};
    bytes_format(&sort, "%c%s", order, label);
    json_put_text(item, "sortText", sort.data);
    json_object_array_add(all->items, item);
    return item;
}

static void detail(Json *item, const char *text, const char *help) {
    if (item != NULL && text[0] != '\0') {
        json_put_text(item, "detail", text);
    }
    if (item != NULL && help[0] != '\0') {
        json_put(item, "documentation", json_markdown(help));
    }
}

static void offer_kinds(Offer *all) {
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        SCOPED_BYTES label = {0};
        bytes_format(&label, "!%s", kind.name);
        detail(offer(all, label.data, AS_CLASS, label.data, 'a'), kind.area, kind.help);
    }
}

static void offer_attributes(Offer *all, size_t kind) {
    PetriNodeAttribute attribute;
    for (size_t i = 0; kind != SIZE_MAX && petri_node_attribute(kind, i, &attribute); i++) {
        SCOPED_BYTES label = {0};
        SCOPED_BYTES help = {0};
        bytes_format(&label, "%s=", attribute.name);
        explain_attribute(&help, &attribute);
        detail(offer(all, label.data, AS_FIELD, label.data, 'a'), attribute.type, help.data);
    }
}

static void offer_keywords(Offer *all, const char *list) {
    SCOPED_TEXT copy = memory_text(list);
    char *rest = copy;
    for (char *word = strsep(&rest, " "); word != NULL; word = strsep(&rest, " ")) {
        offer(all, word, AS_KEYWORD, word, 'd');
    }
}

static void offer_name(Offer *all, Document *document, const PetriTextName *name) {
    SCOPED_TEXT label = memory_copied(document->text.data + name->start, name->end - name->start);
    SCOPED_BYTES help = {0};
    Json *item = offer(all, label, name->kind == PETRI_NAME_FUNC ? AS_FUNCTION : AS_VARIABLE, label, 'b');
    if (item != NULL) {
        explain_binding(&help, all->place->server, document, name);
        detail(item, "", help.data);
    }
}

// What the scripts bind that include this one, where they do.
static void offer_around(Offer *all) {
    Workspace workspace;
    workspace_open(&workspace, all->place->server, all->place->document, false);
    for (size_t i = 1; i < workspace.count; i++) {
        Document *document = workspace.documents[i];
        for (size_t k = 0; k < document->link_count; k++) {
            const Link *link = &document->links[k];
            for (size_t n = 0; link->include && link->target == 0 && n < document->name_count; n++) {
                const PetriTextName *name = &document->names[n];
                if (workspace_visible(document, link, document_part(document, name->start, name->end)) == name) {
                    offer_name(all, document, name);
                }
            }
        }
    }
    workspace_close(&workspace);
}

static void offer_names(Offer *all) {
    Document *document = all->place->document;
    PetriBuiltin builtin;
    for (size_t i = document->name_count; i > 0; i--) { // the innermost of a name is the last
        const PetriTextName *name = &document->names[i - 1];
        bool seen = name->kind != PETRI_NAME_USE && name->scope_start <= all->place->offset &&
                    all->place->offset <= name->scope_end;
        if (seen) {
            offer_name(all, document, name);
        }
    }
    offer_around(all);
    for (size_t i = 0; petri_builtin(i, &builtin); i++) {
        SCOPED_BYTES head = {0};
        bytes_format(&head, "%s(%s)", builtin.name, builtin.parameters);
        detail(offer(all, builtin.name, AS_FUNCTION, builtin.name, 'c'), head.data, builtin.help);
    }
    for (size_t i = 0; TOPICS[i].word != NULL && strcmp(TOPICS[i].word, "let") != 0; i++) {
        detail(offer(all, TOPICS[i].word, AS_CONSTANT, TOPICS[i].word, 'c'), "", TOPICS[i].help);
    }
}

// The symbols of a script; with `keys` those under which its systems write their state, and what it looks up already.
static void offer_symbols(Offer *all, bool keys) {
    const Document *document = all->place->document;
    for (size_t i = 0; i < document->token_count; i++) {
        if (document->tokens[i].kind != PETRI_TOKEN_SYMBOL || document->tokens[i].start == all->start) {
            continue;
        }
        Str text = document_token(document, i);
        SCOPED_TEXT label = memory_copied(text.bytes, text.len);
        bool writes = i >= 2 && document_is(document, i - 1, "=") && document_is(document, i - 2, "state");
        bool reads = i > 0 && (document_is(document, i - 1, "$") ||
                               (i > 1 && document_is(document, i - 2, "$") && document_is(document, i - 1, "(")));
        if (!keys || writes || reads) {
            detail(offer(all, label, AS_CONSTANT, label, writes ? 'a' : 'b'), writes ? "key of a system" : "", "");
        }
    }
}

// The words that an attribute takes stand in its type: ":butt, :round or :square".
static void offer_choices(Offer *all, size_t token) {
    const Document *document = all->place->document;
    const char *node;
    size_t kind =
        token >= 2 && document_is(document, token - 1, "=") ? explain_node_of(document, token - 2, &node) : SIZE_MAX;
    PetriNodeAttribute attribute;
    for (size_t k = 0; kind != SIZE_MAX && petri_node_attribute(kind, k, &attribute); k++) {
        if (!str_equal(document_token(document, token - 2), str_from(attribute.name))) {
            continue;
        }
        for (const char *at = strchr(attribute.type, ':'); at != NULL; at = strchr(at + 1, ':')) {
            SCOPED_TEXT word = memory_copied(at, 1 + strspn(at + 1, "abcdefghijklmnopqrstuvwxyz_0123456789"));
            offer(all, word, AS_ENUM, word, 'a');
        }
    }
}

static void offer_files(Offer *all, size_t string) {
    const Document *document = all->place->document;
    Str typed = document_part(document, string + 1, all->place->offset), folder = path_directory(typed);
    SCOPED_BYTES path = {0};
    Str own = path_directory(str_from(document->path));
    bytes_add(&path, own.bytes, folder.len > 0 && folder.bytes[0] == '/' ? 0 : own.len);
    bytes_add(&path, folder.bytes, folder.len);
    bytes_add_text(&path, path.length == 0 ? "." : "");
    all->start = string + 1 + folder.len;
    DIR *entries = document->is_file ? opendir(path.data) : NULL;
    for (struct dirent *entry = entries == NULL ? NULL : readdir(entries); entry != NULL; entry = readdir(entries)) {
        if (entry->d_name[0] != '.' && utf8_find_error(str_from(entry->d_name)) == strlen(entry->d_name)) {
            offer(all, entry->d_name, entry->d_type == DT_DIR ? AS_FOLDER : AS_FILE, entry->d_name, 'a');
        }
    }
    if (entries != NULL) {
        closedir(entries);
    }
}

// The bracket around an offset that a name stands before, as in a call; SIZE_MAX if there is none. Counts commas.
static size_t call_around(const Document *document, size_t offset, size_t *commas) {
    size_t depth = 0;
    *commas = 0;
    for (size_t i = document_token_at(document, offset > 0 ? offset - 1 : 0) + 1; i > 0; i--) {
        if (i > document->token_count || document->tokens[i - 1].end > offset) {
            continue;
        }
        if (document_is(document, i - 1, ")") || document_is(document, i - 1, "]")) {
            depth++;
        } else if (document_is(document, i - 1, "(") || document_is(document, i - 1, "[")) {
            bool call = document_is(document, i - 1, "(") && i > 1 && document->tokens[i - 2].kind == PETRI_TOKEN_NAME;
            if (depth == 0 && call) {
                return i - 2;
            }
            *commas = depth == 0 ? 0 : *commas; // what is within other brackets
            depth -= depth > 0;
        } else if (document_is(document, i - 1, ",") && depth == 0) {
            ++*commas;
        }
        if (document_begins(document, i - 1) && depth == 0) {
            break;
        }
    }
    return SIZE_MAX;
}

// The parameters of the function that a name stands for, without brackets; its help goes to `help`.
static bool parameters_of(const Place *place, size_t token, Bytes *out, Bytes *help) {
    Workspace workspace;
    workspace_open(&workspace, place->server, place->document, false);
    Senses meant = workspace_meaning(&workspace, token);
    PetriBuiltin builtin;
    if (meant.count > 0) {
        Document *owner = workspace.documents[meant.items[0].file];
        const PetriTextName *bound = workspace_name(&workspace, meant.items[0]);
        Str value = document_part(owner, bound->value_start, bound->value_end);
        const char *open = str_starts_with(value, STR("func")) ? memchr(value.bytes, '(', value.len) : NULL;
        size_t length = 0, depth = 0;
        for (const char *c = open; c != NULL && c < value.bytes + value.len; c++) {
            depth += *c == '(';
            depth -= *c == ')';
            if (depth == 0) {
                length = (size_t)(c - open);
                break;
            }
        }
        if (length > 0) {
            bytes_add(out, open + 1, length - 1);
            explain_binding(help, place->server, owner, bound);
        }
    } else if (explain_builtin(document_token(place->document, token), &builtin)) {
        bytes_add_text(out, builtin.parameters);
        bytes_add_text(help, builtin.help);
    }
    workspace_close(&workspace);
    return help->length > 0;
}

static void offer_arguments(Offer *all) {
    size_t commas, callee = call_around(all->place->document, all->start, &commas);
    SCOPED_BYTES parameters = {0};
    SCOPED_BYTES help = {0};
    if (callee == SIZE_MAX || !parameters_of(all->place, callee, &parameters, &help) || parameters.data == NULL) {
        return;
    }
    char *rest = parameters.data;
    for (char *word = strsep(&rest, ","); word != NULL; word = strsep(&rest, ",")) {
        word += strspn(word, " \n");
        word[strcspn(word, "= \n")] = '\0';
        SCOPED_BYTES label = {0};
        bytes_format(&label, "%s=", word);
        if (word[0] != '\0' && word[0] != '.') {
            detail(offer(all, label.data, AS_FIELD, label.data, 'a'), "parameter", "");
        }
    }
}

static bool ends_operand(const Document *document, size_t token) {
    PetriTokenKind kind = document->tokens[token].kind;
    return kind <= PETRI_TOKEN_TAG ? kind != PETRI_TOKEN_KEYWORD
                                   : document_is(document, token, ")") || document_is(document, token, "]");
}

// What may stand at the token, of which so much is written.
static void offer_all(Offer *all, size_t token, bool first) {
    const Document *document = all->place->document;
    const char *node;
    bool behind = token > 0 && !first && document->tokens[token - 1].kind != PETRI_TOKEN_COMMENT;
    if (behind && document_is(document, token - 1, "$")) {
        offer_symbols(all, true);
        return;
    }
    if (behind && ends_operand(document, token - 1)) { // an attribute, or a word that goes on
        offer_attributes(all, explain_node_of(document, token, &node));
        offer_keywords(all, "for if else in where and or xor");
        return;
    }
    if (behind && document_is(document, token - 1, "=")) {
        offer_choices(all, token);
    }
    if (behind && (document_is(document, token - 1, "(") || document_is(document, token - 1, ","))) {
        offer_arguments(all);
    }
    offer_names(all);
    offer_keywords(all, first ? "let func import for if elif else not" : "not func");
    if (first) {
        offer_kinds(all);
    }
}

Json *answer_completion(const Place *place, const char **problem) {
    (void)problem;
    const Document *document = place->document;
    Offer all = {.place = place, .items = json_object_new_array(), .start = place->offset};
    size_t at = place->offset > 0 ? document_token_at(document, place->offset - 1) : document->token_count;
    bool within = at < document->token_count && document->tokens[at].start < place->offset;
    PetriTokenKind kind = within ? document->tokens[at].kind : PETRI_TOKEN_OPERATOR;
    Str text = within ? document_token(document, at) : (Str){"", 0};
    bool word = within && (kind == PETRI_TOKEN_NAME || kind == PETRI_TOKEN_KEYWORD);
    if (within && kind != PETRI_TOKEN_OPERATOR) {
        all.start = document->tokens[at].start;
    }
    size_t token = within && !word && kind == PETRI_TOKEN_OPERATOR ? at + 1 : at;
    char c = text.len > 0 ? text.bytes[0] : ' ';
    if (kind == PETRI_TOKEN_NODE || (kind == PETRI_TOKEN_WRONG && c == '!')) {
        offer_kinds(&all);
    } else if (kind == PETRI_TOKEN_SYMBOL || (kind == PETRI_TOKEN_WRONG && c == ':')) {
        offer_choices(&all, at);
        offer_symbols(&all, at > 0 && document_is(document, at - 1, "$"));
        offer_symbols(&all, false);
    } else if (kind == PETRI_TOKEN_STRING || (kind == PETRI_TOKEN_WRONG && (c == '\'' || c == '"'))) {
        offer_files(&all, document->tokens[at].start);
    } else if (kind != PETRI_TOKEN_COMMENT && kind != PETRI_TOKEN_NUMBER) {
        bool line = true; // nothing but blanks stands before it in its line
        for (size_t i = all.start; i > 0 && document->text.data[i - 1] != '\n'; i--) {
            line = line && strchr(" \t", document->text.data[i - 1]) != NULL;
        }
        offer_all(&all, token, line);
    }
    texts_free(&all.labels);
    return all.items;
}

Json *answer_signature(const Place *place, const char **problem) {
    (void)problem;
    SCOPED_BYTES parameters = {0};
    SCOPED_BYTES help = {0};
    SCOPED_BYTES label = {0};
    size_t commas, callee = call_around(place->document, place->offset, &commas);
    if (callee == SIZE_MAX || !parameters_of(place, callee, &parameters, &help)) {
        return NULL;
    }
    Str name = document_token(place->document, callee);
    bytes_format(&label, "%.*s(%s)", STR_ARGS(name), parameters.data == NULL ? "" : parameters.data);
    Json *list = json_object_new_array(), *signature = json_put_text(json_object_new_object(), "label", label.data);
    char *rest = parameters.data;
    for (char *word = strsep(&rest, ","); word != NULL; word = strsep(&rest, ",")) {
        word += strspn(word, " \n");
        json_object_array_add(list, json_put_text(json_object_new_object(), "label", word));
    }
    json_put(json_put(signature, "documentation", json_markdown(help.data)), "parameters", list);
    Json *signatures = json_object_new_array();
    json_object_array_add(signatures, signature);
    Json *result = json_put(json_object_new_object(), "signatures", signatures);
    return json_put_number(json_put_number(result, "activeSignature", 0), "activeParameter", (int64_t)commas);
}
