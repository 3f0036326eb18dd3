// json.c: see json.h.
//
// The reader checks everything that RFC 8259 demands, in one pass over a copy of the text. jsmn, the parser of Debian
// that is only a header, would not make it shorter: it accepts texts such as [1 2], so that its tokens must be checked
// again.
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

static void skip_space(Reader *reader) {
    reader->at += strspn(reader->at, " \t\n\r");
}

// Moves after the character if it comes next, apart from white space.
static bool take(Reader *reader, char c) {
    skip_space(reader);
    bool found = *reader->at == c;
    reader->at += found;
    return found;
}

// Returns the value of four hexadecimal digits, or -1 if they are not.
static int32_t read_hex(const char *at) {
    int32_t value = 0;
    for (int i = 0; i < 4; i++) {
        int digit = str_hex_digit(at[i]);
        if (digit < 0)
            return -1;
        value = value * 16 + digit;
    }
    return value;
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
    char c = *reader->at;
    const char *found = c == '\0' ? NULL : strchr(ESCAPES, c);
    reader->at += c != '\0';
    if (found)
        *(*to)++ = ESCAPED[found - ESCAPES];
    if (found || c != 'u')
        return found;
    int32_t code = read_code_point(reader);
    if (code >= 0)
        *to += utf8_encode((uint32_t)code, *to);
    return code >= 0;
}

// Reads a string whose first quote comes next. Replaces its escapes in place.
static bool read_string(Reader *reader) {
    char *start = ++reader->at, *to = start;
    Json *value = add_value(reader, JSON_STRING);
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
    value->length = (uint32_t)(to - start);
    return true;
}

static size_t skip_digits(Reader *reader) {
    size_t count = strspn(reader->at, "0123456789");
    reader->at += count;
    return count;
}

static bool read_number(Reader *reader) {
    Json *value = add_value(reader, JSON_NUMBER);
    reader->at += *reader->at == '-';
    bool zero = *reader->at == '0';
    size_t digits = skip_digits(reader);
    bool good = digits > 0 && !(zero && digits > 1);
    if (*reader->at == '.') {
        reader->at++;
        good = skip_digits(reader) > 0 && good;
    }
    if (*reader->at == 'e' || *reader->at == 'E') {
        reader->at++;
        reader->at += *reader->at == '+' || *reader->at == '-';
        good = skip_digits(reader) > 0 && good;
    }
    value->length = (uint32_t)(reader->at - value->text);
    return good;
}

static bool read_word(Reader *reader, const char *word, JsonKind kind) {
    size_t length = strlen(word);
    add_value(reader, kind)->length = (uint32_t)length;
    bool good = strncmp(reader->at, word, length) == 0;
    reader->at += good ? length : 0;
    return good;
}

static Str value_str(const Json *value) {
    return (Str){value->text, value->length};
}

static int by_text(const void *a, const void *b) {
    return str_compare(value_str(*(const Json *const *)a), value_str(*(const Json *const *)b));
}

// Returns the value after `item` in an array, or the name after the member `item` of an object. NULL: the first or
// last.
static const Json *next_value(const Json *nested, const Json *item) {
    const Json *value = item && nested->kind == JSON_OBJECT ? item + 1 : item;
    const Json *next = !value ? nested + 1 : value + value->span;
    return next < nested + nested->span ? next : NULL;
}

// Returns true if no two members of an object have the same name.
static bool has_distinct_names(const Json *object) {
    size_t count = 0, i = 0;
    for (const Json *name = NULL; (name = next_value(object, name));)
        count++;
    const Json **names = memory_calloc(count * sizeof *names);
    for (const Json *name = NULL; (name = next_value(object, name));)
        names[i++] = name;
    qsort(names, count, sizeof *names, by_text);
    for (i = 1; i < count && by_text(&names[i - 1], &names[i]) != 0;)
        i++;
    free(names);
    return i >= count;
}

static bool read_value(Reader *reader, unsigned max_depth);

// Reads an array or object whose bracket comes next.
static bool read_nested(Reader *reader, unsigned max_depth) {
    bool object = *reader->at == '{';
    char end = object ? '}' : ']';
    size_t index = reader->document->count;
    add_value(reader, object ? JSON_OBJECT : JSON_ARRAY);
    reader->at++;
    if (max_depth == 0 || take(reader, end))
        return max_depth > 0;
    do {
        skip_space(reader);
        if (object && !(*reader->at == '"' && read_string(reader) && take(reader, ':')))
            return false;
        if (!read_value(reader, max_depth - 1))
            return false;
    } while (take(reader, ','));
    Json *value = &reader->document->values[index];
    value->span = (uint32_t)(reader->document->count - index);
    return take(reader, end) && (!object || has_distinct_names(value));
}

static bool read_value(Reader *reader, unsigned max_depth) {
    skip_space(reader);
    switch (*reader->at) {
    case '{':
    case '[':
        return read_nested(reader, max_depth);
    case '"':
        return read_string(reader);
    case 'n':
        return read_word(reader, "null", JSON_NULL);
    case 'f':
        return read_word(reader, "false", JSON_FALSE);
    case 't':
        return read_word(reader, "true", JSON_TRUE);
    default:
        return read_number(reader);
    }
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

const Json *json_get(const Json *object, const char *name) {
    if (!json_is(object, JSON_OBJECT))
        return NULL;
    const Json *member = NULL;
    while ((member = next_value(object, member)) && !str_equal(value_str(member), str_from(name)))
        ;
    return member && member[1].kind != JSON_NULL ? member + 1 : NULL;
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
    size_t length = 0;
    for (const Json *item = NULL; (item = json_next(array, item));)
        length++;
    return length;
}

bool json_is(const Json *value, JsonKind kind) {
    return value && value->kind == kind;
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
