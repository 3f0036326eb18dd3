// send.c: `petri view --send`, which evaluates code in a running view.
#include "base/file.h"
#include "cli/json.h"
#include "cli/option_groups.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/script.h"

#include <errno.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

// Options that no other command has.
typedef struct Own {
    const char *send; // path of the socket
} Own;

static const size_t MAX_BYTES = (size_t)1 << 20;

static int connect_to(const char *path) {
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    int descriptor = strlen(path) < sizeof address.sun_path ? socket(AF_UNIX, SOCK_STREAM, 0) : -1;
    if (descriptor >= 0)
        strcpy(address.sun_path, path);
    if (descriptor < 0 || connect(descriptor, (const struct sockaddr *)&address, sizeof address) != 0) {
        message("cannot reach a view at %s: %s; to start one, run 'petri view SCRIPT.fl --listen %s'", path,
                descriptor < 0 ? "name too long" : strerror(errno), path);
        return -1;
    }
    return descriptor;
}

// Returns `done` of the reply's last line, or NULL if the reply does not end with such a line.
static const Json *find_done(JsonDocument *document, const Text *reply) {
    size_t end = reply->len - (reply->bytes[reply->len - 1] == '\n'), start = end;
    while (start > 0 && reply->bytes[start - 1] != '\n')
        start--;
    return json_get(json_read(document, (Str){reply->bytes + start, end - start}, 1), "done");
}

static int send_text(const char *path, const Text *text) {
    int view = connect_to(path);
    SCOPED_TEXT reply = {0};
    SCOPED_JSON document = {0};
    if (view < 0)
        return STATUS_FAILED;
    bool sent = file_write(view, text->bytes, text->len) && shutdown(view, SHUT_WR) == 0 &&
                text_read(&reply, view, SIZE_MAX / 2);
    close(view);
    if (!sent || reply.len == 0) {
        message("the view closed the connection without an answer");
        return STATUS_FAILED;
    }
    int status = output_text(reply.bytes, reply.len, STATUS_DONE);
    const Json *done = find_done(&document, &reply);
    if (!done)
        message("the view closed the connection before the end of its answer");
    return status == STATUS_DONE && json_is(done, JSON_TRUE) ? STATUS_DONE : STATUS_FAILED;
}

// Sends the code, or standard input if it is `-`.
static int send_code(const char *socket, const char *code) {
    SCOPED_TEXT text = {0};
    text_add_c(&text, "");
    if (!script_is_stdin(code)) {
        text_add_c(&text, code);
    } else if (!text_read(&text, STDIN_FILENO, MAX_BYTES)) {
        message("cannot read standard input: %s", strerror(errno));
        return STATUS_FAILED;
    }
    return send_text(socket, &text);
}

static int send_run(const CommandContext *context, Options *options) {
    (void)context;
    const Own *own = options->own;
    return send_code(own->send, options->script);
}

// clang-format off
static const OptionSpec ROWS[] = {
    OWN("send", 0, "SOCKET", option_text, send, "send code, the operand, to the view that listens on SOCKET, and print its answer")
    NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable SEND_OPTIONS = {ROWS, sizeof(Own), NULL};

const Command SEND_COMMAND = {
    .name = "view --send",
    .operands = "SOCKET TEXT",
    .summary = "evaluate code in a running `petri view`",
    .details =
        "Sends TEXT (-: standard input) to a view that was started with --listen SOCKET, and prints its answer as\n"
        "lines of JSON: {\"text\": ...} for values and debug(), diagnostics, and finally {\"done\": true}. TEXT is\n"
        "evaluated as in petri repl: expressions are evaluated once, bindings and nodes in every frame, after the\n"
        "script. '.set NAME VALUE' sets a parameter, '.set NAME' resets it to its default, '.back N' goes back N\n"
        "frames, '.drop' removes what was sent before, '.reset' restarts the script. Other commands of petri repl "
        "work\n"
        "if they stay in the frame: '.particles', '.why ID', '.energy', '.help'. Exits with 1 if the text was "
        "rejected.",
    .examples = "  petri view dish.fl --listen /tmp/dish &\n"
                "  petri view --send /tmp/dish 'len($)'\n"
                "  petri view --send /tmp/dish '.set SPEED 0.5'\n",
    .missing_operand = "no code given",
    .second_operand_error = "too many arguments: '%s'; put the code in quotes",
    .options = &SEND_OPTIONS,
    .run = send_run,
};

static int old_send_run(const CommandContext *context, Options *options) {
    (void)context;
    if (options->argc == 2)
        return send_code(options->argv[0], options->argv[1]);
    if (options->argc == 1 && (strcmp(options->argv[0], "--help") == 0 || strcmp(options->argv[0], "-h") == 0))
        return help_for(&SEND_COMMAND);
    message("expected a socket and code, as in: petri view --send /tmp/dish 'let SPEED=2'; '-' reads the code from "
            "standard input");
    return STATUS_USAGE;
}

const Command OLD_SEND_COMMAND = {
    .name = "send",
    .operands = "SOCKET TEXT",
    .details = "Does the same as 'petri view --send SOCKET TEXT', its new name.",
    .parses_arguments = true,
    .run = old_send_run,
};
