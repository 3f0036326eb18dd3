// signal_cleanup.h: actions on unfinished files, run before a signal ends the process.
#pragma once

// An action. It is called from a signal handler, possibly twice, possibly while another thread completes the file.
typedef void SignalCleanup(void *context);

// Registers the action for a file that is being written. Returns the number of the action, or -1 if too many are
// registered. Any thread may call this function. Once signal_cleanup_run has started, signal_cleanup_begin waits until
// the process ends and never returns.
int signal_cleanup_begin(SignalCleanup *act, void *context);
// Removes an action, because the file is complete or deleted. -1 is ignored.
void signal_cleanup_end(int number);
// Runs all actions. To be called by a signal handler that then terminates the process.
void signal_cleanup_run(void);
