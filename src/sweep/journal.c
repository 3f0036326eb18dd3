// journal.c: see journal.h.
#include "sweep/journal.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/source.h"
#include "base/table.h"

static void add_head(const Sweep *sweep, Bytes *text) {
    bytes_format(text, "petri sweep 1 %s\n", sweep->identity);
}

static uint64_t checksum(size_t run, int64_t frames, const char *rows, size_t length) {
    return hash_bytes((uint64_t)run * 31 + (uint64_t)frames, rows, length);
}

// Takes the run at *at, and on to the next; false if it is not whole.
static bool take_run(Sweep *sweep, const Bytes *text, size_t *at) {
    Str line;
    size_t next = *at, run = 0, length = 0;
    int64_t frames = 0;
    uint64_t sum = 0;
    if (!bytes_line(text, &next, &line) || next > text->length || text->data[next - 1] != '\n' ||
        sscanf(text->data + *at, "run %zu %" SCNd64 " %zu %" SCNx64 "\n", &run, &frames, &length, &sum) != 4 ||
        run >= sweep->design.run_count || length > text->length - next ||
        checksum(run, frames, text->data + next, length) != sum) {
        return false;
    }
    sweep_keep(sweep, run, frames, text->data + next, length);
    *at = next + length;
    return true;
}

// Takes the runs of a journal. Returns how many of its bytes are good, 0 if it is of another sweep.
static size_t take_runs(Sweep *sweep, const Bytes *text) {
    SCOPED_BYTES head = {0};
    add_head(sweep, &head);
    size_t at = head.length;
    if (text->length < at || memcmp(text->data, head.data, at) != 0) {
        return 0;
    }
    while (at < text->length && take_run(sweep, text, &at)) {
    }
    return at;
}

static bool is_beginning(const Bytes *text, const Bytes *of) {
    return text->length < of->length && memcmp(text->data, of->data, text->length) == 0;
}

static int lock(const Journal *journal) {
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    return fcntl(journal->file, F_SETLK, &whole);
}

// Goes on with what is there: cuts off what is not whole.
static int go_on(Journal *journal, Sweep *sweep) {
    SCOPED_BYTES text = {0}, head = {0};
    bytes_add(&text, "", 0);
    add_head(sweep, &head);
    if (!bytes_read(&text, journal->file, SIZE_MAX)) {
        message("cannot read %s: %s", journal->path, strerror(errno));
        return STATUS_FAILED;
    }
    size_t good = take_runs(sweep, &text);
    bool fresh = good == 0 && is_beginning(&text, &head);
    if (good == 0 && !fresh) {
        message("%s is of another sweep: script, values or options have changed since; remove it to begin anew",
                journal->path);
        return STATUS_USAGE;
    }
    if (!file_cut(journal->file, good) || lseek(journal->file, (off_t)good, SEEK_SET) < 0 ||
        (fresh && !file_write(journal->file, head.data, head.length))) {
        message("cannot write %s: %s", journal->path, strerror(errno));
        return STATUS_FAILED;
    }
    return STATUS_DONE;
}

int journal_open(Journal *journal, Sweep *sweep, const char *output) {
    SCOPED_BYTES path = {0};
    bytes_format(&path, "%s.part", output);
    if (sweep->shards > 1) {
        bytes_format(&path, "-%zu-of-%zu", sweep->shard + 1, sweep->shards);
    }
    journal->output = output;
    journal->path = memory_text(path.data);
    journal->file = open(journal->path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (journal->file < 0) {
        message("cannot write %s: %s", journal->path, strerror(errno));
        return STATUS_FAILED;
    }
    if (lock(journal) != 0) {
        message("another petri is at work on %s", journal->path);
        return STATUS_FAILED;
    }
    int status = go_on(journal, sweep);
    journal_gather(journal, sweep);
    return status;
}

bool journal_add(Journal *journal, size_t run, const Result *result) {
    if (journal->path == NULL) {
        return true;
    }
    SCOPED_BYTES text = {0};
    size_t length = strlen(result->rows);
    bytes_format(&text, "run %zu %" PRId64 " %zu %016" PRIx64 "\n", run, result->frames, length,
                 checksum(run, result->frames, result->rows, length));
    bytes_add(&text, result->rows, length);
    if (!file_write(journal->file, text.data, text.length)) {
        message("cannot write %s: %s", journal->path, strerror(errno));
        return false;
    }
    return true;
}

typedef void Visit(Sweep *sweep, const char *path, const Bytes *text);

static void take(Sweep *sweep, const char *path, const Bytes *text) {
    (void)path;
    take_runs(sweep, text);
}

static void drop(Sweep *sweep, const char *path, const Bytes *text) {
    SCOPED_BYTES head = {0};
    add_head(sweep, &head);
    if (text->length >= head.length && memcmp(text->data, head.data, head.length) == 0) {
        unlink(path);
    }
}

// Visits the other journals beside the table. Not our own: to close a file gives its lock up.
static void visit(const Journal *journal, Sweep *sweep, Visit *call) {
    SCOPED_BYTES folder = {0}, prefix = {0};
    size_t name = path_directory(str_from(journal->output)).len;
    bytes_format(&folder, "%.*s", name == 0 ? 1 : (int)name, name == 0 ? "." : journal->output);
    bytes_format(&prefix, "%s.part", journal->output + name);
    DIR *entries = opendir(folder.data);
    for (struct dirent *entry; entries != NULL && (entry = readdir(entries)) != NULL;) {
        SCOPED_BYTES path = {0}, text = {0};
        bytes_format(&path, "%.*s%s", (int)name, journal->output, entry->d_name);
        if (strncmp(entry->d_name, prefix.data, prefix.length) == 0 && strcmp(path.data, journal->path) != 0) {
            bytes_add(&text, "", 0);
            bytes_read_file(&text, path.data);
            call(sweep, path.data, &text);
        }
    }
    if (entries != NULL) {
        closedir(entries);
    }
}

void journal_gather(const Journal *journal, Sweep *sweep) {
    visit(journal, sweep, take);
}

void journal_remove(const Journal *journal, Sweep *sweep) {
    visit(journal, sweep, drop);
    unlink(journal->path);
}

void journal_close(Journal *journal) {
    if (journal->path != NULL && journal->file >= 0) {
        close(journal->file);
    }
    memory_drop(&journal->path);
}
