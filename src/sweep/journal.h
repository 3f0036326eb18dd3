// journal.h: what is done, in a file beside the table to come, so that the same command goes on where one was ended.
//
// OUT.part, or OUT.part-2-of-4 of the second of four shards: a line that identifies the sweep, and then each run as it
// was done. A run that was cut is not there. The table is made from all such files beside it that are of the same
// sweep.
#ifndef PETRI_SRC_JOURNAL_H
#define PETRI_SRC_JOURNAL_H

#include "sweep/sweep.h"

typedef struct Journal {
    char *path; // NULL: there is none
    int file;
    const char *output; // the table to come
} Journal;

// Opens the journal beside the table `output`, and takes what is done from it and from those of others. STATUS_DONE, or
// the status to exit with after a message.
int journal_open(Journal *journal, Integrator *sweep, const char *output);
// False after a message.
bool journal_add(Journal *journal, size_t run, const Result *result);
// Takes what others have done meanwhile.
void journal_merge(const Journal *journal, Integrator *sweep);
// Removes all journals of the sweep: the table is there.
void journal_remove(const Journal *journal, Integrator *sweep);
void journal_close(Journal *journal);

#endif
