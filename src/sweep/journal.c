// journal.c: see journal.h.
#include "sweep/journal.h"

#include "base/file.h"
#include "base/hash_index.h"
#include "base/source.h"
#include "cli/memory.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void add_head(const Sweep *sweep, Text *text) {
    text_add_format(text, "petri sweep 1 %s\n", sweep->identity);
}

static uint64_t checksum(size_t run, int64_t frames, const char *rows, size_t length) {
    return hash_bytes((uint64_t)run * 31 + (uint64_t)frames, rows, length);
}

// Reads the result at *at and advances *at. Returns false if it is incomplete or damaged.
static bool read_run(Sweep *sweep, const Text *text, size_t *at) {
    Str line;
    size_t next = *at, run = 0, length = 0;
    int64_t frames = 0;
    uint64_t sum = 0;
    if (!text_next_line(text, &next, &line) || next > text->len || text->bytes[next - 1] != '\n' ||
        sscanf(text->bytes + *at, "run %zu %" SCNd64 " %zu %" SCNx64 "\n", &run, &frames, &length, &sum) != 4 ||
        run >= sweep->design.run_count || length > text->len - next ||
        checksum(run, frames, text->bytes + next, length) != sum)
        return false;
    sweep_store_result(sweep, run, frames, text->bytes + next, length);
    *at = next + length;
    return true;
}

// Reads the results of a journal. Returns the length of its valid part, or 0 if the journal belongs to another sweep.
static size_t read_runs(Sweep *sweep, const Text *text) {
    SCOPED_TEXT head = {0};
    add_head(sweep, &head);
    size_t at = head.len;
    if (text->len < at || memcmp(text->bytes, head.bytes, at) != 0)
        return 0;
    while (at < text->len && read_run(sweep, text, &at)) {
    }
    return at;
}

static bool is_prefix(const Text *text, const Text *of) {
    return text->len < of->len && memcmp(text->bytes, of->bytes, text->len) == 0;
}

static int lock_journal(const Journal *journal) {
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    return fcntl(journal->file, F_SETLK, &whole);
}

// Reads the existing results and removes an incomplete result at the end of the file. Returns STATUS_DONE or the exit
// status.
static int resume_journal(Journal *journal, Sweep *sweep) {
    SCOPED_TEXT text = {0}, head = {0};
    add_head(sweep, &head);
    if (!text_read(&text, journal->file, SIZE_MAX)) {
        message("cannot read %s: %s", journal->path, strerror(errno));
        return STATUS_FAILED;
    }
    size_t good = read_runs(sweep, &text);
    bool fresh = good == 0 && is_prefix(&text, &head);
    if (good == 0 && !fresh) {
        message("%s belongs to another sweep: script, values or options have changed; to start over, remove that file",
                journal->path);
        return STATUS_USAGE;
    }
    if (!file_truncate(journal->file, good) || lseek(journal->file, (off_t)good, SEEK_SET) < 0 ||
        (fresh && !file_write(journal->file, head.bytes, head.len))) {
        message("cannot write %s: %s", journal->path, strerror(errno));
        return STATUS_FAILED;
    }
    return STATUS_DONE;
}

int journal_open(Journal *journal, Sweep *sweep, const char *output) {
    SCOPED_TEXT path = {0};
    text_add_format(&path, "%s.part", output);
    if (sweep->shards > 1)
        text_add_format(&path, "-%zu-of-%zu", sweep->shard + 1, sweep->shards);
    journal->output = output;
    journal->path = memory_strdup(path.bytes);
    journal->file = open(journal->path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (journal->file < 0) {
        message("cannot write %s: %s", journal->path, errno == ELOOP ? "it is a symbolic link" : strerror(errno));
        return STATUS_FAILED;
    }
    if (lock_journal(journal) != 0) {
        message("%s is in use by another petri process", journal->path);
        return STATUS_FAILED;
    }
    int status = resume_journal(journal, sweep);
    journal_merge(journal, sweep);
    return status;
}

bool journal_add(Journal *journal, size_t run, const Result *result) {
    if (!journal->path)
        return true;
    SCOPED_TEXT text = {0};
    size_t length = strlen(result->rows);
    text_add_format(&text, "run %zu %" PRId64 " %zu %016" PRIx64 "\n", run, result->frames, length,
                    checksum(run, result->frames, result->rows, length));
    text_add(&text, (Str){result->rows, length});
    if (!file_write(journal->file, text.bytes, text.len)) {
        message("cannot write %s: %s", journal->path, strerror(errno));
        return false;
    }
    return true;
}

typedef void Visit(Sweep *sweep, const char *path, const Text *text);

static void read_journal(Sweep *sweep, const char *path, const Text *text) {
    (void)path;
    read_runs(sweep, text);
}

static void remove_journal(Sweep *sweep, const char *path, const Text *text) {
    SCOPED_TEXT head = {0};
    add_head(sweep, &head);
    if (text->len >= head.len && memcmp(text->bytes, head.bytes, head.len) == 0)
        unlink(path);
}

// Calls `call` for the journals of other shards. Skips this shard's journal, because this process holds a lock on it,
// and closing any descriptor of the file would release the lock.
static void visit_journals(const Journal *journal, Sweep *sweep, Visit *call) {
    SCOPED_TEXT prefix = {0};
    SCOPED_STRING folder = memory_folder(journal->output);
    size_t name = path_directory(str_from(journal->output)).len;
    text_add_format(&prefix, "%s.part", journal->output + name);
    DIR *entries = opendir(folder);
    for (struct dirent *entry; entries && (entry = readdir(entries));) {
        SCOPED_TEXT path = {0}, text = {0};
        text_add_format(&path, "%.*s%s", (int)name, journal->output, entry->d_name);
        if (strncmp(entry->d_name, prefix.bytes, prefix.len) == 0 && strcmp(path.bytes, journal->path) != 0) {
            text_read_file(&text, path.bytes, SIZE_MAX);
            call(sweep, path.bytes, &text);
        }
    }
    if (entries)
        closedir(entries);
}

void journal_merge(const Journal *journal, Sweep *sweep) {
    visit_journals(journal, sweep, read_journal);
}

void journal_remove(const Journal *journal, Sweep *sweep) {
    visit_journals(journal, sweep, remove_journal);
    unlink(journal->path);
}

void journal_close(Journal *journal) {
    if (journal->path && journal->file >= 0)
        close(journal->file);
    memory_free_string(&journal->path);
}
