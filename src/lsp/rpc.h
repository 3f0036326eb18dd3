// rpc.h: messages of the Language Server Protocol: JSON-RPC on standard input and output.
#pragma once

#include "cli/json.h"

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
// input, or if the header of a message is invalid. Sets *message to NULL except for RPC_MESSAGE; it is valid until the
// document is freed or read again.
RpcRead rpc_read(Text *input, JsonDocument *document, const Json **message);
// Returns true if more input can be read without waiting.
bool rpc_has_input(const Text *input);
// Returns the writer of the results and parameters of messages.
JsonWriter rpc_writer(Text *out);
// Send a message. `id` NULL, and an empty `result` or `params`, mean null. Return false if the editor has closed the
// pipe.
bool rpc_answer(const Json *id, const Text *result);
bool rpc_send_error(const Json *id, int code, const char *text);
bool rpc_notify(const char *method, const Text *params);
bool rpc_request(const char *method, const Json *id, const Text *params);
