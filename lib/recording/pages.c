// pages.c: the connection to an archive that is read. SQLite reads pages through the functions of this file, which can
// only read the archive and its journal: they write, delete, create and lock nothing. Pages that a killed recording has
// changed come from its journal (journal.h).
#include "base/budget.h"
#include "base/file.h"
#include "base/heap.h"
#include "base/os.h"
#include "recording/archive.h"
#include "recording/journal.h"
#include "recording/recognise.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// A step of SQLite takes about 20 ns, but while it reads the schema, some steps parse a statement.
enum { STEPS_PER_CHARGE = 1000, UNITS_PER_STEP = 2, UNITS_PER_SCHEMA_STEP = 2000, UNITS_PER_READ = 30 };

struct ArchivePages {
    sqlite3_vfs vfs;
    char vfs_name[40];
    char path[PATH_MAX];
    int file;
    int journal_file; // -1: none
    Journal journal;
    struct stat opened; // when the archive was opened
};

// The file that SQLite sees.
typedef struct PagesFile {
    sqlite3_file base;
    PetriArchive *archive;
} PagesFile;

// --- reading

static int64_t size_of(const ArchivePages *pages) {
    const Journal *journal = &pages->journal;
    return journal->exists ? (int64_t)journal->page_count * journal->page_size : (int64_t)pages->opened.st_size;
}

// Returns true if no process has written the file since it was opened.
static bool is_unchanged(const ArchivePages *pages) {
    struct stat now;
    struct timespec before = os_time_modified(&pages->opened), after;
    if (fstat(pages->file, &now) != 0)
        return false;
    after = os_time_modified(&now);
    return now.st_size == pages->opened.st_size && after.tv_sec == before.tv_sec && after.tv_nsec == before.tv_nsec;
}

// Reads bytes of one page. Bytes after the end of the file are zero.
static bool read_part(const ArchivePages *pages, void *bytes, size_t length, int64_t at) {
    const Journal *journal = &pages->journal;
    int64_t from = journal->exists ? archive_journal_find(journal, (uint32_t)(at / journal->page_size + 1)) : -1;
    ssize_t got;
    do
        got = from < 0 ? pread(pages->file, bytes, length, (off_t)at)
                       : pread(pages->journal_file, bytes, length, (off_t)(from + at % journal->page_size));
    while (got < 0 && errno == EINTR);
    if (got < 0)
        return false;
    memset((char *)bytes + got, 0, length - (size_t)got);
    return true;
}

static int on_read(sqlite3_file *file, void *bytes, int length, sqlite3_int64 at) {
    PetriArchive *archive = ((PagesFile *)file)->archive;
    const ArchivePages *pages = archive->pages;
    int64_t size = size_of(pages), left = at < size ? size - at : 0;
    if (!archive_charge(archive, UNITS_PER_READ + (uint64_t)length / BUDGET_BYTES))
        return SQLITE_INTERRUPT;
    int wanted = left < length ? (int)left : length;
    for (int done = 0, part; done < wanted; done += part) {
        int64_t from = at + done, page = pages->journal.exists ? pages->journal.page_size : INT_MAX;
        int64_t rest = page - from % page;
        part = rest < wanted - done ? (int)rest : wanted - done;
        if (!read_part(pages, (char *)bytes + done, (size_t)part, from))
            return SQLITE_IOERR_READ;
    }
    if (!is_unchanged(pages))
        return SQLITE_BUSY;
    memset((char *)bytes + wanted, 0, (size_t)(length - wanted));
    return wanted < length ? SQLITE_IOERR_SHORT_READ : SQLITE_OK;
}

static int on_close(sqlite3_file *file) {
    (void)file;
    return SQLITE_OK;
}

static int on_write(sqlite3_file *file, const void *bytes, int length, sqlite3_int64 at) {
    (void)file, (void)bytes, (void)length, (void)at;
    return SQLITE_READONLY;
}

static int on_truncate(sqlite3_file *file, sqlite3_int64 size) {
    (void)file, (void)size;
    return SQLITE_READONLY;
}

