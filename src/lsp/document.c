// document.c: see document.h.
//
// Every change of the text makes tokens and names stale; document_read reads them again when they are needed. The text
// is valid UTF-8, and all offsets count its bytes. Only positions that are exchanged with the editor count its units.
#include "lsp/document.h"

#include "base/os.h"
#include "base/source.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

// Returns the length of a character in the editor's units: UTF-8 bytes or UTF-16 code units.
static size_t character_units(int32_t c, size_t bytes, bool utf8) {
    return utf8 ? bytes : c > 0xffff ? 2 : 1;
}

static void count_lines(Document *document) {
    Str text = {document->text.bytes, document->text.len};
    document->line_count = 1;
    for (size_t i = 0; i < text.len; i++)
        document->line_count += text.bytes[i] == '\n';
    document->lines = memory_realloc(document->lines, document->line_count * sizeof *document->lines);
    document->lines[0] = 0;
    for (size_t i = 0, line = 0; i < text.len; i++)
        if (text.bytes[i] == '\n')
            document->lines[++line] = i + 1;
}

// Appends text, replacing invalid UTF-8 by question marks. Files may contain invalid UTF-8, but JSON must not.
static void add_valid_utf8(Text *out, Str text) {
    for (size_t at = 0; at < text.len;) {
        size_t start = at;
        int32_t c = utf8_next(text, &at);
        text_add(out, (Str){c < 0 ? "?" : text.bytes + start, c < 0 ? 1 : at - start});
    }
}

static void forget_values(Document *document) {
    for (size_t i = 0; document->values && i < document->name_count; i++)
        free(document->values[i]);
    free(document->values);
    document->values = NULL;
}

static void text_changed(Document *document) {
    document->text.len = source_unify_lines(document->text.bytes, document->text.len);
    document->text.bytes[document->text.len] = '\0';
    document->unread = document->unchecked = true;
    document->exceeded = false;
    forget_values(document);
    count_lines(document);
}

static void document_set_text(Document *document, Str text) {
    document->text.len = 0;
    text_add_c(&document->text, "");
    add_valid_utf8(&document->text, text);
    text_changed(document);
}

Document *document_new(const char *uri, Str text, int64_t version) {
    Document *document = memory_calloc(sizeof *document);
    document->uri = memory_strdup(uri);
    document->path = uri_path(uri);
    document->is_file = document->path;
    document->path = document->is_file ? document->path : memory_strdup(uri);
    document->canonical = path_canonical(document->path);
    document->version = version;
    document_set_text(document, text);
    return document;
}

void diagnostic_list_free(DiagnosticList *list) {
    for (size_t i = 0; i < list->count; i++) {
        free(list->items[i].text);
        free(list->items[i].hint);
        free(list->items[i].code);
    }
    free(list->items);
}

void file_diagnostics_free(FileDiagnosticsList *list) {
    for (size_t i = 0; i < list->count; i++) {
        free(list->items[i].uri);
        texts_free(&list->items[i].items);
    }
    free(list->items);
    *list = (FileDiagnosticsList){0};
}

static void forget_links(Document *document) {
    for (size_t i = 0; i < document->link_count; i++)
        free(document->links[i].path);
    free(document->links);
    document->links = NULL;
    document->link_count = 0;
}

void document_add_failure(Document *document, uint32_t line, const char *text) {
    size_t count = document->failure_count;
    document->failures = memory_realloc(document->failures, (count + 1) * sizeof *document->failures);
    document->failures[count] = (DocumentFailure){.line = line, .text = memory_strdup(text)};
    document->failure_count++;
}

void document_clear_failures(Document *document) {
    for (size_t i = 0; i < document->failure_count; i++)
        free(document->failures[i].text);
    free(document->failures);
    document->failures = NULL;
    document->failure_count = 0;
}

void document_free(Document *document) {
    document_clear_failures(document);
    diagnostic_list_free(&document->diagnostics);
    file_diagnostics_free(&document->published);
    forget_links(document);
    forget_values(document);
    texts_free(&document->used);
    free(document->uri);
    free(document->path);
    free(document->canonical);
    free(document->lines);
    free(document->tokens);
    free(document->levels);
    free(document->names);
    text_free(&document->text);
    free(document);
}

void document_change(Document *document, const Json *change, bool utf8) {
    const char *text = json_text(change, "text");
    const Json *range = json_get(change, "range");
    if (!text)
        return;
    if (!range) {
        document_set_text(document, str_from(text));
        return;
    }
    size_t start = document_offset(document, json_get(range, "start"), utf8);
    size_t end = document_offset(document, json_get(range, "end"), utf8);
    Text old = document->text;
    document->text = (Text){0};
    text_add(&document->text, (Str){old.bytes, start < end ? start : end});
    text_add_c(&document->text, text);
    text_add(&document->text, (Str){old.bytes + (start < end ? end : start), old.len - (start < end ? end : start)});
    text_free(&old);
    text_changed(document);
}

typedef struct Reading {
    Document *document;
    size_t capacity;
    size_t level;
    bool begins;
} Reading;

