// json.h: the functions of json-c that src/link calls, implemented by JSON.parse (links.c). A value is the number of a
// value in JavaScript, cast to a pointer.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct json_object json_object;
typedef struct json_tokener json_tokener;
typedef enum json_type { json_type_null, json_type_int, json_type_string, json_type_array, json_type_object } json_type;

enum { JSON_TOKENER_STRICT = 1 };

json_tokener *json_tokener_new_ex(int depth);
#define json_tokener_set_flags(tokener, flags) ((void)(tokener))
json_object *json_tokener_parse_ex(json_tokener *tokener, const char *text, int length);
size_t json_tokener_get_parse_end(const json_tokener *tokener);
void json_tokener_free(json_tokener *tokener);
// Frees all values.
void json_object_put(json_object *value);
bool json_object_is_type(const json_object *value, json_type type);
int64_t json_object_get_int64(const json_object *value);
const char *json_object_get_string(const json_object *value);
int json_object_get_string_len(const json_object *value);
size_t json_object_array_length(const json_object *value);
json_object *json_object_array_get_idx(const json_object *value, size_t index);
json_object *json_object_object_get(const json_object *value, const char *key);
