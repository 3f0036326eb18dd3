// listen.c: see listen.h.
//
// There is one client at a time, and reading never blocks the view. Only an answer may wait, for at most one second. A
// client that is silent for MAX_SILENCE is disconnected if another one waits. Only the owner can open the socket.
#include "view/listen.h"

#include "base/clock.h"
#include "base/file.h"
#include "cli/json.h"
#include "petri-edit.h"
#include "prompt/prompt.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

static const size_t MAX_BYTES = (size_t)1 << 20;
static const double MAX_SILENCE = 2; // seconds after which a silent client is disconnected if another one waits

// Removes a socket that no process listens on: a view that crashed has left it behind.
static void remove_dead(const struct sockaddr_un *address) {
    struct stat about;
    int probe = socket(AF_UNIX, SOCK_STREAM, 0);
    if (probe >= 0 && lstat(address->sun_path, &about) == 0 && S_ISSOCK(about.st_mode) &&
        connect(probe, (const struct sockaddr *)address, sizeof *address) != 0 && errno == ECONNREFUSED)
        unlink(address->sun_path);
    if (probe >= 0)
        close(probe);
}

static void set_flags(int descriptor) {
    fcntl(descriptor, F_SETFD, FD_CLOEXEC);
    fcntl(descriptor, F_SETFL, O_NONBLOCK);
}

bool listener_open(Listener *listener, const char *path) {
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    *listener = (Listener){.socket = -1, .client = -1};
    if (strlen(path) >= sizeof address.sun_path) {
        message("cannot listen on %s: the name is too long", path);
        return false;
    }
    strcpy(address.sun_path, path);
    remove_dead(&address);
    mode_t mask = umask(0177);
    listener->socket = socket(AF_UNIX, SOCK_STREAM, 0);
    bool bound =
        listener->socket >= 0 && bind(listener->socket, (const struct sockaddr *)&address, sizeof address) == 0;
    bool good = bound && listen(listener->socket, 8) == 0;
    int cause = errno;
    umask(mask);
    if (!good) {
        message("cannot listen on %s: %s", path, strerror(cause));
        if (listener->socket >= 0)
            close(listener->socket);
        return false;
    }
    set_flags(listener->socket);
    listener->path = memory_strdup(path);
    return true;
}

void listener_close(Listener *listener) {
    if (!listener->path)
        return;
    unlink(listener->path);
    free(listener->path);
    close(listener->socket);
    if (listener->client >= 0)
        close(listener->client);
    text_free(&listener->text);
    *listener = (Listener){0};
}

// --- answers

static void add_diagnostics(PetriSession *session, Text *out) {
    PetriDiagnostic diagnostic;
    for (size_t i = 0; petri_diagnostic(session, i, &diagnostic, sizeof diagnostic); i++) {
        json_put_diagnostic(&(JsonWriter){.out = out, .spaced = true}, &diagnostic);
        text_add_c(out, "\n");
    }
}

static void add_output(const Text *output, Text *out) {
    JsonWriter json = {.out = out, .spaced = true};
    Str line;
    for (size_t at = 0; output->len > 0 && text_next_line(output, &at, &line);) {
        json_open(&json, NULL, "{");
        json_put_str(&json, "text", line);
        json_close(&json, "}\n");
    }
}

static void add_result_line(Text *out, bool done, int64_t frame, const PetriPromptResult *prompted) {
    JsonWriter json = {.out = out, .spaced = true};
    json_open(&json, NULL, "{");
    json_put_bool(&json, "done", done);
    json_put_integer(&json, "frame", frame);
    json_put_integer(&json, "values", prompted->values);
    json_put_integer(&json, "bindings", prompted->bindings);
    json_put_integer(&json, "nodes", prompted->nodes);
    json_put_text(&json, "shadowed", prompted->shadowed);
    json_close(&json, "}\n");
}

// Executes `.set NAME VALUE`. Modifies the text. Returns false if this fails.
static bool set_parameter(LiveScript *live, char *text) {
    char *name = text + strspn(text, " "), *value = name + strcspn(name, " ");
    bool given = *value != '\0' && value[1] != '\0';
    *value = '\0';
    return live_script_set_parameter(live, name, given ? value + 1 : NULL);
}

// Executes `.back` or `.back N`. Returns false after adding the reason to `output` if this fails.
static bool go_back(LiveScript *live, const char *text, Text *output) {
    char *end;
    long long count = *text == '\0' ? 1 : strtoll(text, &end, 10);
    if (*text != '\0' && (*end != '\0' || count < 1)) {
        text_add_c(output, ".back takes a number of frames >= 1 (default: 1)");
        return false;
    }
    return live_script_go_back(live, count, output);
}

static void complain(Prompt *prompt, const char *text) {
    output_format(prompt->output, "%s\n", text);
}

