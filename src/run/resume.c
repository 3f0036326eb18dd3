// resume.c: see resume.h.
//
// Nothing is removed from a file before its content up to the given frame was recognised as a trajectory. Then
// everything after the last complete frame is removed, and the run appends as if it had never stopped.
#include "run/resume.h"

#include "base/file.h"
#include "base/os.h"
#include "cli/cli.h"
#include "cli/hdf5.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BLOCK = 1 << 16, MAX_LINE = 256 << 20 };

// A file that is read line by line.
typedef struct Lines {
    int fd;
    Text line;    // current line with its line feed
    size_t end;   // offset of the line's end in the file
    int error;    // errno of a failed read; 0: none failed
    size_t at;    // position in `block`
    size_t count; // number of bytes in `block`
    char block[BLOCK];
} Lines;

// Reads the next line. Returns false at the end of the file, at an incomplete last line, which has no line feed, and at
// a line that is too long.
static bool next_line(Lines *lines) {
    for (lines->line.len = 0; lines->line.len <= MAX_LINE;) {
        const char *rest = lines->block + lines->at, *feed = memchr(rest, '\n', lines->count - lines->at);
        size_t length = feed ? (size_t)(feed + 1 - rest) : lines->count - lines->at;
        text_add(&lines->line, (Str){rest, length});
        lines->at += length;
        if (feed) {
            lines->end += lines->line.len;
            return true;
        }
        ssize_t got = file_read_some(lines->fd, lines->block, BLOCK);
        lines->error = got < 0 ? errno : 0;
        if (got <= 0)
            return false;
        lines->at = 0;
        lines->count = (size_t)got;
    }
    return false;
}

// Parses an integer >= 0 that is followed by one of the characters in `ends`. Returns false if there is no such
// integer.
static bool read_integer(const char *text, const char *ends, int64_t *number) {
    char *end = NULL;
    errno = 0;
    *number = strtoll(text, &end, 10);
    return errno == 0 && end > text && text[0] >= '0' && text[0] <= '9' && strchr(ends, *end) && *end != '\0';
}

// read_xyz and read_csv find the last complete frame that is not later than frame `after`. They set file->last to its
// number and file->end to the offset of its end. They return false if the file is not a trajectory written by petri.

static bool read_xyz(Lines *lines, int64_t after, XyzNames *names, ResumeFile *file) {
    int64_t count = 0, frame = 0;
    while (next_line(lines)) {
        if (!read_integer(lines->line.bytes, "\n", &count))
            return false;
        if (!next_line(lines))
            return true;
        const char *number = strstr(lines->line.bytes, " Frame=");
        if (strncmp(lines->line.bytes, "Properties=species:S:1:pos:R:3:", 31) != 0 || !number ||
            !read_integer(number + strlen(" Frame="), "\n", &frame))
            return false;
        if (frame > after)
            return true;
        if (!xyz_read_names(names, lines->line.bytes))
            return false;
        while (count > 0 && next_line(lines))
            count--;
        if (count > 0)
            return true;
        file->end = lines->end;
        file->last = frame;
    }
    return true;
}

// Reads the header `frame,time,system,id,anchor,x1,…,v1,…,radius,mass,charge`, perhaps with
// `kinetic_energy,potential_energy`.
static bool read_header(const Lines *lines, ResumeFile *file) {
    static const char first[] = "frame,time,system,id,anchor,x1";
    if (strncmp(lines->line.bytes, first, sizeof first - 1) != 0)
        return false;
    for (const char *at = lines->line.bytes; (at = strstr(at, ",x")); at++)
        file->dimensions++;
    file->energies = strstr(lines->line.bytes, ",potential_energy");
    file->end = lines->end;
    return true;
}

static bool read_csv(Lines *lines, int64_t after, ResumeFile *file) {
    int64_t frame = 0;
    if (next_line(lines) && !read_header(lines, file))
        return false;
    while (next_line(lines)) {
        if (!read_integer(lines->line.bytes, ",", &frame))
            return false;
        if (frame > after)
            return true;
        file->end = lines->end;
        file->last = frame;
    }
    return true;
}

static bool report_error(const char *path, const char *why) {
    message("cannot continue %s: %s", path, why);
    return false;
}

static bool read_existing(ResumeFile *file, const char *path, XyzNames *names, int64_t after) {
    struct stat info;
    if (!os_lock(file->fd) && errno == EWOULDBLOCK)
        return report_error(path, "the file is in use by another petri process");
    if (fstat(file->fd, &info) != 0 || !S_ISREG(info.st_mode))
        return report_error(path, "not a regular file");
    Lines lines = {.fd = file->fd};
    bool known = names ? read_xyz(&lines, after, names, file) : read_csv(&lines, after, file);
    text_free(&lines.line);
    if (lines.error)
        return report_error(path, strerror(lines.error));
    if (!known)
        return report_error(path, TRAJECTORY_FILE_UNKNOWN);
    return (file_truncate(file->fd, file->end) && lseek(file->fd, 0, SEEK_END) >= 0) ||
           report_error(path, strerror(errno));
}

bool resume_open(ResumeFile *file, const char *path, XyzNames *names, int64_t after) {
    *file = (ResumeFile){.last = -1};
    file->fd = file_open_at(AT_FDCWD, path, O_RDWR | O_NONBLOCK, 0);
    if (file->fd < 0)
        return errno == ENOENT || report_error(path, strerror(errno));
    if (!read_existing(file, path, names, after)) {
        close(file->fd);
        file->fd = -1;
        return false;
    }
    return true;
}

void resume_report_gap(const char *path, int64_t last, const Resume *resume) {
    if (last < resume->expected) {
        message("frames %" PRId64 " to %" PRId64 " are missing in %s, which continues with frame %" PRId64, last + 1,
                resume->after, path, resume->after + 1);
    }
}
