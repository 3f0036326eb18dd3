// json.h: reading and writing of JSON (RFC 8259).
#pragma once

#include "cli/memory.h"
#include "petri.h"

// --- writing

// Adds values to a text, with commas between them. The styles differ only in bytes, not in meaning.
typedef struct JsonWriter {
    Text *out;
    bool spaced;        // true: a space follows each comma and each colon
    bool short_escapes; // true: a line feed is written \n, not \u000a; the same for \b, \f, \r and \t
} JsonWriter;

// In all these functions, `name` is the name of the member in an object that is open. It is NULL in an array, and for
// the outermost value.
void json_open(JsonWriter *json, const char *name, const char *brackets); // such as "{", "[" or "[{"
void json_close(JsonWriter *json, const char *brackets);                  // such as "}]"
// Begins a line before the next value or name: adds the comma, if one is due, and `line`, such as "\n  ".
void json_break(JsonWriter *json, const char *line);
// Adds a string. Invalid UTF-8 becomes U+FFFD. A null pointer becomes null.
void json_put_text(JsonWriter *json, const char *name, const char *text);
void json_put_str(JsonWriter *json, const char *name, Str text);
// Adds members that are strings: names and texts in turn, then NULL.
void json_put_texts(JsonWriter *json, const char *const members[]);
#define JSON_PUT_TEXTS(json, ...) json_put_texts(json, (const char *const[]){__VA_ARGS__, NULL})
// Adds an object with such members.
#define JSON_PUT_OBJECT(json, name, ...)                                                                               \
    (json_open(json, name, "{"), JSON_PUT_TEXTS(json, __VA_ARGS__), json_close(json, "}"))
// Adds an array of strings.
void json_put_array(JsonWriter *json, const char *name, const char *const texts[]); // `texts` ends with NULL
#define JSON_PUT_ARRAY(json, name, ...) json_put_array(json, name, (const char *const[]){__VA_ARGS__, NULL})
void json_put_integer(JsonWriter *json, const char *name, int64_t number);
void json_put_number(JsonWriter *json, const char *name, double number); // infinity and NaN become null
void json_put_bool(JsonWriter *json, const char *name, bool value);
// Adds a value that is already written as JSON. An empty text becomes null.
void json_put_written(JsonWriter *json, const char *name, Str value);
// Returns "error", "warning" or "note".
const char *level_word(PetriLevel level);
// Adds a diagnostic as an object on one line.
void json_put_diagnostic(JsonWriter *json, const PetriDiagnostic *diagnostic);

// --- reading

typedef enum JsonKind {
    JSON_NULL,
    JSON_FALSE,
    JSON_TRUE,
    JSON_NUMBER,
    JSON_STRING,
    JSON_ARRAY,
    JSON_OBJECT,
} JsonKind;

// A value in a document. The values in an array or object follow it. A member is two values: its name and its value.
typedef struct Json {
    const char *text; // of a string: without escapes, with a NUL after it; of a number or word: as written
    uint32_t length;  // of `text`, in bytes; of an array or object: the number of its values or members
    uint32_t span;    // number of values up to the next one that is not in this one
    JsonKind kind;
} Json;

// A text that has been read. Zeroed: none. It owns its values, which take at most 24 times the memory of the text.
typedef struct JsonDocument {
    char *text;
    Json *values;
    size_t count;
    size_t capacity;
} JsonDocument;

// Reads a text. Returns its value, which is valid until json_free, or NULL if the text is not JSON, or if arrays and
// objects are nested deeper than `max_depth`. Half of a surrogate pair becomes U+FFFD.
const Json *json_read(JsonDocument *document, Str text, unsigned max_depth);
void json_free(JsonDocument *document);
#define SCOPED_JSON __attribute__((cleanup(json_free))) JsonDocument

// The value may be NULL in all functions below. Results are borrowed from the document.
// Returns the member with this name; of several, the last, as in JavaScript. Returns NULL if there is none, and if it
// is null.
const Json *json_get(const Json *object, const char *name);
// Returns the member of a member, or NULL. `names` are separated by dots.
const Json *json_path(const Json *object, const char *names);
// Returns the value after `item` in the array, or the first one if `item` is NULL. Returns NULL after the last one, and
// if `array` is not an array.
const Json *json_next(const Json *array, const Json *item);
size_t json_length(const Json *array); // returns 0 if the value is not an array
bool json_is(const Json *value, JsonKind kind);
// Returns a string member's text up to its first NUL, or NULL if there is no such string.
const char *json_text(const Json *object, const char *name);
// Returns false if the value is not an integer, or does not fit.
bool json_integer(const Json *value, int64_t *number);
// Returns an integer member, or `otherwise` if there is no such integer.
int64_t json_integer_or(const Json *object, const char *name, int64_t otherwise);
double json_number(const Json *value); // returns 0 if the value is not a number
// Adds a value that was read.
void json_put(JsonWriter *json, const char *name, const Json *value);
