// links.c: compression and JSON for links, see zlib.h and json-c/json.h. src/web/engine/links.mjs has the imports.
#include "cli/wasm_host.h"

#include <json-c/json.h>
#include <stdlib.h>
#include <zlib.h>

// Return the number of bytes written to `out`, or -1: damaged or trailing data, -2: more than `capacity` bytes.
HOST(deflate) int host_deflate(const unsigned char *in, unsigned length, unsigned char *out, unsigned capacity);
HOST(inflate) int host_inflate(const unsigned char *in, unsigned length, unsigned char *out, unsigned capacity);
// Values are numbers from 1; 0: none or null. host_json_string writes a text and NUL to a new block.
HOST(json_parse) int host_json_parse(const char *text, int length, int depth);
HOST(json_free) void host_json_free(void);
HOST(json_type) json_type host_json_type(int value);
HOST(json_number) double host_json_number(int value);
HOST(json_string) const char *host_json_string(int value, int *length);
HOST(json_length) int host_json_length(int value);
HOST(json_item) int host_json_item(int value, int index);
HOST(json_member) int host_json_member(int value, const char *key);

struct json_tokener {
    int depth;
    size_t end;
};

unsigned long deflateBound(z_stream *stream, unsigned long length) {
    (void)stream;
    return length + length / 8 + 64;
}

int deflate(z_stream *stream, int flush) {
    (void)flush;
    int length = host_deflate(stream->next_in, stream->avail_in, stream->next_out, stream->avail_out);
    if (length < 0)
        return Z_DATA_ERROR;
    stream->avail_out -= (unsigned)length;
    return Z_STREAM_END;
}

int inflate(z_stream *stream, int flush) {
    (void)flush;
    int length = host_inflate(stream->next_in, stream->avail_in, stream->next_out, stream->avail_out);
    if (length == -2)
        stream->avail_out = 0;
    if (length < 0)
        return Z_DATA_ERROR;
    stream->avail_in = 0;
    stream->avail_out -= (unsigned)length;
    return Z_STREAM_END;
}

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

void json_object_put(json_object *value) {
    (void)value;
    host_json_free();
}

bool json_object_is_type(const json_object *value, json_type type) {
    return host_json_type(number_of(value)) == type;
}

int64_t json_object_get_int64(const json_object *value) {
    return (int64_t)host_json_number(number_of(value));
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
