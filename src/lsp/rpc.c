// rpc.c: see rpc.h.
#include "lsp/rpc.h"

#include "base/file.h"

#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum { MAX_DEPTH = 256, MAX_HEADER = 4096 };
static const size_t MAX_BYTES = (size_t)64 << 20;

// Reads more input. Returns false at the end of the input.
static bool read_more(Text *input) {
    char part[1 << 16];
    ssize_t count = file_read_some(STDIN_FILENO, part, sizeof part);
    if (count > 0)
        text_add(input, (Str){part, (size_t)count});
    return count > 0;
}

static void drop_bytes(Text *input, size_t count) {
    memmove(input->bytes, input->bytes + count, input->len - count);
    input->len -= count;
    input->bytes[input->len] = '\0';
}

// Returns the content length in a message header, or SIZE_MAX if it is missing or too large.
static size_t content_length(const char *header) {
    static const char name[] = "Content-Length:";
    for (const char *line = header; line; line = strchr(line, '\n')) {
        line += *line == '\n';
        if (strncasecmp(line, name, strlen(name)) == 0) {
            long long length = atoll(line + strlen(name));
            return length >= 0 && (size_t)length <= MAX_BYTES ? (size_t)length : SIZE_MAX;
        }
    }
    return SIZE_MAX;
}

RpcRead rpc_read(Text *input, Json **message) {
    char *end = NULL;
    *message = NULL;
    while (input->len == 0 || !(end = strstr(input->bytes, "\r\n\r\n")))
        if (input->len > MAX_HEADER || !read_more(input))
            return RPC_END;
    *end = '\0';
    size_t length = content_length(input->bytes), begin = (size_t)(end - input->bytes) + 4;
    if (length == SIZE_MAX)
        return RPC_END; // the start of the next message is unknown
    while (input->len - begin < length)
        if (!read_more(input))
            return RPC_END;
    json_tokener *tokener = json_tokener_new_ex(MAX_DEPTH);
    *message = json_tokener_parse_ex(tokener, input->bytes + begin, (int)length);
    json_tokener_free(tokener);
    drop_bytes(input, begin + length);
    return *message ? RPC_MESSAGE : RPC_INVALID;
}

bool rpc_has_input(const Text *input) {
    struct pollfd ready = {.fd = STDIN_FILENO, .events = POLLIN};
    return input->len > 0 || poll(&ready, 1, 0) > 0;
}

// Writes a message and frees it.
static bool write_message(Json *message) {
    json_put_text(message, "jsonrpc", "2.0");
    size_t length = 0;
    const char *text =
        json_object_to_json_string_length(message, JSON_C_TO_STRING_PLAIN | JSON_C_TO_STRING_NOSLASHESCAPE, &length);
    SCOPED_TEXT out = {0};
    text_add_format(&out, "Content-Length: %zu\r\n\r\n", length);
    text_add(&out, (Str){text, length});
    bool written = file_write(STDOUT_FILENO, out.bytes, out.len);
    json_object_put(message);
    return written;
}

bool rpc_answer(Json *id, Json *result) {
    Json *message = json_put(json_object_new_object(), "id", json_object_get(id));
    return write_message(json_put(message, "result", result));
}

bool rpc_send_error(Json *id, int code, const char *text) {
    Json *error = json_put_text(json_put_number(json_object_new_object(), "code", code), "message", text);
    Json *message = json_put(json_object_new_object(), "id", json_object_get(id));
    return write_message(json_put(message, "error", error));
}

bool rpc_notify(const char *method, Json *params) {
    return write_message(json_put(json_put_text(json_object_new_object(), "method", method), "params", params));
}

Json *json_get(const Json *object, const char *key) {
    return json_object_is_type(object, json_type_object) ? json_object_object_get(object, key) : NULL;
}

Json *json_path(const Json *object, const char *keys) {
    SCOPED_STRING copy = memory_strdup(keys);
    char *rest = copy;
    Json *at = (Json *)object;
    for (char *key = str_split(&rest, '.'); key; key = str_split(&rest, '.'))
        at = json_get(at, key);
    return at;
}

const char *json_text(const Json *object, const char *key) {
    Json *value = json_get(object, key);
    return json_object_is_type(value, json_type_string) ? json_object_get_string(value) : NULL;
}

int64_t json_number(const Json *object, const char *key, int64_t otherwise) {
    Json *value = json_get(object, key);
    return json_object_is_type(value, json_type_int) ? json_object_get_int64(value) : otherwise;
}

Json *json_put(Json *object, const char *key, Json *value) {
    json_object_object_add(object, key, value);
    return object;
}

Json *json_put_text(Json *object, const char *key, const char *text) {
    return json_put(object, key, json_object_new_string(text));
}

Json *json_put_number(Json *object, const char *key, int64_t number) {
    return json_put(object, key, json_object_new_int64(number));
}

Json *json_put_true(Json *object, const char *key) {
    return json_put(object, key, json_object_new_boolean(true));
}

Json *json_from(Str text) {
    return json_object_new_string_len(text.bytes, (int)text.len);
}

Json *json_markdown(const char *text) {
    return json_put_text(json_put_text(json_object_new_object(), "kind", "markdown"), "value", text);
}
