// journal.c: see journal.h.
//
// As in SQLite, reading ends at the first record that is incomplete or has a wrong checksum. SQLite does not change a
// page of the database before its record is on disk.
#include "recording/journal.h"

#include "base/file.h"
#include "base/heap.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const unsigned char archive_journal_magic[ARCHIVE_JOURNAL_MAGIC_BYTES] = {0xd9, 0xd5, 0x05, 0xf9,
                                                                          0x20, 0xa1, 0x63, 0xd7};

enum {
    HEADER_BYTES = ARCHIVE_JOURNAL_MAGIC_BYTES + 20,
    MIN_SECTOR = 512, // a shorter journal is not complete
    MAX_PAGE = 65536,
    CHECKSUM_STEP = 200,                // bytes between those that the checksum of a page includes
    PENDING_BYTE = 0x40000000,          // the page with this byte of a database is not used
    OVERHEAD = 2 * (int)sizeof(int32_t) // of a page: its number before it, its checksum after it
};

// A part of the journal, which SQLite begins when its cache is full.
typedef struct Segment {
    uint32_t records; // UINT32_MAX: up to the end of the file
    uint32_t nonce;   // to which the checksums are added
    uint32_t page_count;
    uint32_t sector_size;
    uint32_t page_size;
} Segment;

static uint32_t big_endian(const unsigned char *bytes) {
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

// Returns false if there is no segment at this position.
static bool read_header(int file, int64_t at, Segment *segment) {
    unsigned char header[HEADER_BYTES];
    if (pread(file, header, sizeof header, (off_t)at) != HEADER_BYTES ||
        memcmp(header, archive_journal_magic, sizeof archive_journal_magic) != 0)
        return false;
    uint32_t fields[5];
    for (size_t i = 0; i < 5; i++)
        fields[i] = big_endian(header + ARCHIVE_JOURNAL_MAGIC_BYTES + 4 * i);
    *segment = (Segment){fields[0], fields[1], fields[2], fields[3], fields[4]};
    return true;
}

static bool is_power_between(uint32_t x, uint32_t min, uint32_t max) {
    return x >= min && x <= max && (x & (x - 1)) == 0;
}

static bool has_checksum(const unsigned char *page, uint32_t size, uint32_t nonce) {
    uint32_t sum = nonce;
    for (uint32_t at = size - CHECKSUM_STEP; at > 0 && at < size; at -= CHECKSUM_STEP)
        sum += page[at];
    return sum == big_endian(page + size);
}

static bool add_page(Journal *journal, uint32_t number, int64_t at) {
    if (!heap_reserve((void **)&journal->pages, &journal->capacity, journal->count, sizeof *journal->pages))
        return false;
    journal->pages[journal->count++] = (JournalPage){number, at};
    return true;
}

// Reads the records of a segment from *at on. Sets *at to their end, or to `size` after a record that was not written
// completely. Returns false if out of memory.
static bool read_records(Journal *journal, int file, const Segment *segment, int64_t size, int64_t *at) {
    unsigned char record[4 + MAX_PAGE + 4];
    uint32_t page_size = journal->page_size;
    ssize_t length = (ssize_t)page_size + OVERHEAD;
    for (uint32_t i = 0; i < segment->records; i++) {
        bool complete = pread(file, record, (size_t)length, (off_t)*at) == length;
        uint32_t number = big_endian(record);
        if (!complete || number == 0 || number == PENDING_BYTE / page_size + 1 ||
            (number <= journal->page_count && !has_checksum(record + 4, page_size, segment->nonce))) {
            *at = size;
            return true;
        }
        if (number <= journal->page_count && !add_page(journal, number, *at + 4))
            return false;
        *at += length;
    }
    return true;
}

// If there are two records of a page, SQLite applies the second one last.
static int compare_pages(const void *a, const void *b) {
    const JournalPage *x = a, *y = b;
    return x->number != y->number ? (x->number < y->number ? -1 : 1) : (x->at > y->at) - (x->at < y->at);
}

// A journal of several databases ends with the name of another file, which SQLite would delete. Petri writes none.
static bool has_super_journal(int file, int64_t size) {
    unsigned char end[ARCHIVE_JOURNAL_MAGIC_BYTES];
    return pread(file, end, sizeof end, (off_t)size - ARCHIVE_JOURNAL_MAGIC_BYTES) == ARCHIVE_JOURNAL_MAGIC_BYTES &&
           memcmp(end, archive_journal_magic, sizeof end) == 0;
}

const char *archive_journal_read(Journal *journal, int file) {
    Segment segment;
    int64_t size = lseek(file, 0, SEEK_END), at = 0;
    if (size < MIN_SECTOR || !read_header(file, 0, &segment))
        return NULL;
    if (has_super_journal(file, size))
        return "it names another journal";
    if (!is_power_between(segment.page_size, 512, MAX_PAGE) || !is_power_between(segment.sector_size, 32, MAX_PAGE))
        return "its header is not valid";
    journal->exists = true;
    journal->page_size = segment.page_size;
    journal->page_count = segment.page_count;
    const int64_t sector = segment.sector_size;
    do {
        at += sector;
        if (!read_records(journal, file, &segment, size, &at))
            return "out of memory";
        at = (at + sector - 1) / sector * sector;
    } while (at + sector <= size && read_header(file, at, &segment));
    if (journal->count > 0)
        qsort(journal->pages, journal->count, sizeof *journal->pages, compare_pages);
    return NULL;
}

int64_t archive_journal_find(const Journal *journal, uint32_t page) {
    uint32_t from = 0, to = journal->count;
    while (from < to) {
        uint32_t middle = from + (to - from) / 2;
        if (journal->pages[middle].number <= page)
            from = middle + 1;
        else
            to = middle;
    }
    return from > 0 && journal->pages[from - 1].number == page ? journal->pages[from - 1].at : -1;
}

void archive_journal_free(Journal *journal) {
    heap_free(journal->pages);
    *journal = (Journal){0};
}
