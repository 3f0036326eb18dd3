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
#include <sys/stat.h>
#include <unistd.h>

static void add_head(const Sweep *sweep, Text *text) {
    text_add_format(text, "petri sweep 2 %s\n", sweep->identity);
}

static uint64_t checksum(size_t run, int64_t frames, Str rows) {
    return hash_bytes((uint64_t)run * 31 + (uint64_t)frames, rows.bytes, rows.len);
}

// A journal that is read in pieces, because another file beside the table can be endless.
typedef struct JournalReader {
    int file;
    Text text;   // the bytes that were read from the file, except those before `start`
    size_t at;   // position in `text`
    off_t start; // position of `text` in the file
    int error;   // errno of a failed read; 0: none failed
} JournalReader;

// Reads until `needed` bytes follow the position. Returns false if the file ends earlier or cannot be read.
static bool fill(JournalReader *in, size_t needed) {
    enum { BLOCK = 1 << 16 };
    Text *text = &in->text;
    if (text->len - in->at >= needed)
        return true;
    if (in->at > 0)
        memmove(text->bytes, text->bytes + in->at, text->len - in->at);
    in->start += (off_t)in->at;
    text->len -= in->at;
    in->at = 0;
    while (text->len < needed) {
        text_reserve(text, BLOCK);
        ssize_t got = file_read_some(in->file, text->bytes + text->len, BLOCK - 1);
        if (got < 0)
            in->error = errno;
        if (got <= 0)
            return false;
        text->len += (size_t)got;
    }
    return true;
}

// Reads the result at the position and advances. Returns false if it is incomplete or damaged.
static bool read_run(Sweep *sweep, JournalReader *in) {
    enum { MAX_LINE = 100, MAX_ROWS = 1 << 30 };
    char line[MAX_LINE + 1];
    size_t run = 0, length = 0;
    int64_t frames = 0;
    uint64_t sum = 0;
    fill(in, MAX_LINE); // shorter at the end of the file
    size_t rest = in->text.len - in->at;
    const char *end = rest ? memchr(in->text.bytes + in->at, '\n', rest < MAX_LINE ? rest : MAX_LINE) : NULL;
    size_t used = end ? (size_t)(end + 1 - in->text.bytes) - in->at : 0;
    memcpy(line, in->text.bytes + in->at, used);
    line[used] = '\0';
    if (!end || sscanf(line, "run %zu %" SCNd64 " %zu %" SCNx64 "\n", &run, &frames, &length, &sum) != 4 ||
        run >= sweep->design.run_count || length > MAX_ROWS || !fill(in, used + length + 1))
        return false;
    Str rows = {in->text.bytes + in->at + used, length};
    if (rows.bytes[length] != '\n' || checksum(run, frames, rows) != sum || !rows_are_valid(sweep, rows))
        return false;
    sweep_store_result(sweep, run, frames, rows);
    in->at += used + length + 1;
    return true;
}

typedef enum JournalKind { JOURNAL_OTHER, JOURNAL_NEW, JOURNAL_OURS } JournalKind;

// Reads the first line of a file: does it belong to a journal of this sweep, or is it a part of that line?
static JournalKind read_head(const Sweep *sweep, JournalReader *in) {
    SCOPED_TEXT head = {0};
    add_head(sweep, &head);
    bool complete = fill(in, head.len);
    size_t length = complete ? head.len : in->text.len;
    if (length > 0 && memcmp(in->text.bytes, head.bytes, length) != 0)
        return JOURNAL_OTHER;
    in->at = complete ? length : 0;
    return complete ? JOURNAL_OURS : JOURNAL_NEW;
}

static int lock_journal(const Journal *journal) {
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    return fcntl(journal->file, F_SETLK, &whole);
}

