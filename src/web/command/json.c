// json.c: the functions of json-c/json.h. src/web/engine/json.mjs has the imports.
#include "cli/wasm_host.h"

#include <json-c/json.h>
#include <stdlib.h>
#include <string.h>

// Values are numbers from 1; 0: none or null. Texts end with NUL and are freed with their value.
HOST(json_parse) int host_json_parse(const char *text, int length, int depth);
HOST(json_retain) void host_json_retain(int value);
HOST(json_release) void host_json_release(int value);
HOST(json_type) json_type host_json_type(int value);
HOST(json_number) double host_json_number(int value);
HOST(json_string) const char *host_json_string(int value, int *length);
HOST(json_length) int host_json_length(int value);
HOST(json_item) int host_json_item(int value, int index);
HOST(json_member) int host_json_member(int value, const char *key);
HOST(json_key) const char *host_json_key(int value, int index); // NULL: there are fewer members
HOST(json_new_object) int host_json_new_object(void);
HOST(json_new_array) int host_json_new_array(void);
HOST(json_new_boolean) int host_json_new_boolean(int value);
HOST(json_new_number) int host_json_new_number(double value);
HOST(json_new_string) int host_json_new_string(const char *text, int length);
HOST(json_set) void host_json_set(int object, const char *key, int value);
HOST(json_append) void host_json_append(int array, int value);
HOST(json_print) const char *host_json_print(int value, int *length);

struct json_tokener {
    int depth;
    size_t end;
};

static int number_of(const json_object *value) {
    return (int)(intptr_t)value;
}

static json_object *value_of(int number) {
    return (json_object *)(intptr_t)number;
}

json_tokener *json_tokener_new_ex(int depth) {
    json_tokener *tokener = calloc(1, sizeof *tokener);
    if (tokener)
        tokener->depth = depth;
    return tokener;
}

json_object *json_tokener_parse_ex(json_tokener *tokener, const char *text, int length) {
    json_object *value = value_of(host_json_parse(text, length, tokener->depth));
    tokener->end = value ? (size_t)length : 0;
    return value;
}

size_t json_tokener_get_parse_end(const json_tokener *tokener) {
    return tokener->end;
}

void json_tokener_free(json_tokener *tokener) {
    free(tokener);
}

json_object *json_object_get(json_object *value) {
    host_json_retain(number_of(value));
    return value;
}

void json_object_put(json_object *value) {
    host_json_release(number_of(value));
}

bool json_object_is_type(const json_object *value, json_type type) {
    return host_json_type(number_of(value)) == type;
}

bool json_object_get_boolean(const json_object *value) {
    return host_json_number(number_of(value)) != 0;
}

int64_t json_object_get_int64(const json_object *value) {
    return (int64_t)host_json_number(number_of(value));
}

double json_object_get_double(const json_object *value) {
    return host_json_number(number_of(value));
}

const char *json_object_get_string(const json_object *value) {
    int length = 0;
    return host_json_string(number_of(value), &length);
}

int json_object_get_string_len(const json_object *value) {
    int length = 0;
    host_json_string(number_of(value), &length);
    return length;
}

size_t json_object_array_length(const json_object *value) {
    return (size_t)host_json_length(number_of(value));
}

json_object *json_object_array_get_idx(const json_object *value, size_t index) {
    return value_of(host_json_item(number_of(value), (int)index));
}

json_object *json_object_object_get(const json_object *value, const char *key) {
    return value_of(host_json_member(number_of(value), key));
}

bool json_object_member_at(const json_object *object, int index, const char **key, json_object **value) {
    *key = host_json_key(number_of(object), index);
    *value = *key ? json_object_object_get(object, *key) : NULL;
    return *key;
}

bool json_object_equal(const json_object *first, const json_object *second) {
    int length = 0;
    const char *text = host_json_print(number_of(first), &length), *other = host_json_print(number_of(second), &length);
    return first == second || (text && other && strcmp(text, other) == 0);
}

json_object *json_object_new_object(void) {
    return value_of(host_json_new_object());
}

json_object *json_object_new_array(void) {
    return value_of(host_json_new_array());
}

json_object *json_object_new_boolean(bool value) {
    return value_of(host_json_new_boolean(value));
}

json_object *json_object_new_int(int32_t value) {
    return value_of(host_json_new_number(value));
}

json_object *json_object_new_int64(int64_t value) {
    return value_of(host_json_new_number((double)value));
}

json_object *json_object_new_double(double value) {
    return value_of(host_json_new_number(value));
}

json_object *json_object_new_string_len(const char *text, int length) {
    return value_of(host_json_new_string(text, length));
}

json_object *json_object_new_string(const char *text) {
    return json_object_new_string_len(text, (int)strlen(text));
}

void json_object_object_add(json_object *object, const char *key, json_object *value) {
    host_json_set(number_of(object), key, number_of(value));
}

void json_object_array_add(json_object *array, json_object *value) {
    host_json_append(number_of(array), number_of(value));
}

const char *json_object_to_json_string_length(json_object *value, int flags, size_t *length) {
    (void)flags;
    int count = 0;
    const char *text = host_json_print(number_of(value), &count);
    *length = (size_t)count;
    return text;
}
