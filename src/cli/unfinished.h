// unfinished.h: files that are being written, for when a signal ends the process at once: they must not stay behind.
//
// Files grow under another name beside the one that is wanted (FILE.PID.tmp) and are renamed when they are complete.
#ifndef PETRI_SRC_UNFINISHED_H
#define PETRI_SRC_UNFINISHED_H

#include <sys/types.h>

// A file is begun: what grows beside it is known from now on. Returns its number, -1 if there are too many. Any thread
// may call this; it does not return once the end has come.
int unfinished_begin(const char *file);
// A process of ours writes it.
void unfinished_process(int number, pid_t process);
// It is complete, or removed. -1 is fine.
void unfinished_end(int number);
// Removes what has been begun and kills the processes. For a signal handler that ends the process next.
void unfinished_abandon(void);

#endif
