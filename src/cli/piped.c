// piped.c: see piped.h.
#include "cli/piped.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/bytes.h"
#include "cli/cli.h"
#include "cli/output.h"

static const char *const formats[] = {"png", "svg", "pdf", "mp4", "webm", "gif", NULL};

bool piped_wanted(const char *output) {
    return output != NULL && strcmp(output, "-") == 0;
}

static bool is_format(const char *format) {
    for (size_t i = 0; formats[i] != NULL; i++) {
        if (strcmp(formats[i], format) == 0) {
            return true;
        }
    }
    return false;
}

bool piped_check(const char *format) {
    if (format != NULL && !is_format(format)) {
        message("option '--format' expects png, svg, pdf, mp4, webm or gif, not '%s'", format);
        return false;
    }
    if (isatty(STDOUT_FILENO)) {
        message(
            "standard output is a terminal, which '-o -' would fill with bytes: put '>FILE' or '| COMMAND' behind it");
        return false;
    }
    return true;
}

bool piped_open(Piped *piped, const char *format) {
    const char *temporary = getenv("TMPDIR");
    Bytes folder = {0}, file = {0};
    bytes_format(&folder, "%s/petri.XXXXXX", temporary == NULL || temporary[0] == '\0' ? "/tmp" : temporary);
    if (mkdtemp(folder.data) == NULL) {
        message("cannot make a folder '%s': %s", folder.data, strerror(errno));
        bytes_free(&folder);
        return false;
    }
    bytes_format(&file, "%s/out.%s", folder.data, format == NULL ? "png" : format);
    *piped = (Piped){.folder = folder.data, .file = file.data};
    return true;
}

bool piped_send(const Piped *piped) {
    int fd = piped->folder == NULL ? -1 : open(piped->file, O_RDONLY | O_CLOEXEC);
    if (fd < 0) {
        return true;
    }
    Output *output = memory_zeroed(sizeof *output);
    char *block = memory_zeroed(sizeof output->buffer);
    ssize_t got = 1;
    output_start(output, STDOUT_FILENO);
    while (got != 0 && output->error == 0) {
        got = read(fd, block, sizeof output->buffer);
        if (got < 0 && errno != EINTR) {
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

void piped_close(Piped *piped) {
    if (piped->folder != NULL) {
        unlink(piped->file);
        rmdir(piped->folder);
    }
    free(piped->folder);
    free(piped->file);
    *piped = (Piped){0};
}
