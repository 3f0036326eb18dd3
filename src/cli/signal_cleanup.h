// signal_cleanup.h: actions on unfinished files, run before a signal ends the process.
#ifndef PETRI_SRC_SIGNAL_CLEANUP_H
#define PETRI_SRC_SIGNAL_CLEANUP_H

// An action. It is called from a signal handler, possibly twice, possibly while another thread completes the file.
typedef void SignalCleanup(void *context);

// Registers the action for a file that is being written. Returns its number, or -1 if there are too many. Any thread
// may call it. It never returns after signal_cleanup_run has started.
int signal_cleanup_begin(SignalCleanup *act, void *context);
// Removes an action, because the file is complete or deleted. -1 is ignored.
void signal_cleanup_end(int number);
// Runs all actions. For a signal handler that ends the process afterwards.
void signal_cleanup_run(void);

#endif
