// journal.h: the rollback journal beside a database, as https://sqlite.org/fileformat.html#the_rollback_journal defines
// it. It has the former contents of the pages that a transaction changes. After a recording was killed, a reader takes
// these pages from the journal, so that neither file is written.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { ARCHIVE_JOURNAL_MAGIC_BYTES = 8 };
extern const unsigned char archive_journal_magic[ARCHIVE_JOURNAL_MAGIC_BYTES];

typedef struct JournalPage {
    uint32_t number; // of the page, from 1
    int64_t at;      // position of its contents in the journal
} JournalPage;

// A journal that was read. Starts as zeros.
typedef struct Journal {
    JournalPage *pages; // in the order of their numbers
    uint32_t count;
    uint32_t capacity;
    uint32_t page_size;
    uint32_t page_count; // of the database before the transaction
    bool exists;         // false: there is no transaction to undo
} Journal;

// Reads the journal in an open file. Returns NULL, or why the journal cannot be used. In both cases, the caller calls
// archive_journal_free.
const char *archive_journal_read(Journal *journal, int file);
// Returns the position of the contents of a page in the journal, or -1 if the database has them.
int64_t archive_journal_find(const Journal *journal, uint32_t page);
void archive_journal_free(Journal *journal);
