// rpc.h: messages of the Language Server Protocol: JSON-RPC on standard input and output, and the JSON in them.
#ifndef PETRI_SRC_LSP_RPC_H
#define PETRI_SRC_LSP_RPC_H

#include "cli/byte_buffer.h"

#include <json-c/json.h>

typedef struct json_object Json;

// What the protocol calls errors.
enum {
    RPC_PARSE_ERROR = -32700,
    RPC_INVALID_REQUEST = -32600,
    RPC_METHOD_NOT_FOUND = -32601,
    RPC_INVALID_PARAMS = -32602,
    RPC_NOT_INITIALIZED = -32002,
    RPC_REQUEST_FAILED = -32803,
};

typedef enum RpcRead { RPC_MESSAGE, RPC_INVALID, RPC_END } RpcRead;
// Waits for the next message. RPC_INVALID: what came is no JSON.
RpcRead rpc_read(ByteBuffer *input, Json **message);
// Whether more of standard input is there already.
bool rpc_has_input(const ByteBuffer *input);
// They take `result` and `params`. False if nobody reads.
bool rpc_answer(Json *id, Json *result);
bool rpc_send_error(Json *id, int code, const char *text);
bool rpc_notify(const char *method, Json *params);

// JSON. Those that make or put take what they are given; those that get borrow, and NULL has nothing in it.
Json *json_get(const Json *object, const char *key);
Json *json_path(const Json *object, const char *keys); // with dots
const char *json_text(const Json *object, const char *key);
int64_t json_number(const Json *object, const char *key, int64_t otherwise);
Json *json_put(Json *object, const char *key, Json *value); // gives the object
Json *json_put_text(Json *object, const char *key, const char *text);
Json *json_put_number(Json *object, const char *key, int64_t number);
Json *json_put_true(Json *object, const char *key);
Json *json_from(Str text);
// `{"kind": "markdown", "value": text}`
Json *json_markdown(const char *text);

#endif
