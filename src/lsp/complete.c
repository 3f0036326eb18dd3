// complete.c: completion of names, functions, nodes, attributes, keys and files; signature help for calls.
#include "base/source.h"
#include "cli/help.h"
#include "lsp/workspace.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// CompletionItemKind of the protocol.
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

// A list of completion items.
typedef struct Offer {
    const RequestContext *request;
    JsonWriter *items;
    size_t start;    // offset of the word being completed
    TextList labels; // labels added so far
} Offer;

// Begins an item that replaces the word with its label. `order` is the first character of the item's sort key. Returns
// false if there is already an item with this label. Otherwise, end_candidate must follow.
static bool begin_candidate(Offer *all, const char *label, int kind, char order) {
    const RequestContext *request = all->request;
    JsonWriter *json = all->items;
    if (texts_contain(&all->labels, label))
        return false;
    texts_add(&all->labels, label);
    json_open(json, NULL, "{");
    json_put_text(json, "label", label);
    json_put_integer(json, "kind", kind);
    request_put_edit(json, "textEdit", request, all->start, request->offset, str_from(label));
    json_put_text(json, "filterText", label);
    SCOPED_TEXT sort = {0};
    text_add_format(&sort, "%c%s", order, label);
    json_put_text(json, "sortText", sort.bytes);
    return true;
}

static void end_candidate(Offer *all, const char *detail, const char *help) {
    if (detail[0] != '\0')
        json_put_text(all->items, "detail", detail);
    if (help[0] != '\0')
        JSON_PUT_OBJECT(all->items, "documentation", "kind", "markdown", "value", help);
    json_close(all->items, "}");
}

static void add_candidate(Offer *all, const char *label, int kind, char order, const char *detail, const char *help) {
    if (begin_candidate(all, label, kind, order))
        end_candidate(all, detail, help);
}

static void offer_kinds(Offer *all) {
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        SCOPED_TEXT label = {0};
        text_add_format(&label, "!%s", kind.name);
        add_candidate(all, label.bytes, AS_CLASS, 'a', kind.area, kind.help);
    }
}

static void offer_attributes(Offer *all, size_t kind) {
    PetriNodeAttribute attribute;
    for (size_t i = 0; kind != SIZE_MAX && petri_node_attribute(kind, i, &attribute, sizeof attribute); i++) {
        SCOPED_TEXT label = {0};
        SCOPED_TEXT help = {0};
        text_add_format(&label, "%s=", attribute.name);
        hover_attribute(&help, &attribute);
        add_candidate(all, label.bytes, AS_FIELD, 'a', attribute.type, help.bytes);
    }
}

static void offer_keywords(Offer *all, const char *list) {
    SCOPED_STRING copy = memory_strdup(list);
    char *rest = copy;
    for (char *word = str_split(&rest, ' '); word; word = str_split(&rest, ' '))
        add_candidate(all, word, AS_KEYWORD, 'd', "", "");
}

static void offer_name(Offer *all, Document *document, const PetriBinding *name) {
    SCOPED_STRING label = memory_strndup(document->text.bytes + name->start, name->end - name->start);
    SCOPED_TEXT help = {0};
    if (begin_candidate(all, label, name->kind == PETRI_NAME_FUNC ? AS_FUNCTION : AS_VARIABLE, 'b')) {
        hover_binding(&help, all->request->server, document, name);
        end_candidate(all, "", help.bytes);
    }
}

// Offers names from the scripts that include this script: the names that are visible at the include.
static void offer_around(Offer *all) {
    Workspace workspace;
    workspace_open(&workspace, all->request->server, all->request->document, false);
    for (size_t i = 1; i < workspace.count; i++) {
        Document *document = workspace.documents[i];
        for (size_t k = 0; k < document->link_count; k++) {
            const Link *link = &document->links[k];
            for (size_t n = 0; link->include && link->target == 0 && n < document->name_count; n++) {
                const PetriBinding *name = &document->names[n];
                if (workspace_visible(document, link, document_slice(document, name->start, name->end)) == name)
                    offer_name(all, document, name);
            }
        }
    }
    workspace_close(&workspace);
}

