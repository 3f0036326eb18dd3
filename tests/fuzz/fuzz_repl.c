// fuzz_repl.c: fuzzes `petri repl`. The input is the typed text. Skips inputs that could write outside the harness's
// folder.
#include "cli/cli.h"
#include "fuzz.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The linker uses this function instead of clock_seconds (meson.build). Its time passes quickly, because `.time`
// repeats an expression for a while.
double __wrap_clock_seconds(void);
double __wrap_clock_seconds(void) {
    static double now;
    return now += 0.02;
}

static const char SCRIPT[] = "let SIZE=SIZE or 2 -- 1..9 how many\n"
                             "!physics state=:cells dimensions=2\n"
                             "    for i in ..SIZE\n"
                             "        !particle id=i position=i;0 velocity=1;i radius=1\n"
                             "    !collision\n"
                             "!counter state=:n rate=60\n"
                             "!shape size=SIZE at=$:n\n";

// Returns true if a line is a command (it begins with a dot) that may name another folder.
static bool leaves_folder(const uint8_t *data, size_t size) {
    bool command = false, start = true;
    for (size_t i = 0; i < size; i++) {
        command = start && data[i] == '.' ? true : command && data[i] != '\n';
        start = data[i] == '\n' || (start && (data[i] == ' ' || data[i] == '\t'));
        if (command && (data[i] == '/' || data[i] == '~'))
            return true;
    }
    return false;
}

FUZZ_HARNESS(repl) {
    static const CommandContext host = {.program = "petri", .invoked_as = "petri", .stack_bytes = 1 << 20};
    static char words[][16] = {"--threads", "1", "--limit", "20", "--work", "2M", "fuzz.fl"};
    if (leaves_folder(data, size))
        return 0;
    fuzz_put("fuzz.fl", SCRIPT, sizeof SCRIPT - 1);
    fuzz_put("typed", data, size);
    if (chdir(fuzz_file("")) != 0 || !freopen(fuzz_file("typed"), "rb", stdin))
        fuzz_fail("cannot redirect the input");
    setenv("EDITOR", "true", 1);
    setenv("VISUAL", "true", 1);
    struct sigaction before;
    sigaction(SIGINT, NULL, &before);
    char *arguments[] = {words[0], words[1], words[2], words[3], words[4], words[5], words[6], NULL};
    fuzz_watch(NULL);
    command_run(&REPL_COMMAND, &host, 7, arguments);
    fuzz_end_watch();
    sigaction(SIGINT, &before, NULL);
    return 0;
}
