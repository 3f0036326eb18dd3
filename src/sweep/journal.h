// journal.h: the journal of finished runs. After an interruption, the same command resumes the sweep from it.
//
// The journal is a file beside the table: OUT.part, or OUT.part-2-of-4 for the second of four shards. Its first line
// identifies the sweep. The results follow in the order in which runs finished. An incomplete result at the end is
// ignored. The table contains the results in all journals of the sweep.
#pragma once

#include "sweep/sweep.h"

typedef struct Journal {
    char *path; // NULL: no journal
    int file;
    const char *output; // path of the table
} Journal;

// Opens the journal beside the table `output`, and reads its results and those of other shards' journals. Returns
// STATUS_DONE, or the exit status after a message.
int journal_open(Journal *journal, Sweep *sweep, const char *output);
// Appends a result. Returns false after a message.
bool journal_add(Journal *journal, size_t run, const Result *result);
// Reads the results that other shards have added to their journals since the last call.
void journal_merge(const Journal *journal, Sweep *sweep);
// Removes all journals of the sweep. Must be called after the table was written.
void journal_remove(const Journal *journal, Sweep *sweep);
void journal_close(Journal *journal);
