// signal_cleanup.h: what is still to be done about files that are being written when a signal ends the process at once.
#ifndef PETRI_SRC_SIGNAL_CLEANUP_H
#define PETRI_SRC_SIGNAL_CLEANUP_H

// Called from a signal handler, perhaps twice, and perhaps while another thread is just ending the file.
typedef void SignalCleanup(void *context);

// A file is begun. Returns its number, -1 if there are too many. Any thread may call this; it does not return once the
// end has come.
int signal_cleanup_begin(SignalCleanup *act, void *context);
// It is complete, or removed. -1 is fine.
void signal_cleanup_end(int number);
// Does what is to be done. For a signal handler that ends the process next.
void signal_cleanup_run(void);

#endif
