// json.c: see json.h.
//
// The reader checks everything that RFC 8259 demands, in one pass over a copy of the text. CONTRIBUTING.md says why it
// is not a library.
#include "cli/json.h"

#include "base/number.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static const char ESCAPES[] = "\"\\/bfnrt", ESCAPED[] = "\"\\/\b\f\n\r\t";

// --- writing

static void add_string(JsonWriter *json, Str text) {
    Text *out = json->out;
    text_add_c(out, "\"");
    for (size_t at = 0; at < text.len;) {
        size_t start = at;
        int32_t c = utf8_next(text, &at);
        const char *escaped = c > 0 && c < 0x80 && c != '/' ? strchr(ESCAPED, c) : NULL;
        if (c < 0)
            text_add_c(out, "\\ufffd");
        else if (escaped && (c >= 0x20 || json->short_escapes))
            text_add_format(out, "\\%c", ESCAPES[escaped - ESCAPED]);
        else if (c < 0x20)
            text_add_format(out, "\\u%04x", (unsigned)c);
        else
            text_add(out, (Str){text.bytes + start, at - start});
    }
    text_add_c(out, "\"");
}

// Adds a comma, if another value precedes.
static void separate(JsonWriter *json, const char *comma) {
    Text *out = json->out;
    if (out->len > 0 && !strchr("{[: \n", out->bytes[out->len - 1]))
        text_add_c(out, comma);
}

void json_break(JsonWriter *json, const char *line) {
    separate(json, ",");
    text_add_c(json->out, line);
}

static void add_name(JsonWriter *json, Str name) {
    separate(json, json->spaced ? ", " : ",");
    add_string(json, name);
    text_add_c(json->out, json->spaced ? ": " : ":");
}

static void begin_value(JsonWriter *json, const char *name) {
    if (name)
        add_name(json, str_from(name));
    separate(json, json->spaced ? ", " : ",");
}

void json_open(JsonWriter *json, const char *name, const char *brackets) {
    begin_value(json, name);
    text_add_c(json->out, brackets);
}

void json_close(JsonWriter *json, const char *brackets) {
    text_add_c(json->out, brackets);
}

void json_put_str(JsonWriter *json, const char *name, Str text) {
    begin_value(json, name);
    if (text.bytes)
        add_string(json, text);
    else
        text_add_c(json->out, "null");
}

void json_put_text(JsonWriter *json, const char *name, const char *text) {
    json_put_str(json, name, text ? str_from(text) : (Str){NULL, 0});
}

void json_put_texts(JsonWriter *json, const char *const members[]) {
    for (; members[0]; members += 2)
        json_put_text(json, members[0], members[1]);
}

void json_put_array(JsonWriter *json, const char *name, const char *const texts[]) {
    json_open(json, name, "[");
    for (; texts[0]; texts++)
        json_put_text(json, NULL, texts[0]);
    json_close(json, "]");
}

void json_put_integer(JsonWriter *json, const char *name, int64_t number) {
    begin_value(json, name);
    text_add_format(json->out, "%" PRId64, number);
}

void json_put_number(JsonWriter *json, const char *name, double number) {
    begin_value(json, name);
    if (isfinite(number))
        text_add_number(json->out, number);
    else
        text_add_c(json->out, "null");
}

void json_put_written(JsonWriter *json, const char *name, Str value) {
    begin_value(json, name);
    text_add(json->out, value.len > 0 ? value : STR("null"));
}

void json_put_bool(JsonWriter *json, const char *name, bool value) {
    json_put_written(json, name, value ? STR("true") : STR("false"));
}

const char *level_word(PetriLevel level) {
    static const char *const words[] = {"error", "warning", "note"};
    return words[level];
}

void json_put_diagnostic(JsonWriter *json, const PetriDiagnostic *diagnostic) {
    json_open(json, NULL, "{");
    JSON_PUT_TEXTS(json, "file", diagnostic->file, "level", level_word(diagnostic->level), "code", diagnostic->code,
                   "text", diagnostic->text, "hint", diagnostic->hint[0] != '\0' ? diagnostic->hint : NULL);
    json_put_integer(json, "line", diagnostic->line);
    json_put_integer(json, "column", diagnostic->column);
    json_put_integer(json, "endLine", diagnostic->end_line);
    json_put_integer(json, "endColumn", diagnostic->end_column);
    json_close(json, "}");
}

// --- reading