static void add_token(void *user_data, const PetriToken *token) {
    Reading *reading = user_data;
    Document *document = reading->document;
    switch (token->kind) {
    case PETRI_TOKEN_NEWLINE:
        reading->begins = true;
        return;
    case PETRI_TOKEN_INDENT:
        reading->level++;
        return;
    case PETRI_TOKEN_DEDENT:
        reading->level -= reading->level > 0;
        return;
    default:
        break;
    }
    if (document->token_count == reading->capacity) {
        reading->capacity = reading->capacity == 0 ? 256 : 2 * reading->capacity;
        document->tokens = memory_realloc(document->tokens, reading->capacity * sizeof *document->tokens);
        document->levels = memory_realloc(document->levels, reading->capacity * sizeof *document->levels);
    }
    bool begins = reading->begins && token->kind != PETRI_TOKEN_COMMENT;
    document->levels[document->token_count] = begins ? SIZE_MAX - reading->level : reading->level;
    document->tokens[document->token_count++] = *token;
    reading->begins = reading->begins && !begins;
}

static void add_name(void *user_data, const PetriBinding *name) {
    Reading *reading = user_data;
    Document *document = reading->document;
    if (document->name_count == reading->capacity) {
        reading->capacity = reading->capacity == 0 ? 256 : 2 * reading->capacity;
        document->names = memory_realloc(document->names, reading->capacity * sizeof *document->names);
    }
    document->names[document->name_count++] = *name;
}

static int by_start(const void *a, const void *b) {
    const PetriBinding *first = a, *second = b;
    return first->start < second->start ? -1 : first->start > second->start;
}

// Finds the links: the strings after %include and after the `from` of an import.
static void find_links(Document *document) {
    forget_links(document);
    for (size_t i = 1; document->is_file && i < document->token_count; i++) {
        Str file = document_token(document, i);
        bool include = document_is(document, i - 1, "%include");
        if (document->tokens[i].kind != PETRI_TOKEN_STRING || file.len < 3 ||
            (!include && !document_is(document, i - 1, "from")))
            continue;
        SCOPED_TEXT path = {0};
        Str folder = path_directory(str_from(document->path));
        text_add(&path, (Str){folder.bytes, file.bytes[1] == '/' ? 0 : folder.len});
        text_add(&path, (Str){file.bytes + 1, file.len - 2});
        document->links = memory_realloc(document->links, (document->link_count + 1) * sizeof *document->links);
        document->links[document->link_count++] =
            (Link){.token = i, .include = include, .path = path_canonical(path.bytes), .target = SIZE_MAX};
    }
}

const Link *document_link(const Document *document, size_t offset) {
    for (size_t i = 0; i < document->link_count; i++) {
        const PetriToken *token = &document->tokens[document->links[i].token];
        if (token->start <= offset && offset < token->end)
            return &document->links[i];
    }
    return NULL;
}

void document_read(Document *document, PetriSession *session) {
    if (!document->unread)
        return;
    Reading tokens = {.document = document, .begins = true}, names = {.document = document};
    free(document->tokens);
    free(document->levels);
    free(document->names);
    document->tokens = NULL;
    document->levels = NULL;
    document->names = NULL;
    document->token_count = document->name_count = 0;
    petri_tokenise(session, document->text.bytes, document->text.len, add_token, &tokens);
    petri_bindings(session, document->text.bytes, document->text.len, add_name, &names);
    if (document->name_count > 0)
        qsort(document->names, document->name_count, sizeof *document->names, by_start);
    find_links(document);
    document->unread = false;
}

size_t document_offset(const Document *document, const Json *position, bool utf8) {
    int64_t line = json_integer_or(position, "line", 0), character = json_integer_or(position, "character", 0);
    if (line < 0 || (uint64_t)line >= document->line_count)
        return line < 0 ? 0 : document->text.len;
    Str text = {document->text.bytes, document->text.len};
    size_t at = document->lines[line];
    for (int64_t left = character; left > 0 && at < text.len && text.bytes[at] != '\n';) {
        size_t start = at;
        int32_t c = utf8_next(text, &at);
        left -= (int64_t)character_units(c, at - start, utf8);
    }
    return at;
}

size_t document_offset_at(const Document *document, uint32_t line, uint32_t column) {
    if (line == 0 || line > document->line_count)
        return line == 0 ? 0 : document->text.len;
    Str text = {document->text.bytes, document->text.len};
    size_t at = document->lines[line - 1];
    for (uint32_t i = 1; i < column && at < text.len && text.bytes[at] != '\n'; i++)
        utf8_next(text, &at);
    return at;
}

void document_position(const Document *document, size_t offset, bool utf8, size_t *line, size_t *character) {
    size_t low = 0, high = document->line_count - 1;
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        if (document->lines[middle] <= offset)
            low = middle;
        else
            high = middle - 1;
    }
    *line = low;
    *character = 0;
    Str text = {document->text.bytes, document->text.len};
    for (size_t at = document->lines[low]; at < offset && at < text.len;) {
        size_t start = at;
        int32_t c = utf8_next(text, &at);
        *character += character_units(c, at - start, utf8);
    }
}

