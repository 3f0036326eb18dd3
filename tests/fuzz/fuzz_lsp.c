// fuzz_lsp.c: fuzzes the language server. If the first byte of the input is '#', the rest is what the editor sends.
// Otherwise, the input is a list of messages, separated by a byte 30, and the headers are added here.
#include "cli/options.h"
#include "fuzz.h"
#include "lsp/rpc.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The linker uses the functions __wrap_… instead of those without this prefix (meson.build).
bool __wrap_rpc_has_input(const Text *input);
DIR *__wrap_opendir(const char *folder);
DIR *__real_opendir(const char *folder);

static unsigned asked; // number of calls of rpc_has_input during this input
static bool serving;   // true while the server runs; libFuzzer also lists folders

// Lets the server check documents after every second message, as it does when the editor sends nothing for a while.
bool __wrap_rpc_has_input(const Text *input) {
    (void)input;
    return asked++ % 2 == 1;
}

// Lists only the harness's folder, because other folders differ from run to run.
DIR *__wrap_opendir(const char *folder) {
    char own[200];
    snprintf(own, sizeof own, "%s", fuzz_file(""));
    own[strlen(own) - 1] = '\0'; // the slash
    return !serving || strncmp(folder, own, strlen(own)) == 0 ? __real_opendir(folder) : NULL;
}

static void add_message(FuzzText *all, const char *message, size_t length) {
    char header[40];
    int count = snprintf(header, sizeof header, "Content-Length: %zu\r\n\r\n", length);
    fuzz_append(all, header, (size_t)count);
    fuzz_append(all, message, length);
}

FUZZ_HARNESS(lsp) {
    static const CommandContext context = {.program = "petri", .invoked_as = "petri", .stack_bytes = 1 << 20};
    static const char first[] = "{\"id\":0,\"method\":\"initialize\",\"params\":{}}";
    FuzzText messages = {0};
    if (asked == 0) {
        fuzz_put("part.fl", "let part=3\nfunc twice(x)\n    2*x\n", 33);
        if (chdir(fuzz_file("")) != 0)
            fuzz_fail("cannot enter the harness's folder");
    }
    add_message(&messages, first, sizeof first - 1);
    fuzz_put_parts("sent", &messages, data, size, add_message);
    int file = open(fuzz_file("sent"), O_RDONLY);
    if (file < 0 || dup2(file, STDIN_FILENO) < 0)
        fuzz_fail("cannot redirect the input");
    close(file);
    asked = 2;
    char *words[] = {"--work=1M", "--memory=64M", NULL};
    fuzz_watch(NULL);
    serving = true;
    command_run(&LSP_COMMAND, &context, 2, words);
    serving = false;
    fuzz_end_watch();
    return 0;
}
