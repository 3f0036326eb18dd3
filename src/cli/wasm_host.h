// wasm_host.h: functions that petri-command.wasm imports from JavaScript, in addition to the system calls of
// emscripten's C library. src/web/engine/system.mjs provides them. They return a negative number of an error on
// failure.
#pragma once

#include <stdbool.h>

#ifdef __EMSCRIPTEN__
#define HOST(name) __attribute__((import_module("petri"), import_name(#name)))
#else // so that each header compiles alone
#define HOST(name)
#endif

// Returns a new descriptor, at least `min`, of the same open file.
HOST(duplicate) int host_duplicate(int descriptor, int min);
// Returns 0 if the descriptor is open.
HOST(descriptor_flags) int host_descriptor_flags(int descriptor);
// Ends the program as if by a signal.
HOST(end_by_signal) _Noreturn void host_end_by_signal(int number);
// Replaces the program by another one of the package, with the same open standard descriptors.
HOST(execute) int host_execute(const char *program, char *const *argv);
// Returns the number of processors.
HOST(processors) int host_processors(void);
// Starts petri with other arguments in another instance and thread, without standard input. Returns its process id.
// host_wait waits until it ends, returns its process id and sets *status like waitpid.
HOST(start) int host_start(const char *folder, char *const *argv, int output, int errors);
HOST(wait) int host_wait(int pid, int *status);
// Starts helpers: `count` instances of this command that share a list of runs. Their output is discarded.
HOST(start_helpers) int host_start_helpers(int count, const int *runs, int run_count);
HOST(is_helper) bool host_is_helper(void);
// In a helper, removes a run from the list and returns it; -1 if the list is empty.
HOST(take_run) int host_take_run(void);
// Sends a result from a helper.
HOST(send) void host_send(const char *bytes, int length);
// Waits for a result of a helper and returns its length; -1 if all helpers have ended, or after a signal. host_read
// copies the result.
HOST(receive) int host_receive(void);
HOST(read) void host_read(char *bytes);
