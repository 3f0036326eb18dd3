// test_src_rpc.c: tests of the framing of the language server protocol: src/lsp/rpc.c.
#include "captured.h"
#include "lsp/rpc.h"

// Makes standard input a pipe that contains `text` and then ends.
static void set_input(const char *text, size_t length) {
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], text, length), (ssize_t)length);
    close(ends[1]);
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
}

// Reads a message whose member `id` must be `id`.
static void assert_message(Text *input, int64_t id) {
    SCOPED_JSON document = {0};
    const Json *message = NULL;
    assert_int_equal(rpc_read(input, &document, &message), RPC_MESSAGE);
    assert_int_equal(json_integer_or(message, "id", -1), id);
}

static void assert_end(const char *text) {
    Text input = {0};
    SCOPED_JSON document = {0};
    const Json *message = NULL;
    set_input(text, strlen(text));
    assert_int_equal(rpc_read(&input, &document, &message), RPC_END);
    assert_null(message);
    text_free(&input);
}

static void test_messages_follow_each_other(void **state) {
    (void)state;
    static const char text[] = "Content-Length: 8\r\n\r\n{\"id\":1}"
                               "content-length:8\r\nContent-Type: x\r\n\r\n{\"id\":2}"
                               "Content-Type: x\r\nContent-Length: 10\r\n\r\n{\"id\": 3} ";
    Text input = {0};
    SCOPED_JSON document = {0};
    const Json *message;
    set_input(text, sizeof text - 1);
    assert_true(rpc_has_input(&input));
    assert_message(&input, 1);
    assert_true(rpc_has_input(&input)); // in the buffer
    assert_message(&input, 2);
    assert_message(&input, 3);
    assert_int_equal(rpc_read(&input, &document, &message), RPC_END);
    text_free(&input);
}

static void test_invalid_json_does_not_end_the_input(void **state) {
    (void)state;
    static const char text[] = "Content-Length: 6\r\n\r\n{\"id\":"
                               "Content-Length: 0\r\n\r\n"
                               "Content-Length: 8\r\n\r\n{\"id\":4}";
    Text input = {0};
    SCOPED_JSON document = {0};
    const Json *message;
    set_input(text, sizeof text - 1);
    assert_int_equal(rpc_read(&input, &document, &message), RPC_INVALID);
    assert_null(message);
    assert_int_equal(rpc_read(&input, &document, &message), RPC_INVALID);
    assert_message(&input, 4);
    text_free(&input);
}

static void test_invalid_headers_end_the_input(void **state) {
    (void)state;
    assert_end("");
    assert_end("Content-Length: 8\r\n");
    assert_end("Content-Type: x\r\n\r\n{}");
    assert_end("Content-Length: -1\r\n\r\n{}");
    assert_end("Content-Length: 99999999999\r\n\r\n{}");
    assert_end("Content-Length: 8\r\n\r\n{\"id\"");
    char header[6000];
    memset(header, 'x', sizeof header - 1);
    header[sizeof header - 1] = '\0';
    assert_end(header);
}

static void test_messages_are_written_with_their_length(void **state) {
    (void)state;
    Captured captured;
    SCOPED_JSON document = {0};
    SCOPED_TEXT result = {0}, params = {0};
    const Json *id = json_read(&document, STR("7"), 0);
    JsonWriter json = rpc_writer(&result);
    json_put_text(&json, NULL, "a/b");
    captured_begin(&captured, STDOUT_FILENO);
    bool sent = rpc_answer(id, &result) && rpc_send_error(id, RPC_PARSE_ERROR, "no") && rpc_notify("exit", &params);
    captured_end(&captured);
    assert_true(sent);
    assert_string_equal(
        captured.text,
        "Content-Length: 39\r\n\r\n{\"id\":7,\"result\":\"a/b\",\"jsonrpc\":\"2.0\"}"
        "Content-Length: 63\r\n\r\n{\"id\":7,\"error\":{\"code\":-32700,\"message\":\"no\"},\"jsonrpc\":\"2.0\"}"
        "Content-Length: 47\r\n\r\n{\"method\":\"exit\",\"params\":null,\"jsonrpc\":\"2.0\"}");
}

TEST_GROUP(src_rpc) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_messages_follow_each_other),
        cmocka_unit_test(test_invalid_json_does_not_end_the_input),
        cmocka_unit_test(test_invalid_headers_end_the_input),
        cmocka_unit_test(test_messages_are_written_with_their_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