// Reads the existing results and removes an incomplete result at the end of the file. Returns STATUS_DONE or the exit
// status.
static int resume_journal(Journal *journal, Sweep *sweep) {
    SCOPED_TEXT head = {0};
    add_head(sweep, &head);
    JournalReader in = {.file = journal->file};
    JournalKind kind = read_head(sweep, &in);
    while (kind == JOURNAL_OURS && read_run(sweep, &in)) {
    }
    off_t good = in.start + (off_t)in.at;
    text_free(&in.text);
    if (in.error) {
        message("cannot read %s: %s", journal->path, strerror(in.error));
        return STATUS_FAILED;
    }
    if (kind == JOURNAL_OTHER) {
        message("%s belongs to another sweep: script, values, options or petri's version have changed; to start over, "
                "remove that file",
                journal->path);
        return STATUS_USAGE;
    }
    if (!file_truncate(journal->file, (size_t)good) || lseek(journal->file, good, SEEK_SET) < 0 ||
        (kind == JOURNAL_NEW && !file_write(journal->file, head.bytes, head.len))) {
        message("cannot write %s: %s", journal->path, strerror(errno));
        return STATUS_FAILED;
    }
    return STATUS_DONE;
}

// Returns why an opened file cannot be a journal, or NULL.
static const char *open_problem(int file) {
    struct stat info;
    if (file < 0)
        return errno == ELOOP ? "it is a symbolic link" : strerror(errno);
    return fstat(file, &info) == 0 && S_ISREG(info.st_mode) ? NULL : "it is not a regular file";
}

int journal_open(Journal *journal, Sweep *sweep, const char *output) {
    SCOPED_TEXT path = {0};
    text_add_format(&path, "%s.part", output);
    if (sweep->shards > 1)
        text_add_format(&path, "-%zu-of-%zu", sweep->shard + 1, sweep->shards);
    journal->output = output;
    journal->path = memory_strdup(path.bytes);
    journal->file = file_open_at(AT_FDCWD, journal->path, O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK, 0666);
    const char *problem = open_problem(journal->file);
    if (problem) {
        message("cannot write %s: %s", journal->path, problem);
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
    text_add_format(&text, "run %zu %" PRId64 " %zu %016" PRIx64 "\n", run, result->frames, result->rows.len,
                    checksum(run, result->frames, result->rows));
    text_add(&text, result->rows);
    text_add_char(&text, '\n');
    if (!file_write(journal->file, text.bytes, text.len)) {
        message("cannot write %s: %s", journal->path, strerror(errno));
        return false;
    }
    return true;
}

// Reads or removes a file if it is a journal of this sweep. Other files are not read beyond their first bytes.
static void visit_journal(Sweep *sweep, const char *path, bool remove) {
    struct stat info;
    JournalReader in = {.file = file_open_at(AT_FDCWD, path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK, 0)};
    if (in.file < 0)
        return;
    bool ours = fstat(in.file, &info) == 0 && S_ISREG(info.st_mode) && read_head(sweep, &in) == JOURNAL_OURS;
    if (ours && remove)
        unlink(path);
    while (ours && !remove && read_run(sweep, &in)) {
    }
    text_free(&in.text);
    close(in.file);
}

// Visits the journals of other shards. Skips this shard's journal, because this process holds a lock on it, and closing
// any descriptor of the file would release the lock.
static void visit_journals(const Journal *journal, Sweep *sweep, bool remove) {
    SCOPED_TEXT prefix = {0};
    SCOPED_STRING folder = memory_folder(journal->output);
    size_t name = path_directory(str_from(journal->output)).len;
    text_add_format(&prefix, "%s.part", journal->output + name);
    DIR *entries = opendir(folder);
    for (struct dirent *entry; entries && (entry = readdir(entries));) {
        SCOPED_TEXT path = {0};
        text_add_format(&path, "%.*s%s", (int)name, journal->output, entry->d_name);
        if (strncmp(entry->d_name, prefix.bytes, prefix.len) == 0 && strcmp(path.bytes, journal->path) != 0)
            visit_journal(sweep, path.bytes, remove);
    }
    if (entries)
        closedir(entries);
}

void journal_merge(const Journal *journal, Sweep *sweep) {
    visit_journals(journal, sweep, false);
}

void journal_remove(const Journal *journal, Sweep *sweep) {
    visit_journals(journal, sweep, true);
    unlink(journal->path);
}

void journal_close(Journal *journal) {
    if (journal->path && journal->file >= 0)
        close(journal->file);
    memory_free_string(&journal->path);
}