static void offer_names(Offer *all) {
    Document *document = all->request->document;
    PetriBuiltin builtin;
    for (size_t i = document->name_count; i > 0;
         i--) { // backwards: a name is added only once, and its last binding is the innermost
        const PetriBinding *name = &document->names[i - 1];
        bool seen = name->kind != PETRI_NAME_USE && name->scope_start <= all->request->offset &&
                    all->request->offset <= name->scope_end;
        if (seen)
            offer_name(all, document, name);
    }
    offer_around(all);
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++) {
        SCOPED_TEXT head = {0};
        text_add_format(&head, "%s(%s)", builtin.name, builtin.parameters);
        add_candidate(all, builtin.name, AS_FUNCTION, 'c', head.bytes, builtin.help);
    }
    for (size_t i = 0; TOPICS[i].word && strcmp(TOPICS[i].word, "let") != 0; i++)
        add_candidate(all, TOPICS[i].word, AS_CONSTANT, 'c', "", TOPICS[i].help);
}

// Offers the symbols in the script. If `keys` is true, offers only the state keys of systems and symbols that are
// looked up in the state.
static void offer_symbols(Offer *all, bool keys) {
    const Document *document = all->request->document;
    for (size_t i = 0; i < document->token_count; i++) {
        if (document->tokens[i].kind != PETRI_TOKEN_SYMBOL || document->tokens[i].start == all->start)
            continue;
        Str text = document_token(document, i);
        SCOPED_STRING label = memory_strndup(text.bytes, text.len);
        bool writes = i >= 2 && document_is(document, i - 1, "=") && document_is(document, i - 2, "state");
        bool reads = i > 0 && (document_is(document, i - 1, "$") ||
                               (i > 1 && document_is(document, i - 2, "$") && document_is(document, i - 1, "(")));
        if (!keys || writes || reads)
            add_candidate(all, label, AS_CONSTANT, writes ? 'a' : 'b', writes ? "key of a system" : "", "");
    }
}

// Offers the symbols that an attribute accepts. They are listed in its type, such as ":butt, :round or :square".
static void offer_choices(Offer *all, size_t token) {
    const Document *document = all->request->document;
    const char *node;
    size_t kind =
        token >= 2 && document_is(document, token - 1, "=") ? hover_node_of(document, token - 2, &node) : SIZE_MAX;
    PetriNodeAttribute attribute;
    for (size_t k = 0; kind != SIZE_MAX && petri_node_attribute(kind, k, &attribute, sizeof attribute); k++) {
        if (!str_equal(document_token(document, token - 2), str_from(attribute.name)))
            continue;
        for (const char *at = strchr(attribute.type, ':'); at; at = strchr(at + 1, ':')) {
            SCOPED_STRING word = memory_strndup(at, 1 + strspn(at + 1, "abcdefghijklmnopqrstuvwxyz_0123456789"));
            add_candidate(all, word, AS_ENUM, 'a', "", "");
        }
    }
}

static void offer_files(Offer *all, size_t string) {
    const Document *document = all->request->document;
    Str typed = document_slice(document, string + 1, all->request->offset), folder = path_directory(typed);
    SCOPED_TEXT path = {0};
    Str own = path_directory(str_from(document->path));
    text_add(&path, (Str){own.bytes, folder.len > 0 && folder.bytes[0] == '/' ? 0 : own.len});
    text_add(&path, folder);
    text_add_c(&path, path.len == 0 ? "." : "");
    all->start = string + 1 + folder.len;
    DIR *entries = document->is_file ? opendir(path.bytes) : NULL;
    for (struct dirent *entry = !entries ? NULL : readdir(entries); entry; entry = readdir(entries)) {
        struct stat status;
        if (entry->d_name[0] == '.' || utf8_find_error(str_from(entry->d_name)) != strlen(entry->d_name))
            continue;
        bool folder_found = fstatat(dirfd(entries), entry->d_name, &status, 0) == 0 && S_ISDIR(status.st_mode);
        add_candidate(all, entry->d_name, folder_found ? AS_FOLDER : AS_FILE, 'a', "", "");
    }
    if (entries)
        closedir(entries);
}

