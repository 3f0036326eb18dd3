// stdout_file.c: see stdout_file.h.
#include "cli/stdout_file.h"

#include "base/file.h"
#include "cli/cli.h"
#include "cli/memory.h"
#include "cli/output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const formats[] = {"png", "svg", "pdf", "mp4", "m4v", "mov", "mkv", "webm", "ogg", "gif", NULL};

bool stdout_file_is_requested(const char *output) {
    return output && strcmp(output, "-") == 0;
}

static bool is_format(const char *format) {
    for (size_t i = 0; formats[i]; i++)
        if (strcmp(formats[i], format) == 0)
            return true;
    return false;
}

bool stdout_file_check(const char *format) {
    if (format && !is_format(format)) {
        message("option '--format' expects png, svg, pdf, mp4, m4v, mov, mkv, webm, ogg or gif, not '%s'", format);
        return false;
    }
    if (isatty(STDOUT_FILENO)) {
        message("'-o -' cannot write to a terminal; add '>FILE' or '| COMMAND'");
        return false;
    }
    return true;
}

bool stdout_file_open(StdoutFile *piped, const char *format) {
    const char *temporary = getenv("TMPDIR");
    Text folder = {0}, file = {0};
    text_add_format(&folder, "%s/petri.XXXXXX", !temporary || temporary[0] == '\0' ? "/tmp" : temporary);
    if (!mkdtemp(folder.bytes)) {
        message("cannot create folder '%s': %s", folder.bytes, strerror(errno));
        text_free(&folder);
        return false;
    }
    text_add_format(&file, "%s/out.%s", folder.bytes, !format ? "png" : format);
    *piped = (StdoutFile){.folder = folder.bytes, .file = file.bytes};
    return true;
}

bool stdout_file_send(const StdoutFile *piped) {
    int fd = !piped->folder ? -1 : open(piped->file, O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        return true;
    Output *output = memory_calloc(sizeof *output);
    char *block = memory_calloc(sizeof output->buffer);
    ssize_t got = 1;
    output_start(output, STDOUT_FILENO);
    while (got != 0 && output->error == 0) {
        got = file_read_some(fd, block, sizeof output->buffer);
        if (got < 0) {
            message("cannot read '%s': %s", piped->file, strerror(errno));
            break;
        }
        output_write(output, block, got > 0 ? (size_t)got : 0);
    }
    bool sent = output_finish(output, got < 0 ? STATUS_FAILED : STATUS_DONE) == STATUS_DONE;
    close(fd);
    free(block);
    free(output);
    return sent;
}

void stdout_file_close(StdoutFile *piped) {
    if (piped->folder) {
        unlink(piped->file);
        rmdir(piped->folder);
    }
    free(piped->folder);
    free(piped->file);
    *piped = (StdoutFile){0};
}
