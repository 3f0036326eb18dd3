// fuzz_listen.c: fuzzes the socket of `petri view --listen`. The input is a sequence of texts that clients send,
// separated by a byte 30. A frame is computed after each of them.
#include "cli/options.h"
#include "fuzz.h"
#include "petri-edit.h"
#include "view/listen.h"
#include "view/options.h"

#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

static const char SCRIPT[] = "let SIZE=SIZE or 2 -- 1..9 how many\n"
                             "!physics state=:cells dimensions=2\n"
                             "    for i in ..SIZE\n"
                             "        !particle id=i position=i;0 velocity=1;i radius=1\n"
                             "!counter state=:n rate=60\n"
                             "!shape size=SIZE at=$:n\n";

static LiveScript live;

// Opens the live script. Its session stays open for many inputs, because opening it takes long.
static int open_live(const CommandContext *context, Options *options) {
    static Options copy;
    static ViewOptions own;
    options->work = 1 << 22;
    options->memory = 64 << 20;
    copy = *options;
    copy.script = "fuzz.fl";
    copy.realtime = false;
    own = *view_options(options);
    own.listen = "listener";
    copy.own = &own;
    live = (LiveScript){.awaits_display = true};
    if (live_script_open(&live, context, &copy) != OPTIONS_READ)
        fuzz_fail("cannot open the script");
    live_script_enable_history(&live);
    return STATUS_DONE;
}

static void open_script(void) {
    static const CommandContext context = {.program = "petri", .invoked_as = "petri", .stack_bytes = 1 << 20};
    static char words[][16] = {"--quiet", "--threads", "1", "fuzz.fl"};
    Command command = VIEW_COMMAND;
    char *arguments[] = {words[0], words[1], words[2], words[3], NULL};
    fuzz_put("fuzz.fl", SCRIPT, sizeof SCRIPT - 1);
    if (chdir(fuzz_file("")) != 0)
        fuzz_fail("cannot enter the harness's folder");
    command.run = open_live;
    command_run(&command, &context, 4, arguments);
}

static void send_text(const char *text, size_t length) {
    int ends[2];
    static char name[] = "listener";
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0 || write(ends[0], text, length) != (ssize_t)length)
        fuzz_fail("cannot write to the socket");
    shutdown(ends[0], SHUT_WR);
    Listener listener = {.path = name, .socket = -1, .client = ends[1]};
    listener_serve(&listener, &live);
    if (listener.client >= 0)
        fuzz_fail("a client was not answered");
    text_free(&listener.text);
    close(ends[0]);
}

FUZZ_HARNESS(listen) {
    enum { INPUTS = 200 }; // number of inputs for which a session is used
    static unsigned count;
    const char *at = (const char *)data, *end = at + size, *part;
    size_t length;
    if (count % INPUTS == 0)
        open_script();
    fuzz_watch(live.session);
    petri_prompt_clear(live.session, true);
    live_script_reset(&live);
    while (fuzz_next_part(&at, end, &part, &length)) {
        send_text(part, length);
        if (!live_script_halted(&live))
            live_script_step(&live);
    }
    fuzz_end_watch();
    if (++count % INPUTS == 0)
        live_script_close(&live);
    return 0;
}