// Finds the call whose argument list contains an offset. Returns the token of the function's name, or SIZE_MAX if there
// is no such call. Sets *commas to the number of commas between arguments that precede the offset.
static size_t call_around(const Document *document, size_t offset, size_t *commas) {
    size_t depth = 0;
    *commas = 0;
    for (size_t i = document_token_at(document, offset > 0 ? offset - 1 : 0) + 1; i > 0; i--) {
        if (i > document->token_count || document->tokens[i - 1].end > offset)
            continue;
        if (document_is(document, i - 1, ")") || document_is(document, i - 1, "]")) {
            depth++;
        } else if (document_is(document, i - 1, "(") || document_is(document, i - 1, "[")) {
            bool call = document_is(document, i - 1, "(") && i > 1 && document->tokens[i - 2].kind == PETRI_TOKEN_NAME;
            if (depth == 0 && call)
                return i - 2;
            *commas = depth == 0 ? 0 : *commas; // these brackets are not a call: ignore their commas
            depth -= depth > 0;
        } else if (document_is(document, i - 1, ",") && depth == 0) {
            ++*commas;
        }
        if (document_begins(document, i - 1) && depth == 0)
            break;
    }
    return SIZE_MAX;
}

// Appends the parameters of a function, without parentheses, to `out`, and its help to `help`. Returns false if the
// name is not a function.
static bool parameters_of(const RequestContext *request, size_t token, Text *out, Text *help) {
    Workspace workspace;
    workspace_open(&workspace, request->server, request->document, false);
    BindingSet meant = workspace_resolve(&workspace, token);
    PetriBuiltin builtin;
    if (meant.count > 0) {
        Document *owner = workspace.documents[meant.items[0].file];
        const PetriBinding *bound = workspace_name(&workspace, meant.items[0]);
        Str value = document_slice(owner, bound->value_start, bound->value_end);
        const char *open = str_starts_with(value, STR("func")) ? memchr(value.bytes, '(', value.len) : NULL;
        size_t length = 0, depth = 0;
        for (const char *c = open; c && c < value.bytes + value.len; c++) {
            depth += *c == '(';
            depth -= *c == ')';
            if (depth == 0) {
                length = (size_t)(c - open);
                break;
            }
        }
        if (length > 0) {
            text_add(out, (Str){open + 1, length - 1});
            hover_binding(help, request->server, owner, bound);
        }
    } else if (topic_find_builtin(document_token(request->document, token), &builtin)) {
        text_add_c(out, builtin.parameters);
        text_add_c(help, builtin.help);
    }
    workspace_close(&workspace);
    return help->len > 0;
}

static void offer_arguments(Offer *all) {
    size_t commas, callee = call_around(all->request->document, all->start, &commas);
    SCOPED_TEXT parameters = {0};
    SCOPED_TEXT help = {0};
    if (callee == SIZE_MAX || !parameters_of(all->request, callee, &parameters, &help) || !parameters.bytes)
        return;
    char *rest = parameters.bytes;
    for (char *word = str_split(&rest, ','); word; word = str_split(&rest, ',')) {
        word += strspn(word, " \n");
        word[strcspn(word, "= \n")] = '\0';
        SCOPED_TEXT label = {0};
        text_add_format(&label, "%s=", word);
        if (word[0] != '\0' && word[0] != '.')
            add_candidate(all, label.bytes, AS_FIELD, 'a', "parameter", "");
    }
}

static bool ends_operand(const Document *document, size_t token) {
    PetriTokenKind kind = document->tokens[token].kind;
    return kind <= PETRI_TOKEN_TAG ? kind != PETRI_TOKEN_KEYWORD
                                   : document_is(document, token, ")") || document_is(document, token, "]");
}