typedef struct Reader {
    char *at; // in a copy of the text, which ends with NUL
    JsonDocument *document;
} Reader;

static Json *add_value(Reader *reader, JsonKind kind) {
    JsonDocument *document = reader->document;
    if (document->count == document->capacity) {
        document->capacity = document->capacity == 0 ? 64 : 2 * document->capacity;
        document->values = memory_realloc(document->values, document->capacity * sizeof *document->values);
    }
    document->values[document->count] = (Json){.text = reader->at, .span = 1, .kind = kind};
    return &document->values[document->count++];
}

// Moves after the next character if it is one of these.
static bool take(Reader *reader, const char *characters) {
    bool found = *reader->at != '\0' && strchr(characters, *reader->at);
    reader->at += found;
    return found;
}

static void skip_space(Reader *reader) {
    reader->at += strspn(reader->at, " \t\n\r");
}

static bool take_mark(Reader *reader, const char *mark) {
    skip_space(reader);
    return take(reader, mark);
}

// Returns the value of four hexadecimal digits, or -1 if they are not.
static int32_t read_hex(const char *at) {
    if (strspn(at, "0123456789abcdefABCDEF") < 4)
        return -1;
    const char digits[] = {at[0], at[1], at[2], at[3], '\0'};
    return (int32_t)strtol(digits, NULL, 16);
}

// Reads the digits after `\u`, and those of the second half of a surrogate pair. Returns -1 if they are invalid.
static int32_t read_code_point(Reader *reader) {
    int32_t code = read_hex(reader->at), low = -1;
    reader->at += code < 0 ? 0 : 4;
    if (code < 0xd800 || code > 0xdfff)
        return code;
    if (code < 0xdc00 && reader->at[0] == '\\' && reader->at[1] == 'u')
        low = read_hex(reader->at + 2);
    if (low < 0xdc00 || low > 0xdfff)
        return 0xfffd;
    reader->at += 6;
    return 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
}

// Reads the rest of an escape and writes its character, which is never longer, to **to.
static bool read_escape(Reader *reader, char **to) {
    if (take(reader, ESCAPES)) {
        *(*to)++ = ESCAPED[strchr(ESCAPES, reader->at[-1]) - ESCAPES];
        return true;
    }
    int32_t code = take(reader, "u") ? read_code_point(reader) : -1;
    *to += code < 0 ? 0 : utf8_encode((uint32_t)code, *to);
    return code >= 0;
}

// Reads a string after its first quote. Replaces its escapes in place.
static bool read_string(Reader *reader) {
    Json *value = add_value(reader, JSON_STRING);
    char *to = reader->at;
    while (*reader->at != '"') {
        if ((unsigned char)*reader->at < 0x20) // also the end of the text
            return false;
        char c = *reader->at++;
        if (c != '\\')
            *to++ = c;
        else if (!read_escape(reader, &to))
            return false;
    }
    reader->at++;
    *to = '\0';
    value->length = (uint32_t)(to - value->text);
    return true;
}

static bool read_digits(Reader *reader) {
    size_t count = strspn(reader->at, "0123456789");
    reader->at += count;
    return count > 0;
}

static bool read_number(Reader *reader) {
    Json *value = add_value(reader, JSON_NUMBER);
    take(reader, "-");
    bool good = (take(reader, "0") || read_digits(reader)) && (!take(reader, ".") || read_digits(reader));
    if (good && take(reader, "eE")) {
        take(reader, "+-");
        good = read_digits(reader);
    }
    value->length = (uint32_t)(reader->at - value->text);
    return good;
}

static bool read_word(Reader *reader) {
    static const char *const words[] = {[JSON_NULL] = "null", [JSON_FALSE] = "false", [JSON_TRUE] = "true"};
    for (JsonKind kind = JSON_NULL; kind <= JSON_TRUE; kind++) {
        size_t length = strlen(words[kind]);
        if (strncmp(reader->at, words[kind], length) == 0) {
            add_value(reader, kind)->length = (uint32_t)length;
            reader->at += length;
            return true;
        }
    }
    return false;
}

static bool read_value(Reader *reader, unsigned max_depth);

