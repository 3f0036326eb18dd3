// wasm_host.h: functions that petri-command.wasm imports from JavaScript, in addition to the system calls of
// emscripten's C library. src/web/engine/system.mjs provides them. They return a negative number of an error on
// failure.
#pragma once

#ifdef __EMSCRIPTEN__
#define HOST(name) __attribute__((import_module("petri"), import_name(#name)))
#else // so that each header compiles alone
#define HOST(name)
#endif

// Returns a new descriptor, at least `least`, of the same open file.
HOST(duplicate) int host_duplicate(int descriptor, int least);
// Returns 0 if the descriptor is open.
HOST(descriptor_flags) int host_descriptor_flags(int descriptor);
// Ends the program as if by a signal.
HOST(end_by_signal) _Noreturn void host_end_by_signal(int number);
// Runs petri with other arguments in another instance, without standard input, and returns its process id after it has
// ended. host_wait returns it and sets *status like waitpid.
HOST(start) int host_start(const char *folder, char *const *argv, int output, int errors);
HOST(wait) int host_wait(int pid, int *status);