static int on_file_size(sqlite3_file *file, sqlite3_int64 *size) {
    *size = size_of(((PagesFile *)file)->archive->pages);
    return SQLITE_OK;
}

static int on_lock(sqlite3_file *file, int level) {
    (void)file, (void)level;
    return SQLITE_OK;
}

static int on_check_lock(sqlite3_file *file, int *locked) {
    (void)file;
    *locked = 0;
    return SQLITE_OK;
}

static int on_control(sqlite3_file *file, int operation, void *argument) {
    (void)file, (void)operation, (void)argument;
    return SQLITE_NOTFOUND;
}

static int sector_size(sqlite3_file *file) {
    (void)file;
    return 512;
}

// SQLite neither locks an immutable file nor looks for journals beside it.
static int characteristics(sqlite3_file *file) {
    (void)file;
    return SQLITE_IOCAP_IMMUTABLE;
}

static const sqlite3_io_methods methods = {
    .iVersion = 1,
    .xClose = on_close,
    .xRead = on_read,
    .xWrite = on_write,
    .xTruncate = on_truncate,
    .xSync = on_lock,
    .xFileSize = on_file_size,
    .xLock = on_lock,
    .xUnlock = on_lock,
    .xCheckReservedLock = on_check_lock,
    .xFileControl = on_control,
    .xSectorSize = sector_size,
    .xDeviceCharacteristics = characteristics,
};

// --- the file system, which has only the archive

// Other files, such as temporary ones, cannot be opened.
static int on_open(sqlite3_vfs *vfs, const char *name, sqlite3_file *file, int flags, int *given) {
    (void)name;
    file->pMethods = NULL;
    if (!(flags & SQLITE_OPEN_MAIN_DB))
        return SQLITE_CANTOPEN;
    PagesFile *opened = (PagesFile *)file;
    opened->archive = vfs->pAppData;
    opened->base.pMethods = &methods;
    if (given)
        *given = SQLITE_OPEN_READONLY | SQLITE_OPEN_MAIN_DB;
    return SQLITE_OK;
}

static int on_delete(sqlite3_vfs *vfs, const char *name, int sync) {
    (void)vfs, (void)name, (void)sync;
    return SQLITE_IOERR_DELETE;
}

static int on_access(sqlite3_vfs *vfs, const char *name, int flags, int *result) {
    (void)vfs, (void)name, (void)flags;
    *result = 0;
    return SQLITE_OK;
}

static int full_path(sqlite3_vfs *vfs, const char *name, int size, char *path) {
    (void)vfs;
    return snprintf(path, (size_t)size, "%s", name) < size ? SQLITE_OK : SQLITE_CANTOPEN;
}

// Reading needs no random numbers, pauses and times.
static int randomness(sqlite3_vfs *vfs, int size, char *bytes) {
    (void)vfs;
    memset(bytes, 0, (size_t)size);
    return size;
}

static int no_sleep(sqlite3_vfs *vfs, int microseconds) {
    (void)vfs, (void)microseconds;
    return 0;
}

static int no_time(sqlite3_vfs *vfs, double *days) {
    (void)vfs;
    *days = 0;
    return SQLITE_OK;
}

static int last_error(sqlite3_vfs *vfs, int size, char *text) {
    (void)vfs, (void)size, (void)text;
    return 0;
}

// --- opening

static bool open_journal(PetriArchive *archive, ArchivePages *pages) {
    char path[PATH_MAX + sizeof "-journal"];
    struct stat info;
    snprintf(path, sizeof path, "%s-journal", pages->path);
    pages->journal_file = archive_open_regular(path, O_NOFOLLOW, &info);
    if (pages->journal_file < 0)
        return true;
    const char *problem = archive_journal_read(&pages->journal, pages->journal_file);
    return !problem || archive_fail(archive, "its journal '%s' cannot be used: %s", path, problem);
}

