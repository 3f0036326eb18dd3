// rpc.h: messages of the Language Server Protocol: JSON-RPC on standard input and output, and the JSON in them.
#pragma once

#include "cli/memory.h"

#include <json-c/json.h>

typedef struct json_object Json;

// Error codes of the protocol.
enum {
    RPC_PARSE_ERROR = -32700,
    RPC_INVALID_REQUEST = -32600,
    RPC_METHOD_NOT_FOUND = -32601,
    RPC_INVALID_PARAMS = -32602,
    RPC_NOT_INITIALIZED = -32002,
    RPC_REQUEST_FAILED = -32803,
};

typedef enum RpcRead { RPC_MESSAGE, RPC_INVALID, RPC_END } RpcRead;
// Waits for the next message. Returns RPC_INVALID if the message is not valid JSON. Returns RPC_END at the end of the
// input, or if the header of a message is invalid. The caller releases *message.
RpcRead rpc_read(Text *input, Json **message);
// Returns true if more input can be read without waiting.
bool rpc_has_input(const Text *input);
// Send a message and take ownership of `result` and `params`. Return false if the editor has closed the pipe.
bool rpc_answer(Json *id, Json *result);
bool rpc_send_error(Json *id, int code, const char *text);
bool rpc_notify(const char *method, Json *params);

// JSON. json_put takes ownership of `value`; json_put_text copies the text. All json_put* return the object. json_get,
// json_path and json_text return borrowed values, or NULL if there is no such member or `object` is NULL. json_text
// also returns NULL if the member is not a string.
Json *json_get(const Json *object, const char *key);
Json *json_path(const Json *object, const char *keys); // keys separated by dots
const char *json_text(const Json *object, const char *key);
int64_t json_number(const Json *object, const char *key, int64_t otherwise);
Json *json_put(Json *object, const char *key, Json *value);
Json *json_put_text(Json *object, const char *key, const char *text);
Json *json_put_number(Json *object, const char *key, int64_t number);
Json *json_put_true(Json *object, const char *key);
Json *json_from(Str text);
// Returns `{"kind": "markdown", "value": text}`.
Json *json_markdown(const char *text);
