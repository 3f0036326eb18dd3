// hints.c: telling what to type next.
#include "cli/hints.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/bytes.h"

// A path as a shell takes it.
static void add_word(Bytes *text, const char *path) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+,:@%=-";
    if (path[0] != '\0' && path[strspn(path, plain)] == '\0') {
        bytes_add_text(text, path);
        return;
    }
    bytes_format(text, "'");
    for (const char *c = path; *c != '\0'; c++) {
        bytes_format(text, *c == '\'' ? "'\\''" : "%c", *c);
    }
    bytes_format(text, "'");
}

// The program as it was called, from the current folder where it is below that.
static void add_program(Bytes *text, const char *called) {
    char *folder = getcwd(NULL, 0);
    size_t length = folder == NULL ? 0 : strlen(folder);
    if (length > 1 && strncmp(called, folder, length) == 0 && called[length] == '/') {
        const char *below = called + length + 1;
        bytes_add_text(text, strchr(below, '/') == NULL ? "./" : "");
        called = below;
    }
    add_word(text, called);
    free(folder);
}

void hint_pictures(const Host *host, const char *script) {
    SCOPED_BYTES program = {0};
    SCOPED_BYTES operand = {0};
    add_program(&program, host->called);
    add_word(&operand, script);
    message("to see it: %s view %s", program.data, operand.data);
    message("to keep a picture of it: %s render %s -o OUT.png (or OUT.mp4)", program.data, operand.data);
}