// Offers everything that the grammar allows at the token. `first`: true if only blanks precede the token in its line.
static void offer_all(Offer *all, size_t token, bool first) {
    const Document *document = all->request->document;
    const char *node;
    bool after_token = token > 0 && !first && document->tokens[token - 1].kind != PETRI_TOKEN_COMMENT;
    if (after_token && document_is(document, token - 1, "$")) {
        offer_symbols(all, true);
        return;
    }
    if (after_token && ends_operand(document, token - 1)) { // only an attribute or an operator word can follow
        offer_attributes(all, hover_node_of(document, token, &node));
        offer_keywords(all, "for if else in where and or xor");
        return;
    }
    if (after_token && document_is(document, token - 1, "="))
        offer_choices(all, token);
    if (after_token && (document_is(document, token - 1, "(") || document_is(document, token - 1, ",")))
        offer_arguments(all);
    offer_names(all);
    offer_keywords(all, first ? "let func import for if elif else not" : "not func");
    if (first)
        offer_kinds(all);
}

void answer_completion(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    const Document *document = request->document;
    Offer all = {.request = request, .items = result, .start = request->offset};
    json_open(result, NULL, "[");
    size_t at = request->offset > 0 ? document_token_at(document, request->offset - 1) : document->token_count;
    bool within = at < document->token_count && document->tokens[at].start < request->offset;
    PetriTokenKind kind = within ? document->tokens[at].kind : PETRI_TOKEN_OPERATOR;
    Str text = within ? document_token(document, at) : (Str){"", 0};
    bool word = within && (kind == PETRI_TOKEN_NAME || kind == PETRI_TOKEN_KEYWORD);
    if (within && kind != PETRI_TOKEN_OPERATOR)
        all.start = document->tokens[at].start;
    size_t token = within && !word && kind == PETRI_TOKEN_OPERATOR ? at + 1 : at;
    char c = text.len > 0 ? text.bytes[0] : ' ';
    if (kind == PETRI_TOKEN_NODE || (kind == PETRI_TOKEN_INVALID && c == '!')) {
        offer_kinds(&all);
    } else if (kind == PETRI_TOKEN_SYMBOL || (kind == PETRI_TOKEN_INVALID && c == ':')) {
        offer_choices(&all, at);
        offer_symbols(&all, at > 0 && document_is(document, at - 1, "$"));
        offer_symbols(&all, false);
    } else if (kind == PETRI_TOKEN_STRING || (kind == PETRI_TOKEN_INVALID && (c == '\'' || c == '"'))) {
        offer_files(&all, document->tokens[at].start);
    } else if (kind != PETRI_TOKEN_COMMENT && kind != PETRI_TOKEN_NUMBER) {
        bool line = true; // true if only blanks precede the word in its line
        for (size_t i = all.start; i > 0 && document->text.bytes[i - 1] != '\n'; i--)
            line = line && strchr(" \t", document->text.bytes[i - 1]);
        offer_all(&all, token, line);
    }
    texts_free(&all.labels);
    json_close(result, "]");
}

void answer_signature(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    SCOPED_TEXT parameters = {0};
    SCOPED_TEXT help = {0};
    SCOPED_TEXT label = {0};
    size_t commas, callee = call_around(request->document, request->offset, &commas);
    if (callee == SIZE_MAX || !parameters_of(request, callee, &parameters, &help))
        return;
    Str name = document_token(request->document, callee);
    text_add_format(&label, "%.*s(%s)", STR_ARGS(name), !parameters.bytes ? "" : parameters.bytes);
    json_open(result, NULL, "{");
    json_open(result, "signatures", "[{");
    json_put_text(result, "label", label.bytes);
    JSON_PUT_OBJECT(result, "documentation", "kind", "markdown", "value", help.bytes);
    json_open(result, "parameters", "[");
    char *rest = parameters.bytes;
    for (char *word = str_split(&rest, ','); word; word = str_split(&rest, ',')) {
        word += strspn(word, " \n");
        JSON_PUT_OBJECT(result, NULL, "label", word);
    }
    json_close(result, "]}]");
    json_put_integer(result, "activeSignature", 0);
    json_put_integer(result, "activeParameter", (int64_t)commas);
    json_close(result, "}");
}
