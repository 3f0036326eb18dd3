// system.c: functions of the C library that emscripten provides only with its own JavaScript.
#include "cli/wasm_host.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <unistd.h>

// Replaces a function of emscripten that opens no files.
long __syscall_openat(long folder, long path, long flags, ...);
long __syscall_open(long path, long flags, ...);

long __syscall_open(long path, long flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    long mode = flags & O_CREAT ? va_arg(arguments, long) : 0;
    va_end(arguments);
    return __syscall_openat(AT_FDCWD, path, flags, mode);
}

static int return_or_set_errno(int result) {
    if (result >= 0)
        return result;
    errno = -result;
    return -1;
}

int fcntl(int descriptor, int command, ...) {
    va_list arguments;
    va_start(arguments, command);
    int argument = command == F_DUPFD || command == F_DUPFD_CLOEXEC ? va_arg(arguments, int) : 0;
    va_end(arguments);
    switch (command) {
    case F_DUPFD:
    case F_DUPFD_CLOEXEC:
        return return_or_set_errno(host_duplicate(descriptor, argument));
    case F_GETFD:
    case F_SETFD:
    case F_GETFL:
    case F_SETFL:
    case F_SETLK: // Node.js cannot lock files, so every lock succeeds
        return return_or_set_errno(host_descriptor_flags(descriptor));
    default:
        errno = ENOTSUP;
        return -1;
    }
}

int execvp(const char *program, char *const *argv) {
    return return_or_set_errno(host_execute(program, argv));
}

// emscripten's function ignores signals without a handler.
int raise(int number) {
    struct sigaction action;
    if (sigaction(number, NULL, &action) != 0)
        return -1;
    if (action.sa_handler == SIG_DFL)
        host_end_by_signal(number);
    if (action.sa_flags & SA_RESETHAND)
        signal(number, SIG_DFL);
    if (action.sa_handler != SIG_IGN)
        action.sa_handler(number);
    return 0;
}

// Called by JavaScript for a signal that the process has received. Returns -1 if it must end the program.
__attribute__((export_name("raise_signal"))) int raise_signal(int number);

int raise_signal(int number) {
    struct sigaction action;
    return sigaction(number, NULL, &action) != 0 || action.sa_handler == SIG_DFL ? -1 : raise(number);
}
