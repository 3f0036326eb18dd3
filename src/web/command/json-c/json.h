// json.h: the functions of json-c that src/link and src/lsp call, implemented by JavaScript's JSON (json.c). A value is
// the number of a value in JavaScript, cast to a pointer.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct json_object json_object;
typedef struct json_tokener json_tokener;
typedef enum json_type { json_type_null, json_type_int, json_type_string, json_type_array, json_type_object } json_type;

enum { JSON_TOKENER_STRICT = 1, JSON_C_TO_STRING_PLAIN = 0, JSON_C_TO_STRING_NOSLASHESCAPE = 0 };

json_tokener *json_tokener_new_ex(int depth);
#define json_tokener_set_flags(tokener, flags) ((void)(tokener))
json_object *json_tokener_parse_ex(json_tokener *tokener, const char *text, int length);
size_t json_tokener_get_parse_end(const json_tokener *tokener);
void json_tokener_free(json_tokener *tokener);
// Values have reference counts, as in json-c.
json_object *json_object_get(json_object *value);
void json_object_put(json_object *value);
bool json_object_is_type(const json_object *value, json_type type);
bool json_object_get_boolean(const json_object *value);
int64_t json_object_get_int64(const json_object *value);
double json_object_get_double(const json_object *value);
const char *json_object_get_string(const json_object *value);
int json_object_get_string_len(const json_object *value);
size_t json_object_array_length(const json_object *value);
json_object *json_object_array_get_idx(const json_object *value, size_t index);
json_object *json_object_object_get(const json_object *value, const char *key);
// Returns false if the object has at most `index` members. The key is valid until the next call for the object.
bool json_object_member_at(const json_object *object, int index, const char **key, json_object **value);
#define json_object_object_foreach(object, key, member)                                                                \
    const char *key;                                                                                                   \
    json_object *member;                                                                                               \
    for (int key##_index = 0; json_object_member_at(object, key##_index, &key, &member); key##_index++)
bool json_object_equal(const json_object *first, const json_object *second);
json_object *json_object_new_object(void);
json_object *json_object_new_array(void);
json_object *json_object_new_boolean(bool value);
json_object *json_object_new_int(int32_t value);
json_object *json_object_new_int64(int64_t value);
json_object *json_object_new_double(double value);
json_object *json_object_new_string(const char *text);
json_object *json_object_new_string_len(const char *text, int length);
// The container takes the caller's reference to the value.
void json_object_object_add(json_object *object, const char *key, json_object *value);
void json_object_array_add(json_object *array, json_object *value);
const char *json_object_to_json_string_length(json_object *value, int flags, size_t *length);