// Reads an array or object after its first bracket.
static bool read_nested(Reader *reader, JsonKind kind, unsigned max_depth) {
    const char *end = kind == JSON_OBJECT ? "}" : "]";
    size_t index = reader->document->count;
    add_value(reader, kind);
    if (max_depth == 0 || take_mark(reader, end))
        return max_depth > 0;
    do {
        bool named = kind == JSON_ARRAY || (take_mark(reader, "\"") && read_string(reader) && take_mark(reader, ":"));
        if (!named || !read_value(reader, max_depth - 1))
            return false;
        reader->document->values[index].length++;
    } while (take_mark(reader, ","));
    reader->document->values[index].span = (uint32_t)(reader->document->count - index);
    return take(reader, end);
}

static bool read_value(Reader *reader, unsigned max_depth) {
    if (take_mark(reader, "\""))
        return read_string(reader);
    if (take(reader, "{"))
        return read_nested(reader, JSON_OBJECT, max_depth);
    if (take(reader, "["))
        return read_nested(reader, JSON_ARRAY, max_depth);
    return read_word(reader) || read_number(reader);
}

const Json *json_read(JsonDocument *document, Str text, unsigned max_depth) {
    json_free(document);
    if (text.len == 0 || text.len > UINT32_MAX / 2 || utf8_find_error(text) < text.len)
        return NULL;
    document->text = memory_strndup(text.bytes, text.len);
    Reader reader = {.at = document->text, .document = document};
    bool good = read_value(&reader, max_depth);
    skip_space(&reader);
    if (!good || reader.at != document->text + text.len)
        json_free(document);
    return document->values;
}

void json_free(JsonDocument *document) {
    free(document->text);
    free(document->values);
    *document = (JsonDocument){0};
}

// --- values that were read

static Str value_str(const Json *value) {
    return (Str){value->text, value->length};
}

bool json_is(const Json *value, JsonKind kind) {
    return value && value->kind == kind;
}

// Returns the value after `item` in an array, or the name after the member `item` of an object. NULL: the first or
// last.
static const Json *next_value(const Json *nested, const Json *item) {
    const Json *value = item && nested->kind == JSON_OBJECT ? item + 1 : item;
    const Json *next = !value ? nested + 1 : value + value->span;
    return next < nested + nested->span ? next : NULL;
}

const Json *json_get(const Json *object, const char *name) {
    const Json *found = NULL;
    if (json_is(object, JSON_OBJECT))
        for (const Json *member = NULL; (member = next_value(object, member));)
            found = str_equal(value_str(member), str_from(name)) ? member + 1 : found;
    return json_is(found, JSON_NULL) ? NULL : found;
}

const Json *json_path(const Json *object, const char *names) {
    SCOPED_STRING copy = memory_strdup(names);
    char *rest = copy;
    for (char *name = str_split(&rest, '.'); name; name = str_split(&rest, '.'))
        object = json_get(object, name);
    return object;
}

const Json *json_next(const Json *array, const Json *item) {
    return json_is(array, JSON_ARRAY) ? next_value(array, item) : NULL;
}

size_t json_length(const Json *array) {
    return json_is(array, JSON_ARRAY) ? array->length : 0;
}

const char *json_text(const Json *object, const char *name) {
    const Json *value = json_get(object, name);
    return json_is(value, JSON_STRING) ? value->text : NULL;
}

bool json_integer(const Json *value, int64_t *number) {
    if (!json_is(value, JSON_NUMBER))
        return false;
    char *end;
    errno = 0;
    long long integer = strtoll(value->text, &end, 10);
    *number = integer;
    return errno == 0 && end == value->text + value->length;
}

int64_t json_integer_or(const Json *object, const char *name, int64_t otherwise) {
    int64_t number;
    return json_integer(json_get(object, name), &number) ? number : otherwise;
}

double json_number(const Json *value) {
    return json_is(value, JSON_NUMBER) ? number_parse(value_str(value)) : 0;
}

void json_put(JsonWriter *json, const char *name, const Json *value) {
    JsonKind kind = value ? value->kind : JSON_NULL;
    if (kind == JSON_STRING) {
        json_put_str(json, name, value_str(value));
    } else if (kind == JSON_ARRAY || kind == JSON_OBJECT) {
        json_open(json, name, kind == JSON_ARRAY ? "[" : "{");
        for (const Json *item = NULL; (item = next_value(value, item));) {
            if (kind == JSON_OBJECT)
                add_name(json, value_str(item));
            json_put(json, NULL, kind == JSON_OBJECT ? item + 1 : item);
        }
        json_close(json, kind == JSON_ARRAY ? "]" : "}");
    } else {
        json_put_written(json, name, value ? value_str(value) : (Str){NULL, 0});
    }
}