static bool is_never_interrupted(Prompt *prompt) {
    (void)prompt;
    return false;
}

// Executes a command of the prompt that does not move to another frame.
static bool run_command(LiveScript *live, const char *text, Text *text_out) {
#define ONLY "works only in 'petri repl'"
    static const PromptHostCommand commands[] = {
        {".step", NULL, ONLY "; the view computes frames by itself"},
        {".run", NULL, ONLY "; the view computes frames by itself"},
        {".until", NULL, ONLY},
        {".goto", NULL, ONLY "; .back N and .reset go back in the view"},
        {".watch", NULL, ONLY},
        {".unwatch", NULL, ONLY},
        {".break", NULL, ONLY},
        {".unbreak", NULL, ONLY},
        {".reload", NULL, ONLY "; the view reloads a script that has changed"},
        {0},
    };
#undef ONLY
    static const PromptHost host = {.complain = complain, .interrupted = is_never_interrupted, .commands = commands};
    Output *output = memory_calloc(sizeof *output);
    output_start(output, -1);
    output->send = text_collect;
    output->user_data = text_out;
    Prompt prompt = {.host = &host, .session = live->session, .history = live->history, .output = output};
    bool done = prompt_execute(&prompt, text, strlen(text));
    prompt_end(&prompt);
    free(output);
    return done;
}

static ListenerResult execute_command(LiveScript *live, char *text, Text *out) {
    static const char set[] = ".set ", back[] = ".back";
    ListenerResult result = LISTENER_ACCEPTED;
    PetriPromptResult prompted = {0};
    SCOPED_TEXT output = {0};
    size_t length = strlen(text);
    while (length > 0 && strchr(" \n", text[length - 1]))
        text[--length] = '\0';
    petri_clear_diagnostics(live->session);
    bool done = true;
    if (strncmp(text, set, strlen(set)) == 0) {
        done = set_parameter(live, text + strlen(set));
    } else if (strcmp(text, back) == 0 || strncmp(text, ".back ", strlen(".back ")) == 0) {
        done = go_back(live, text + strlen(back) + (text[strlen(back)] == ' '), &output);
        result = done ? LISTENER_MOVED : LISTENER_NOTHING;
    } else if (strcmp(text, ".reset") == 0) {
        live_script_reset(live);
    } else if (strcmp(text, ".drop") == 0) {
        petri_prompt_clear(live->session, true);
    } else if (text[0] == '.' && text[1] >= 'a' && text[1] <= 'z') {
        done = run_command(live, text, &output);
    } else {
        done = petri_prompt(live->session, text, length, text_collect, &output, &prompted, sizeof prompted) == PETRI_OK;
    }
    add_output(&output, out);
    add_diagnostics(live->session, out);
    add_result_line(out, done, petri_frame_number(live->session), &prompted);
    return result;
}

// Executes the client's text and sends the answer. If the client does not read the answer, waits at most one second.
static ListenerResult answer_client(Listener *listener, LiveScript *live) {
    SCOPED_TEXT out = {0};
    text_add_c(&listener->text, "");
    ListenerResult result = execute_command(live, listener->text.bytes, &out);
    fcntl(listener->client, F_SETFL, 0);
    setsockopt(listener->client, SOL_SOCKET, SO_SNDTIMEO, &(struct timeval){.tv_sec = 1}, sizeof(struct timeval));
    (void)file_write(listener->client, out.bytes, out.len);
    return result;
}

static void disconnect_client(Listener *listener) {
    close(listener->client);
    listener->client = -1;
    listener->text.len = 0;
}

static bool has_waiting_client(const Listener *listener) {
    struct pollfd ready = {.fd = listener->socket, .events = POLLIN};
    return poll(&ready, 1, 0) > 0;
}

ListenerResult listener_serve(Listener *listener, LiveScript *live) {
    if (!listener->path)
        return LISTENER_NOTHING;
    if (listener->client < 0) {
        listener->client = accept(listener->socket, NULL, NULL);
        if (listener->client < 0)
            return LISTENER_NOTHING;
        set_flags(listener->client);
        listener->heard = clock_seconds();
    }
    char part[4096];
    ssize_t count;
    while ((count = read(listener->client, part, sizeof part)) > 0) {
        text_add(&listener->text, (Str){part, (size_t)count});
        listener->heard = clock_seconds();
        if (listener->text.len > MAX_BYTES) {
            disconnect_client(listener);
            return LISTENER_NOTHING;
        }
    }
    if (count < 0) {
        bool failed = errno != EAGAIN && errno != EINTR;
        if (failed || (clock_seconds() - listener->heard > MAX_SILENCE && has_waiting_client(listener)))
            disconnect_client(listener);
        return LISTENER_NOTHING;
    }
    ListenerResult result = answer_client(listener, live);
    disconnect_client(listener);
    return result;
}
