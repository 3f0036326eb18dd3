// rpc.c: see rpc.h.
//
// Bytes after a message stay in `input` for the next one. A message with invalid content is skipped. A header without a
// valid length ends the session, because the start of the next message is unknown.
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

RpcRead rpc_read(Text *input, JsonDocument *document, const Json **message) {
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
    *message = json_read(document, (Str){input->bytes + begin, length}, MAX_DEPTH);
    drop_bytes(input, begin + length);
    return *message ? RPC_MESSAGE : RPC_INVALID;
}

bool rpc_has_input(const Text *input) {
    struct pollfd ready = {.fd = STDIN_FILENO, .events = POLLIN};
    return input->len > 0 || poll(&ready, 1, 0) > 0;
}

JsonWriter rpc_writer(Text *out) {
    return (JsonWriter){.out = out, .short_escapes = true};
}

// Sends a message with a method, an id or both, and one more member. Returns false if the editor has closed the pipe.
static bool send(const char *method, const Json *id, const char *name, const Text *value) {
    SCOPED_TEXT message = {0}, out = {0};
    JsonWriter json = rpc_writer(&message);
    json_open(&json, NULL, "{");
    if (method)
        json_put_text(&json, "method", method);
    if (id || !method)
        json_put(&json, "id", id);
    json_put_written(&json, name, text_str(value));
    json_put_text(&json, "jsonrpc", "2.0");
    json_close(&json, "}");
    text_add_format(&out, "Content-Length: %zu\r\n\r\n", message.len);
    text_add(&out, text_str(&message));
    return file_write(STDOUT_FILENO, out.bytes, out.len);
}

bool rpc_answer(const Json *id, const Text *result) {
    return send(NULL, id, "result", result);
}

bool rpc_send_error(const Json *id, int code, const char *text) {
    SCOPED_TEXT error = {0};
    JsonWriter json = rpc_writer(&error);
    json_open(&json, NULL, "{");
    json_put_integer(&json, "code", code);
    json_put_text(&json, "message", text);
    json_close(&json, "}");
    return send(NULL, id, "error", &error);
}

bool rpc_notify(const char *method, const Text *params) {
    return send(method, NULL, "params", params);
}

bool rpc_request(const char *method, const Json *id, const Text *params) {
    return send(method, id, "params", params);
}