// Checks those fields of the header of which SQLite would accept other values.
static bool check_header(PetriArchive *archive, const ArchivePages *pages) {
    enum { PAGE_SIZE_AT = 16, VERSIONS_AT = 18, ENCODING_AT = 56, HEADER = 100 };
    unsigned char header[HEADER];
    if (size_of(pages) == 0)
        return archive_fail(archive, "it has no frames"); // the transaction that creates the tables is undone
    if (size_of(pages) < HEADER || !read_part(pages, header, HEADER, 0))
        return archive_fail(archive, "the archive is damaged: its header is incomplete");
    uint32_t page_size = (uint32_t)header[PAGE_SIZE_AT] << 8 | header[PAGE_SIZE_AT + 1];
    page_size = page_size == 1 ? 65536 : page_size;
    if (header[VERSIONS_AT] != 1 || header[VERSIONS_AT + 1] != 1)
        return archive_fail(archive, "it is a database with a write-ahead log, which no archive is");
    if (header[ENCODING_AT + 3] != SQLITE_UTF8)
        return archive_fail(archive, "the archive is damaged: its texts are not in UTF-8");
    return !pages->journal.exists || page_size == pages->journal.page_size ||
           archive_fail(archive, "its journal cannot be used: it has other pages");
}

// Returns the number of bytes of contents that the archive can have. A sparse file has less than its size, but a file
// system that compresses can store a text in a small part of its size.
static uint64_t content_limit(const ArchivePages *pages) {
    const uint64_t min = 1 << 20, compression = 64, block = 512;
    uint64_t size = (uint64_t)size_of(pages), blocks = (uint64_t)pages->opened.st_blocks;
    uint64_t stored = blocks > size / block / compression ? size : blocks * block * compression;
    stored = blocks == 0 ? size : stored; // not all file systems count blocks
    return stored > min ? stored : min;
}

static int on_progress(void *user_data) {
    PetriArchive *archive = user_data;
    return !archive_charge(archive, STEPS_PER_CHARGE * (archive->has_schema ? UNITS_PER_STEP : UNITS_PER_SCHEMA_STEP));
}

static bool connect(PetriArchive *archive, ArchivePages *pages) {
    snprintf(pages->vfs_name, sizeof pages->vfs_name, "petri-%p", (void *)pages);
    pages->vfs = (sqlite3_vfs){
        .iVersion = 1,
        .szOsFile = sizeof(PagesFile),
        .mxPathname = 64,
        .zName = pages->vfs_name,
        .pAppData = archive,
        .xOpen = on_open,
        .xDelete = on_delete,
        .xAccess = on_access,
        .xFullPathname = full_path,
        .xRandomness = randomness,
        .xSleep = no_sleep,
        .xCurrentTime = no_time,
        .xGetLastError = last_error,
    };
    int result = sqlite3_initialize();
    if (result == SQLITE_OK)
        result = sqlite3_vfs_register(&pages->vfs, 0);
    if (result != SQLITE_OK)
        return archive_fail_sqlite(archive, result);
    result =
        sqlite3_open_v2("archive", &archive->database, SQLITE_OPEN_READONLY | SQLITE_OPEN_FULLMUTEX, pages->vfs_name);
    sqlite3_vfs_unregister(&pages->vfs); // the connection keeps its pointer
    if (result != SQLITE_OK)
        return archive_fail_sqlite(archive, result);
    sqlite3_progress_handler(archive->database, STEPS_PER_CHARGE, on_progress, archive);
    return true;
}

bool archive_connect(PetriArchive *archive, const char *name) {
    ArchivePages *pages = archive->pages = heap_calloc(1, sizeof *pages);
    if (!pages)
        return archive_fail(archive, "out of memory");
    pages->file = pages->journal_file = -1;
    // The journal is beside the file to which a symbolic link leads.
    pages->file = file_resolve(name, pages->path) ? archive_open_regular(pages->path, O_NOFOLLOW, &pages->opened) : -1;
    if (pages->file < 0)
        return archive_fail(archive, "%s", strerror(errno));
    if (!open_journal(archive, pages) || !check_header(archive, pages))
        return false;
    archive->content_limit = content_limit(pages);
    return connect(archive, pages);
}

void archive_free_pages(ArchivePages *pages) {
    if (!pages)
        return;
    if (pages->file >= 0)
        close(pages->file);
    if (pages->journal_file >= 0)
        close(pages->journal_file);
    archive_journal_free(&pages->journal);
    heap_free(pages);
}