void document_put_position(JsonWriter *json, const char *name, const Document *document, size_t offset, bool utf8) {
    size_t line, character;
    document_position(document, offset, utf8, &line, &character);
    json_open(json, name, "{");
    json_put_integer(json, "line", (int64_t)line);
    json_put_integer(json, "character", (int64_t)character);
    json_close(json, "}");
}

void document_put_range(JsonWriter *json, const char *name, const Document *document, size_t start, size_t end,
                        bool utf8) {
    json_open(json, name, "{");
    document_put_position(json, "start", document, start, utf8);
    document_put_position(json, "end", document, end, utf8);
    json_close(json, "}");
}

Str document_slice(const Document *document, size_t start, size_t end) {
    size_t text_length = document->text.len;
    start = start < text_length ? start : text_length;
    end = end < text_length ? end : text_length;
    return (Str){document->text.bytes + start, end > start ? end - start : 0};
}

Str document_token(const Document *document, size_t token) {
    return document_slice(document, document->tokens[token].start, document->tokens[token].end);
}

bool document_is(const Document *document, size_t token, const char *text) {
    return token < document->token_count && str_equal(document_token(document, token), str_from(text));
}

bool document_begins(const Document *document, size_t token) {
    return document->levels[token] > SIZE_MAX / 2;
}

size_t document_level(const Document *document, size_t token) {
    size_t level = document->levels[token];
    return level > SIZE_MAX / 2 ? SIZE_MAX - level : level;
}

size_t document_block_end(const Document *document, size_t token) {
    size_t level = document_level(document, token), end = document->tokens[token].end;
    for (size_t i = token + 1; i < document->token_count; i++) {
        if (document_begins(document, i) && document_level(document, i) <= level)
            break;
        if (document->tokens[i].kind != PETRI_TOKEN_COMMENT)
            end = document->tokens[i].end;
    }
    return end;
}

size_t document_token_at(const Document *document, size_t offset) {
    size_t low = 0, high = document->token_count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (document->tokens[middle].end > offset)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

const PetriBinding *document_name_at(const Document *document, size_t offset) {
    size_t low = 0, high = document->name_count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (document->names[middle].end < offset)
            low = middle + 1;
        else
            high = middle;
    }
    return low < document->name_count && document->names[low].start <= offset ? &document->names[low] : NULL;
}

const PetriBinding *document_binding(const Document *document, const PetriBinding *name) {
    if (!name || name->kind != PETRI_NAME_USE)
        return name;
    const PetriBinding *bound =
        name->binding_start == PETRI_NUL_TERMINATED ? NULL : document_name_at(document, name->binding_start + 1);
    return bound && bound->start == name->binding_start && bound->kind != PETRI_NAME_USE ? bound : NULL;
}

const PetriBinding *document_resolve(const Document *document, size_t token) {
    size_t at = document->tokens[token].start;
    const PetriBinding *name = document_name_at(document, at), *found = NULL;
    if (document->tokens[token].kind != PETRI_TOKEN_NAME || name || document_is(document, token + 1, "="))
        return document_binding(document, name);
    Str text = document_token(document, token);
    for (size_t i = 0; i < document->name_count && document->names[i].start < at; i++) {
        name = &document->names[i];
        bool visible = name->kind != PETRI_NAME_USE && name->scope_start <= at && at <= name->scope_end;
        if (visible && str_equal(document_slice(document, name->start, name->end), text))
            found = name;
    }
    return found;
}

char *uri_path(const char *uri) {
    static const char scheme[] = "file://";
    if (strncmp(uri, scheme, strlen(scheme)) != 0)
        return NULL;
    const char *at = strchr(uri + strlen(scheme), '/');
    Text path = {0};
    for (; at && *at != '\0'; at++) {
        int high = *at == '%' ? str_hex_digit(at[1]) : -1, low = high >= 0 ? str_hex_digit(at[2]) : -1;
        char c = low >= 0 ? (char)(high * 16 + low) : *at;
        at += low >= 0 ? 2 : 0;
        text_add_char(&path, c);
    }
    return path.bytes;
}

char *uri_of(const char *path) {
    Text uri = {0};
    if (path[0] == '/')
        text_add_uri(&uri, path);
    else // the URI is not a file URI
        text_add_c(&uri, path);
    return uri.bytes;
}

char *path_canonical(const char *path) {
    char resolved[PATH_MAX];
    return memory_strdup(realpath(path, resolved) ? resolved : path);
}

const PetriBinding *document_export(const Document *document, Str text) {
    const PetriBinding *found = NULL;
    for (size_t i = 0; i < document->name_count; i++) {
        const PetriBinding *name = &document->names[i];
        if (name->kind != PETRI_NAME_USE && name->depth == 0 && name->kind != PETRI_NAME_LOOP &&
            str_equal(document_slice(document, name->start, name->end), text) && name->scope_end >= document->text.len)
            found = name;
    }
    return found;
}
